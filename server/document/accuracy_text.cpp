#include "server/document/accuracy_text.h"

#include <array>
#include <cmath>
#include <utility>

#include "server/document/json_text.h"

namespace awan {
namespace {

using json_text::member;
using json_text::name;

void rung_object(const RungCost& rung, std::string& out) {
    out += '{';
    member("rung", std::string_view(rung.rung), out);
    member("time_ms", rung.time_ms, out);
    member("light_ms", rung.light_ms, out);
    member("draw_ms", rung.draw_ms, out);
    member("error", rung.error.nrmse, out);
    member("error_noise", rung.error.nrmse_noise, out);
    member("bias", rung.error.bias, out);
    member("bias_noise", rung.error.bias_noise, out);
    member("flip", rung.flip, out);
    member("stated", rung.stated_error, out);
    name("predicted", out);
    out += '{';
    member("error", rung.predicted_error, out);
    member("time_ms", rung.predicted_time_ms, out);
    out += '}';
    member("memory_bytes", rung.memory_bytes, out);
    member("runs", rung.runs, out);
    member("pareto", rung.pareto, out);
    out += '}';
}

// The members of a report, without its braces.
void members(const AccuracyReport& report, std::string& out) {
    member("width", report.width, out);
    member("height", report.height, out);
    const AccuracyReport::Reference& reference = report.reference;
    name("reference", out);
    out += '{';
    member("rung", std::string_view("truth"), out);
    member("width", reference.width, out);
    member("height", reference.height, out);
    member("samples", std::uint64_t{reference.samples}, out);
    member("noise", reference.noise, out);
    member("time_ms", reference.time_ms, out);
    member("cpu_ms", reference.cpu_ms, out);
    out += '}';
    name("rungs", out);
    out += '[';
    for (const RungCost& rung : report.rungs) {
        out += out.back() == '[' ? "\n" : ",\n";
        rung_object(rung, out);
    }
    out += ']';
    name("left_out", out);
    out += '[';
    for (const AccuracyReport::LeftOut& rung : report.left_out) {
        if (out.back() != '[') out += ',';
        out += '{';
        member("rung", std::string_view(rung.rung), out);
        member("reason", std::string_view(rung.reason), out);
        out += '}';
    }
    out += ']';
}

void cell(double value, std::string& out) {
    out += ',';
    if (std::isfinite(value)) append_json_number(value, out);
}

// RFC 4180: quoted where it has to be.
std::string csv_text(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

}  // namespace

std::string accuracy_to_json(std::span<const NamedAccuracy> reports) {
    std::string out = "{";
    if (reports.size() == 1) {
        members(reports[0].report, out);
        return out + "}\n";
    }
    name("scenes", out);
    out += '[';
    for (const NamedAccuracy& named : reports) {
        out += out.back() == '[' ? "{" : ",\n{";
        member("scene", std::string_view(named.name), out);
        members(named.report, out);
        out += '}';
    }
    return out + "]}\n";
}

std::string accuracy_to_csv(std::span<const NamedAccuracy> reports) {
    const bool several = reports.size() > 1;
    std::string out = several ? "scene," : "";
    out +=
        "rung,time_ms,light_ms,draw_ms,error,error_noise,bias,bias_noise,flip,stated,predicted_"
        "error,"
        "predicted_time_ms,memory_bytes,runs,pareto\n";
    for (const NamedAccuracy& named : reports)
        for (const RungCost& rung : named.report.rungs) {
            if (several) out += csv_text(named.name) + ',';
            out += rung.rung;
            for (const double value :
                 {rung.time_ms, rung.light_ms, rung.draw_ms, rung.error.nrmse,
                  rung.error.nrmse_noise, rung.error.bias, rung.error.bias_noise, rung.flip,
                  rung.stated_error, rung.predicted_error, rung.predicted_time_ms,
                  rung.memory_bytes})
                cell(value, out);
            out += ',' + std::to_string(rung.runs) + (rung.pareto ? ",true\n" : ",false\n");
        }
    return out;
}

}  // namespace awan
