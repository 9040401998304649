// The picture of what accuracy costs, decoded again; its layout as geometry.
#include "core/accuracy/plot.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <set>

#include "core/accuracy/plot_layout.h"
#include "core/accuracy/ratio_plot.h"
#include "tests/accuracy_reports.h"

namespace awan {
namespace {

using test::fake_report;
using test::whole_ladder;

struct Decoded {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  // 3 a pixel
    std::size_t colors() const {
        std::set<std::uint32_t> seen;
        for (std::size_t i = 0; i + 2 < pixels.size(); i += 3)
            seen.insert(std::uint32_t{pixels[i]} << 16 | std::uint32_t{pixels[i + 1]} << 8 |
                        pixels[i + 2]);
        return seen.size();
    }
};

Decoded decoded(const std::string& png) {
    OIIO::Filesystem::IOMemReader proxy(const_cast<char*>(png.data()), png.size());
    const auto input = OIIO::ImageInput::open("plot.png", nullptr, &proxy);
    Decoded image;
    EXPECT_TRUE(input) << OIIO::geterror();
    if (!input) return image;
    image.width = input->spec().width;
    image.height = input->spec().height;
    EXPECT_EQ(input->spec().nchannels, 3);
    image.pixels.resize(3 * static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height));
    EXPECT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, image.pixels.data()));
    return image;
}

Decoded drawn(const std::vector<AccuracyPlot>& plots, PlotTheme theme = PlotTheme::kLight,
              double scale = 1) {
    const auto png = plot_accuracy(plots, theme, scale);
    EXPECT_TRUE(png) << png.error().message;
    return png ? decoded(*png) : Decoded{};
}

TEST(Plot, ShowsTheWholeLadderInBothThemes) {
    const AccuracyReport report = fake_report(whole_ladder());
    const Decoded light = drawn({{"congestus", &report}});
    const Decoded dark = drawn({{"congestus", &report}}, PlotTheme::kDark);
    EXPECT_EQ(light.width, 1120);
    EXPECT_GT(light.height, 600);
    EXPECT_EQ(dark.height, light.height);
    EXPECT_GT(light.colors(), 500u);
    EXPECT_GT(dark.colors(), 500u);
    EXPECT_GT(light.pixels[0], 240);
    EXPECT_LT(dark.pixels[0], 40);
}

TEST(Plot, IsTheSamePictureAgain) {
    const AccuracyReport report = fake_report(whole_ladder());
    const AccuracyPlot plot{"congestus", &report};
    const auto first = plot_accuracy({&plot, 1}, PlotTheme::kLight);
    ASSERT_TRUE(first);
    EXPECT_EQ(*first, *plot_accuracy({&plot, 1}, PlotTheme::kLight));
}

TEST(Plot, StacksSeveralAndScales) {
    const AccuracyReport a = fake_report(whole_ladder());
    const AccuracyReport b = fake_report({{"harris", 40, 0.3}}, 128, 16);
    const Decoded one = drawn({{"a", &a}});
    const Decoded two = drawn({{"a", &a}, {"b", &b}});
    EXPECT_GT(two.height, one.height + 300);
    EXPECT_EQ(drawn({{"a", &a}}, PlotTheme::kLight, 2).width, 2240);
    const std::vector<AccuracyPlot> many(60, {"a", &a});
    const auto refused = plot_accuracy(many, PlotTheme::kLight);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kTooLarge);
}

