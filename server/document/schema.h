// The scene part of the contract, from the tables of core/scene: what /openapi.json says a document may hold is what is
// read and checked.
#pragma once

#include <string>

namespace awan {

// Members of "components/schemas" (OpenAPI 3.1, JSON Schema 2020-12), with commas between and none at the ends: Scene,
// SceneOfParticles, and every object that may stand in them. Beside JSON Schema's words: `x-unit`; `x-otherwise`, what
// holds when the field is left out and that is no value of its own; and in objects of which one field, named by
// `x-presets-by`, decides about others: `x-presets`, what those come to with each of its words.
std::string scene_schemas();

}  // namespace awan
