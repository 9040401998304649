#include "core/formats/atlas.h"

#include <algorithm>

#include "core/formats/image_file.h"

namespace awan {

Atlas begin_atlas(int views, int size) {
    const auto count = static_cast<std::uint64_t>(views) * static_cast<std::uint64_t>(views);
    const SheetLayout layout{views, views, size, size, count};
    return {layout, begin_sheet(layout, false), {}};
}

void put_on_atlas(std::uint64_t index, const Image& picture, const PictureLayers& layers,
                  Atlas& atlas) {
    put_on_sheet(atlas.layout, index, picture, atlas.image);
    if (layers.depth.empty()) return;
    if (atlas.depth.empty()) atlas.depth.assign(atlas.image.pixel_count(), kNoDepth);
    const auto width = static_cast<std::size_t>(picture.width);
    const auto x = static_cast<std::size_t>(atlas.layout.x(index)),
               y = static_cast<std::size_t>(atlas.layout.y(index));
    for (std::size_t line = 0; line < static_cast<std::size_t>(picture.height); ++line)
        std::copy_n(
            layers.depth.data() + line * width, width,
            atlas.depth.data() + (y + line) * static_cast<std::size_t>(atlas.image.width) + x);
}

Result<std::string> encode_atlas(const Atlas& atlas, const Scene& scene, bool exr,
                                 const Deadline& deadline) {
    if (!exr)
        return encode_png(atlas.image, film_of(scene),
                          scene->image.format == ImageFormat::kPng16 ? 16 : 8, deadline);
    std::vector<ExrChannel> depth;
    if (!atlas.depth.empty()) depth.push_back({"depth.Z", atlas.depth.data(), 1, true});
    return encode_exr(atlas.image, scene->image.precision, {}, deadline, depth);
}

}  // namespace awan