TEST(Plot, DrawsWhatIsDegenerate) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    AccuracyReport nothing = fake_report({});
    AccuracyReport perfect = fake_report({{"harris", 40, 0}});
    perfect.rungs[0].error = {};
    AccuracyReport unknown = fake_report(whole_ladder(), 1, 128);
    for (RungCost& rung : unknown.rungs) {
        rung.predicted_error = rung.predicted_time_ms = nan;
        rung.error.nrmse = nan;
        rung.picture.pixels.assign(rung.picture.pixels.size(),
                                   std::numeric_limits<float>::quiet_NaN());
        rung.difference.assign(rung.difference.size(), std::numeric_limits<float>::infinity());
    }
    unknown.left_out.push_back({"truth", "no time"});
    AccuracyReport coarse = fake_report(whole_ladder(), 1, 1);
    AccuracyReport far = fake_report({{"additive", 1e-3, 1e-6}, {"truth", 1e9, 1e4}});
    for (const AccuracyReport* report : {&nothing, &perfect, &unknown, &coarse, &far})
        EXPECT_GT(drawn({{"", report}}).colors(), 20u);
}

// Bars of their lengths: so many pixels of a row are of the colour for faster, or for slower.
TEST(RatioPlot, DrawsABarARowAsLongAsItsLogarithm) {
    const std::vector<RatioRow> rows = {{"one", "ten times", "10 ms / 1 ms", 10},
                                        {"one", "a hundred times", "100 ms / 1 ms", 100},
                                        {"two", "half", "1 ms / 2 ms", 0.1}};
    const auto png = plot_ratios("Figures", "there / here", rows, PlotTheme::kLight);
    ASSERT_TRUE(png) << png.error().message;
    const Decoded image = decoded(*png);
    EXPECT_EQ(image.width, 1120);
    // Rows of pixels: how many are of the theme's accent, and of its orange.
    std::vector<int> faster, slower;
    for (int y = 0; y < image.height; ++y) {
        int blue = 0, orange = 0;
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* const p = &image.pixels[3 * (static_cast<std::size_t>(y) * 1120 +
                                                             static_cast<std::size_t>(x))];
            blue += p[0] == 0x1f && p[1] == 0x64 && p[2] == 0xad;
            orange += p[0] == 0xc2 && p[1] == 0x50 && p[2] == 0x0a;
        }
        if (blue > 20 && (faster.empty() || faster.back() != blue)) faster.push_back(blue);
        if (orange > 20 && (slower.empty() || slower.back() != orange)) slower.push_back(orange);
    }
    ASSERT_EQ(faster.size(), 2U);
    ASSERT_EQ(slower.size(), 1U);
    EXPECT_NEAR(faster[1], 2 * faster[0], 3);
    EXPECT_NEAR(slower[0], faster[0], 3);
    EXPECT_TRUE(plot_ratios("", "", {}, PlotTheme::kDark));
    const std::vector<RatioRow> many(2000, rows[0]);
    EXPECT_EQ(plot_ratios("", "", many, PlotTheme::kDark).error().code, ErrorCode::kTooLarge);
}

// What stands at the right end is there to its last letter.
TEST(RatioPlot, CutsNoFigures) {
    for (const char* const figures : {"120 frames/s / 1,234 frames/s", "22116 ms / 1234 ms"}) {
        const auto with = [&](const std::string& text) {
            const std::vector<RatioRow> rows = {
                {"one", "50,000 particles, 1152 x 864, splats", text, 3}};
            return decoded(*plot_ratios("Figures", "there / here", rows, PlotTheme::kLight));
        };
        const Decoded image = with(figures), other = with(std::string(figures) + "!");
        int differ = 0, edge = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const auto x = static_cast<int>(i / 3) % image.width;
            differ += x > image.width - 60 && image.pixels[i] != other.pixels[i];
            edge += x > image.width - 20 && image.pixels[i] < 200;
        }
        EXPECT_GT(differ, 3) << figures;
        EXPECT_EQ(edge, 0) << figures;
    }
}

TEST(Plot, DrawsAnyTitle) {
    const AccuracyReport report = fake_report({{"harris", 40, 0.3}});
    for (const std::string& title :
         {std::string("\xFF\xFE\xC0\x80\xED\xA0\x80"), std::string("<b>&amp;\n\t"),
          std::string("\xE4\xBA\x91 \xE2\x98\x81"), std::string(5000, 'x'),
          std::string(300, '\xE4')})
        EXPECT_GT(drawn({{title, &report}}).colors(), 50u);
}

