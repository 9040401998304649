// The only way to a Scene.
#pragma once

#include "core/scene/scene.h"

namespace awan {

// Checks every range of core/scene/limits.h and every rule between fields. The error of the first
// value that fails carries its JSON pointer and says what was allowed. What the contract has but
// this version lacks (later effects) is refused
// with kUnsupported.
Result<Scene> validate(SceneDraft draft);

}  // namespace awan
