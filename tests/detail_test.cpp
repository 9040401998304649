// Laws of detail: it keeps the mass, it is seeded, its two compilers agree, and transport and truth see the same.
#include "core/generate/detail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/accuracy/error_measures.h"
#include "core/draw/march.h"
#include "core/draw/march_light.h"
#include "core/light/sun_depth.h"
#include "core/survey/detail_of.h"
#include "core/survey/lattice.h"
#include "core/survey/lattice_detail.h"
#include "core/truth/matter.h"
#include "core/truth/path_tracer.h"
#include "tests/patience.h"
#include "tests/scenes.h"

namespace awan {
namespace {

DetailField field_of(double amount, std::uint64_t seed = 1, int threads = 2) {
    return make_detail({2, 1, {0, 0, 0}}, amount, 1, make_detail_tile(seed, threads));
}

// A few thousand points that share no lattice with the tile.
glm::dvec3 scattered_point(int i) {
    const double golden = 0.618033988749895, root2 = 0.414213562373095, root3 = 0.732050807568877;
    return 40.0 *
           glm::dvec3(std::fmod(i * golden, 1), std::fmod(i * root2, 1), std::fmod(i * root3, 1));
}

TEST(Detail, ItsBumpsAreUniform) {
    const DetailField field = field_of(0.7);
    constexpr int kPoints = 20000, kBins = 10;
    std::array<int, kBins> bins{};
    for (int i = 0; i < kPoints; ++i) {
        const auto n = static_cast<double>(bumps_at(field, scattered_point(i)));
        ASSERT_GE(n, 0);
        ASSERT_LE(n, 1);
        ++bins[static_cast<std::size_t>(std::min(n * kBins, kBins - 1.0))];
    }
    // Interpolation between voxels moves the extremes inward: a quarter of the outermost bins.
    for (const int count : bins) EXPECT_NEAR(count, kPoints / kBins, 0.3 * kPoints / kBins);
}

TEST(Detail, MeanOverTheBumpsIsTheSmoothExtinction) {
    DetailField field = field_of(0.8);
    const auto edge = static_cast<double>(field.edge);
    for (const double u : {0.02, 0.1, 0.25, 0.4, 0.6, 0.8, 0.95, 1.5}) {
        double sum = 0;
        constexpr int kSteps = 4000;
        for (int i = 0; i < kSteps; ++i)
            sum += static_cast<double>(detailed(field, static_cast<float>(u * edge),
                                                (static_cast<float>(i) + 0.5F) / kSteps));
        EXPECT_NEAR(sum / kSteps, u * edge * kept_by_detail(field, u * edge), 2e-3 * edge) << u;
        if (u > 0.25) {
            EXPECT_DOUBLE_EQ(kept_by_detail(field, u * edge), 1) << u;
        }
    }
}

// The amount says how dense matter may be and still be gathered; without any, nothing is.
TEST(Detail, ItsAmountIsOfTheEdge) {
    EXPECT_NEAR(field_of(0.8).edge, 2 * field_of(0.4).edge, 1e-6F);
    const DetailField none = field_of(0);
    for (const float extinction : {1e-3F, 0.1F, 2.0F})
        for (const float n : {0.0F, 0.5F, 1.0F})
            EXPECT_EQ(detailed(none, extinction, n), extinction);
}

TEST(Detail, NothingIsAboveItsBound) {
    const DetailField field = field_of(0.9);
    for (double most = 1e-4; most < 50; most *= 1.7) {
        const double bound = most_detailed(field, most);
        for (int i = 1; i <= 40; ++i)
            for (int j = 0; j <= 20; ++j)
                EXPECT_LE(static_cast<double>(detailed(field, static_cast<float>(most * i / 40),
                                                       static_cast<float>(j) / 20)),
                          bound);
        // And it is reached somewhere, nearly: flights look the more often the looser it is.
        double most_found = 0;
        for (int i = 1; i <= 4000; ++i)
            most_found = std::max(most_found, static_cast<double>(detailed(
                                                  field, static_cast<float>(most * i / 4000), 1)));
        EXPECT_LT(bound, 1.01 * most_found);
    }
}

TEST(Detail, IsContinuousFiniteAndZeroWhereThereIsNothing) {
    const DetailField field = field_of(1);
    EXPECT_EQ(detailed(field, 0, 1), 0);
    for (int j = 0; j <= 10; ++j) {
        const float n = static_cast<float>(j) / 10;
        float before = 0;
        for (int i = 1; i <= 4000; ++i) {
            const float now = detailed(field, field.edge * static_cast<float>(i) / 2000, n);
            EXPECT_LT(std::abs(now - before), 0.02F * field.edge);
            before = now;
        }
    }
    for (const glm::dvec3& far :
         {glm::dvec3(1e9, -1e9, 1e9), glm::dvec3(-1e-300), glm::dvec3(1e300)})
        EXPECT_TRUE(std::isfinite(bumps_at(field, far)));
}

TEST(Detail, DependsOnTheSeedAndNotOnThreads) {
    const DetailField one = field_of(0.7, 5, 1), many = field_of(0.7, 5, 7),
                      other = field_of(0.7, 6);
    EXPECT_EQ(*one.tile, *many.tile);
    EXPECT_NE(*one.tile, *other.tile);
    DetailTiles tiles;
    EXPECT_EQ(*tiles.of(2, 1), *make_detail_tile(2, 1));
    const DetailTile kept = tiles.of(2, 1);
    for (std::uint64_t seed = 3; seed < 13; ++seed) EXPECT_NE(*tiles.of(seed, 2), *kept);
    EXPECT_EQ(*tiles.of(2, 2), *kept);  // made again
}

TEST(Detail, TheShippedTileIsWhatWouldBeMade) {
    EXPECT_EQ(kShippedTileSeed, SceneDraft().seed);
    const std::vector<std::uint8_t> made = detail_tile_bytes(kShippedTileSeed, 2);
    const std::span<const std::uint8_t> shipped = shipped_tile_bytes();
    EXPECT_TRUE(std::equal(made.begin(), made.end(), shipped.begin(), shipped.end()));
    // A word has the bytes of its neighbours, over the tile's ends too.
    constexpr auto n = static_cast<std::size_t>(kDetailSide);
    const DetailTile tile = make_detail_tile(kShippedTileSeed, 1);
    ASSERT_EQ(tile->size(), n * n * (n + 1));
    for (const std::size_t x : {std::size_t{0}, std::size_t{40}, n - 1})
        for (const std::size_t y : {std::size_t{0}, std::size_t{41}, n - 1})
            for (const std::size_t z : {std::size_t{0}, std::size_t{42}, n}) {
                const auto byte = [&](std::size_t dx, std::size_t dy) {
                    return std::uint32_t{made[(z % n * n + (y + dy) % n) * n + (x + dx) % n]};
                };
                EXPECT_EQ((*tile)[(z * n + y) * n + x],
                          byte(0, 0) | byte(1, 0) << 8 | byte(0, 1) << 16 | byte(1, 1) << 24);
            }
}

// Table 4.4 with detail.
struct Detailed {
    Scene scene;
    Planned planned;
};
Detailed detailed_cloud(double amount, const char* rung, int side = 64) {
    SceneDraft draft = test::table_4_4();
    draft.density = 0.5;
    draft.detail = Detail{amount, 1.2};
    draft.sky.none = true;
    draft.medium.g = 0.5;
    draft.image.width = side;
    draft.image.height = side;
    draft.image.background = Background::kTransparent;
    draft.accuracy.rung = rung;
    const Scene scene = test::valid(draft);
    auto planned = plan_scene(scene, 2, {});
    EXPECT_TRUE(planned.ok());
    return {scene, *std::move(planned)};
}

Result<TruthImage> traced(const Detailed& cloud, std::uint32_t samples) {
    TruthOptions options;
    options.whole_pixels = true;
    options.samples = samples;
    options.threads = 2;
    return trace_truth(cloud.scene, cloud.planned.particles, cloud.planned.survey.view, options, {},
                       {});
}

TEST(Detail, KeepsTheMassOfACloud) {
    for (const double amount : {0.3, 0.7, 1.0}) {
        const Detailed cloud = detailed_cloud(amount, "transport-16");
        ASSERT_TRUE(cloud.planned.particles.detail);
        const Lattice lattice = lattice_around_matter(cloud.planned.particles, {1, 0, 0}, {0, 1, 0},
                                                      {0, 0, 1}, 1e-3, 128, 2);
        std::vector<float> cells = extinction_in(cloud.planned.particles, lattice, 2);
        double before = 0, after = 0;
        for (const float cell : cells) before += static_cast<double>(cell);
        add_detail(cloud.planned.particles, lattice, 2, cells);
        for (const float cell : cells) after += static_cast<double>(cell);
        // One realisation of a few hundred bumps, `keep` from a coarse volume.
        EXPECT_NEAR(after / before, 1, 0.04) << amount;
    }
}

// Bumps are the cloud's: the eye that goes with it sees no difference. To where numbers still have enough digits.
TEST(Detail, GoesWhereTheCloudGoes) {
    const auto seen = [](const glm::dvec3& away) {
        SceneDraft draft = test::table_4_4();
        draft.top_level_cubes = false;
        draft.clouds[0].translate = away;
        draft.density = 0.5;
        draft.detail = Detail{0.8, 1.2};
        draft.camera = {false, away + glm::dvec3(0, 0, 30), away, {0, 1, 0}, 30};
        draft.image.width = draft.image.height = 40;
        draft.image.background = Background::kTransparent;
        draft.accuracy.rung = "single";
        auto rendered = render_scene(test::valid(draft), {nullptr, 2, nullptr, {}, {}}, {});
        EXPECT_TRUE(rendered.ok());
        return rendered->image;
    };
    const Image here = seen({0, 0, 0});
    for (const glm::dvec3& away : {glm::dvec3(7.3, 0, 0), glm::dvec3(0, 1234.5, -77.7)}) {
        const Image there = seen(away);
        double off = 0, sum = 0;
        for (std::size_t p = 3; p < here.pixels.size(); p += 4) {
            off += std::abs(static_cast<double>(there.pixels[p] - here.pixels[p]));
            sum += static_cast<double>(here.pixels[p]);
        }
        EXPECT_LT(off, 1e-3 * sum) << away.x;
    }
    // As a field by itself, and by as much as it moved.
    const DetailTile tile = make_detail_tile(1, 2);
    const glm::dvec3 away(64, -32, 16);
    const DetailField one = make_detail({2, 1, {0, 0, 0}}, 0.7, 1, tile);
    const DetailField other = make_detail({2, 1, away}, 0.7, 1, tile);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p = scattered_point(i);
        EXPECT_NEAR(bumps_at(one, p), bumps_at(other, p + away), 1e-5F);
    }
}

TEST(Detail, MarchAndTruthSeeTheSameDepth) {
    const Detailed cloud = detailed_cloud(0.8, "single");
    Tools tools;
    tools.threads = 2;
    const auto marched = render_scene(cloud.scene, tools, {});
    const auto truth = traced(cloud, 2);
    ASSERT_TRUE(marched.ok() && truth.ok());
    double off = 0, sum = 0;
    for (std::size_t p = 3; p < marched->image.pixels.size(); p += 4) {
        const double a = double{marched->image.pixels[p]}, b = double{truth->half_a.pixels[p]};
        off += (a - b) * (a - b);
        sum += b * b;
    }
    // Steps of a fifth of a bump at silhouettes; pixels of which only the sharpest are seen by more than one ray.
    EXPECT_LT(std::sqrt(off / sum), 0.06);
}

TEST(Detail, TransportIsNearTheTruth) {
    const Detailed cloud = detailed_cloud(0.8, "transport-32", 48);
    Tools tools;
    tools.threads = 2;
    const auto rendered = render_scene(cloud.scene, tools, {});
    const auto truth = traced(cloud, test::or_fewer(96u, 16u));
    ASSERT_TRUE(rendered.ok() && truth.ok());
    const PictureError error = picture_error(rendered->image, *truth);
    std::printf("transport-32 with detail: nrmse %.3f +- %.3f, bias %.3f\n", error.nrmse,
                error.nrmse_noise, error.bias);
    EXPECT_LT(error.nrmse, 0.15 + 2 * error.nrmse_noise);
    EXPECT_LT(std::abs(error.bias), 0.06 + 2 * error.bias_noise);
    // Far nearer than a picture without it.
    SceneDraft smooth = *cloud.scene;
    smooth.effects[static_cast<int>(Effect::kDetail)] = Switch::kOff;
    const auto without = render_scene(test::valid(smooth), tools, {});
    ASSERT_TRUE(without.ok());
    EXPECT_GT(picture_error(without->image, *truth).nrmse, 2 * error.nrmse);
}

// Lumps that the grid's cells do not see: what the sun's light on fine cells is for.
TEST(Detail, FineCellsBringTheSunIntoLumps) {
    Detailed cloud = detailed_cloud(0.9, "transport-16", 40);
    Tools tools;
    tools.threads = 2;
    const auto truth = traced(cloud, test::or_fewer(96u, 16u));
    ASSERT_TRUE(truth.ok());
    auto light = transport_light(cloud.scene, cloud.planned.particles, cloud.planned.survey,
                                 cloud.planned.plan.transport, 2, {});
    ASSERT_TRUE(light.ok());
    ASSERT_EQ(light->fine.bands.size(), 1U);
    EXPECT_EQ(light->fine.cells, 3 * light->cells);
    const auto error_of = [&](const TransportLight& lit) {
        const auto image =
            march(cloud.scene, cloud.planned.particles, cloud.planned.survey.view, lit, {}, 2, {});
        EXPECT_TRUE(image.ok());
        return picture_error(*image, *truth);
    };
    const PictureError fine = error_of(*light);
    TransportLight coarse = *light;
    coarse.fine = {};
    const PictureError without = error_of(coarse);
    std::printf("transport-16 with detail: nrmse %.3f +- %.3f, on the grid's cells %.3f\n",
                fine.nrmse, fine.nrmse_noise, without.nrmse);
    EXPECT_LT(fine.nrmse, 0.8 * without.nrmse + 2 * fine.nrmse_noise);
}

// Near the grid light is looked up by each ray's own direction; from farther away, cell by cell. From where the one
// gives way to the other, both see the same source function.
TEST(Detail, FineLightIsTheSameNearAndFar) {
    const Detailed cloud = detailed_cloud(0.8, "transport-16", 40);
    const auto light = transport_light(cloud.scene, cloud.planned.particles, cloud.planned.survey,
                                       cloud.planned.plan.transport, 2, {});
    ASSERT_TRUE(light.ok());
    const glm::dvec3 middle = light->origin + 0.5 * light->cell * glm::dvec3(light->cells);
    const double reach = 0.5 * light->cell.z * light->cells.z;
    const glm::dvec3 eye = middle + glm::dvec3(0, 0, reach + 2.2 * longest(light->cell));
    const EyeLight far = source_towards(*light, eye, 2);
    EyeLight near = far;
    ASSERT_FALSE(far.close);
    near.close = true;
    near.source.clear();
    const glm::dvec3 ahead(0, 0, -1);
    LightAt by_cells[8], by_rays[8];
    const auto step = static_cast<float>(reach / 8);
    light_along(far, light_ray(far, eye, ahead), static_cast<float>(reach), step, 8, by_cells);
    light_along(near, light_ray(near, eye, ahead), static_cast<float>(reach), step, 8, by_rays);
    for (int k = 0; k < 8; ++k)
        EXPECT_NEAR(by_cells[k].source[0], by_rays[k].source[0],
                    0.02F * by_cells[k].source[0] + 1e-6F)
            << k;
}

// Lumps that are smaller than pixels: these show the mean over their area, which the ray through a pixel's middle does
// not.
TEST(Detail, PixelsShowTheMeanOfSmallLumps) {
    constexpr int kSide = test::or_fewer(24, 12), kFiner = 8;
    const auto cloud_of = [](int side) { return detailed_cloud(0.9, "transport-16", side); };
    const Detailed coarse = cloud_of(kSide), fine = cloud_of(kSide * kFiner);
    const auto light = transport_light(coarse.scene, coarse.planned.particles,
                                       coarse.planned.survey, coarse.planned.plan.transport, 2, {});
    ASSERT_TRUE(light.ok());
    const auto picture = [&](const Detailed& cloud) {
        return march(cloud.scene, cloud.planned.particles, cloud.planned.survey.view, *light, {}, 2,
                     {});
    };
    const auto own = picture(coarse), closer = picture(fine);
    ASSERT_TRUE(own.ok() && closer.ok());
    double off = 0, off_one_ray = 0, sum = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const auto value = [](const Image& image, int i, int j) {
                return static_cast<double>(
                    image.pixels[4 * static_cast<std::size_t>(j * image.width + i)]);
            };
            double mean = 0;
            for (int j = 0; j < kFiner; ++j)
                for (int i = 0; i < kFiner; ++i)
                    mean += value(*closer, x * kFiner + i, y * kFiner + j) / (kFiner * kFiner);
            const int middle = kFiner / 2;
            off += std::pow(value(*own, x, y) - mean, 2);
            off_one_ray +=
                std::pow(value(*closer, x * kFiner + middle, y * kFiner + middle) - mean, 2);
            sum += mean * mean;
        }
    std::printf("pixels of lumps: off %.3f, with one ray %.3f\n", std::sqrt(off / sum),
                std::sqrt(off_one_ray / sum));
    EXPECT_LT(off, 0.15 * off_one_ray);
}

TEST(Detail, IsTheSameForAllNumbersOfThreads) {
    const Detailed cloud = detailed_cloud(0.8, "transport-16", 40);
    Tools one, many;
    many.threads = 5;
    const auto a = render_scene(cloud.scene, one, {}), b = render_scene(cloud.scene, many, {});
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a->image.pixels, b->image.pixels);
}

}  // namespace
}  // namespace awan
