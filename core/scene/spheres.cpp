#include "core/scene/spheres.h"

#include <algorithm>

#include "core/scene/checks.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

Status check_span(const Span& span, double lowest, double highest, const std::string& at,
                  const char* low, const char* high) {
    if (Status wrong = in_range(span.low, lowest, highest, at + low)) return wrong;
    if (Status wrong = in_range(span.high, lowest, highest, at + high)) return wrong;
    if (span.low <= span.high) return std::nullopt;
    return invalid(at + low, "must be at most the upper end, " + to_text(span.high) + ", not " +
                                 to_text(span.low));
}

}  // namespace

Span ratios_of(const SpheresCloud& cloud) {
    const bool cumulus = cloud.kind == SpheresKind::kCumulus;
    return {cloud.ratio_min.value_or(cumulus ? 0.26 : 0.2),
            cloud.ratio_max.value_or(cumulus ? 0.76 : 0.7)};
}

Span shifts_of(const SpheresCloud& cloud) {
    const bool cumulus = cloud.kind == SpheresKind::kCumulus;
    return {cloud.shift_min.value_or(cumulus ? 0.9 : 0.5), cloud.shift_max.value_or(1.0)};
}

std::vector<double> figures_of(const SpheresCloud& cloud) {
    // Ranges that only repeat the kind's say the same as none.
    const Span ratios = ratios_of(cloud), shifts = shifts_of(cloud);
    std::vector<double> figures = {static_cast<double>(cloud.levels),
                                   cloud.size.x,
                                   cloud.size.y,
                                   cloud.size.z,
                                   cloud.visual_range ? 1.0 : 0.0,
                                   cloud.visual_range.value_or(0.0),
                                   ratios.low,
                                   ratios.high,
                                   shifts.low,
                                   shifts.high,
                                   static_cast<double>(cloud.scaling),
                                   static_cast<double>(cloud.growth),
                                   cloud.morph ? 1.0 : 0.0};
    if (cloud.morph) {
        // A seed is more than a double holds.
        figures.push_back(static_cast<double>(cloud.morph->seed >> 32));
        figures.push_back(static_cast<double>(cloud.morph->seed & 0xffffffffu));
        figures.push_back(cloud.morph->duration);
        figures.push_back(static_cast<double>(cloud.morph->steps));
    }
    return figures;
}

Status check_spheres(const SpheresCloud& cloud, const std::string& at) {
    if (Status wrong = count_in_range(cloud.levels, 0, limits::kMaxSphereLevels, at + "/levels"))
        return wrong;
    for (int axis = 0; axis < 3; ++axis)
        if (Status wrong = in_range(cloud.size[axis], limits::kMinSpheresSide,
                                    limits::kMaxSpheresSide, at + "/size/" + std::to_string(axis)))
            return wrong;
    if (cloud.visual_range)
        if (Status wrong = in_range(*cloud.visual_range, limits::kMinVisualRange,
                                    limits::kMaxVisualRange, at + "/visual_range"))
            return wrong;
    if (Status wrong = check_span(ratios_of(cloud), limits::kMinSphereRatio,
                                  limits::kMaxSphereRatio, at, "/ratio_min", "/ratio_max"))
        return wrong;
    if (Status wrong = check_span(shifts_of(cloud), 0, 1, at, "/shift_min", "/shift_max"))
        return wrong;
    if (!cloud.morph) return std::nullopt;
    if (Status wrong = in_range(cloud.morph->duration, limits::kMinMorphDuration, limits::kMaxTime,
                                at + "/morph/duration"))
        return wrong;
    return count_in_range(cloud.morph->steps, 1, limits::kMaxMorphSteps, at + "/morph/steps");
}

std::uint64_t most_particles(const SpheresCloud& cloud) {
    std::uint64_t leaves = 1;
    for (std::uint64_t k = 0; k < cloud.levels && leaves < limits::kMaxSpheresParticles; ++k)
        leaves *= 5;
    return std::min(leaves, limits::kMaxSpheresParticles);
}

}  // namespace awan
