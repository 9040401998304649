// The oracle for even sheets against what is published of them, then rungs against the oracle.
#include <gtest/gtest.h>

#include "tests/adding_doubling.h"
#include "tests/sheet_scenes.h"

namespace awan {
namespace {

using test::Sheet;
using test::SheetMatter;
using test::SheetView;

// What a rung makes of a sheet's middle, to what is there, less 1.
double error_of(const SheetMatter& matter, const SheetView& seen, const char* rung) {
    return test::mean_of(test::render(test::sheet_scene(matter, {}, seen, rung)).image) /
               test::exact_of(matter, seen) -
           1;
}

// Heaslet & Warming 1965: diffuse light through a layer that scatters evenly and absorbs nothing.
TEST(AddingDoubling, DiffuseLightThroughALayer) {
    struct Known {
        double depth, through;
    };
    for (const Known& known : {Known{.1, .9157}, {.5, .7040}, {1, .5532}, {2, .3900}, {3, .3016}})
        EXPECT_NEAR(Sheet({known.depth, 1, 0}, {}, 1).diffuse_through(), known.through, 3e-4)
            << known.depth;
}

// Van de Hulst 1980, table 35, as Wang et al. 1995 quote it: shares of a beam straight down.
TEST(AddingDoubling, AForwardScatteringSheetThatAbsorbs) {
    const Sheet sheet({2, .9, .75}, {1});
    EXPECT_NEAR(sheet.back_share(1), .09739, 1e-5);
    EXPECT_NEAR(sheet.through_share(1) + sheet.straight_share(1), .66096, 1e-5);
}

// Chandrasekhar 1950: what a layer without end sends back is albedo / 4 pi * sun / (sun + view) H(sun) H(view), where
// H(x) = 1 + albedo / 2 * x H(x) integral over 0..1 of H(y) / (x + y).
TEST(AddingDoubling, ADeepLayerIsALayerWithoutEnd) {
    constexpr int kSteps = 400;
    constexpr double kAlbedo = .9;
    std::vector<double> h(kSteps, 1);
    const auto place = [](std::size_t i) { return (static_cast<double>(i) + .5) / kSteps; };
    const auto h_at = [&](double x) {
        double sum = 0;
        for (std::size_t j = 0; j < kSteps; ++j) sum += h[j] / (x + place(j)) / kSteps;
        return 1 / (1 - kAlbedo / 2 * x * sum);
    };
    for (int again = 0; again < 60; ++again) {
        std::vector<double> next(kSteps);
        for (std::size_t i = 0; i < kSteps; ++i) next[i] = h_at(place(i));
        h = next;
    }
    const Sheet sheet({64, kAlbedo, 0}, {.3, .8, 1});
    for (const double sun : {.3, .8})
        for (const double view : {.3, 1.})
            EXPECT_NEAR(sheet.back(view, sun, 1) / (kAlbedo / (4 * std::numbers::pi) * sun /
                                                    (sun + view) * h_at(sun) * h_at(view)),
                        1, 1e-4)
                << sun << " " << view;
}

TEST(AddingDoubling, NoLightIsLost) {
    for (const double g : {0., .5, .85})
        for (const double depth : {.5, 8., 64.})
            for (const double sun : {1., .5, .17}) {
                const Sheet sheet({depth, 1, g}, {sun}, 1);
                EXPECT_NEAR(
                    sheet.back_share(sun) + sheet.through_share(sun) + sheet.straight_share(sun), 1,
                    1e-6)
                    << g << " " << depth << " " << sun;
            }
}

// Light goes back the way that it came.
TEST(AddingDoubling, IsReciprocal) {
    const Sheet sheet({4, .95, .7}, {.9, .4});
    for (const double azimuth : {0., 1., 3.})
        EXPECT_NEAR(sheet.back(.9, .4, azimuth) / .4, sheet.back(.4, .9, azimuth) / .9, 1e-6);
}

// Light that is scattered once, in a sheet whose upper edge hides all below: the sun's depth is right within a
// Gaussian. Straight from above all pixels step alike and are off alike; slanting rays don't, and show the sun's depth
// alone.
TEST(Sheets, ScatteredOnceWhateverTheSun) {
    for (const double depth : {2., 32.})
        for (const double sun : {1., .5, .1736})
            EXPECT_NEAR(error_of({depth, .001, 0}, {sun, .5, 2, false}, "single"), 0, .005)
                << depth << " " << sun;
}

// Light that goes through many mean free paths, or comes back from them.
TEST(Sheets, DeepLight) {
    const struct {
        SheetMatter matter;
        SheetView seen;
        double near;    // transport-32
        double nearer;  // transport-64
    } cases[] = {{{8, 1, .5}, {1, 1, 0, false}, .03, .02},
                 {{32, 1, 0}, {1, 1, 0, false}, .03, .02},
                 {{32, 1, .5}, {.5, 1, 0, true}, .10, .05},
                 {{64, 1, .85}, {.5, .5, 0, false}, .07, .05}};
    for (const auto& one : cases) {
        EXPECT_NEAR(error_of(one.matter, one.seen, "transport-32"), 0, one.near)
            << one.matter.depth << " " << one.matter.g;
        EXPECT_NEAR(error_of(one.matter, one.seen, "transport-64"), 0, one.nearer)
            << one.matter.depth << " " << one.matter.g;
    }
}

}  // namespace
}  // namespace awan
