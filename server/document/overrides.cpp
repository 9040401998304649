#include "server/document/overrides.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "core/formats/numbers.h"
#include "core/scene/layers.h"
#include "core/scene/limits.h"
#include "core/scene/rungs.h"

namespace awan {
namespace {

constexpr std::array<std::string_view, 10> kNames = {"width",  "height", "format", "background",
                                                     "layers", "seed",   "error",  "time_ms",
                                                     "rung",   "radius"};

Error wrong_value(std::string_view name, const std::string& wanted, std::string_view value) {
    return {ErrorCode::kMalformed, "",
            "query parameter `" + std::string(name) + "` must be " + wanted + ", not " +
                short_quote(value)};
}

Status read_side(std::string_view name, std::string_view value, std::optional<int>& to) {
    const auto number = read_number<int>(value);
    if (!number || *number < 1 || *number > limits::kMaxImageSide)
        return wrong_value(name, "an integer from 1 to " + std::to_string(limits::kMaxImageSide),
                           value);
    to = *number;
    return std::nullopt;
}

Status read_positive(std::string_view name, std::string_view value, std::optional<double>& to) {
    const auto number = read_number<double>(value);
    if (!number || !(*number > 0)) return wrong_value(name, "a number > 0", value);
    to = *number;
    return std::nullopt;
}

Status read_rung(std::string_view value, std::optional<std::string>& to) {
    to = value;
    if (find_rung(value) != nullptr) return std::nullopt;
    std::string names;
    for (const Rung& rung : ladder()) names += (names.empty() ? "" : ", ") + std::string(rung.name);
    return wrong_value("rung", "one of " + names, value);
}

Status read_one(std::string_view name, std::string_view value, Overrides& to) {
    if (name == "width") return read_side(name, value, to.width);
    if (name == "height") return read_side(name, value, to.height);
    if (name == "error") return read_positive(name, value, to.error);
    if (name == "time_ms") return read_positive(name, value, to.time_ms);
    if (name == "radius") return read_positive(name, value, to.radius);
    if (name == "rung") return read_rung(value, to.rung);
    if (name == "format") {
        if (value.empty())
            return wrong_value(name, "the name of a format, such as json or png", value);
        to.format = value;
    } else if (name == "background") {
        if (value != "sky" && value != "transparent")
            return wrong_value(name, "sky or transparent", value);
        to.background = value == "sky" ? Background::kSky : Background::kTransparent;
    } else if (name == "layers") {
        if (!read_layers(value)) return wrong_value(name, std::string(kLayersWanted), value);
        to.layers = value;
    } else if (name == "seed") {
        to.seed = read_number<std::uint64_t>(value);
        if (!to.seed) return wrong_value(name, "an integer from 0 to 18446744073709551615", value);
    }
    return std::nullopt;
}

}  // namespace

bool is_override(std::string_view name) {
    return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

Result<Overrides> read_overrides(std::span<const std::pair<std::string, std::string>> query) {
    Overrides overrides;
    std::array<bool, kNames.size()> seen{};
    for (const auto& [name, value] : query) {
        const auto at = std::find(kNames.begin(), kNames.end(), name);
        if (at == kNames.end()) continue;
        if (std::exchange(seen[static_cast<std::size_t>(at - kNames.begin())], true))
            return Error{ErrorCode::kMalformed, "", "query parameter `" + name + "` stands twice"};
        if (Status wrong = read_one(name, value, overrides)) return *wrong;
    }
    if (overrides.error.has_value() + overrides.time_ms.has_value() + overrides.rung.has_value() >
        1)
        return Error{ErrorCode::kMalformed, "",
                     "give at most one of the query parameters error, time_ms and rung"};
    return overrides;
}

void override_scene(const Overrides& overrides, SceneDraft& draft) {
    ImageSettings& image = draft.image;
    if (overrides.width) image.width = *overrides.width;
    if (overrides.height) image.height = *overrides.height;
    if (overrides.background) image.background = *overrides.background;
    if (overrides.layers) image.layers = *overrides.layers;
    for (std::size_t i = 0; i < std::size(kImageFormatWords); ++i)
        if (overrides.format == kImageFormatWords[i]) image.format = static_cast<ImageFormat>(i);
    if (overrides.seed) draft.seed = *overrides.seed;
    if (overrides.error || overrides.time_ms || overrides.rung)
        draft.accuracy = {overrides.error, overrides.time_ms, overrides.rung};
}

}  // namespace awan
