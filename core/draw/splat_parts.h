// Where splats are drawn on finer pixels than the picture's.
//
// A pixel shows the mean of transmittance over its area. Particles that are narrower than a pixel and stand
// independently of each other may be widened for that, their area kept (survey/narrow.h). Those of one cloud do not:
// they are all where the cloud is, behind and beside each other, and a cloud of many that is drawn as if they were
// spread over a pixel hides much more of it than the cloud covers. So the rectangle in which there is such matter is
// drawn on pixels that divide the picture's, fine enough for the particles' own size, and averaged. Then alpha is
// within 1% of the exact mean at any distance (sub_pixel_test).
//
// Where that is more work than is allowed, the pixels are as fine as it allows, and what is narrower still is widened
// there, as if it stood independently within them. That holds for particles that are strewn evenly: a picture full of
// them, a twelfth of a pixel wide, has its alpha within .1% in the mean. It fails for clumps far below a pixel that are
// strewn over a whole picture: of 1,500, each of 60 dense particles, 200 x 150 pixels show 1.9 times too much.
#pragma once

#include "core/base/image.h"
#include "core/draw/splats.h"

namespace awan {

// Work that may be spent on fine pixels: their number, and the entries of their tiles' lists (of a tile and a particle
// that reaches into it; each entry is blended into all pixels of the tile).
struct SplatBudget {
    double pixels, entries;
};
// About four times a picture's pixels, and as many entries as narrow particles have in four pictures.
SplatBudget splat_budget(const ImageSettings& image, std::size_t particles);

// A rectangle of a window's pixels that is drawn with 2^level as many pixels along each side.
struct SplatPart {
    int left, top, width, height, level;
    std::vector<std::uint32_t> order;  // all that reach into it, in drawing order
    SplatBudget left_over;             // for parts of this part
};

struct SplatParts {
    std::vector<SplatPart> parts;     // disjoint
    std::vector<std::uint32_t> rest;  // the particles that the window itself draws
};

// What of a window to draw in parts: none where no particle's matter (order: indices, as they are drawn) is narrower
// than its pixels call for. The same for the same arguments.
// painted: particles that have paint are billboards, which have no need of finer pixels.
SplatParts divide(const ParticleSet& particles, bool painted, const View& view,
                  const SplatWindow& window, std::vector<std::uint32_t> order,
                  const SplatBudget& budget);

SplatWindow window_of(const SplatPart& part, const SplatWindow& in);

// Puts the means of a part's pixels into the picture that it is a part of.
void put_mean(const Image& fine, const SplatPart& part, Image& image);

}  // namespace awan
