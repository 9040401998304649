// Values -> answers. Written piece by piece: an answer may be a million particles long.
#include <limits>

#include "server/document/json.h"
#include "server/document/json_text.h"

namespace awan {
namespace {

using json_text::member;
using json_text::name;

void bounds(const Bounds& box, std::string& out) {
    name("bounds", out);
    out += "{\"min\":";
    append_json_vector(box.min, out);
    out += ",\"max\":";
    append_json_vector(box.max, out);
    out += '}';
}

void survey_object(const Survey& survey, std::string& out) {
    out += '{';
    member("particles", std::uint64_t{survey.particles}, out);
    name("density", out);
    out += '[';
    for (const double density : survey.cloud_density) {
        if (out.back() != '[') out += ',';
        append_json_number(density, out);
    }
    out += ']';
    bounds(survey.bounds, out);
    name("optical_depth", out);
    out += '{';
    member("sun", survey.optical_depth_sun, out);
    member("zenith", survey.optical_depth_zenith, out);
    member("eye", survey.optical_depth_eye, out);
    out += '}';
    member("total_mass", survey.total_mass, out);          // unit^2
    member("max_extinction", survey.max_extinction, out);  // 1/unit
    member("max_sigma_s", survey.max_sigma_s, out);
    name("projected_px", out);
    out += '{';
    member("min", survey.min_projected_px, out);  // null: the eye is in it
    member("max", survey.max_projected_px, out);
    out += '}';
    member("eye_inside", survey.eye_inside, out);
    member("model_error", survey.model_error, out);
    name("volume", out);
    const glm::ivec3& cells = survey.volume.cells;
    out += "{\"cells\":[" + std::to_string(cells.x) + ',' + std::to_string(cells.y) + ',' +
           std::to_string(cells.z) + ']';
    member("cell", survey.volume.cell, out);  // unit
    out += "}}";
}

}  // namespace

std::string particles_json_head(const ParticleSet& particles, std::uint64_t seed) {
    std::string out = "{";
    member("count", std::uint64_t{particles.size()}, out);
    member("seed", seed, out);
    bounds(bounds_of(particles), out);
    name("particles", out);
    out += "[\n";
    return out;
}

void append_particles_json(const ParticleSet& particles, std::size_t first, std::size_t last,
                           std::string& out) {
    for (std::size_t i = first; i < last; ++i) {
        out += i == 0 ? "{\"center\":" : ",\n{\"center\":";
        append_json_vector(particles.center[i], out);
        out += ",\"radius\":";
        append_json_number(particles.radius[i], out);
        out += ",\"density\":";
        append_json_number(particles.density[i], out);
        if (particles.color.empty()) {
            out += ",\"color\":[1,1,1]}";
        } else {
            out += ",\"color\":";
            append_json_vector(particles.color[i], out);
            out += '}';
        }
    }
}

std::string particles_json_tail() {
    return "\n]}\n";
}

std::string plan_to_json(const Survey& survey, const Plan& plan) {
    std::string out = "{\"survey\":";
    survey_object(survey, out);
    name("effects", out);
    out += '[';
    for (const EffectDecision& decision : plan.effects) {
        if (out.back() != '[') out += ',';
        out += '{';
        member("name", std::string_view(effect_name(decision.effect)), out);
        member("on", decision.on, out);
        member("available", true, out);  // every effect of the contract is there
        member("reason", std::string_view(decision.reason), out);
        member("error_left_out", decision.left_out, out);
        out += '}';
    }
    out += ']';
    member("rung", std::string_view(plan.rung), out);
    member("rung_reason", std::string_view(plan.rung_reason), out);
    name("predicted", out);
    out += '{';
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const bool predicted = plan.predicted.rung != nullptr;
    member("error", predicted ? plan.predicted.error : unknown, out);
    member("time_ms", predicted ? plan.predicted.time_ms : unknown, out);
    out += '}';
    name("rungs", out);
    out += '[';
    for (const RungForecast& forecast : plan.forecasts) {
        if (out.back() != '[') out += ',';
        out += '{';
        member("rung", std::string_view(forecast.rung->name), out);
        member("simulates", std::string_view(forecast.rung->simulates), out);
        member("error", forecast.error, out);
        member("time_ms", forecast.time_ms, out);
        member("memory_bytes", forecast.bytes, out);
        out += '}';
    }
    out += "]}\n";
    return out;
}

std::string problem_to_json(int status, std::string_view title, std::string_view detail,
                            std::string_view pointer, std::string_view request_id) {
    // RFC 9457: "about:blank" says that the status means all there is to mean.
    std::string out = R"({"type":"about:blank")";
    member("title", title, out);
    name("status", out);
    out += std::to_string(status);
    member("detail", detail, out);
    // "" is the whole document: worth saying of a scene that cannot be, nowhere else.
    if (!pointer.empty() || status == 422) member("pointer", pointer, out);
    member("request_id", request_id, out);
    out += "}\n";
    return out;
}

std::string presets_to_json(const PresetEntry* first, std::size_t count) {
    std::string out = R"({"presets":[)";
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) out += ',';
        out += '{';
        member("name", first[i].name, out);
        member("title", first[i].title, out);
        if (!first[i].genus.empty()) member("genus", first[i].genus, out);
        member("href", std::string_view("/v1/presets/" + std::string(first[i].name)), out);
        out += '}';
    }
    out += "]}\n";
    return out;
}

std::string version_to_json(const DeviceInfo* device, std::string_view no_device_reason) {
    std::string out = R"({"name":"awan")";
    member("version", std::string_view(AWAN_VERSION), out);
    name("renderer", out);
    if (device == nullptr) {
        out += "null";
        member("reason", no_device_reason, out);
    } else {
        out += '{';
        member("name", std::string_view(device->renderer), out);
        member("version", std::string_view(device->version), out);
        member("platform", std::string_view(device->platform), out);
        member("software", device->software, out);
        out += "},\"reason\":null";
    }
    out += "}\n";
    return out;
}

}  // namespace awan
