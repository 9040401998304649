// Particles as files that other programs read.
//
// CSV: header `x,y,z,radius,density,r,g,b`, one particle a line, shortest numbers that read back exactly. PLY: binary
// little-endian 1.0, one `vertex` element with properties
//   double x, y, z; float radius, density, red, green, blue   (44 bytes a particle).
#pragma once

#include <string>
#include <string_view>

#include "core/generate/particle_set.h"
#include "core/scene/scene.h"

namespace awan {

// Append to `out`. first, last (exclusive): a caller can stream a million particles in pieces.
void append_csv_header(std::string& out);
void append_csv(const ParticleSet& particles, std::size_t first, std::size_t last,
                std::string& out);
void append_ply_header(const ParticleSet& particles, std::string& out);
void append_ply(const ParticleSet& particles, std::size_t first, std::size_t last,
                std::string& out);

// Appends the shortest decimal that reads back to the same value. Finite values only.
void append_number(double value, std::string& out);
void append_number(float value, std::string& out);

// Ready particles (model `particles`) from a file, as a draft with every other value at its
// default. Columns are found by name (CSV header line; PLY properties, ascii or binary
// little-endian, any scalar type): x y z and radius are required; density, red/green/blue (or
// r/g/b; uchar means 0..255) optional. `density` columns hold extinction (1/unit) as our own
// answers do: the draft's cloud density is then 1. Errors: kMalformed with `pointer` "line N" or ""
// and what was expected; kTooLarge over kMaxParticles.
Result<SceneDraft> read_particles_csv(std::string_view text);
Result<SceneDraft> read_particles_ply(std::string_view bytes);

}  // namespace awan
