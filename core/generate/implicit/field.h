// The density of an implicit cloud at one time: everything that a point needs, prepared.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/implicit/elements.h"
#include "core/generate/implicit/noise.h"
#include "core/scene/implicit.h"

namespace awan {

// Lengths and places in the frame, where a mean radius is 1; angles as what they are needed for.
struct PreparedAttractor {
    glm::vec3 at;
    // Inverse: 1 / reach.
    float strength, inverse;
    // It moves nothing outside.
    Box ball;
    // Nor anything inside farther than that.
    double most;
};
struct PreparedVortex {
    // Axis of length 1.
    glm::vec3 at, axis;
    // Of the angle.
    float turns, inverse;
    Box ball;
    double most;
};
struct PreparedFlow {
    bool any = false;
    // The table's index is (p - min) * steps.
    glm::vec3 min{0}, steps{0};
    int size[3] = {0, 0, 0};
    std::vector<glm::vec3> vectors;
    // Of all vectors and 0.
    glm::dvec3 low{0}, high{0};
};

struct ImplicitField {
    Frame frame;
    std::vector<Element> elements;
    // Where there can be density, at any time; in the frame.
    Box box;

    float amount, exponent, blend, displacement;
    bool diagonal;
    // The noise: places times 1 / size, along the jet stream fewer.
    float noise_scale;
    glm::vec3 stretch_axis;
    // 1 / stretch - 1.
    float stretch_less;
    NoiseLattice path_noise;
    // How far it moves the noise, along each axis.
    glm::vec3 path_scale;
    Octaves octaves, moving;

    bool warped;
    glm::vec3 jet;
    // Both with the warp's share at this time.
    float jet_turbulence;
    float jet_floor, jet_slope;
    PreparedFlow flow;
    std::vector<PreparedAttractor> attractors;
    std::vector<PreparedVortex> vortices;

    // 1 / wavelength, 0: none.
    glm::vec3 ripple;
    float ripple_depth, ripple_turns;
    bool has_base;
    float base, base_inverse;
};

// At `time`, with all its octaves.
ImplicitField prepare_field(const ImplicitCloud& cloud, std::uint64_t key, double time);

// Leaves out what a lattice of cells of `cell` units cannot show. The rest stays as prepare_field() had it.
void limit_octaves(const ImplicitCloud& cloud, std::uint64_t key, double time, double cell,
                   ImplicitField& field);

// Around all density at any time, units; empty when there is none. As prepare_field's.
Box box_of(const ImplicitField& field);

// A row of cells: `count` points from `first` on, `step` units apart along x. Writes densities >= 0, at most
// limits::kMaxImplicitDensity.
struct CellRow {
    glm::dvec3 first;
    double step;
    int count;
};
// Only elements in `list` are looked at: elements_near() the row.
void row_densities(const ImplicitField& field, const std::vector<std::uint32_t>& list,
                   const CellRow& row, float* out);

// The elements that points in the box (units) may come to after all displacements, in their order.
std::vector<std::uint32_t> elements_near(const ImplicitField& field, const Box& box);

// At one place, units.
double density_at(const ImplicitField& field, const glm::dvec3& p);

// Where the path of the noise is (document 004, cumulus()), in sizes of the largest octave, and how far the noise of
// the path moves it.
struct SwirlPath {
    glm::dvec3 offset{0};
    glm::dvec3 scale{0};
};
SwirlPath swirl_path(double frame, bool printed);

}  // namespace awan
