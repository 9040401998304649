// What takes the place of what a document says: the query of a route, the fields of a form, flags of the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"
#include "core/scene/scene.h"

namespace awan {

struct Overrides {
    // Pixels.
    std::optional<int> width, height;
    // Of the answer: a word that its route knows, such as png or csv.
    std::optional<std::string> format;
    std::optional<Background> background;
    // As ImageSettings::layers.
    std::optional<std::string> layers;
    std::optional<std::uint64_t> seed;
    // At most one of the three: what is asked of accuracy, in place of the document's.
    std::optional<double> error, time_ms;
    std::optional<std::string> rung;
    // Of ready particles (ParticleReading::radius); read_scene() takes it, not override_scene().
    std::optional<double> radius;
};

// "width, height, ...": the names that there are.
inline constexpr std::string_view kOverrideNames =
    "width, height, format, background, layers, seed, error, time_ms, rung, radius";
bool is_override(std::string_view name);

// From names and values as they come in a query; others than overrides are passed over. Errors are kMalformed, with the
// name and what was allowed: no such value, a name twice, two of error, time_ms and rung.
Result<Overrides> read_overrides(std::span<const std::pair<std::string, std::string>> query);

// Puts them into a scene that has been read. Ranges are validate()'s business.
void override_scene(const Overrides& overrides, SceneDraft& draft);

// A value and its place in a document: `pointer` as /sun/elevation (RFC 6901), `value` JSON, the numbers of a list
// without its brackets ("1, 2, 3"), or a word without quotes; particles of an implicit cloud also a table
// (particle_table.h).
struct PlacedValue {
    std::string pointer, value;
};

// Puts values into a scene, and reads it again when all are there. Objects on the way are made; in lists the element
// must be there, or "-" is one more. Errors: what parse_scene() says of the document as it is then.
Status set_in_scene(std::span<const PlacedValue> values, SceneDraft& draft);
Status set_in_scene(std::string_view pointer, std::string_view value, SceneDraft& draft);

}  // namespace awan
