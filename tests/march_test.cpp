// The march against exact integrals, and the pictures that used to break such things.
#include "core/draw/march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/draw/march_phase.h"
#include "core/light/legendre.h"
#include "tests/march_lights.h"

namespace awan {
namespace {

using test::Ball;

double luminance(const test::Pixel& p) {
    return (p.r + p.g + p.b) / 3;
}

void expect_sane(const Image& image, double most) {
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const float* p = image.pixels.data() + 4 * i;
        for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(p[c])) << i;
            ASSERT_GE(p[c], 0) << i;
            ASSERT_LE(static_cast<double>(p[c]), most) << i;
        }
        ASSERT_GE(p[3], 0) << i;
        ASSERT_LE(p[3], 1) << i;
    }
}

SceneDraft transparent(SceneDraft draft) {
    draft.image.background = Background::kTransparent;
    return draft;
}

TransportLight no_light() {
    return {};
}

double exact_alpha(const test::Stage& stage, double x, double y) {
    const View& view = stage.view;
    const double u = (x / stage.scene->image.width * 2 - 1) * view.tan_half_fov * view.aspect;
    const double v = (1 - y / stage.scene->image.height * 2) * view.tan_half_fov;
    const glm::dvec3 d = glm::normalize(view.forward + u * view.right + v * view.up);
    return -std::expm1(-test::line_depth(stage.particles, view.eye, d));
}

// Largest difference of alpha from the exact one: that of a pixel's middle, or, where pixels change sharply, the mean
// of four rays.
double worst_alpha(const test::Stage& stage, const Image& image) {
    double worst = 0;
    for (int y = 0; y < image.height; y += 3)
        for (int x = 0; x < image.width; x += 2) {
            const double alpha = test::pixel(image, x, y).a;
            double off = std::abs(alpha - exact_alpha(stage, x + 0.5, y + 0.5));
            if (off > 1e-4) {
                double mean = 0;
                for (const double dy : {0.25, 0.75})
                    for (const double dx : {0.25, 0.75})
                        mean += exact_alpha(stage, x + dx, y + dy) / 4;
                off = std::min(off, std::abs(alpha - mean));
            }
            worst = std::max(worst, off);
        }
    return worst;
}

std::vector<Ball> scattered(int count, double spread, double least, double most, double density) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Ball> list;
    for (int i = 0; i < count; ++i)
        list.push_back({spread * (glm::dvec3(unit(random), unit(random), unit(random)) - 0.5),
                        least + (most - least) * unit(random), density});
    return list;
}

TEST(March, TransmittanceIsExact) {
    struct Case {
        const char* name;
        std::vector<Ball> list;
        glm::dvec3 eye;
        double fov;
        double most = 1e-3;
    };
    const Case cases[] = {
        {"one", {{{0, 0, 0}, 2, 1}}, {0, 0, 6}, 40},
        {"beside the middle", {{{1, 0.5, 0}, 1, 3}}, {0, 0, 6}, 60},
        {"wide", scattered(40, 8, 1, 3, 0.3), {0, 0, 5}, 140},
        {"inside", scattered(60, 6, 0.5, 3, 0.3), {0.2, 0.1, 0.3}, 90},
        {"at its centre", {{{0, 0, 0}, 2, 0.7}}, {0, 0, 0}, 90},
        {"dense", {{{0, 0, 0}, 2, 1e6}}, {0, 0, 20}, 60},
        {"small ones", scattered(3000, 6, 0.16, 0.3, 3), {0, 0, 9}, 50},
        // Far wider than pixels: interpolated between rays.
        {"far wider", scattered(30, 3, 2, 5, 0.3), {0, 0, 9}, 20},
        {"far wider, around", scattered(30, 3, 2, 5, 0.3), {0, 0, 1}, 20},
        {"just wide enough", scattered(12, 0.2, 2, 2.2, 0.08), {0, 0, 15}, 27, 2e-3},
    };
    for (const Case& one : cases) {
        SceneDraft draft = transparent(test::balls(one.list));
        draft.camera.eye = one.eye;
        draft.camera.target = one.eye - glm::dvec3(0, 0, 1);
        draft.camera.fov = one.fov;
        draft.image.width = 160;  // no particle is a speck
        draft.image.height = 120;
        const test::Stage stage = test::stage(draft);
        EXPECT_LT(worst_alpha(stage, test::marched(stage, no_light())), one.most) << one.name;
        // With a grid, steps are longer and cut where they get deep.
        TransportLight light =
            test::grid_light(stage.scene, stage.particles, 16, 1, [](glm::dvec3) { return 1.0; });
        EXPECT_LT(worst_alpha(stage, test::marched(stage, light)), one.most)
            << one.name << ", grid";
    }
}

