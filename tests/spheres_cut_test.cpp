// Level of detail of clouds of spheres: what a cut keeps, how large it may get, and that pictures of it are as near to
// those of all leaves as it says.
#include "core/generate/spheres/cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/generate/models.h"
#include "core/pipeline.h"
#include "core/scene/limits.h"
#include "core/scene/spheres.h"
#include "core/scene/validate.h"
#include "tests/scenes.h"

namespace awan {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

double pixel_angle(int height) {
    return 2 * std::tan(20 * kDegrees) / height;
}

ModelParticles made_of(const SpheresCloud& cloud, double angle, std::optional<glm::dvec3> eye,
                       int threads = 1) {
    ModelRequest request;
    request.key = 77;
    request.density = 0.2;
    request.pixel_angle = angle;
    request.eye = eye;
    request.threads = threads;
    auto made = spheres::make_particles(cloud, request, {});
    EXPECT_TRUE(made.ok());
    return *std::move(made);
}

double mass_of(const ReadyParticles& set) {
    double mass = 0;
    for (std::size_t i = 0; i < set.radii.size(); ++i)
        mass +=
            static_cast<double>(set.densities[i]) * std::pow(static_cast<double>(set.radii[i]), 3);
    return mass;
}

SpheresCloud flat_cirrus(std::uint64_t levels) {
    SpheresCloud cloud;
    cloud.kind = SpheresKind::kCirrus;
    cloud.levels = levels;
    cloud.size = {500, 60, 400};
    cloud.scaling = SpheresScaling::kEvery;
    return cloud;
}

Image picture_of(const ReadyParticles& particles, const glm::dvec3& eye, int height) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    Cloud& cloud = draft.clouds.emplace_back();
    cloud.model = CloudModel::kParticles;
    cloud.ready = particles;
    cloud.density = 1;
    draft.camera.automatic = false;
    draft.camera.eye = eye;
    draft.camera.target = {0, 60, 0};
    draft.image.width = height * 4 / 3;
    draft.image.height = height;
    draft.image.background = Background::kTransparent;
    draft.accuracy.rung = "transport-16";
    const auto rendered = render_scene(test::valid(draft), {nullptr, 2, nullptr, {}, {}}, {});
    EXPECT_TRUE(rendered.ok());
    return rendered->image;
}

// The means of squares of `by` x `by` pixels.
Image shrunk(const Image& image, int by) {
    Image small{image.width / by, image.height / by, image.opaque, {}};
    small.pixels.resize(4 * small.pixel_count());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 4; ++c)
                small.pixels[static_cast<std::size_t>(4 * (y / by * small.width + x / by) + c)] +=
                    image.pixels[static_cast<std::size_t>(4 * (y * image.width + x) + c)] /
                    static_cast<float>(by * by);
    return small;
}

// Root mean square of the difference over that of `b`, of pixels with some cloud.
double difference(const Image& a, const Image& b) {
    double square = 0, sum = 0;
    for (std::size_t i = 0; i < b.pixels.size(); i += 4) {
        if (b.pixels[i + 3] < 0.05F) continue;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double own = static_cast<double>(b.pixels[c]);
            const double off = static_cast<double>(a.pixels[c]) - own;
            square += off * off;
            sum += own * own;
        }
    }
    return std::sqrt(square / sum);
}

TEST(SpheresCut, PicturesAreAsNearAsStated) {
    constexpr int kHeight = 120, kFiner = 2;
    SpheresCloud cumulus;
    cumulus.levels = 6;
    const SpheresCloud clouds[] = {cumulus, flat_cirrus(6)};
    for (const SpheresCloud& cloud : clouds)
        for (const double distance : {700.0, 2500.0}) {
            const glm::dvec3 eye(distance * 0.7, 60, distance * 0.7);
            const ModelParticles cut = made_of(cloud, pixel_angle(kHeight), eye);
            const ModelParticles whole = made_of(cloud, 0, eye);
            EXPECT_EQ(whole.particles.positions.size(), 15625u);
            EXPECT_EQ(whole.error, 0);
            EXPECT_EQ(whole.variant, 0u);
            EXPECT_LT(cut.particles.positions.size(), 15625u);
            EXPECT_NE(cut.variant, 0u);
            EXPECT_GT(cut.error, 0);
            EXPECT_LT(cut.error, 0.2);
            // Of the whole, whose leaves are far below a pixel, pixels are means of many rays.
            const auto seen = [&](const ModelParticles& of) {
                return shrunk(picture_of(of.particles, eye, kFiner * kHeight), kFiner);
            };
            const double off = difference(seen(cut), seen(whole));
            std::printf("cut at %zu of 15625: stated %.4f, measured %.4f\n",
                        cut.particles.positions.size(), cut.error, off);
            EXPECT_LE(off, cut.error) << distance;
        }
}

