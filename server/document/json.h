// JSON at the edge: text -> SceneDraft, values -> text. The only user of nlohmann-json.
#pragma once

#include <string>
#include <string_view>

#include "core/pipeline.h"
#include "core/scene/scene.h"
#include "server/document/presets.h"

namespace awan {

// The scene document of the contract. Strict: unknown fields, wrong types, duplicate keys, numbers
// that are not finite, integers that are not integral or do not fit: each an Error with a JSON
// pointer. kMalformed: not JSON (position in the message). kInvalidScene: JSON, but not a scene
// document. A deep or huge document costs no more than its text. A document with the member `preset` is first completed
// by with_preset(). Ranges are validate()'s business.
Result<SceneDraft> parse_scene(std::string_view text);

// The scene as a document that parses back to an equal draft (defaults are left out).
std::string scene_to_json(const SceneDraft& scene);
// One object of it, on one line: the fields that differ from `standards`, an object of the same table.
std::string object_to_json(const Table& table, const void* object, const void* standards);

// Particle answer, in pieces so that a million particles never stand in memory as text:
// {"count","seed","bounds":{"min","max"},"particles":[{"center","radius","density","color"}...]}.
std::string particles_json_head(const ParticleSet& particles, std::uint64_t seed);
void append_particles_json(const ParticleSet& particles, std::size_t first, std::size_t last,
                           std::string& out);
std::string particles_json_tail();

// Plan answer: {"survey":{...},"effects":[{"name","on","available","reason"}],"rung","rung_reason",
// "predicted":{"error","time_ms"},"rungs":[{"rung","simulates","error","time_ms","memory_bytes"}]},
// the rungs in the ladder's order. null where nothing can be predicted.
std::string plan_to_json(const Survey& survey, const Plan& plan);

// RFC 9457. `pointer` is left out when empty and status is not 422.
std::string problem_to_json(int status, std::string_view title, std::string_view detail,
                            std::string_view pointer, std::string_view request_id);

std::string presets_to_json(const PresetEntry* first, std::size_t count);
std::string version_to_json(const DeviceInfo* device, std::string_view no_device_reason);

}  // namespace awan
