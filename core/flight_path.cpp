#include "core/flight_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/exact_math.h"
#include "core/generate/generate.h"
#include "core/scene/spheres.h"
#include "core/scene/validate.h"
#include "core/sequence.h"
#include "core/survey/survey.h"

namespace awan {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

// An orbit looks up to the clouds as the automatic camera does. Over a ground it is as much higher as it must, at most
// to this, degrees.
constexpr double kSteepestOrbit = 60;
// Sides from which an orbit's distance is looked for.
constexpr int kOrbitSides = 72;
// How high over the ground an eye is at least, of its distance.
constexpr double kOverGround = 0.02;
// Where a way through turns around: from this share of the way within the clouds' box to this share of the way after.
constexpr double kTurnBegins = 0.4, kTurnEnds = 0.4;

double fov_of(const Camera& camera) {
    return camera.automatic ? kAutomaticFov : camera.fov;
}

glm::dvec3 level(double azimuth) {
    return {exact::sin(azimuth), 0, exact::cos(azimuth)};
}

// Where `forward` looks, with the picture of the scene; its eye is not used.
View view_along(const SceneDraft& draft, const glm::dvec3& forward) {
    Camera camera;
    camera.automatic = false;
    camera.target = forward;
    camera.fov = fov_of(draft.camera);
    return resolve_view(camera, draft.image, {});
}

CameraKey key_at(const SceneDraft& draft, const glm::dvec3& eye, const glm::dvec3& target) {
    return {0, eye, target, fov_of(draft.camera)};
}

// The least height at which an eye so far from what it looks at sees the ground from above.
double least_height(const SceneDraft& draft, double distance) {
    return draft.ground ? draft.ground->height + kOverGround * distance
                        : -std::numeric_limits<double>::infinity();
}

// --- orbit

// As far away as holds the box from every side.
double orbit_distance(const SceneDraft& draft, const Bounds& bounds, double elevation) {
    const glm::dvec3 center = 0.5 * (bounds.min + bounds.max);
    double distance = 1e-3;
    for (int i = 0; i < kOrbitSides; ++i) {
        const glm::dvec3 outward =
            exact::cos(elevation) * level(2 * std::numbers::pi * i / kOrbitSides) +
            glm::dvec3(0, exact::sin(elevation), 0);
        distance =
            std::max(distance, distance_that_holds(view_along(draft, -outward), bounds, center));
    }
    return distance;
}

std::vector<CameraKey> orbit(const SceneDraft& draft, const Bounds& bounds, std::uint64_t frames) {
    const glm::dvec3 center = 0.5 * (bounds.min + bounds.max);
    double elevation = kAutomaticElevation * kRadians;
    double distance = orbit_distance(draft, bounds, elevation);
    // The distance depends little on the elevation, and the elevation on it.
    for (int i = 0; i < 3; ++i) {
        const double sine = (least_height(draft, distance) - center.y) / distance;
        if (!(sine > exact::sin(elevation))) break;
        elevation = std::min(exact::asin(std::min(sine, 1.0)), kSteepestOrbit * kRadians);
        distance = orbit_distance(draft, bounds, elevation);
    }
    double begin = kAutomaticAzimuth * kRadians;
    if (!draft.camera.automatic) {
        const glm::dvec3 out = draft.camera.eye - center;
        if (out.x != 0 || out.z != 0) begin = exact::atan2(out.x, out.z);
    }
    std::vector<CameraKey> keys;
    for (std::uint64_t i = 0; i < frames; ++i) {
        const double turned =
            2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(frames);
        const glm::dvec3 outward =
            exact::cos(elevation) * level(begin + turned) + glm::dvec3(0, exact::sin(elevation), 0);
        keys.push_back(key_at(draft, center + distance * outward, center));
    }
    return keys;
}

// --- through

// The level line along an axis, 0 or 2, on which there is most matter, and how much; lines stand a cell apart and are
// as thick as three.
struct Line {
    glm::dvec3 through{0};
    double depth = -1;
};
Line deepest_line(const DensityVolume& volume, int axis) {
    const int side = 2 - axis;
    const int across = volume.cells[side], up = volume.cells.y;
    std::vector<double> depths(static_cast<std::size_t>(across) * static_cast<std::size_t>(up));
    const auto at = [&](int a, int y) -> double& {
        return depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(across) +
                      static_cast<std::size_t>(a)];
    };
    std::size_t cell = 0;
    for (int z = 0; z < volume.cells.z; ++z)
        for (int y = 0; y < up; ++y)
            for (int x = 0; x < volume.cells.x; ++x, ++cell)
                at(axis == 0 ? z : x, y) += static_cast<double>(volume.extinction[cell]);
    Line best;
    for (int y = 0; y < up; ++y)
        for (int a = 0; a < across; ++a) {
            double depth = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, up - 1); ++v)
                for (int b = std::max(a - 1, 0); b <= std::min(a + 1, across - 1); ++b)
                    depth += at(b, v);
            if (!(depth > best.depth)) continue;
            best.depth = depth;
            best.through = volume.origin;
            best.through[side] += (a + 0.5) * volume.cell;
            best.through.y += (y + 0.5) * volume.cell;
        }
    return best;
}