// Also where it is uneven: what otherwise is the mean of several is that of the pixel's middle.
TEST(March, OneRayAPixelIsThatOfItsMiddle) {
    SceneDraft draft = transparent(test::balls({{{0, 0, 0}, 1, 1e6}, {{1, 0.5, 1}, 0.7, 40}}));
    draft.camera.eye = {0, 0, 9};
    draft.camera.target = {0, 0, 0};
    draft.image.width = 80;
    draft.image.height = 60;
    const test::Stage stage = test::stage(draft);
    const auto worst_middle = [&](bool one_ray) {
        MarchSettings settings;
        settings.one_ray = one_ray;
        const Image image = test::marched(stage, no_light(), 2, settings);
        double worst = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                worst = std::max(worst, std::abs(test::pixel(image, x, y).a -
                                                 exact_alpha(stage, x + 0.5, y + 0.5)));
        return worst;
    };
    EXPECT_LT(worst_middle(true), 1e-3);
    EXPECT_GT(worst_middle(false), 0.005);
}

// Sunlight scattered once, by fine midpoints over exact depths.
double single(const test::Stage& stage, const test::Ray& ray, double far, int steps) {
    const glm::dvec3 sun = sun_direction(stage.scene->sun);
    const double phase = phase_of_chords(stage.scene->medium, glm::length(ray.direction - sun),
                                         glm::length(ray.direction + sun));
    double sum = 0, depth = 0;
    for (int k = 0; k < steps; ++k) {
        const double t = far * (k + 0.5) / steps;
        const glm::dvec3 p = ray.eye + t * ray.direction;
        const double of_step = test::line_depth(stage.particles, ray.eye, ray.direction,
                                                far * k / steps, far * (k + 1) / steps);
        sum += std::exp(-depth) * -std::expm1(-of_step) *
               std::exp(-test::line_depth(stage.particles, p, sun));
        depth += of_step;
    }
    return sum * phase * stage.scene->medium.albedo;
}

// rms over the picture, relative to the mean.
double single_error(const SceneDraft& draft, MarchSettings settings) {
    const test::Stage stage = test::stage(draft);
    TransportLight light;
    light.sun = test::exact_sun(stage.scene, stage.particles, 96, 1.7);
    const Image image = test::marched(stage, light, 2, settings);
    double square = 0, mean = 0;
    int count = 0;
    for (int y = 1; y < image.height; y += 4)
        for (int x = 1; x < image.width; x += 4) {
            const double exact = single(stage, test::ray(stage.view, image, x, y), 20, 1200);
            const double difference = luminance(test::pixel(image, x, y)) - exact;
            square += difference * difference;
            mean += exact;
            ++count;
        }
    return std::sqrt(square / count) / (mean / count);
}

TEST(March, SingleScatteringIsExact) {
    for (const double density : {0.05, 1.0, 5.0}) {
        SceneDraft draft = transparent(test::balls({{{0, 0, 0}, 2, density}}));
        draft.camera.eye = {0, 0, 8};
        draft.medium.g = 0.3;
        EXPECT_LT(single_error(draft, {}), 0.01) << density;
    }
    for (const double elevation : {70.0, 10.0}) {
        SceneDraft draft = transparent(test::balls(scattered(8, 3, 1, 2.5, 0.7)));
        draft.camera.eye = {0, 0, 9};
        draft.sun.elevation = elevation;
        EXPECT_LT(single_error(draft, {}), 0.01) << elevation;
    }
}

