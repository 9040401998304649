// What the sweep's weighted differences (sweep.h) blur, and the source that undoes it.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/light/ordinates.h"
#include "core/light/sweep.h"

namespace awan {

// In the weighted scheme the radiance on a face is that of the cell before it and not the mean of both: with theta its
// weight, light that changes evenly from cell to cell carries across a face with the cosine c (over the cell's side)
//     c (theta - 1/2) = s c / 2 (6 c + s)
// of its change a cell too much, s the depth of the cell's side. To light that goes in all directions alike this is
// diffusion, of conductance
//     mean over directions of s c / 2 (6 c + s)
// beside 1 / 3 s (1 - mean cosine), which is right: in cells of depth 2 a third too much. A deep cloud would send
// back too little light and let too much through. So its opposite is added to the source; less of it in cells so deep
// that light does not change evenly.
struct Sharpening {
    glm::ivec3 cells{0};
    std::vector<float> across[3];  // conductance to the next cell along x, y, z (0 after the last)
};

Sharpening make_sharpening(const SweepGrid& grid, const Ordinates& ordinates);

// to[i] += sum over faces of conductance * (own value - neighbour's); one value of each cell.
void add_sharpening(const Sharpening& sharpening, std::span<const float> value,
                    std::span<float> to);

}  // namespace awan
