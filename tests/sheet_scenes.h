// Even sheets of Gaussians, and their middle as a rung draws it.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "tests/adding_doubling.h"
#include "tests/scenes.h"

namespace awan::test {

// Gaussians of s = 1 on a regular grid, so close that their sum is even within 1e-4. Only its optical depth counts: not
// its thickness, and not its width where that is many times the thickness.
struct SheetShape {
    double width = 54, thickness = 4;  // s, from the first Gaussians' centres to the last
};

// A sun of irradiance 1 at `sun` (cosine to the vertical), an eye that looks at the sheet's middle along a line of the
// cosine `view`, from below where `below`. azimuth: as Sheet has it. The y axis is across the sheet.
struct SheetView {
    double sun = 1, view = 1, azimuth = 0;
    bool below = false;
};

inline SceneDraft sheet_scene(const SheetMatter& matter, const SheetShape& shape,
                              const SheetView& seen, const std::string& rung) {
    const int across = static_cast<int>(std::ceil(shape.width / 1.25)) + 1;
    const int layers = static_cast<int>(std::ceil(shape.thickness / 1.25)) + 1;
    const double apart = shape.width / (across - 1), high = shape.thickness / (layers - 1);
    const double density =
        matter.depth * apart * apart / (std::pow(2 * std::numbers::pi, 1.5) * layers);
    std::vector<Ball> list;
    for (int k = 0; k < layers; ++k)
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i)
                list.push_back({{i * apart - 0.5 * shape.width, k * high - 0.5 * shape.thickness,
                                 j * apart - 0.5 * shape.width},
                                2,
                                density});
    SceneDraft draft = balls(list);
    draft.medium.albedo = matter.albedo;
    draft.medium.g = matter.g;
    // Light goes to +x and down; it leaves at `azimuth` to that.
    draft.sun.direction =
        glm::dvec3(-std::sqrt(std::max(0.0, 1 - seen.sun * seen.sun)), seen.sun, 0);
    const double flat = std::sqrt(std::max(0.0, 1 - seen.view * seen.view));
    draft.camera.eye =
        500.0 * glm::dvec3(flat * std::cos(seen.azimuth), (seen.below ? -1 : 1) * seen.view,
                           flat * std::sin(seen.azimuth));
    draft.camera.up = {0, seen.view > 0.9 ? 0 : 1, seen.view > 0.9 ? 1 : 0};
    draft.camera.fov = 0.5;
    draft.image.width = draft.image.height = 16;
    draft.accuracy.rung = rung;
    return draft;
}

// Mean radiance of the picture of a sheet.
inline double mean_of(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += pixel(image, x, y).g;
    return sum / (image.width * image.height);
}

inline double exact_of(const SheetMatter& matter, const SheetView& seen) {
    const Sheet sheet(matter, {seen.sun, seen.view});
    return seen.below ? sheet.through(seen.view, seen.sun, seen.azimuth)
                      : sheet.back(seen.view, seen.sun, seen.azimuth);
}

}  // namespace awan::test
