#include "core/formats/column_names.h"

#include <array>
#include <utility>

namespace awan {
namespace {

constexpr std::array<const char*, kSaysCount> kNames = {
    "x",        "y",       "z",       "radius",  "width",   "radius_x", "radius_y",
    "radius_z", "scale_0", "scale_1", "scale_2", "density", "opacity",  "red",
    "green",    "blue",    "f_dc_0",  "f_dc_1",  "f_dc_2"};

// Lower case, and one '_' for any run of other characters, none at the ends.
std::string plain(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        const bool kept = (lower >= 'a' && lower <= 'z') || (lower >= '0' && lower <= '9');
        if (kept)
            out += lower;
        else if (!out.empty() && out.back() != '_')
            out += '_';
    }
    while (!out.empty() && out.back() == '_') out.pop_back();
    return out;
}

struct Alias {
    std::string_view name;
    Says says;
};
constexpr Alias kAliases[] = {
    {"radii", Says::kRadius},
    {"rad", Says::kRadius},
    {"pscale", Says::kRadius},
    {"radiuspp", Says::kRadius},
    {"point_radius", Says::kRadius},
    {"particle_radius", Says::kRadius},
    {"sphere_radius", Says::kRadius},
    {"widths", Says::kWidth},
    {"diameter", Says::kWidth},
    {"diameters", Says::kWidth},
    {"densities", Says::kDensity},
    {"extinction", Says::kDensity},
    {"sigma_t", Says::kDensity},
    {"opacitypp", Says::kOpacity},
    {"radii_x", Says::kRadiusX},
    {"radii_y", Says::kRadiusY},
    {"radii_z", Says::kRadiusZ},
    {"rx", Says::kRadiusX},
    {"ry", Says::kRadiusY},
    {"rz", Says::kRadiusZ},
    {"r", Says::kRed},
    {"g", Says::kGreen},
    {"b", Says::kBlue},
};

// Vectors that are written as three columns: a base, and which of the three.
constexpr std::string_view kPlaces[] = {"p",
                                        "pos",
                                        "position",
                                        "positions",
                                        "point",
                                        "points",
                                        "center",
                                        "centre",
                                        "coord",
                                        "coords",
                                        "location",
                                        "loc",
                                        "co",
                                        "xyz",
                                        "coordinate",
                                        "coordinates",
                                        "translation",
                                        "vertex",
                                        "particle",
                                        "world",
                                        "particle_position",
                                        "world_position"};
constexpr std::string_view kColours[] = {"color",   "colour", "cd",   "rgb",
                                         "diffuse", "colors", "rgbpp"};

// What may stand behind a name without brackets: "x_m".
constexpr std::string_view kUnits[] = {"m",  "mm",     "cm",     "km",          "um",         "nm",
                                       "ft", "meters", "metres", "millimeters", "centimeters"};

// 0, 1 or 2; nothing where it is none of the words.
std::optional<int> axis(std::string_view word, std::string_view words) {
    for (int i = 0; i < 3; ++i) {
        const std::size_t space = words.find(' ');
        if (word == words.substr(0, space)) return i;
        words.remove_prefix(space == std::string_view::npos ? words.size() : space + 1);
    }
    return {};
}

template <std::size_t N>
bool is_one_of(std::string_view word, const std::string_view (&words)[N]) {
    for (const std::string_view one : words)
        if (word == one) return true;
    return false;
}

Says after(Says first, int steps) {
    return static_cast<Says>(static_cast<int>(first) + steps);
}

// A name and the unit behind it, in brackets or after a "_" or a blank; EMPTY where there is none.
std::pair<std::string_view, std::string_view> without_unit(std::string_view name) {
    const std::size_t open = name.find_last_of("[(");
    if (open != std::string_view::npos && open > 0 && (name.back() == ']' || name.back() == ')'))
        return {name.substr(0, open), name.substr(open + 1, name.size() - open - 2)};
    const std::size_t cut = name.find_last_of("_ ");
    if (cut != std::string_view::npos && cut > 0 && is_one_of(name.substr(cut + 1), kUnits))
        return {name.substr(0, cut), name.substr(cut + 1)};
    return {name, {}};
}

// What a plain name says. CloudCompare writes its own fields as "scalar_Radius".
std::optional<KnownName> known_word(std::string word) {
    if (word.starts_with("scalar_")) word.erase(0, 7);
    for (std::size_t i = 0; i < kSaysCount; ++i)
        if (word == kNames[i]) return KnownName{static_cast<Says>(i), 0, {}};
    for (const Alias& alias : kAliases)
        if (word == alias.name) return KnownName{alias.says, 1, {}};
    const std::size_t cut = word.rfind('_');
    std::string_view base = std::string_view(word).substr(0, cut), last;
    if (cut != std::string::npos) {
        last = std::string_view(word).substr(cut + 1);
    } else if (word.size() > 1) {
        // "posx", "cdr"
        last = std::string_view(word).substr(word.size() - 1);
        base = std::string_view(word).substr(0, word.size() - 1);
    }
    std::optional<int> which = axis(last, "x y z");
    if (!which) which = axis(last, "0 1 2");
    if (which && is_one_of(base, kPlaces)) return KnownName{after(Says::kX, *which), 2, {}};
    if (!which) which = axis(last, "r g b");
    if (!which) which = axis(last, "red green blue");
    if (which && is_one_of(base, kColours)) return KnownName{after(Says::kRed, *which), 2, {}};
    return {};
}

}  // namespace

std::optional<KnownName> known_name(std::string_view name) {
    // Longer ones are nobody's, and cost nothing.
    if (name.size() > 64) return {};
    if (const auto known = known_word(plain(name))) return known;
    const auto [rest, unit] = without_unit(name);
    if (unit.empty()) return {};
    auto known = known_word(plain(rest));
    if (known) known->unit = unit;
    return known;
}

bool is_vector_name(std::string_view name) {
    if (name.size() > 64) return false;
    const std::string_view without = without_unit(name).first;
    const std::string word = plain(without);
    return is_one_of(word, kPlaces) || is_one_of(word, kColours);
}

const char* name_of(Says says) {
    return kNames[static_cast<std::size_t>(says)];
}

}  // namespace awan
