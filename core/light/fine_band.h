// The sun's light where matter has detail, on cells that see its lumps.
//
// Lumps are many mean free paths deep and have hard edges. On the grid's cells their lit sides and the gaps between
// them are one: tops come out too dark and hollows too bright, by as much as a half. The sun's depth at the eye's
// samples has little to do with it where g is large, and neither has diffusion, which is smooth: it is light of few
// scatterings (tests/calibration/README.md has the figures). So the band is solved once more on the fine cells from
// which the grid's means are taken. The grid's own band is where that begins, and what is left over for many mean free
// paths is spread on the grid's cells; a few sweeps are enough.
#pragma once

#include "core/light/band_solve.h"
#include "core/light/part_matter.h"
#include "core/light/transport_light.h"

namespace awan {

// Whether there are lumps that the grid's cells do not see, but its fine cells do. detail: null, there is none.
// scaled: share of the depth that dims light (delta_m.h).
bool needs_fine_light(const DetailField* detail, const PartGrid& grid, double scaled);

// What of a lattice a FineLight is made on: the grid's fine cells. Its bands are empty.
FineLight fine_light_on(const PartGrid& grid);

// The band that `coarse` is, on the fine cells. problem: as `coarse` was solved for, with the grid's matter; its beam,
// guess, spread and tolerance are not looked at. albedo: of each of the grid's cells (EMPTY: grey), channel: of it.
// Errors: kOverDeadline, kCancelled.
Result<SolvedBand> fine_band(const BandProblem& problem, const LightBand& coarse,
                             const PartGrid& grid, const SunDepth& sun,
                             const std::vector<glm::vec3>& albedo, int channel,
                             const Ordinates& ordinates, int threads, const Deadline& deadline);

// Cells along the longest side of SunDepth; `cells`: of matter without detail. Between the nodes the depth is linear,
// and within a cell that lies across the edge of a lump that is too deep, or too shallow, by much of the cell's depth:
// with half the cell the error of light that was scattered once is halved.
int sun_cells_in(const DetailField* detail, int cells);

}  // namespace awan