TEST(March, AnEvenSourceIsIntegratedExactly) {
    for (const double g : {0.0, 0.5, 0.85}) {
        SceneDraft draft = transparent(test::table_4_4());
        draft.image.width = 160;  // no particle is a speck
        draft.image.height = 120;
        draft.medium.g = g;
        draft.sun.intensity = 0;
        draft.sky.none = true;
        const test::Stage stage = test::stage(draft);
        const TransportLight light =
            test::grid_light(stage.scene, stage.particles, 8, 2, [](glm::dvec3) { return 0.5; });
        const Image image = test::marched(stage, light);
        const double scaled = 1 - stage.scene->medium.albedo * light.peak_share;
        for (int y = 0; y < image.height; y += 7)
            for (int x = 0; x < image.width; x += 5) {
                const test::Ray ray = test::ray(stage.view, image, x, y);
                const double depth = test::line_depth(stage.particles, ray.eye, ray.direction);
                ASSERT_NEAR(luminance(test::pixel(image, x, y)),
                            -std::expm1(-scaled * depth) / scaled, 2e-3)
                    << x << " " << y;
            }
    }
}

TEST(March, RestAndPeakAreThePhaseFunction) {
    for (const auto phase : {PhaseFunction::kHenyeyGreenstein, PhaseFunction::kCornetteShanks})
        for (const double g : {-0.9, 0.0, 0.3, 0.85, 0.95}) {
            Medium medium;
            medium.g = g;
            medium.phase = phase;
            const Peak peak{4, std::pow(g, 4)};
            const PeakTable table = peak_table(medium, peak, 0, 2);
            for (int i = 0; i <= 180; ++i) {
                const double angle = i * std::numbers::pi / 180;
                const double ahead = 2 * std::sin(angle / 2), behind = 2 * std::cos(angle / 2);
                double sum = rest_of_phase(rest_of(medium, peak), ahead, behind);
                if (table.columns > 0) {
                    const RowAt row = row_at(table, ahead, behind);
                    const auto at =
                        static_cast<std::size_t>(row.row) * static_cast<std::size_t>(table.columns);
                    const float low = table.values[at],
                                high = table.values[at + static_cast<std::size_t>(table.columns)];
                    sum += static_cast<double>(low + row.share * (high - low));
                }
                const double exact = phase_of_chords(medium, ahead, behind);
                ASSERT_NEAR(sum, exact, 2e-3 * exact + 2e-4) << g << " at " << i;
            }
        }
}

// The moments are the phase function's: against quadrature.
TEST(March, MomentsAreThePhaseFunctions) {
    Medium medium;
    medium.g = 0.6;
    for (const auto phase : {PhaseFunction::kHenyeyGreenstein, PhaseFunction::kCornetteShanks}) {
        medium.phase = phase;
        double moment[4] = {};
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double mu = (i + 0.5) / steps * 2 - 1;
            const double p = phase_of_chords(medium, std::sqrt(2 - 2 * mu), std::sqrt(2 + 2 * mu)) *
                             4 * std::numbers::pi / steps;
            const double legendre[] = {1, mu, (3 * mu * mu - 1) / 2,
                                       (5 * mu * mu * mu - 3 * mu) / 2};
            for (int l = 0; l < 4; ++l) moment[l] += p * legendre[l];
        }
        for (int l = 0; l < 4; ++l) EXPECT_NEAR(phase_moment(medium, l), moment[l], 1e-6) << l;
    }
}

