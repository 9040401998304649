// What a march begins with: its scene, what stands behind the clouds, and the blocks that are to be marched.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/draw/hills_backdrop.h"
#include "core/draw/march.h"
#include "core/draw/march_block.h"
#include "core/draw/march_scene.h"

namespace awan {

// What the picture is marched through. It refers to all that it is made from. islands: as of source_towards. width,
// height: of the picture, pixels; 0: the scene's.
MarchScene march_scene(const Scene& scene, const View& view, const TransportLight& light,
                       const ParticleSet& particles, const std::vector<SeenParticle>& seen,
                       double step_error, int threads, std::span<const std::uint8_t> islands = {},
                       int width = 0, int height = 0);

// How finely the light's own grid is marched, with the usual step_error; EMPTY where nothing is seen.
MarchFinenesses fineness_of(const View& view, const TransportLight& light,
                            const ParticleSet& particles, const std::vector<SeenParticle>& seen);

// As MarchSettings::fineness, not EMPTY.
void set_fineness(const MarchFinenesses& given, MarchScene& march);

// What a MarchScene refers to beside light and matter.
struct MarchBehind {
    std::optional<Air> air;
    std::optional<ReliefLight> hills;
    Backdrop backdrop;
    BehindPeak through_peak;
};

// Puts sky, ground, hills and haze behind what is marched, in a picture of that many pixels. `behind` must stay where
// it is as long as `march` is used.
void set_behind(const Scene& scene, const TransportLight& light, const MarchSettings& settings,
                int width, int height, int threads, EffectTimes& took, MarchBehind& behind,
                MarchScene& march);

// Marches all blocks; false: the deadline passed. only: those that it says yes to; null: all.
using BlockChoice = std::function<bool(int x, int y, bool has_matter)>;
bool march_blocks(const MarchScene& scene, int threads, const Deadline& deadline, Image& image,
                  std::span<MarchedAlong> along = {}, const BlockChoice& only = nullptr);

}  // namespace awan
