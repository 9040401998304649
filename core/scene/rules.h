// The rules of a scene that concern several fields at once; what concerns one alone is in its table (table.h).
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scene/check_ranges.h"
#include "core/scene/scene.h"

namespace awan {

struct AutomatonCloud;
struct SpheresCloud;
struct ImplicitCloud;
struct EllipsoidsCloud;

// --- of values. Precondition: check_ranges() found nothing.

// The first that a scene breaks, clouds first, then in the order of the document.
Status check_rules(const SceneDraft& draft);

// Those of the models (rules_models.cpp). `at` is the pointer to the cloud's object of that model.
Status check_rules(const AutomatonCloud& cloud, const std::string& at);
Status check_rules(const SpheresCloud& cloud, const std::string& at);
Status check_rules(const ImplicitCloud& cloud, const std::string& at);
Status check_rules(const EllipsoidsCloud& cloud, const std::string& at);

// Ranges, then rules, of the object of one model: whether a cloud may have it.
template <typename Model>
Status check_model(const Model& model, const std::string& at) {
    if (Status wrong = check_ranges(table_of<Model>(), &model, at)) return wrong;
    return check_rules(model, at);
}

// --- of writing: what a document must give, and what it may not give together (rules_written.cpp)

// `object` is as read so far, all of its fields done. The error's pointer is relative to it.
Status check_written(const Given& given, const void* object);

}  // namespace awan