// F2 between and at the table's columns against its Legendre sum, where that converges.
TEST(March, PeakTableIsTheSum) {
    for (const auto phase : {PhaseFunction::kHenyeyGreenstein, PhaseFunction::kCornetteShanks}) {
        Medium medium;
        medium.phase = phase;
        const Peak peak{4, std::pow(medium.g, 4)};
        const double a = medium.albedo;
        const PeakTable table = peak_table(medium, peak, 0, 2);
        for (const double t : {0.05, 0.5, 1.7, 5.0, 14.0})
            for (int i = 0; i <= 90; ++i) {
                const double angle = i * std::numbers::pi / 90;
                const double ahead = 2 * std::sin(angle / 2), behind = 2 * std::cos(angle / 2);
                const double mu = std::cos(angle);
                double sum = 0, p = 1, before = 0, most = 0;
                for (int l = 0; l < 300; ++l) {
                    const double chi = phase_moment(medium, l);
                    const double weight =
                        (2 * l + 1) / (4 * std::numbers::pi) *
                        (l < 4 ? peak.share : chi * std::exp(t * a * (chi - peak.share)));
                    sum += weight * p;
                    most += weight;
                    const double next = ((2 * l + 1) * mu * p - l * before) / (l + 1);
                    before = p;
                    p = next;
                }
                const RowAt row = row_at(table, ahead, behind);
                const auto columns = static_cast<std::size_t>(table.columns);
                const double y = 1 + t, octave = std::floor(std::log2(y));
                const double at = 8 * octave + 8 * (y / std::exp2(octave) - 1);
                const auto k = static_cast<std::size_t>(at);
                const auto value = [&](std::size_t r) {
                    const float* v = table.values.data() + r * columns + k;
                    return static_cast<double>(v[0]) +
                           (at - static_cast<double>(k)) * static_cast<double>(v[1] - v[0]);
                };
                const auto r = static_cast<std::size_t>(row.row);
                const double got =
                    value(r) + static_cast<double>(row.share) * (value(r + 1) - value(r));
                ASSERT_NEAR(got, sum, 3e-3 * most * std::exp(-4 * angle) + 3e-3) << t << " " << i;
            }
    }
}

TEST(March, ThreadsDoNotShow) {
    SceneDraft draft = test::table_4_4();
    draft.image.width = 130;
    draft.image.height = 100;
    const test::Stage stage = test::stage(draft);
    TransportLight light = test::grid_light(stage.scene, stage.particles, 16, 3,
                                            [](glm::dvec3 p) { return 1 + 0.1 * p.x; });
    light.sun = test::exact_sun(stage.scene, stage.particles, 16);
    const Image one = test::marched(stage, light, 1);
    for (int threads = 2; threads <= 4; ++threads)
        EXPECT_EQ(one.pixels, test::marched(stage, light, threads).pixels) << threads;
}

TEST(March, FinerStepsChangeLessThanTheError) {
    SceneDraft draft = transparent(test::table_4_4());
    draft.image.width = 80;
    draft.image.height = 60;
    for (const double elevation : {40.0, -5.0}) {
        draft.sun.elevation = elevation;
        const test::Stage stage = test::stage(draft);
        TransportLight light = test::grid_light(
            stage.scene, stage.particles, 32, 1,
            [](glm::dvec3 p) { return 1 + 0.5 * std::sin(p.x) * std::sin(1.3 * p.z); });
        light.sun = test::exact_sun(stage.scene, stage.particles, 48);
        MarchSettings settings;
        settings.step_error = 0.01;
        const Image coarse = test::marched(stage, light, 2, settings);
        settings.step_error = 0.001;
        const Image fine = test::marched(stage, light, 2, settings);
        double square = 0, mean = 0;
        for (std::size_t i = 0; i < coarse.pixels.size(); ++i) {
            if (i % 4 == 3) continue;
            const double d = static_cast<double>(coarse.pixels[i] - fine.pixels[i]);
            square += d * d;
            mean += static_cast<double>(fine.pixels[i]);
        }
        const auto n = static_cast<double>(coarse.pixels.size());
        EXPECT_LT(std::sqrt(square / n) / (mean / n), 0.005) << elevation;
        RecordProperty("step_error", std::to_string(std::sqrt(square / n) / (mean / n)));
    }
}

