// Other names that media types go by, for what is sent and what is asked for.
#pragma once

#include <string_view>

namespace awan {

// {another name, the usual one}, in lower case.
inline constexpr std::string_view kOtherMediaTypes[][2] = {
    {"text/json", "application/json"},        {"application/csv", "text/csv"},
    {"application/ply", "application/x-ply"}, {"model/ply", "application/x-ply"},
    {"model/x-ply", "application/x-ply"},     {"image/exr", "image/x-exr"},
    {"image/openexr", "image/x-exr"},         {"image/aces", "image/x-exr"},
};

// The usual name of a media type, which is most often its own.
constexpr std::string_view usual_media_type(std::string_view type) {
    for (const auto& [other, usual] : kOtherMediaTypes)
        if (type == other) return usual;
    return type;
}

}  // namespace awan
