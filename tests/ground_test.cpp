// The ground: its light against laws, pictures of it and of clouds over it against the path tracer.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/draw/backdrop.h"
#include "core/light/ground_gather.h"
#include "core/light/light_cache.h"
#include "core/light/sun_depth.h"
#include "core/survey/projection.h"
#include "core/truth/oracles.h"
#include "tests/ground_scenes.h"

namespace awan {
namespace {

using std::numbers::pi;
using test::ground_picture;

// The sun's depth behind an opaque half-plane that faces the sun: depth 60 where u < 0, `above` the ground's origin
// along the light.
SunDepth half_plane(const glm::dvec3& to_sun, double away, double side, int cells) {
    SunDepth sun;
    sun.w = -to_sun;
    const SideAxes axes = side_axes(sun.w);
    sun.u = axes.u;
    sun.v = axes.v;
    sun.cell = glm::dvec3(side / cells);
    sun.nodes = {cells, cells, 2};
    sun.origin = to_sun * away - 0.5 * (side - sun.cell.x) * (sun.u + sun.v);
    const auto n = static_cast<std::size_t>(cells);
    sun.depth.assign(n * n * 2, 0.F);
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n / 2; ++i) sun.depth[n * n + j * n + i] = 60;
    return sun;
}

// The share of a disc of radius 1 that is to the right of -x.
double disc_beyond(double x) {
    if (x <= -1) return 0;
    if (x >= 1) return 1;
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi;
}

TEST(Ground, FarFromTheCloudItHasTheOpenSunAndSky) {
    SceneDraft draft = test::over_ground(.3);
    draft.sky.zenith = draft.sky.horizon = {.2, .4, .6};
    draft.sky.intensity = 2;
    const auto made = ground_picture(draft, 16);
    const GroundLight& ground = made.light.ground;
    const double up = std::sin(draft.sun.elevation * pi / 180);
    for (const double far : {1e6, -1e8}) {
        const glm::dvec3 e = irradiance_at(ground, far, 3), l = radiance_at(ground, 5, far);
        for (int c = 0; c < 3; ++c) {
            // The sky's part is a sum (means_of), good to 1e-3.
            const double expected =
                draft.sun.color[c] * draft.sun.intensity * up + pi * 2 * (.2 + .2 * c);
            EXPECT_NEAR(e[c] / expected, 1, 1e-3);
            EXPECT_NEAR(l[c] / (.3 / pi * expected), 1, 1e-3);
        }
    }
}

TEST(Ground, APenumbraIsAsWideAsTheSunIsFromTheEdge) {
    for (const double elevation : {90., 30.})
        for (const double away : {400., 3000.}) {  // nearer, the lattice's cell hides it
            SCOPED_TRACE(testing::Message() << "elevation " << elevation << " away " << away);
            Sun there;
            there.elevation = elevation;
            const glm::dvec3 to_sun = sun_direction(there);
            const SunDepth sun = half_plane(to_sun, away, 60, 120);
            GroundLight ground;
            ground.present = true;
            ground.sun = glm::dvec3(1);
            cast_shadow(sun, 1, 0, 0, 2, ground);
            // Depth falls from 60 to 0 between two nodes: light begins at the farther one.
            const double edge = 0.5 * sun.cell.x;
            const double r = away * std::tan(kSunRadius);
            const double blur = std::max(sun.cell.x, ground.shadow.cell);
            double worst = 0, off = 0;
            int count = 0;
            for (double x = -2 * r; x <= 2 * r; x += r / 20) {
                if (std::abs(x) > 20) continue;
                // The ground's point on the sun's line through u = x, v = 0.
                glm::dvec3 p = x * sun.u;
                p -= p.y / sun.w.y * sun.w;
                const double seen = 1 + share_at(ground.shadow, p),
                             expected = disc_beyond((x - edge) / r);
                worst = std::max(worst, std::abs(seen - expected));
                off += seen - expected;
                ++count;
            }
            // An edge blurred by a cell (the lattice's, the raster's) is off by up to its half width's share of the
            // disc's edge function, whose slope is 2 / (pi r); the disc is sampled in at most 96 places.
            EXPECT_LT(worst, std::min(.5, blur * 2 / (pi * r)) + .03);
            EXPECT_LT(std::abs(off / count), .02) << "as much on one side as on the other";
            glm::dvec3 dark = -(r + 1.5 * blur) * sun.u;
            dark -= dark.y / sun.w.y * sun.w;
            if (r < 10) {  // the plane's other end is not in sight
                EXPECT_LT(1 + share_at(ground.shadow, dark), 1e-3) << "umbra";
            }
        }
}

TEST(Ground, AShadowLiesWhereTheSunThrowsIt) {
    SceneDraft draft = test::balls({{{1, 6, -2}, 2, 10, {1, 1, 1}}});
    draft.ground = Ground{-1, glm::dvec3(.5)};
    draft.sun.elevation = 35;
    draft.sun.azimuth = 110;
    const auto made = ground_picture(draft, 0);
    const GroundLight& ground = made.light.ground;
    const glm::dvec3 to_sun = sun_direction(draft.sun), ball(1, 6, -2);
    const glm::dvec3 hit = ball - (ball.y + 1) / to_sun.y * to_sun;
    // Depth through the middle: 10 sqrt(2 pi).
    EXPECT_LT(irradiance_at(ground, hit.x, hit.z).y / ground.sun.y, 1e-6);
    // Elsewhere: exp(-depth along the line to the sun); the penumbra, 7 / sin 35 * .0047 = .06 of the ball's 1, blurs
    // less.
    for (double x = -6; x <= 6; x += .7)
        for (double z = -6; z <= 6; z += .7) {
            const glm::dvec3 p(hit.x + x, -1, hit.z + z);
            const double depth = line_optical_depth(made.planned.particles, p, to_sun, 0, 1e30);
            EXPECT_NEAR(irradiance_at(ground, p.x, p.z).y / ground.sun.y, std::exp(-depth), .03)
                << x << " " << z;
        }
}

// Light that the forward peak keeps on its way is on the ground too, less what is absorbed at each of its scatterings:
// under the middle of a wide cloud whose depth is tau, exp(-(1 - albedo f) tau) in all.
TEST(Ground, ThePeaksLightComesThroughAsFarAsItIsNotAbsorbed) {
    SceneDraft draft = test::balls({{{0, 10, 0}, 16, 0.1}});
    draft.sun.elevation = 90;
    draft.ground = Ground{0, glm::dvec3(0)};
    const Scene scene = test::valid(draft);
    const auto planned = plan_scene(scene, 2, {});
    ASSERT_TRUE(planned.ok());
    const double tau = line_optical_depth(planned->particles, {0, 0, 0}, {0, 1, 0}, 0, 1e30);
    const SunDepth sun = sun_depth(planned->particles, {0, 1, 0}, 96, 2);
    for (const double albedo : {1.0, 0.6, 0.0})
        for (const double share : {0.5, 0.2, 0.0}) {
            GroundLight ground = bare_ground(*scene);
            cast_shadow(sun, albedo, share, 0.85, 2, ground);
            EXPECT_NEAR(irradiance_at(ground, 0, 0).y / ground.sun.y,
                        std::exp(-(1 - albedo * share) * tau), .01)
                << albedo << ' ' << share;
        }
}

// What is weak is gathered with a quarter of the rays: what the ground gets changes by a share of it that is not seen.
TEST(Ground, FewRaysGatherWhatManyDo) {
    CloudAbove cloud;
    cloud.cells = {16, 3, 12};
    cloud.cell = glm::dvec3(0.5);
    cloud.origin = {-4, 2, -3};
    for (int i = 0; i < 16 * 3 * 12; ++i) {
        const bool matter = i % 16 > 2 && (i / 16 + i % 5) % 4 != 0;
        cloud.depth.push_back(matter ? 0.3F + 0.1F * static_cast<float>(i % 7) : 0.F);
        auto& source = cloud.source.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) source[c * kHarmonics] = matter ? 1.F : 0.F;
    }
    GroundChange many = nodes_under(cloud, 0), few = many;
    gather(cloud, nullptr, 0, kGatherRays, 2, many);
    gather(cloud, nullptr, 0, kFewGatherRays, 2, few);
    double square = 0, most = 0;
    for (std::size_t i = 0; i < many.irradiance.size(); ++i) {
        const double from_many = static_cast<double>(many.irradiance[i][1]);
        const double off = static_cast<double>(few.irradiance[i][1]) - from_many;
        square += off * off / static_cast<double>(many.irradiance.size());
        most = std::max(most, from_many);
    }
    EXPECT_GT(most, 0);
    EXPECT_LT(std::sqrt(square), 0.04 * most);
}

