#pragma once

#include <vector>

#include "core/scene/rungs.h"

namespace awan {

// Of one island (core/survey/islands.h).
struct IslandCells {
    int cells = 0;      // as TransportSettings::cells; 0: no grid
    int sun_cells = 0;  // 0: it is not seen and has no light of its own
};

// How finely the transport rungs (core/light/transport.h) solve.
struct TransportSettings {
    int cells = 32;      // along the longest side of the matter; 0: no grid, the sun's depth only
    int sun_cells = 96;  // of SunDepth, along its longest side
    double tolerance = 1e-3;  // of the solve, relative to its source
    int max_sweeps = 40;      // a band; each is one walk through all cells and directions
    bool sky = true;          // whether the sky's light is wanted
    bool ground = false;      // whether the ground's light goes into the cloud
    bool ground_shadow =
        false;  // whether the cloud shades the ground and sends it light of its own
    std::vector<IslandCells> islands;  // one for each of Survey::islands; EMPTY: one grid holds all
};

// Of a rung of Method::kMarch.
TransportSettings transport_settings(const Rung& rung);

}  // namespace awan
