// The inner loops of the march, compiled once a target (AVX-512, AVX2, any x86-64). Results are the same on all of
// them, bit for bit.
#pragma once

#include <vector>

#include "core/draw/march_air.h"
#include "core/draw/march_detail.h"
#include "core/draw/march_rays.h"
#include "core/draw/march_scene.h"
#include "core/draw/march_shade.h"
#include "core/draw/march_tile.h"

namespace awan {

struct MarchKernels {
    void (*rays)(const BlockFrame&, const float*, const float*, Floats*);
    void (*phases)(const MarchScene&, const SunInBlock&, Tile&, Floats*);
    void (*finish)(const MarchScene&, const float*, const BehindPixels&, const Tile&, float (*)[4]);
    void (*finish_air)(const MarchScene&, const AirTile&, const SunInBlock&, const float*,
                       const BehindPixels&, const Tile&, float (*)[4]);
    void (*measure)(const BlockParticles&, const Floats*, const Floats&, ActiveParticle&);
    void (*ratio)(const BlockParticles&, float, std::vector<ActiveParticle>&);
    void (*deposit)(const BlockParticles&, const std::vector<ActiveParticle>&, const Chunk&,
                    const Bilinear*, WideRays&, Tile*);
    void (*detail)(const DetailRays&, const Chunk&, Tile*);
    int (*too_deep)(const Tile&, float, float);
    void (*spread)(const Bilinear&, const LightAt (*)[kChunk + 2], int, int, bool, bool,
                   TileLight&);
    void (*march)(const Shade&, const TileLight&, int, Tile&);
    void (*march_haze)(const Shade&, const TileLight&, int, Tile&);
};

// Of this processor.
const MarchKernels& march_kernels();

}  // namespace awan