TEST(Ground, InAWhiteFurnaceNothingIsSeen) {
    SceneDraft draft = test::over_ground(1, 1.5);
    draft.medium.albedo = 1;
    draft.sun.intensity = 0;
    draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
    draft.sky.intensity = 1;
    const auto made = ground_picture(draft, 32);
    // The grid leaves out an optical depth of up to .5 (transport.cpp); the series ends after its second term.
    double low = 1e9, high = -1e9;
    for (double x = -12; x <= 12; x += .5)
        for (double z = -12; z <= 12; z += .5) {
            const double e = irradiance_at(made.light.ground, x, z).y / pi;
            low = std::min(low, e);
            high = std::max(high, e);
        }
    EXPECT_GT(low, .98);
    EXPECT_LT(high, 1.02);
    double least = 1e9, most = -1e9, mean = 0;
    for (std::size_t i = 0; i < made.image.pixel_count(); ++i) {
        const auto v = static_cast<double>(made.image.pixels[4 * i + 1]);
        least = std::min(least, v);
        most = std::max(most, v);
        mean += v / static_cast<double>(made.image.pixel_count());
    }
    EXPECT_GT(least, .96);
    EXPECT_LT(most, 1.04);
    EXPECT_NEAR(mean, 1, .01);
}

// Under a wide layer much of the light has been up and down many times before it is spent: here the third way and
// those after it bring an eighth of what the ground gets. Where nothing is absorbed and light comes from everywhere,
// the ground gets all of it in the end. (The thicker the layer, the more what it reflects must be known to; optical
// depth 2.)
TEST(Ground, UnderAWideLayerLightGoesUpAndDownUntilItIsSpent) {
    std::vector<test::Ball> list;
    for (int i = -8; i <= 8; ++i)
        for (int j = -8; j <= 8; ++j) list.push_back({{2.0 * i, 0, 2.0 * j}, 3, .15});
    SceneDraft draft = test::balls(list);
    draft.clouds[0].ready.colors.clear();
    draft.medium = {1, 0, PhaseFunction::kHenyeyGreenstein};
    draft.sun.intensity = 0;
    draft.sky.none = false;
    draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
    draft.sky.intensity = 1;
    draft.ground = Ground{-5, glm::dvec3(1)};
    draft.image.width = draft.image.height = 4;
    const auto made = ground_picture(draft, 24);
    double mean = 0;
    for (int i = -4; i <= 4; ++i)
        for (int j = -4; j <= 4; ++j) mean += irradiance_at(made.light.ground, i, j).y / pi / 81;
    EXPECT_NEAR(mean, 1, .06);
}

