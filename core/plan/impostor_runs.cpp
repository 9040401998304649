#include "core/plan/impostor_runs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// Side of a texel where it is drawn, in pixels. A little below 1: what is shown between texels is blurred.
constexpr double kDrawnTexel = 0.8;
// Texels beside what the cloud fills: for the kernel that they are shown through.
constexpr int kPictureMargin = 2;
// Largest slope of a picture's edge.
constexpr double kWidest = 1.2;
// Most texels of a picture, over the frame's pixels.
constexpr double kMostTexels = 4;

// What work costs, in pixels of clouds that are drawn whole (measured on sky-of-100). Of a picture's
// texel; of a pixel that a picture is shown at; of a frame made of pictures, per pixel of the frame.
constexpr double kDrawTexel = 1.6, kShowPixel = 0.03, kFrameOfPictures = 0.03;
// Below this share of saved work impostors are left off, a flight's and a frame's.
constexpr double kFlightPays = 0.2, kFramePays = 0.1;

double pixel_slope(const View& view, const ImageSettings& image) {
    return 2 * view.tan_half_fov / image.height;
}

glm::dvec3 in_frame(const View& view, const glm::dvec3& p) {
    return {glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.forward)};
}

// A box's corners as a view has them.
std::array<glm::dvec3, 8> corners_in(const View& view, const Bounds& box) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = in_frame(view, glm::dvec3((i & 1) != 0 ? box.max.x : box.min.x,
                                               (i & 2) != 0 ? box.max.y : box.min.y,
                                               (i & 4) != 0 ? box.max.z : box.min.z) -
                                        view.eye);
    return corners;
}

// Pixels of the picture that a box fills, by its bounding rectangle; 0: it is not in the picture.
double pixels_of(const View& view, const ImageSettings& image, const Bounds& box) {
    const PictureBox own = picture_box(view, image, box);
    return own.any() ? (own.right - own.left) * (own.bottom - own.top) : 0;
}

// By how much the picture's plane is spread by standing away from the view's middle: 1 / cos^2 of its farthest corner.
double spread_at(const FacingPicture& picture, const View& view) {
    double spread = 1;
    for (const double x : {-picture.across, picture.across})
        for (const double y : {-picture.up, picture.up}) {
            const View& own = picture.view;
            const glm::dvec3 place =
                own.eye + picture.plane * (own.forward + x * own.right + y * own.up);
            const glm::dvec3 d = in_frame(view, place - view.eye);
            if (!(d.z > 0)) return std::numeric_limits<double>::infinity();
            spread = std::max(spread, glm::dot(d, d) / (d.z * d.z));
        }
    return spread;
}

// The most of |m along - across|, m a slope of the picture, of an eye's way `e` in the picture's frame.
double most_across(const FacingPicture& picture, const glm::dvec3& e) {
    return exact::hypot(std::abs(e.z) * picture.across + std::abs(e.x),
                        std::abs(e.z) * picture.up + std::abs(e.y));
}

// About the change of the logarithm of the phase function, taken as Henyey-Greenstein's, over an angle within a cloud
// that is seen in the picture.
double phase_change(const Scene& scene, const FacingPicture& picture, double angle) {
    const double g = std::abs(asymmetry(scene->medium));
    glm::dvec3 to_sun = sun_direction(scene->sun);
    if (asymmetry(scene->medium) < 0) to_sun = -to_sun;
    const double radius = exact::hypot(picture.across, picture.up) + angle;
    const double middle = exact::acos(std::clamp(glm::dot(to_sun, picture.view.forward), -1., 1.));
    const auto slope = [&](double theta) {
        return 3 * g * exact::sin(theta) / (1 + g * g - 2 * g * exact::cos(theta));
    };
    const double low = std::max(middle - radius, 0.0),
                 high = std::min(middle + radius, std::numbers::pi);
    const double steepest = exact::acos(2 * g / (1 + g * g));
    return angle * slope(std::clamp(steepest, low, high));
}

// What decides whether a picture still serves.
struct Bound {
    const FlightImpostorWish& wish;
    const Scene& scene;
    const std::vector<View>& views;

    bool holds(const FacingPicture& picture, const View& view) const {
        const ImageSettings& image = scene->image;
        if (!(displacement(picture, view, image) <= wish.pixels)) return false;
        const glm::dvec3 e = in_frame(picture.view, view.eye - picture.view.eye);
        const double texel = 2 * picture.view.tan_half_fov / picture.height * picture.plane /
                             (picture.plane - e.z) / pixel_slope(view, image);
        const double spread = spread_at(picture, view);
        if (!(texel >= kLeastTexel && texel * spread <= kMostTexel)) return false;
        const double angle = most_across(picture, e) / (picture.near - e.z);
        return phase_change(scene, picture, angle) <= kMostPhaseChange;
    }
};

