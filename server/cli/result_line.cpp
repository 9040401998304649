#include "server/cli/result_line.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/scene/fingerprint.h"
#include "server/document/json_text.h"

namespace awan {
namespace {

std::string percent(double share) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g%%", 100 * share);
    return text.data();
}

void append_times(const StageTimes& times, double encode_ms, std::string& out) {
    json_text::name("times_ms", out);
    out += '{';
    const std::pair<const char*, double> all[] = {
        {"generate", times.generate_ms}, {"survey", times.survey_ms},   {"light", times.light_ms},
        {"draw", times.draw_ms},         {"measure", times.measure_ms}, {"encode", encode_ms}};
    for (const auto& [name, ms] : all) json_text::member(name, std::round(ms * 1000) / 1000, out);
    out += '}';
}

}  // namespace

std::string result_json(const PictureResult& result, const Scene& scene, const Rendered* rendered) {
    using json_text::member;
    std::string out = "{";
    member("scene", std::string_view(result.scene), out);
    json_text::name("outputs", out);
    out += '[';
    for (const std::string& output : result.outputs) {
        if (out.back() != '[') out += ',';
        append_json_string(output, out);
    }
    out += ']';
    if (result.frame) member("frame", *result.frame, out);
    member("skipped", result.skipped, out);
    member("digest", std::string_view(fingerprint(scene)), out);
    member("width", scene->image.width, out);
    member("height", scene->image.height, out);
    if (rendered != nullptr) {
        member("particles", static_cast<std::uint64_t>(rendered->survey.particles), out);
        member("rung",
               std::string_view(rendered->rung != nullptr ? rendered->rung->name
                                                          : rendered->plan.rung),
               out);
        member("error", rendered->stated_error, out);
        member("error_forecast", rendered->plan.predicted.error, out);
        append_times(rendered->times, result.encode_ms, out);
    }
    return out + "}\n";
}

std::string result_text(const std::string& output, const Rendered& rendered) {
    const double expected = rendered.plan.predicted.error;
    if (std::isfinite(rendered.stated_error))
        return output + ": " + rendered.plan.rung + ", error " + percent(rendered.stated_error) +
               " (expected " + percent(expected) + ")\n";
    if (!std::isfinite(expected)) return {};
    return output + ": " + rendered.plan.rung +
           ", error not measured, the time is too short (expected " + percent(expected) + ")\n";
}

}  // namespace awan