// A cumulus over a dark and a bright ground, the sun high. Errors of rung transport-32 without a ground are 2 to 5%
// here.
TEST(Ground, CloudAndGroundAreThoseOfThePathTracer) {
    for (const double albedo : {.3, .8}) {
        SCOPED_TRACE(albedo);
        SceneDraft draft = test::over_ground(albedo);
        draft.sun.elevation = 50;
        const TruthImage truth = test::ground_truth(draft, 512);
        const auto made = ground_picture(draft, 32);
        const auto sees = [&](int x, int y) {
            return test::sight(made.planned, draft, made.image, x, y);
        };
        const auto cloud =
            test::apart(made.image, truth, [&](int x, int y) { return sees(x, y).alpha > .5; });
        const auto ground = test::apart(made.image, truth, [&](int x, int y) {
            const auto pixel = sees(x, y);
            return pixel.ground && pixel.alpha < .05;
        });
        EXPECT_GT(cloud.pixels, 150);
        EXPECT_GT(ground.pixels, 800);
        EXPECT_LT(cloud.nrmse, .06);
        EXPECT_LT(std::abs(cloud.bias), .03);
        // The paths' noise in what estimates the error is about 1% here.
        EXPECT_LT(ground.nrmse, .03);
        EXPECT_LT(std::abs(ground.bias), .01);
    }
}

TEST(Ground, ItsColorComesUp) {
    SceneDraft draft = test::over_ground(.3);
    draft.ground->albedo = {.1, .5, .1};
    draft.image.width = 32;
    draft.image.height = 24;
    const TruthImage truth = test::ground_truth(draft, 64);
    const auto made = ground_picture(draft, 24);
    // Each channel's mean over the cloud's pixels: one band has one colour, that of the ground in the sun.
    for (std::size_t c = 0; c < 3; ++c) {
        double x = 0, t = 0;
        for (int j = 0; j < 24; ++j)
            for (int i = 0; i < 32; ++i) {
                if (test::sight(made.planned, draft, made.image, i, j).alpha < .5) continue;
                const std::size_t at = 4 * static_cast<std::size_t>(j * 32 + i) + c;
                x += static_cast<double>(made.image.pixels[at]);
                t += static_cast<double>(mean_of(truth).pixels[at]);
            }
        EXPECT_NEAR(x / t, 1, .04) << c;
    }
}