// Above all ground: what hides such a cloud stands before all of it or behind.
bool may_have_picture(const Scene& scene, const SeparateCloud& cloud) {
    if (scene->haze && scene->haze->extinction > 0) {
        const double half = 0.5 * glm::length(cloud.shows.max - cloud.shows.min);
        if (half * scene->haze->extinction > kMostHazeWithin) return false;
    }
    if (!scene->ground) return true;
    const double hills = scene->ground->terrain ? scene->ground->terrain->height : 0;
    return cloud.all.min.y > scene->ground->height + hills;
}

// Of one cloud in all frames: pixels that it fills.
using Sizes = std::vector<double>;

// The longest run from `first` on that one picture serves: of the last frame whose eye's picture serves the first, as
// far as that serves. None: the cloud has no picture there.
std::optional<ImpostorRun> run_from(const Bound& bound, const SeparateCloud& cloud,
                                    std::uint64_t first, const Sizes& sizes) {
    const ImageSettings& image = bound.scene->image;
    const auto shown = [&](std::uint64_t i) {
        return i < sizes.size() && sizes[static_cast<std::size_t>(i)] > 0;
    };
    const auto view = [&](std::uint64_t i) -> const View& {
        return bound.views[static_cast<std::size_t>(i)];
    };
    std::optional<ImpostorRun> run;
    for (std::uint64_t key = first; shown(key); ++key) {
        auto picture = facing_picture(cloud, view(key), image);
        if (!picture || !bound.holds(*picture, view(first))) break;
        run = ImpostorRun{0, first, first, key, *picture};
    }
    if (!run) return run;
    run->last = run->key;
    for (std::uint64_t i = first + 1; i < run->key; ++i)
        if (!bound.holds(run->picture, view(i))) {  // the path bends there
            auto own = facing_picture(cloud, view(first), image);
            run = ImpostorRun{0, first, first, first, *own};
            break;
        }
    while (shown(run->last + 1) && bound.holds(run->picture, view(run->last + 1))) ++run->last;
    return run;
}

double saved_by(const ImpostorRun& run, const Sizes& sizes) {
    double saved = -kDrawTexel * run.picture.width * run.picture.height;
    for (std::uint64_t i = run.first; i <= run.last; ++i)
        saved += (1 - kShowPixel) * sizes[static_cast<std::size_t>(i)];
    return saved;
}

std::vector<ImpostorRun> runs_of(const Bound& bound, const SeparateCloud& cloud,
                                 const Sizes& sizes) {
    std::vector<ImpostorRun> runs;
    if (!may_have_picture(bound.scene, cloud)) return runs;
    for (std::uint64_t i = 0; i < sizes.size(); ++i) {
        if (!(sizes[static_cast<std::size_t>(i)] > 0)) continue;
        auto run = run_from(bound, cloud, i, sizes);
        if (!run || run->last == run->first) continue;
        i = run->last;
        if (bound.wish.mode == Impostors::kAuto && !(saved_by(*run, sizes) > 0)) continue;
        runs.push_back(*std::move(run));
    }
    return runs;
}

std::string percent(const char* format, double share) {
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(), format, 100 * share);
    return text.data();
}

}  // namespace

std::optional<FacingPicture> facing_picture(const SeparateCloud& cloud, const View& view,
                                            const ImageSettings& image) {
    const glm::dvec3 middle = 0.5 * (cloud.all.min + cloud.all.max) - view.eye;
    const double distance = glm::length(middle);
    if (!(distance > 0)) return std::nullopt;
    FacingPicture picture;
    View& own = picture.view;
    own.eye = view.eye;
    own.forward = middle / distance;
    // As upright as the frame, so that texels lie as pixels do.
    const glm::dvec3 right = glm::cross(own.forward, view.up);
    if (!(glm::length(right) > 1e-3)) return std::nullopt;
    own.right = glm::normalize(right);
    own.up = glm::cross(own.right, own.forward);
    picture.near = 1e300;
    picture.far = 0;
    for (const glm::dvec3& c : corners_in(own, cloud.shows)) {
        if (!(c.z > 0)) return std::nullopt;
        picture.near = std::min(picture.near, c.z);
        picture.far = std::max(picture.far, c.z);
        picture.across = std::max(picture.across, std::abs(c.x) / c.z);
        picture.up = std::max(picture.up, std::abs(c.y) / c.z);
    }
    picture.plane = 2 / (1 / picture.near + 1 / picture.far);
    double across = 0, up = 0;
    for (const glm::dvec3& c : corners_in(own, cloud.all)) {
        if (!(c.z > 0)) return std::nullopt;
        across = std::max(across, std::abs(c.x) / c.z);
        up = std::max(up, std::abs(c.y) / c.z);
    }
    if (!(std::max(across, up) <= kWidest)) return std::nullopt;
    const double texel = kDrawnTexel * pixel_slope(view, image);
    const double wide = std::ceil(2 * across / texel) + 2 * kPictureMargin,
                 tall = std::ceil(2 * up / texel) + 2 * kPictureMargin;
    if (wide * tall > kMostTexels * image.width * image.height) return std::nullopt;
    picture.width = static_cast<int>(wide);
    picture.height = static_cast<int>(tall);
    own.tan_half_fov = 0.5 * tall * texel;
    own.aspect = wide / tall;
    return picture;
}

