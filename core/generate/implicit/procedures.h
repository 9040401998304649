// The procedures whose particles are primitives (core/scene/implicit_procedures.h), and the particles of a table
// (core/scene/implicit_primitive.h). Each is what it is at a time by itself, whatever was asked for before.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/generate/implicit/elements.h"
#include "core/scene/implicit.h"

namespace awan::implicit {

// A sphere of a procedure, units.
struct Puff {
    glm::dvec3 center{0};
    double radius = 1;
    double weight = 1;
};

// The bubbles at a time, the smaller ones behind each; and a box around them at all times, units.
std::vector<Puff> bubbles_at(const ImplicitBubbles& bubbles, std::uint64_t key, double time);
Box bubbles_box(const ImplicitBubbles& bubbles);

// The parcels at a time, cell after cell: whoever is clear is there with a weight of 0.
std::vector<Puff> cells_at(const ImplicitCells& cells, std::uint64_t key, double time);
Box cells_box(const ImplicitCells& cells);

// A sheet of vortices that rolls up by itself, one wavelength of it, wavelengths: x from 0 to 1, y around 0. After
// `slide` wavelengths of sliding. It begins at (0, 0) and ends at (1, 0).
using SheetLine = std::vector<glm::dvec2>;
inline constexpr int kSheetPoints = 96, kSheetSteps = 80;
// Wavelengths of sliding a step; no sheet is older than all steps together, 4.
inline constexpr double kSheetStep = 0.05;
// At the beginning and after each of the steps.
std::vector<SheetLine> rolled_sheet(double amplitude, double smoothing, int steps = kSheetSteps);

// The billows' sheet at a time: pieces along z. And a box around it at all times, units. sheet: rolled_sheet() of them.
void add_billows(const ImplicitBillows& billows, const std::vector<SheetLine>& sheet,
                 std::uint64_t key, double time, const Frame& frame,
                 std::vector<Element>& elements);
Box billows_box(const ImplicitBillows& billows, const std::vector<SheetLine>& sheet);

// A table's particles as primitives with keys, in the order of their ids.
std::vector<ImplicitPrimitive> primitives_of(const std::vector<ImplicitParticle>& table);

}  // namespace awan::implicit