TEST(Ground, HidesWhatIsBelowIt) {
    SceneDraft draft = test::balls({{{0, 0, 0}, 3, .4, {1, 1, 1}}, {{6, -6, 0}, 2, 5, {1, 1, 1}}});
    draft.ground = Ground{.5, glm::dvec3(.2)};
    draft.camera.eye = {0, 9, 18};
    draft.image.background = Background::kTransparent;
    const auto made = ground_picture(draft, 16);
    for (int y = 0; y < made.image.height; ++y)
        for (int x = 0; x < made.image.width; ++x)
            // A step of the march that the ground ends in is cut by its share.
            EXPECT_NEAR(test::pixel(made.image, x, y).a,
                        test::sight(made.planned, draft, made.image, x, y).alpha, .02)
                << x << " " << y;
}

TEST(Ground, FromBelowItIsNotThere) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 32;
    draft.image.height = 24;
    const auto without = ground_picture(draft, 12);
    draft.ground = Ground{50, glm::dvec3(.9)};
    const auto with = ground_picture(draft, 12);
    EXPECT_EQ(with.image.pixels, without.image.pixels);
}

TEST(Ground, ASunUnderItLightsNothing) {
    SceneDraft draft = test::over_ground(.5);
    draft.sky.none = true;
    draft.sun.elevation = -20;
    const auto made = ground_picture(draft, 12);
    for (std::size_t i = 0; i < made.image.pixel_count(); ++i)
        EXPECT_EQ(made.image.pixels[4 * i], 0.F);
}

TEST(Ground, SwitchedOffItIsBlackToTheCloudAndHasNoShadow) {
    const SceneDraft draft = test::over_ground(.5);
    const auto all = ground_picture(draft, 16), dark = ground_picture(draft, 16, false, true),
               bare = ground_picture(draft, 16, false, false);
    EXPECT_EQ(dark.light.bands.size() + 1, all.light.bands.size());
    EXPECT_FALSE(dark.light.ground.into_cloud);
    EXPECT_TRUE(bare.light.ground.shadow.share.empty());
    EXPECT_EQ(irradiance_at(bare.light.ground, 0, 0),
              bare.light.ground.sun + bare.light.ground.sky);
    const Scene scene = test::valid(draft);
    TransportSettings on, off;
    on.ground = true;
    EXPECT_NE(light_key(scene, on), light_key(scene, off));
}

TEST(Ground, ASceneWithoutOneIsLeftAlone) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 32;
    draft.image.height = 24;
    const auto on = ground_picture(draft, 12, true, true),
               off = ground_picture(draft, 12, false, false);
    EXPECT_EQ(on.image.pixels, off.image.pixels);
    EXPECT_EQ(on.light.sweeps, off.light.sweeps);
    EXPECT_EQ(on.light.ground.bytes(), 0u);
}

TEST(Ground, ThreadsDoNotShow) {
    const SceneDraft draft = test::over_ground(.7);
    const auto one = ground_picture(draft, 12, true, true, 1),
               three = ground_picture(draft, 12, true, true, 3);
    EXPECT_EQ(one.image.pixels, three.image.pixels);
    EXPECT_EQ(one.light.ground.change.irradiance, three.light.ground.change.irradiance);
    EXPECT_EQ(one.light.ground.shadow.share, three.light.ground.shadow.share);
}

TEST(GroundView, TellsWhatIsSeen) {
    SceneDraft draft = test::over_ground(.3);
    const auto view = [](const SceneDraft& scene) {
        return plan_scene(test::valid(scene), 1, {})->survey.ground;
    };
    const GroundView seen = view(draft);
    EXPECT_GT(seen.seen, .7);
    EXPECT_LE(seen.seen, 1);
    EXPECT_GT(seen.shade, .5) << "a thick cloud's shadow is in the picture";
    EXPECT_FALSE(seen.matter_below);
    draft.ground->albedo = glm::dvec3(.6);
    EXPECT_NEAR(view(draft).light, 2 * seen.light, 1e-9);
    draft.ground->height = -4;
    EXPECT_TRUE(view(draft).matter_below);
    draft.camera.target = draft.camera.eye + glm::dvec3(-14, 30, -24);
    EXPECT_EQ(view(draft).seen, 0);
    draft.ground.reset();
    EXPECT_EQ(view(draft).light, 0);
}

}  // namespace
}  // namespace awan
