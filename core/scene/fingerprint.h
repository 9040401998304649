// What tells scenes apart, as 128 bits in 32 hex digits (XXH3): equal scenes, however written, have equal fingerprints.
// No protection against someone who wants a collision.
//
// Every field of every table goes in (table.h), so none can be forgotten; what is resolved or left out because it has
// no meaning (the eye of an automatic camera) is listed in fingerprint.cpp.
#pragma once

#include <string>

#include "core/scene/scene.h"

namespace awan {

// Over every value of the scene.
std::string fingerprint(const Scene& scene);

// Over what the light in a cloud depends on: neither camera, picture, effects (but sun_color) nor accuracy.
std::string light_fingerprint(const Scene& scene);

// Over every field of an object as it stands.
std::string fingerprint_of(const Table& table, const void* object);

}  // namespace awan
