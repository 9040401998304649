// The error that is stated for a picture, measured while it is made, and the light of the transport rungs refined until
// that error is small enough.
//
// A grid's light goes on from those of all coarser grids (core/light/nested_grids.h). After each grid that is a rung's,
// a sample of the picture's blocks shows by how much it differs from the one before: from that difference the error is
// stated. All wishes climb the same steps, so a stricter one never ends at a coarser grid.
#pragma once

#include "core/base/image.h"
#include "core/light/light_cache.h"
#include "core/planning.h"

namespace awan {

struct ClimbTools {
    LightCache* lights = nullptr;  // null: nothing is kept
    int threads = 1;               // >= 1
};

struct Climbed {
    SharedLight light;
    const Rung* rung = nullptr;  // the transport rung of the light; null: it has no grid
    // Its picture's error, as PictureError::nrmse. NaN: the time that was asked for was too short to measure it, or
    // nobody wants it (Planned::is_unmeasured).
    double stated = 0;
    bool was_kept = true;  // all of it came from the cache
    double light_ms = 0, measure_ms = 0;
    EffectTimes took;
};

// Whether the picture has to keep to an error: the scene asks for one, if only by asking for nothing, and the rung is
// not settled.
bool asks_for_error(const Scene& scene, const Planned& planned);

// Whether that is what the scene asks for.
bool holds(double error, const Scene& scene);

// Whether paths of tolerable length are expected to keep to what the scene asks for.
bool paths_may_hold(const Scene& scene, const Plan& plan);

// What was planned for another rung, with the effects, the settings and the detail of the transport rungs. The plan's
// rung and predictions stay. threads >= 1.
Planned planned_for_grids(const Scene& scene, Planned planned, int threads);

// The light of the planned rung where it is settled, a rung of Method::kMarch, or of rung `single` where it is planned
// (its error is not measured here); where the scene asks for an error, of the first transport rung whose stated error
// is at most that, or of the finest; where it asks for a time, of the finest that there is time for after what planning
// took (core/plan/step_times.h), measuring and drawing in.
// Errors: kOverDeadline, kCancelled.
Result<Climbed> climb(const Scene& scene, const Planned& planned, const ClimbTools& tools,
                      const Deadline& deadline);

// The error of a picture that was made without a grid: by how much it differs from that of the first grid that is
// expected to be much nearer to the truth, the coarsest rung's at the latest, and how far off that one is.
// Errors: kOverDeadline, kCancelled.
Result<double> error_of_picture(const Scene& scene, const Planned& planned, const Image& picture,
                                const ClimbTools& tools, const Deadline& deadline);

}  // namespace awan
