#include "core/scene/validate.h"

#include <memory>
#include <string_view>
#include <utility>

#include "core/scene/check_ranges.h"
#include "core/scene/fingerprint.h"
#include "core/scene/outside.h"
#include "core/scene/rules.h"

namespace awan {
namespace {

// A draft that says it was written with its cubes at the top has no other pointers to them, whatever else was set
// since.
void point_to_top(Error& error) {
    constexpr std::string_view kOnlyCloud = "/clouds/0";
    if (error.pointer.starts_with(kOnlyCloud)) error.pointer.erase(0, kOnlyCloud.size());
}

}  // namespace

Result<Scene> validate(SceneDraft draft) {
    if (Status wrong = check_ranges(table_of<SceneDraft>(), &draft, "")) {
        if (draft.top_level_cubes) point_to_top(*wrong);
        return *wrong;
    }
    if (Status wrong = check_rules(draft)) return *wrong;
    Medium& medium = draft.medium;
    if (medium.phase != PhaseFunction::kMie)
        medium.droplets = nullptr;
    else if (!medium.droplets || medium.droplets->diameter != medium.droplet)
        medium.droplets = std::make_shared<const DropletPhase>(droplet_phase(medium.droplet));
    if (!has_terrain(draft)) {
        draft.relief = nullptr;
    } else {
        std::string key =
            fingerprint_of(table_of<Ground>(), &*draft.ground) + std::string(map_hash(draft));
        if (!draft.relief || draft.relief->key != key) {
            draft.relief = std::make_shared<ReliefSlot>();
            draft.relief->key = std::move(key);
        }
    }
    draft.sky.air = air_of(draft);
    return Scene(std::move(draft));
}

}  // namespace awan