// --- geometry

TEST(PlotLayout, LabelsOverlapNeitherEachOtherNorAnyMark) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 200; ++trial) {
        const double spread = trial % 4 == 0 ? 0.02 : trial % 4 == 1 ? 0.2 : 1;
        std::uniform_real_distribution<double> at(0.5 - spread / 2, 0.5 + spread / 2);
        LabelSurroundings around;
        around.area = {60, 20, 1000, trial % 2 == 0 ? 380.0 : 300.0};
        around.marker = 8;
        std::vector<LabelWish> wishes;
        for (int i = 0; i < 1 + trial % 9; ++i)
            wishes.push_back({{around.area.x + at(random) * around.area.width,
                               around.area.y + at(random) * around.area.height},
                              60 + 50 * at(random),
                              29});
        const auto boxes = place_labels(wishes, around);
        ASSERT_EQ(boxes.size(), wishes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            ASSERT_TRUE(boxes[i]) << trial;
            EXPECT_TRUE(around.area.holds(*boxes[i])) << trial;
            EXPECT_EQ(boxes[i]->width, wishes[i].width);
            for (std::size_t k = 0; k < boxes.size(); ++k) {
                if (k != i) {
                    EXPECT_FALSE(boxes[i]->overlaps(*boxes[k])) << trial;
                }
                const PlotPoint& p = wishes[k].point;
                EXPECT_FALSE(boxes[i]->overlaps({p.x - 8, p.y - 8, 16, 16})) << trial;
            }
        }
    }
}

TEST(PlotLayout, LeavesOutWhatHasNoRoom) {
    LabelSurroundings around;
    around.area = {0, 0, 100, 40};
    around.marker = 4;
    const std::vector<LabelWish> wishes(4, {{10, 20}, 60, 30});
    int placed = 0;
    for (const auto& box : place_labels(wishes, around)) placed += box.has_value();
    EXPECT_EQ(placed, 1);
}

TEST(PlotLayout, AxesHoldTheirValuesAndHaveTicks) {
    const std::vector<std::vector<double>> lists = {
        {}, {1}, {3, 60'000}, {0.002, 2}, {1e-12, 1e12}, {5, 5.1}, {0, -1, 7}};
    for (const auto& values : lists) {
        const LogAxis axis = axis_of(values);
        for (const double value : values) {
            if (!(value > 0)) continue;
            EXPECT_GT(axis.share(value), 0);
            EXPECT_LT(axis.share(value), 1);
        }
        int labelled = 0;
        for (const Tick& tick : ticks_of(axis)) {
            EXPECT_GE(axis.share(tick.value), 0);
            EXPECT_LE(axis.share(tick.value), 1);
            labelled += tick.labelled;
        }
        EXPECT_GE(labelled, 2);
        EXPECT_LE(labelled, 13);
    }
}

TEST(PlotLayout, WritesNumbersAsPeopleDo) {
    EXPECT_EQ(time_text(0.416), "0.42 ms");
    EXPECT_EQ(time_text(3), "3.0 ms");
    EXPECT_EQ(time_text(999.4), "1000 ms");
    EXPECT_EQ(time_text(1234), "1.2 s");
    EXPECT_EQ(time_text(94'700), "95 s");
    EXPECT_EQ(time_text(std::nan("")), "?");
    EXPECT_EQ(percent_text(0.0023), "0.23%");
    EXPECT_EQ(percent_text(0.0996), "10%");
    EXPECT_EQ(percent_text(1.72), "170%");
    EXPECT_EQ(percent_text(0), "0%");
    EXPECT_EQ(signed_percent_text(-0.031),
              "\xE2\x88\x92"
              "3.1%");
    EXPECT_EQ(signed_percent_text(0.2), "+20%");
    EXPECT_EQ(time_tick_text(2000), "2 s");
    EXPECT_EQ(percent_tick_text(0.005), "0.5%");
}

}  // namespace
}  // namespace awan
