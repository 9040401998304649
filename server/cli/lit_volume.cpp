// awan particles --light: the extinction and the light of a scene as grids of one file.
#include "server/cli/lit_volume.h"

#include "core/climb.h"
#include "core/formats/vdb_file.h"
#include "core/light/light_volume.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "core/survey/volume.h"

namespace awan {

Result<std::string> encode_lit_vdb(const Scene& scene, int voxels, double most_work, int threads) {
    SceneDraft draft = *scene;
    const Rung* const named = draft.accuracy.rung ? find_rung(*draft.accuracy.rung) : nullptr;
    if (named != nullptr && named->cells == 0)
        return Error{ErrorCode::kInvalidScene, "/accuracy/rung",
                     std::string("rung ") + named->name +
                         " has no grid of light; --light is of the rungs transport-*"};
    if (draft.look != Look::kPhysical)
        return Error{ErrorCode::kInvalidScene, "/look", "a look has no light for --light to give"};
    if (named == nullptr) draft.accuracy = {{}, {}, rung_of(RungId::kTransport32).name};
    const auto lit = validate(std::move(draft));
    if (!lit) return lit.error();
    auto planned = plan_scene(*lit, threads, Deadline{}, measure_speed());
    if (!planned) return planned.error();
    // One grid for all, and nobody asks how far off it is.
    planned->plan.transport.islands = {};
    planned->is_unmeasured = true;
    const auto climbed = climb(*lit, *planned, {nullptr, threads}, Deadline{});
    if (!climbed) return climbed.error();
    const DensityVolume volume = density_volume(planned->particles, voxels, most_work);
    return encode_vdb(volume, light_volume(*lit, *climbed->light, volume, threads));
}

}  // namespace awan
