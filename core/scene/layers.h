// What a picture may hold beside its colours, for compositing ("AOVs", arbitrary output variables).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace awan {

// kDepth: the mean distance from the eye, along its ray, at which the clouds stop its light, scene units.
// kTransmittance: what the clouds let through, 0..1. Radiances as the eye has them, dimmed by clouds and haze: kSun,
// kSky: what was scattered exactly once, of the sun's light and of the sky's; kMultiple: what was scattered more often,
// and all that comes from the ground; kHaze: what the haze scatters. kBackground: what stands behind the clouds, dimmed
// by haze alone. Of every pixel
//     colour = sun + sky + multiple + haze + transmittance * background.
enum class Layer { kDepth, kTransmittance, kSun, kSky, kMultiple, kHaze, kBackground };
inline constexpr const char* kLayerWords[] = {"depth",    "transmittance", "sun",       "sky",
                                              "multiple", "haze",          "background"};
inline constexpr int kLayerCount = static_cast<int>(Layer::kBackground) + 1;

class Layers {
  public:
    bool has(Layer layer) const { return (bits_ >> static_cast<int>(layer) & 1U) != 0; }
    bool any() const { return bits_ != 0; }
    // Whether light has to be told apart.
    bool any_light() const {
        return has(Layer::kSun) || has(Layer::kSky) || has(Layer::kMultiple) || has(Layer::kHaze);
    }
    void add(Layer layer) { bits_ |= 1U << static_cast<int>(layer); }

  private:
    std::uint32_t bits_ = 0;
};

// "none", "all", or words of kLayerWords with commas between them; else nothing.
std::optional<Layers> read_layers(std::string_view text);
inline constexpr std::string_view kLayersWanted =
    "all, none, or some of depth, transmittance, sun, sky, multiple, haze, background with commas "
    "between them";

}  // namespace awan
