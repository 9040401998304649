#include "core/plan/known_error.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/exact_math.h"
#include "core/plan/forecast_figures.h"

namespace awan {
namespace {

// The march's steps and its light between looked up rays, in any matter; and in thick matter the sun's lattice:
constexpr double kEyeError = 0.005, kThickError = 0.006;
// what 128 directions and four orders leave of the angles of forward scattered light, times g squared; the more of it
// the nearer the sun is to behind the eye, in proportion to the square of what the cosine between it and the view is
// below -1/2: what comes back from there has turned around by many small angles, which the peak's light does not. Where
// matter is so thin that little else comes back, that is most of it, times g to the power of 6. Towards the sun, where
// the peak comes through in thick matter, times g to the power of 4 and the cosine squared; of it kLeavingError is of
// light that leaves the matter by its sides, or comes to the next cloud where it would not have, since the peak is
// taken to go straight on: in proportion to how often it would pass matter's thickness on its way (leaving);
constexpr double kAngularError = 0.025, kTurnedBackError = 0.2, kThinTurnedBackError = 0.5,
                 kIntoSunError = 0.1, kLeavingError = 0.25;
// By how much light turns when the peak scatters it, as a tangent; and ways after which no more of it is left.
constexpr double kTurn = 0.47, kMostLeaving = 5;
// what lumps of detail that are smaller than steps, cells and the gaps between rays leave, times the detail's amount;
// more of it in deep matter, where a cell of the sun's lattice is several mean free paths, in proportion to the square
// of depths up to kDeep, and where the sun shines through their edges, times the cosine squared between it and the
// view.
constexpr double kDetailError = 0.021, kDeepDetailError = 0.26, kDeep = 800,
                 kBacklitDetailError = 0.03;
// Of what is far below a pixel, times its share of the matter (Survey::sub_pixel).
constexpr double kSubPixelError = 0.01;
// Of matter in clumps that cells do not see (core/survey/clumps.h), times what is hidden in them to the power of 1.5,
// less kSeenOfClumps of what a grid with kFinerClumps times the cells would see of it: that, grids differ by.
constexpr double kClumpError = 0.5, kSeenOfClumps = 1.65, kFinerClumps = 1.5;
// Of the ground's light where hills stand and a level ground sends it up in their stead, times its share of all
// (terrain_truth_test).
constexpr double kHillsError = 0.3;

// The sun's way through the middle of the matter's box, over the shortest of its sides, times by how much the peak's
// light turns; 0..1, of kMostLeaving.
double leaving(const Scene& scene, const Survey& survey) {
    const glm::dvec3 size = glm::max(survey.bounds.max - survey.bounds.min, glm::dvec3(1e-12));
    const glm::dvec3 slope = glm::abs(sun_direction(scene->sun)) / size;
    const double thinnest = std::min({size.x, size.y, size.z});
    const double way = 1 / std::max({slope.x, slope.y, slope.z});
    return std::min(kTurn * way / (thinnest * kMostLeaving), 1.0);
}

double clump_error(const Survey& survey, int cells) {
    const int along = grid_count(survey, cells);
    const double hidden = survey.clumps.at(along);
    const double seen = hidden - survey.clumps.at(kFinerClumps * along);
    const double unseen = std::max(hidden - kSeenOfClumps * seen, 0.0);
    return kClumpError * unseen * std::sqrt(unseen);
}

}  // namespace

double known_error(const Scene& scene, const Survey& survey, bool detailed, int cells) {
    const double g = asymmetry(scene->medium), depth = survey.optical_depth_eye;
    const double behind = std::clamp(-2 * survey.sun_cosine - 1, 0.0, 1.0);
    const double into_sun = std::max(survey.sun_cosine, 0.0);
    const double into_sun_error = kIntoSunError + kLeavingError * leaving(scene, survey);
    const double angular = (kAngularError + kTurnedBackError * behind * behind +
                            into_sun_error * into_sun * into_sun * g * g) *
                           g * g;
    const double thick = depth / (1 + depth);
    const double thin_turned_back =
        kThinTurnedBackError * behind * behind * g * g * g * g * g * g * 4 * thick * (1 - thick);
    double known =
        exact::hypot(kEyeError, exact::hypot(kThickError, angular) * thick, thin_turned_back);
    if (detailed) {
        const double deep = std::min(depth / kDeep, 1.0);
        known = exact::hypot(known, scene->detail.value_or(Detail{}).amount *
                                        (kDetailError + kDeepDetailError * deep * deep +
                                         kBacklitDetailError * into_sun * into_sun));
    }
    if (has_terrain(*scene))
        known = exact::hypot(known, kHillsError * survey.ground.light / (1 + survey.ground.light));
    known = exact::hypot(known, clump_error(survey, cells));
    return exact::hypot(known, kSubPixelError * survey.sub_pixel);
}

}  // namespace awan