double displacement(const FacingPicture& picture, const View& view, const ImageSettings& image) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    const glm::dvec3 e = in_frame(picture.view, view.eye - picture.view.eye);
    if (!(e.z < picture.near)) return kInfinite;
    const double most = most_across(picture, e);
    const auto at = [&](double z) {
        return most * std::abs(picture.plane - z) / ((z - e.z) * (picture.plane - e.z));
    };
    return std::max(at(picture.near), at(picture.far)) * spread_at(picture, view) /
           pixel_slope(view, image);
}

PictureBox PictureBox::with(const PictureBox& other) const {
    return {std::min(left, other.left), std::min(top, other.top), std::max(right, other.right),
            std::max(bottom, other.bottom)};
}

PictureBox picture_box(const View& view, const ImageSettings& image, const Bounds& box) {
    const double wide = view.tan_half_fov * view.aspect, tall = view.tan_half_fov;
    glm::dvec2 low(1e300), high(-1e300);
    bool left = true, right = true, over = true, under = true, behind = true, before = true;
    for (const glm::dvec3& c : corners_in(view, box)) {
        left = left && c.x < -wide * c.z;
        right = right && c.x > wide * c.z;
        under = under && c.y < -tall * c.z;
        over = over && c.y > tall * c.z;
        behind = behind && c.z <= 0;
        before = before && c.z > 0;
        if (!(c.z > 0)) continue;
        low = glm::min(low, glm::dvec2(c.x, c.y) / c.z);
        high = glm::max(high, glm::dvec2(c.x, c.y) / c.z);
    }
    if (left || right || over || under || behind) return {};
    if (!before) low = glm::dvec2(-1e300), high = glm::dvec2(1e300);
    const double pixel = pixel_slope(view, image);
    low = glm::max(low, glm::dvec2(-wide, -tall));
    high = glm::max(glm::min(high, glm::dvec2(wide, tall)), low + pixel);
    return {(low.x + wide) / pixel, (tall - high.y) / pixel, (high.x + wide) / pixel,
            (tall - low.y) / pixel};
}

ImpostorPlan plan_impostors(const FlightImpostorWish& wish, const Scene& scene,
                            const SeparateClouds& clouds, const std::vector<View>& views) {
    ImpostorPlan plan;
    plan.frames.resize(views.size());
    const bool automatic = wish.mode == Impostors::kAuto;
    if (wish.mode == Impostors::kOff) {
        plan.reason = "they are switched off";
        return plan;
    }
    const Bound bound{wish, scene, views};
    const double frame = static_cast<double>(scene->image.width) * scene->image.height;
    std::vector<double> all(views.size()), kept(views.size());
    for (std::size_t c = 0; c < clouds.list.size(); ++c) {
        Sizes sizes(views.size());
        for (std::size_t i = 0; i < views.size(); ++i) {
            sizes[i] = pixels_of(views[i], scene->image, clouds.list[c].shows);
            all[i] += sizes[i];
        }
        for (ImpostorRun& run : runs_of(bound, clouds.list[c], sizes)) {
            run.cloud = c;
            const double drawn = kDrawTexel * run.picture.width * run.picture.height;
            const auto frames = static_cast<double>(run.last - run.first + 1);
            for (std::uint64_t i = run.first; i <= run.last; ++i) {
                const auto at = static_cast<std::size_t>(i);
                kept[at] += (1 - kShowPixel) * sizes[at] - drawn / frames;
            }
            plan.runs.push_back(std::move(run));
        }
    }
    double work = 0, saved = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const double own = kept[i] - kFrameOfPictures * frame;
        plan.frames[i] = automatic ? own > kFramePays * all[i] : false;
        work += all[i];
        if (plan.frames[i]) saved += own;
    }
    if (!automatic)
        for (const ImpostorRun& run : plan.runs)
            for (std::uint64_t i = run.first; i <= run.last; ++i) {
                saved += plan.frames[static_cast<std::size_t>(i)]
                             ? 0
                             : kept[static_cast<std::size_t>(i)] - kFrameOfPictures * frame;
                plan.frames[static_cast<std::size_t>(i)] = true;
            }
    plan.saved = work > 0 ? saved / work : 0;
    if (plan.runs.empty()) {
        plan.reason = "no cloud's picture could be kept for two frames";
    } else if (automatic && !(plan.saved > kFlightPays)) {
        plan.reason = percent("they would save %.0f%% of the eye pass's work", plan.saved);
    } else {
        plan.on = true;
        plan.reason =
            percent("they are expected to save %.0f%% of the eye pass's work", plan.saved);
    }
    if (!plan.on) {
        plan.runs.clear();
        plan.frames.assign(views.size(), false);
    }
    return plan;
}

}  // namespace awan
