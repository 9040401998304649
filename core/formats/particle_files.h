// Particles as files that other programs read.
//
// CSV: header `x,y,z,radius,density,r,g,b`, one particle a line, shortest numbers that read back exactly. PLY: binary
// little-endian 1.0, one `vertex` element with properties
//   double x, y, z; float radius, density, red, green, blue   (44 bytes a particle),
// and where the particles' light is known, float light_red, light_green, light_blue   (56 bytes).
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/generate/particle_set.h"
#include "core/scene/scene.h"

namespace awan {

// Append to `out`. first, last (exclusive): a caller can stream a million particles in pieces.
void append_csv_header(std::string& out);
void append_csv(const ParticleSet& particles, std::size_t first, std::size_t last,
                std::string& out);
// light: of each particle, linear radiance; EMPTY: it is not written.
void append_ply_header(const ParticleSet& particles, std::string& out,
                       std::span<const glm::vec3> light = {});
void append_ply(const ParticleSet& particles, std::size_t first, std::size_t last, std::string& out,
                std::span<const glm::vec3> light = {});

// Appends the shortest decimal that reads back to the same value. Finite values only.
void append_number(double value, std::string& out);
void append_number(float value, std::string& out);

// A binary glTF 2.0 file of points: POSITION (float, from the middle, where the node stands), _RADIUS, _DENSITY,
// COLOR_0, 32 bytes a particle. Error: there are none.
Result<std::string> write_glb(const ParticleSet& particles);

// How a file of particles is read.
struct ParticleReading {
    // Of every particle, in place of what the file says of radii; one that says nothing of them needs it.
    std::optional<double> radius;
    // What was taken for what, and what is not used, a sentence each; null: nobody asks.
    std::vector<std::string>* notes = nullptr;
};

// Ready particles (model `particles`) from a file, as a draft with every other value at its default. Columns are found
// by name (column_names.h): x, y, z and a radius are required, density and colours optional. What says density holds
// extinction (1/unit), as our own answers do: the draft's cloud density is then 1.
// CSV as RFC 4180 has it, and as tools write it: separated by commas, semicolons, tabs, bars or blanks, whichever
// makes names of the header known; decimal commas where the comma separates nothing; header and comments behind # or
// //. PLY 1.0: ascii and binary of either order, any elements, any properties, lists too; 3D Gaussian splats.
// Errors: kMalformed with `pointer` "line N", "line N, column M" or "" and what was expected; kTooLarge over
// kMaxParticles.
Result<SceneDraft> read_particles_csv(std::string_view text, const ParticleReading& reading = {});
Result<SceneDraft> read_particles_ply(std::string_view bytes, const ParticleReading& reading = {});

}  // namespace awan