// A cut sphere has the mass to be expected below its five children. That of a leaf's parent is exact, deeper ones
// differ by 33% a cluster, at random; here some thousand are cut.
TEST(SpheresCut, MassIsKept) {
    SpheresCloud cloud;
    cloud.levels = 7;
    const double whole = mass_of(made_of(cloud, 0, std::nullopt).particles);
    for (const int height : {40, 20}) {
        const ModelParticles cut = made_of(cloud, pixel_angle(height), std::nullopt);
        EXPECT_LT(cut.particles.positions.size(), 78125u / 2);
        EXPECT_NEAR(mass_of(cut.particles) / whole, 1, 0.01) << height;
    }
}

TEST(SpheresCut, IsFinerWhereTheEyeIsNear) {
    const SpheresCloud cloud = flat_cirrus(7);
    const double angle = pixel_angle(600);
    std::size_t last = 78126;
    for (const double distance : {300.0, 3000.0, 30000.0, 3e6}) {
        const std::size_t count =
            made_of(cloud, angle, glm::dvec3(distance, 0, 0)).particles.positions.size();
        EXPECT_LT(count, last) << distance;
        last = count;
    }
    EXPECT_EQ(last, 1u);  // a cloud that is less than a pixel is one particle
}

// From where an eye stands a sphere is as near as its nearest point.
TEST(SpheresCut, SpheresLookAsLargeAsFromTheirNearestPoint) {
    spheres::SphereCut cut;
    cut.eye = glm::dvec3(0, 0, 13);
    cut.least_distance = 1e-6;
    EXPECT_DOUBLE_EQ(cut.size_of({{0, 0, 0}, 10}), 10.0 / 3);
    EXPECT_DOUBLE_EQ(cut.size_of({{5, 0, 1}, 3}), 3.0 / 10);
    EXPECT_DOUBLE_EQ(cut.size_of({{0, 0, 10}, 5}), 5e6);  // within it
}

TEST(SpheresCut, TheDeepestTreesStayWithinTheirBudget) {
    SpheresCloud cloud;
    cloud.levels = 10;
    const ModelParticles made = made_of(cloud, 0, glm::dvec3(10, 20, 5), 2);
    const std::size_t count = made.particles.positions.size();
    EXPECT_LE(count, limits::kMaxSpheresParticles);
    EXPECT_GT(count,
              limits::kMaxSpheresParticles / 2);  // classes of sizes are an eighth octave wide
    EXPECT_GT(made.error, 0);
}

// All spheres of a tree of one ratio are as large as each other, a level at a time: the budget falls between two
// levels.
TEST(SpheresCut, EqualSpheresStayWithinTheBudgetToo) {
    SpheresCloud cloud;
    cloud.levels = 10;
    for (const double ratio : {0.05, 0.9}) {
        cloud.ratio_min = cloud.ratio_max = ratio;
        for (const bool near : {false, true}) {
            const std::optional<glm::dvec3> eye =
                near ? std::optional(glm::dvec3(0)) : std::nullopt;
            const std::size_t count = made_of(cloud, 0, eye, 2).particles.positions.size();
            EXPECT_LE(count, limits::kMaxSpheresParticles) << ratio << near;
            EXPECT_GE(count, 1u) << ratio << near;
        }
    }
}

TEST(SpheresCut, CoarseOnesHaveAboutTheSameBounds) {
    SpheresCloud cloud;
    cloud.levels = 7;
    ModelRequest request;
    request.coarse = true;
    const auto box = [](const ReadyParticles& set) {
        Bounds bounds{set.positions[0], set.positions[0]};
        for (std::size_t i = 0; i < set.positions.size(); ++i) {
            const glm::dvec3 r(static_cast<double>(set.radii[i]));
            bounds.min = glm::min(bounds.min, set.positions[i] - r);
            bounds.max = glm::max(bounds.max, set.positions[i] + r);
        }
        return bounds;
    };
    for (std::uint64_t key = 1; key <= 10; ++key) {
        request.key = key;
        request.coarse = true;
        const auto coarse = spheres::make_particles(cloud, request, {});
        request.coarse = false;
        const auto fine = spheres::make_particles(cloud, request, {});
        ASSERT_LE(coarse->particles.positions.size(), 625u);
        const Bounds a = box(coarse->particles), b = box(fine->particles);
        // Of a cloud of 500; a coarse particle is some 50 wide.
        EXPECT_LT(glm::length(a.min - b.min), 60) << key;
        EXPECT_LT(glm::length(a.max - b.max), 60) << key;
    }
}

}  // namespace
}  // namespace awan
