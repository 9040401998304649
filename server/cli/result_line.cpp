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

using Times = std::vector<std::pair<const char*, double>>;

void append_times(const Times& times, std::string& out) {
    json_text::name("times_ms", out);
    out += '{';
    for (const auto& [name, ms] : times) json_text::member(name, std::round(ms * 1000) / 1000, out);
    out += '}';
}

// The first members, which every line has.
std::string begin_line(const std::string& scene, const std::vector<std::string>& outputs) {
    std::string out = "{";
    json_text::member("scene", std::string_view(scene), out);
    json_text::name("outputs", out);
    out += '[';
    for (const std::string& output : outputs) {
        if (out.back() != '[') out += ',';
        append_json_string(output, out);
    }
    return out + ']';
}

void append_what(const Scene& scene, bool skipped, int width, int height, std::string& out) {
    json_text::member("skipped", skipped, out);
    json_text::member("digest", std::string_view(fingerprint(scene)), out);
    json_text::member("width", width, out);
    json_text::member("height", height, out);
}

}  // namespace

std::string result_json(const PictureResult& result, const Scene& scene, const Rendered* rendered) {
    using json_text::member;
    std::string out = begin_line(result.scene, result.outputs);
    if (result.frame) member("frame", *result.frame, out);
    append_what(scene, result.skipped, scene->image.width, scene->image.height, out);
    if (rendered != nullptr) {
        member("particles", static_cast<std::uint64_t>(rendered->survey.particles), out);
        member("rung",
               std::string_view(rendered->rung != nullptr ? rendered->rung->name
                                                          : rendered->plan.rung),
               out);
        member("error", rendered->stated_error, out);
        member("error_forecast", rendered->plan.predicted.error, out);
        const StageTimes& times = rendered->times;
        append_times({{"generate", times.generate_ms},
                      {"survey", times.survey_ms},
                      {"light", times.light_ms},
                      {"draw", times.draw_ms},
                      {"measure", times.measure_ms},
                      {"encode", result.encode_ms}},
                     out);
    }
    return out + "}\n";
}

std::string result_json(const FileResult& result, const Scene& scene) {
    std::string out = begin_line(result.scene, result.outputs);
    append_what(scene, result.skipped, result.width, result.height, out);
    if (!result.times.empty()) append_times(result.times, out);
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
