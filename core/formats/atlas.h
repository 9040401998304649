// The views of an impostor side by side on one picture.
#pragma once

#include <string>
#include <vector>

#include "core/base/deadline.h"
#include "core/draw/layers.h"
#include "core/formats/sheet.h"
#include "core/scene/scene.h"

namespace awan {

struct Atlas {
    SheetLayout layout;
    Image image;
    // A float a pixel; EMPTY: the views have none.
    std::vector<float> depth;
};

// An empty one of views x views pictures, each size x size pixels. They fit (core/impostor.h).
Atlas begin_atlas(int views, int size);

// Puts view `index` in its place. layers: those of the picture; its depth is taken where it has one.
void put_on_atlas(std::uint64_t index, const Image& picture, const PictureLayers& layers,
                  Atlas& atlas);

// As PNG of the scene's film, or as EXR with a channel depth.Z where there is depth. Errors: of the encoders.
Result<std::string> encode_atlas(const Atlas& atlas, const Scene& scene, bool exr,
                                 const Deadline& deadline);

}  // namespace awan
