#include "core/draw/layers.h"

#include <algorithm>

namespace awan {
namespace {

// Alpha below which a ray meets no cloud: what is seen of it is lost in any picture.
constexpr float kCloud = 1e-6F;

std::vector<float> colors_of(const Image& image) {
    std::vector<float> colors(3 * image.pixel_count());
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
        std::copy_n(image.pixels.data() + 4 * i, 3, colors.data() + 3 * i);
    return colors;
}

// One channel of one pixel.
struct Parts {
    float sun, sky, multiple, haze;
};

// before: what the picture has before its background. all: that of the clouds alone; null: there is no haze.
Parts parts_of(float before, const float* all, float sun, float sky) {
    const float clouds = all != nullptr ? *all : before;
    const float once = sun + sky;
    const float share = once > clouds ? std::max(clouds, 0.0F) / once : 1.0F;
    Parts parts{sun * share, sky * share, 0, before - clouds};
    parts.multiple = clouds - parts.sun - parts.sky;
    // What rounding left of nothing.
    if (once > clouds && clouds > 0) parts.multiple = std::max(parts.multiple, 0.0F);
    return parts;
}

void add_light(const Image& picture, const MarchedBeside& beside, PictureLayers& to) {
    const std::size_t values = 3 * picture.pixel_count();
    for (std::vector<float>* const layer : {&to.sun, &to.sky, &to.multiple, &to.haze})
        layer->resize(values);
    const bool haze = !beside.all.pixels.empty();
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
        const float through = 1 - beside.distance.pixels[4 * i + 3];
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t from = 4 * i + c, at = 3 * i + c;
            const float before = picture.pixels[from] - through * beside.behind.pixels[from];
            const Parts parts = parts_of(before, haze ? &beside.all.pixels[from] : nullptr,
                                         beside.sun.pixels[from], beside.sky.pixels[from]);
            to.sun[at] = parts.sun;
            to.sky[at] = parts.sky;
            to.multiple[at] = parts.multiple;
            to.haze[at] = parts.haze;
        }
    }
}

}  // namespace

PictureLayers layers_of(const Image& picture, const MarchedBeside& beside, const Layers& asked) {
    PictureLayers layers;
    if (asked.any_light()) add_light(picture, beside, layers);
    const auto drop = [&](Layer layer, std::vector<float>& values) {
        if (!asked.has(layer)) values = {};
    };
    drop(Layer::kSun, layers.sun);
    drop(Layer::kSky, layers.sky);
    drop(Layer::kMultiple, layers.multiple);
    drop(Layer::kHaze, layers.haze);
    if (asked.has(Layer::kBackground)) layers.background = colors_of(beside.behind);
    const Image& distance = beside.distance;
    if (asked.has(Layer::kTransmittance))
        for (std::size_t i = 0; i < distance.pixel_count(); ++i)
            layers.transmittance.push_back(1 - distance.pixels[4 * i + 3]);
    if (asked.has(Layer::kDepth))
        for (std::size_t i = 0; i < distance.pixel_count(); ++i) {
            const float alpha = distance.pixels[4 * i + 3];
            layers.depth.push_back(alpha > kCloud ? distance.pixels[4 * i] / alpha : kNoDepth);
        }
    return layers;
}

}  // namespace awan