TEST(March, NoEdgesBetweenBlocks) {
    SceneDraft draft = transparent(test::balls({{{0, 0, 0}, 4, 2}}));
    draft.camera.eye = {0, 0, 20};
    draft.camera.fov = 10;
    draft.image.width = 320;
    draft.image.height = 320;
    const test::Stage stage = test::stage(draft);
    TransportLight light = test::grid_light(
        stage.scene, stage.particles, 32, 1,
        [](glm::dvec3 p) { return 1 + 0.3 * p.x + 0.2 * p.y + 0.1 * p.z; }, 2);
    light.sun = test::exact_sun(stage.scene, stage.particles, 48, 2);
    const Image image = test::marched(stage, light);
    double at_tiles = 0, at_blocks = 0, within = 0;
    int tiles = 0, blocks = 0, others = 0;
    for (int y = 20; y < 300; ++y)
        for (int x = 20; x < 300; ++x) {
            const auto v = [&](int i) { return luminance(test::pixel(image, x + i, y)); };
            // Third difference over the edge between x and x + 1.
            const double edge = std::abs(v(2) - 3 * v(1) + 3 * v(0) - v(-1));
            if ((x + 1) % 16 == 0) {
                at_blocks += edge;
                ++blocks;
            } else if ((x + 1) % 4 == 0) {
                at_tiles += edge;
                ++tiles;
            } else {
                within += edge;
                ++others;
            }
        }
    RecordProperty("within", std::to_string(within / others));
    RecordProperty("tiles", std::to_string(at_tiles / tiles));
    RecordProperty("blocks", std::to_string(at_blocks / blocks));
    // In units of the picture's own values (about 1), far below a step of 8 bits.
    EXPECT_LT(at_tiles / tiles, 2 * within / others + 2e-4);
    EXPECT_LT(at_blocks / blocks, 2 * within / others + 1e-3);
}

// --- what broke prototypes (hard cases): finite, bounded, and where it has an exact answer, that
// ----------------------------

TransportLight lights(const test::Stage& stage) {
    TransportLight light =
        test::grid_light(stage.scene, stage.particles, 8, 1, [](glm::dvec3) { return 1.0; });
    light.sun = test::exact_sun(stage.scene, stage.particles, 8);
    return light;
}

TEST(March, FarFromTheOrigin) {
    const glm::dvec3 far(9e8, -9e8, 9e8);
    std::vector<Ball> here = scattered(30, 6, 0.5, 2, 0.5), there = here;
    for (Ball& ball : there) ball.center += far;
    SceneDraft draft = transparent(test::balls(here));
    const test::Stage near = test::stage(draft);
    draft = transparent(test::balls(there));
    draft.camera.eye += far;
    draft.camera.target += far;
    const test::Stage away = test::stage(draft);
    const Image a = test::marched(near, lights(near)), b = test::marched(away, lights(away));
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        ASSERT_NEAR(a.pixels[i], b.pixels[i], 1e-4) << i;
}

TEST(March, SpecksKeepTheirMass) {
    SceneDraft draft = transparent(test::balls({{{0.013, 0.007, 0}, 1e-3, 1}}));
    const test::Stage stage = test::stage(draft);
    const Image image = test::marched(stage, no_light());
    double sum = 0;
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
        sum += static_cast<double>(image.pixels[4 * i + 3]);
    const double pixel = 2 * stage.view.tan_half_fov / 48 * 20;
    EXPECT_NEAR(sum * pixel * pixel / gaussian_mass(stage.particles, 0), 1, 0.02);
}

TEST(March, ThinLayersAddUp) {
    std::vector<Ball> list;
    for (int i = 0; i < 100000; ++i)
        list.push_back({{0, 0, -i * 1e-4}, 0.02, 1e-5 / (0.01 * 2.50662827)});
    SceneDraft draft = transparent(test::balls(list));
    draft.camera.eye = {0, 0, 0.3};
    draft.camera.fov = 0.2;
    draft.image.width = draft.image.height = 8;
    const test::Stage stage = test::stage(draft);
    const Image image = test::marched(stage, lights(stage));
    const test::Ray ray = test::ray(stage.view, image, 4, 4);
    const double left = std::exp(-test::line_depth(stage.particles, ray.eye, ray.direction));
    EXPECT_NEAR((1 - test::pixel(image, 4, 4).a) / left, 1, 1e-3);
}

