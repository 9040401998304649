// The density of an implicit cloud (Ebert 2002) at one time, with everything prepared that does not depend on the
// point.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/generate/implicit/elements.h"
#include "core/generate/implicit/formula_field.h"
#include "core/generate/implicit/noise.h"
#include "core/scene/implicit.h"

namespace awan::implicit {

// Prepared warps. Lengths and places are in the frame, where a mean radius is 1.
struct PreparedAttractor {
    glm::vec3 at;
    // The attractor's strength, and 1 / reach.
    float strength, inverse;
    // It moves nothing outside of this box.
    Box ball;
    // And nothing inside farther than this.
    double most;
};
struct PreparedVortex {
    // The axis has length 1.
    glm::vec3 at, axis;
    // The angle in turns, and 1 / reach.
    float turns, inverse;
    Box ball;
    double most;
};
struct PreparedFlow {
    bool any = false;
    // A place p has the index (p - min) * steps in the table.
    glm::vec3 min{0}, steps{0};
    int size[3] = {0, 0, 0};
    std::vector<glm::vec3> vectors;
    // The least and the largest of each component over all vectors and 0.
    glm::dvec3 low{0}, high{0};
};

// Everything that the density at a point needs.
struct ImplicitField {
    Frame frame;
    std::vector<Element> elements;
    // Where there can be density at any time, in the frame.
    Box box;

    float amount, exponent, blend, displacement;
    bool diagonal;
    // Places are multiplied with this, 1 / size of the noise, and along the jet stream with less.
    float noise_scale;
    glm::vec3 stretch_axis;
    // 1 / stretch - 1: what is added along the axis.
    float stretch_less;
    NoiseLattice path_noise;
    // How far that noise moves the place of the turbulence, along each axis.
    glm::vec3 path_scale;
    Octaves octaves, moving;

    bool warped;
    glm::vec3 jet;
    // Both are multiplied with the warp's share at this time.
    float jet_turbulence;
    float jet_floor, jet_slope;
    PreparedFlow flow;
    std::vector<PreparedAttractor> attractors;
    std::vector<PreparedVortex> vortices;

    // 1 / wavelength along each axis; 0: no ripple.
    glm::vec3 ripple;
    float ripple_depth, ripple_turns;
    bool has_base;
    float base, base_inverse;

    // Squash and stretch: matter seen at p is that of squash_at + unsquash (p - squash_at).
    bool squashed;
    glm::dvec3 squash_at;
    glm::dmat3 unsquash;
    // None: the density is the model's.
    std::shared_ptr<const PreparedFormula> formula;
};

// The field at `time`, seconds, with all its octaves.
ImplicitField prepare_field(const ImplicitCloud& cloud, std::uint64_t key, double time);

// Leaves out the octaves that a lattice of cells of `cell` units cannot show. The rest stays as prepare_field() had
// it.
void limit_octaves(const ImplicitCloud& cloud, std::uint64_t key, double time, double cell,
                   ImplicitField& field);

// A box around all density at any time, units; empty when there is none. field: from prepare_field().
Box box_of(const ImplicitField& field);

// A row of cells: `count` points from `first` on, `step` units apart along x.
struct CellRow {
    glm::dvec3 first;
    double step;
    int count;
};
// Writes the densities of a row, from 0 to limits::kMaxImplicitDensity. Only the elements in `list` are looked at,
// which are elements_near() the row.
void row_densities(const ImplicitField& field, const std::vector<std::uint32_t>& list,
                   const CellRow& row, float* out);

// The elements that points in the box (units) may come to after all displacements, in their order.
std::vector<std::uint32_t> elements_near(const ImplicitField& field, const Box& box);

// The density at one place, units.
double density_at(const ImplicitField& field, const glm::dvec3& p);

// Where the path of the noise is (Ebert 2002, procedure cumulus()), in sizes of the largest octave, and how far the
// noise of the path moves it.
struct SwirlPath {
    glm::dvec3 offset{0};
    glm::dvec3 scale{0};
};
SwirlPath swirl_path(double frame, bool printed);

}  // namespace awan::implicit