// From 0 to 1, at rest at both ends.
double smoothstep(double from, double to, double at) {
    const double u = std::clamp((at - from) / (to - from), 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

std::vector<CameraKey> through(const SceneDraft& draft, const Bounds& bounds,
                               const DensityVolume& volume, std::uint64_t frames) {
    const glm::dvec3 center = 0.5 * (bounds.min + bounds.max), size = bounds.max - bounds.min;
    int axis = 0;
    glm::dvec3 middle = center;
    if (volume.extinction.empty()) {
        if (size.z > size.x) axis = 2;
    } else {
        const Line along_x = deepest_line(volume, 0), along_z = deepest_line(volume, 2);
        if (along_z.depth > along_x.depth) axis = 2;
        middle = axis == 0 ? along_x.through : along_z.through;
        middle[axis] = center[axis];
    }
    const glm::dvec3 sun = sun_direction(draft.sun);
    glm::dvec3 forward(0);
    forward[axis] = sun[axis] < 0 ? 1 : -1;
    const double before = distance_that_holds(view_along(draft, forward), bounds, middle);
    const double after = distance_that_holds(view_along(draft, -forward), bounds, middle);
    const double all = std::max(before + after, 1e-3);
    middle.y = std::max(middle.y, least_height(draft, all));
    // Away from the sun, where what it shines on is seen.
    glm::dvec3 aside = glm::cross(glm::dvec3(0, 1, 0), forward);
    if (glm::dot(aside, sun) > 0) aside = -aside;
    const double enters = (before - 0.5 * size[axis]) / all,
                 leaves = (before + 0.5 * size[axis]) / all;
    const double turn_begins = enters + kTurnBegins * (leaves - enters),
                 turn_ends = std::max(leaves + kTurnEnds * (1 - leaves), turn_begins + 1e-3);
    std::vector<CameraKey> keys;
    for (std::uint64_t i = 0; i < frames; ++i) {
        const double share =
            frames < 2 ? 0 : static_cast<double>(i) / static_cast<double>(frames - 1);
        const double turned = std::numbers::pi * smoothstep(turn_begins, turn_ends, share);
        const glm::dvec3 eye = middle + (share * all - before) * forward;
        const glm::dvec3 looks = exact::cos(turned) * forward + exact::sin(turned) * aside;
        keys.push_back(key_at(draft, eye, eye + 0.5 * all * looks));
    }
    return keys;
}

// --- thickness

// As thick as `wanted` where the scene as it stands is `measured`: depth is proportional to density, and of spheres
// that have a visual range to its inverse. densities: of the clouds as they stand, 1/unit.
void thicken(SceneDraft& draft, const std::vector<double>& densities, double wanted,
             double measured) {
    const double factor = wanted / measured;
    for (std::size_t k = 0; k < draft.clouds.size(); ++k) {
        Cloud& cloud = draft.clouds[k];
        cloud.density = factor * densities[k];
        if (!cloud.spheres || !cloud.spheres->visual_range) continue;
        SpheresCloud spheres = *cloud.spheres;
        *spheres.visual_range /= factor;
        cloud.spheres = std::make_shared<const SpheresCloud>(std::move(spheres));
    }
}

// --- the scene

// What the clouds are at the sequence's middle.
Result<Survey> survey_middle(const SceneDraft& draft, int threads, const Deadline& deadline) {
    const Sequence& sequence = *draft.sequence;
    auto scene = validate(still_of(draft, sequence, 0.5 * (sequence.from + sequence.to)));
    if (!scene.ok()) return scene.error();
    const auto particles = generate(*scene, threads, deadline);
    if (!particles.ok()) return particles.error();
    return survey(*scene, *particles, threads, deadline);
}

// How long it lasts, and of how many frames it is.
void give_sequence(const FlightWish& wish, SceneDraft& draft) {
    const bool lasts = draft.sequence && draft.sequence->from != draft.sequence->to;
    const std::uint64_t own = draft.sequence ? draft.sequence->frames : kFlightFrames;
    Sequence sequence = draft.sequence.value_or(Sequence{});
    sequence.frames = wish.frames.value_or(own);
    if (!lasts) {
        sequence.from = draft.sequence ? sequence.from : draft.time;
        sequence.to =
            sequence.from + static_cast<double>(sequence.frames - 1) / wish.frames_per_second;
        sequence.clouds_stand = true;
    }
    draft.sequence = std::move(sequence);
    draft.time = draft.sequence->from;
}

Status give_keys(FlightPath path, const std::optional<Survey>& middle, int threads,
                 const Deadline& deadline, SceneDraft& draft) {
    Sequence& sequence = *draft.sequence;
    sequence.camera.clear();
    const auto bounds = bounds_of_sequence(draft, sequence, threads, deadline);
    if (!bounds.ok()) return bounds.error();
    std::vector<CameraKey> keys = path == FlightPath::kOrbit
                                      ? orbit(draft, *bounds, sequence.frames)
                                      : through(draft, *bounds, middle->volume, sequence.frames);
    for (std::uint64_t i = 0; i < sequence.frames; ++i)
        keys[static_cast<std::size_t>(i)].time = frame_time(sequence, i);
    // A sequence may run backwards.
    if (sequence.to < sequence.from) std::reverse(keys.begin(), keys.end());
    sequence.camera = std::move(keys);
    // Only its `up` would be used, and these stand upright.
    draft.camera = Camera{};
    return std::nullopt;
}

}  // namespace

Result<Scene> flight_of(const SceneDraft& draft, const FlightWish& wish, int threads,
                        const Deadline& deadline) {
    // What is wrong with the scene itself is said of it.
    if (auto scene = validate(draft); !scene.ok()) return scene.error();
    SceneDraft flight = draft;
    const bool has_keys = flight.sequence && !flight.sequence->camera.empty();
    const FlightPath path = wish.path.value_or(has_keys ? FlightPath::kKeys : FlightPath::kOrbit);
    if (path == FlightPath::kKeys && !has_keys)
        return Error{ErrorCode::kInvalidScene, "/sequence/camera",
                     "there are no keys to fly along"};
    if (flight.look == Look::kPhysical) {
        const char* const usual = draws_textures(flight) ? kPaintedFlightRung : kFlightRung;
        flight.accuracy = {{}, {}, wish.rung.value_or(usual)};
    }
    give_sequence(wish, flight);
    if (path != FlightPath::kKeys && flight.sequence->frames > limits::kMaxCameraKeys)
        return Error{ErrorCode::kInvalidScene, "/sequence/frames",
                     "a flight has at most " + std::to_string(limits::kMaxCameraKeys) +
                         " frames, each with a key of its own"};
    std::optional<Survey> middle;
    if (path == FlightPath::kThrough || wish.thickness) {
        auto surveyed = survey_middle(flight, threads, deadline);
        if (!surveyed.ok()) return surveyed.error();
        middle = *std::move(surveyed);
    }
    if (wish.thickness) {
        if (!(middle->optical_depth_zenith > 0))
            return Error{ErrorCode::kInvalidScene, "",
                         "has no matter that could be made thin or thick"};
        thicken(flight, middle->cloud_density, kThicknessDepths[static_cast<int>(*wish.thickness)],
                middle->optical_depth_zenith);
    }
    if (path != FlightPath::kKeys)
        if (Status failed = give_keys(path, middle, threads, deadline, flight)) return *failed;
    return validate(std::move(flight));
}

}  // namespace awan