TEST(March, HardCasesAreFinite) {
    struct Case {
        const char* name;
        std::vector<Ball> list;
        glm::dvec3 eye, target;
        double fov;
        int width, height;
    };
    const std::vector<Ball> huge = {{{0, 0, 0}, 1e6, 1e6}};
    const Case cases[] = {
        {"deep", huge, {0, 0, 1e7}, {0, 0, 0}, 40, 32, 24},
        {"in the deep", huge, {1, 2, 3}, {0, 0, -9}, 40, 32, 24},
        {"at its centre", huge, {0, 0, 0}, {0, 0, -1}, 120, 32, 24},
        {"tiny", {{{0, 0, 0}, 1e-6, 1e6}}, {0, 0, 1e-5}, {0, 0, 0}, 40, 32, 24},
        {"large and small",
         {{{0, 0, 0}, 1e6, 1e-6}, {{0, 0, 5}, 1e-6, 1e6}, {{1, 0, 5}, 1, 1e6}},
         {0, 0, 10},
         {0, 0, 0},
         40,
         32,
         24},
        {"coincident",
         std::vector<Ball>(5000, {{0, 0, 0}, 1, 1}),
         {0, 0, 9},
         {0, 0, 0},
         40,
         32,
         24},
        {"one pixel", scattered(50, 5, 1, 2, 1), {0, 0, 4}, {0, 0, 0}, 170, 1, 1},
        {"a strip", scattered(50, 5, 1, 2, 1), {0, 0, 9}, {0, 0, 0}, 60, 8192, 16},
        {"grazing", scattered(50, 5, 1, 2, 1), {0, 2.5, 9}, {0, 2.5, 0}, 40, 32, 24},
        {"two far apart",
         {{{0, 0, 0}, 1, 1}, {{0, 0, -1e8}, 1e6, 1}},
         {0, 0, 9},
         {0, 0, 0},
         40,
         32,
         24},
    };
    for (const double g : {-0.999, 0.85, 0.999})
        for (const Case& one : cases) {
            SceneDraft draft = transparent(test::balls(one.list));
            draft.camera.eye = one.eye;
            draft.camera.target = one.target;
            draft.camera.fov = one.fov;
            draft.image.width = one.width;
            draft.image.height = one.height;
            draft.medium.g = g;
            draft.sun.direction = glm::dvec3(0, 0, -1);  // in the picture, straight ahead
            const test::Stage stage = test::stage(draft);
            TransportLight light = lights(stage);
            SCOPED_TRACE(one.name);
            // Light that is scattered back twice goes forward.
            const double peak = std::max(phase_of_chords(stage.scene->medium, 0, 2),
                                         phase_of_chords(stage.scene->medium, 2, 0));
            const double scaled = 1 - light.peak_share;
            expect_sane(test::marched(stage, light),
                        1.01 / scaled + 2 * std::max(peak, 1.0) / scaled);
            light.cell = glm::dvec3(0);
            expect_sane(test::marched(stage, light), 2 * std::max(peak, 1.0));
        }
}

TEST(March, NothingToDraw) {
    SceneDraft draft = test::balls({});
    draft.sky.none = false;
    Scene scene = test::valid(draft);
    const View view = resolve_view(scene->camera, scene->image, {});
    const auto image = march(scene, {}, view, {}, {}, 1, {});
    ASSERT_TRUE(image.ok());
    EXPECT_TRUE(image->opaque);
    EXPECT_GT(image->pixels[0], 0);
    EXPECT_EQ(image->pixels[3], 1);
}

TEST(March, GivesUpWhenTold) {
    const test::Stage stage = test::stage(test::table_4_4());
    Deadline deadline;
    deadline.until = Deadline::Clock::now();
    const auto image = march(stage.scene, stage.particles, stage.view, {}, {}, 2, deadline);
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().code, ErrorCode::kOverDeadline);
}

}  // namespace
}  // namespace awan
