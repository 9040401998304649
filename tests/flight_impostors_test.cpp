// Impostors in flight: the bound, the order, and frames made of pictures against frames drawn whole.
#include "core/flight_impostors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/flight_path.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "core/survey/separate_clouds.h"
#include "server/document/json.h"

namespace awan {
namespace {

// Three clouds one behind the other, far away, and a way past them.
struct Sky {
    std::string more;      // of the document
    std::string of_image;  // of its image
    std::string from = "[0,0,40]", to = "[0.8,0,40]";
};
std::string three_clouds(const Sky& sky = {}) {
    std::string cubes;
    for (const char* center : {"[-3,0,0]", "[2,1,-14]", "[6,-1,-30]"})
        cubes += std::string(cubes.empty() ? "" : ",") + R"({"particles":60,"size":[3,1.4,2],)" +
                 R"("radius":0.8,"center":)" + center + "}";
    return R"({"cubes":[)" + cubes + "]," + sky.more +
           R"("sequence":{"frames":8,"to":1,"camera":[{"time":0,"eye":)" + sky.from +
           R"(,"target":[0,0,-60],"fov":30},{"time":1,"eye":)" + sky.to +
           R"(,"target":[0.8,0,-60],"fov":30}]},
           "accuracy":{"rung":"transport-16"},"image":{)" +
           sky.of_image + R"("width":96,"height":64}})";
}

Scene scene_of(const std::string& text) {
    return validate(parse_scene(text).value()).value();
}

struct Flight {
    std::vector<Image> frames;
    std::vector<ImpostorFrame> of_frames;
    ImpostorReport report;
    std::vector<ImpostorRun> runs;
};

Flight fly(const std::string& text, const FlightImpostorWish& wish, int threads = 2) {
    const Scene scene = scene_of(text);
    LightCache lights(64 << 20);
    Settled settled = settle(scene, Settling::kMeasured, {&lights, threads}, Deadline{}).value();
    settled.is_unmeasured = true;
    FlightImpostors impostors(wish, scene, settled);
    Flight flight;
    for (std::uint64_t i = 0; i < settled.sequence.frames; ++i) {
        const Frame frame = frame_at(settled, frame_time(settled.sequence, i));
        Planned planned = plan_frame(frame, threads, Deadline{}, {}).value();
        planned.impostors = &impostors;
        planned.flight_frame = i;
        const Tools tools{nullptr, threads, &lights, {}, {}};
        Rendered rendered =
            render_planned(frame.scene, std::move(planned), tools, Deadline{}).value();
        flight.frames.push_back(std::move(rendered.image));
        flight.of_frames.push_back(rendered.impostors);
    }
    flight.report = impostors.report();
    flight.runs = impostors.runs();
    return flight;
}

double relative_error(const Image& picture, const Image& whole) {
    double difference = 0, all = 0;
    for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
        const double w = static_cast<double>(whole.pixels[i]);
        difference += std::pow(static_cast<double>(picture.pixels[i]) - w, 2);
        all += w * w;
    }
    return std::sqrt(difference / all);
}

// The share of pixels that show what none does within `reach` pixels of the whole frame, by more than `slack` of
// the brightest.
double beside_their_place(const Image& picture, const Image& whole, int reach, float slack) {
    std::size_t off = 0;
    slack *= *std::max_element(whole.pixels.begin(), whole.pixels.end());
    for (int y = 0; y < whole.height; ++y)
        for (int x = 0; x < whole.width; ++x) {
            const auto at = [&](const Image& image, int i, int j) {
                return image.pixels[4 * (static_cast<std::size_t>(j) *
                                             static_cast<std::size_t>(image.width) +
                                         static_cast<std::size_t>(i)) +
                                    1];
            };
            float least = INFINITY, most = -INFINITY;
            for (int j = std::max(0, y - reach); j <= std::min(whole.height - 1, y + reach); ++j)
                for (int i = std::max(0, x - reach); i <= std::min(whole.width - 1, x + reach);
                     ++i) {
                    least = std::min(least, at(whole, i, j));
                    most = std::max(most, at(whole, i, j));
                }
            const float own = at(picture, x, y);
            off += own < least - slack || own > most + slack ? 1 : 0;
        }
    return static_cast<double>(off) / static_cast<double>(whole.pixel_count());
}

TEST(FlightImpostors, OffIsTheFrameDrawnWhole) {
    const Flight off = fly(three_clouds(), {Impostors::kOff, 1});
    const Scene scene = scene_of(three_clouds());
    const Scene still =
        frame_at(settle(scene, Settling::kMeasured, {nullptr, 1}, Deadline{}).value(), 1).scene;
    const Rendered alone = render_scene(still, {nullptr, 1, nullptr, {}, {}}, Deadline{}).value();
    EXPECT_EQ(off.frames.back().pixels, alone.image.pixels);
    EXPECT_FALSE(off.report.on);
    EXPECT_EQ(off.report.reason, "they are switched off");
}

TEST(FlightImpostors, KeptPicturesShowMatterWithinTheBound) {
    const Sky skies[] = {
        {"", ""},
        {R"("haze":{"extinction":0.01,"scale_height":20},"ground":{"height":-9},)", ""},
        {"", R"("background":"transparent",)"}};
    for (const Sky& sky : skies) {
        const std::string more = sky.more + sky.of_image, text = three_clouds(sky);
        const Flight whole = fly(text, {Impostors::kOff, 1});
        double before = 0;
        for (const double pixels : {0.25, 2.0}) {
            const Flight flight = fly(text, {Impostors::kOn, pixels});
            ASSERT_TRUE(flight.report.on) << more << flight.report.reason;
            EXPECT_EQ(flight.report.clouds, 3U);
            std::uint32_t kept = 0;
            double worst = 0;
            for (std::size_t i = 0; i < whole.frames.size(); ++i) {
                kept += flight.of_frames[i].kept;
                const int reach = static_cast<int>(std::ceil(pixels)) + 1;
                EXPECT_LT(beside_their_place(flight.frames[i], whole.frames[i], reach, 0.02F),
                          0.002)
                    << more << " " << pixels << " frame " << i;
                worst = std::max(worst, relative_error(flight.frames[i], whole.frames[i]));
            }
            EXPECT_GT(kept, 0U) << more;
            EXPECT_LT(worst, pixels < 1 ? 0.04 : 0.06) << more << pixels;
            EXPECT_GE(worst, before) << "a wider bound is not better";
            before = 0.8 * worst;
        }
    }
}

TEST(FlightImpostors, SameBytesForEveryNumberOfThreads) {
    const std::string text = three_clouds(
        {R"("haze":{"extinction":0.01,"scale_height":20},"ground":{"height":-9},)", ""});
    const Flight one = fly(text, {Impostors::kOn, 1}, 1);
    ASSERT_TRUE(one.report.on);
    for (const int threads : {2, 7}) {
        const Flight other = fly(text, {Impostors::kOn, 1}, threads);
        for (std::size_t i = 0; i < one.frames.size(); ++i)
            EXPECT_EQ(one.frames[i].pixels, other.frames[i].pixels) << threads << " " << i;
    }
}

// The formula of displacement(), against two rays that are followed.
TEST(FlightImpostors, DisplacementIsWhatMatterAndPlaneDifferBy) {
    const Scene scene = scene_of(three_clouds());
    SeparateCloud cloud;
    cloud.shows = cloud.all = {glm::dvec3(-1, -1, -1), glm::dvec3(1, 1, 1)};
    View key;
    key.eye = {0, 0, 20};
    key.tan_half_fov = 0.2;
    key.aspect = 1.5;
    const auto picture = facing_picture(cloud, key, scene->image).value();
    EXPECT_NEAR(picture.near, 19, 1e-9);
    EXPECT_NEAR(picture.far, 21, 1e-9);
    EXPECT_NEAR(1 / picture.plane, (1 / 19. + 1 / 21.) / 2, 1e-12);
    EXPECT_EQ(displacement(picture, key, scene->image), 0) << "from the eye itself";
    for (const glm::dvec3 way : {glm::dvec3(0.5, 0, 0), glm::dvec3(0, 0.3, 0), glm::dvec3(0, 0, -4),
                                 glm::dvec3(0.4, 0.2, -2), glm::dvec3(-0.3, 0.1, 3)}) {
        View view = key;
        view.eye += way;
        double most = 0;
        for (const double x : {-1., 0., 1.})
            for (const double y : {-1., 1.})
                for (const double z : {-1., -0.3, 1.}) {
                    const glm::dvec3 place{x, y, z}, ray = place - key.eye;
                    const glm::dvec3 shown = key.eye + ray * (picture.plane / -ray.z);
                    const glm::dvec3 a = place - view.eye, b = shown - view.eye;
                    most = std::max(
                        {most, std::hypot(a.x / -a.z - b.x / -b.z, a.y / -a.z - b.y / -b.z)});
                }
        const double pixels = most * scene->image.height / (2 * key.tan_half_fov);
        const double bound = displacement(picture, view, scene->image);
        EXPECT_GE(bound, pixels * (1 - 1e-9)) << way.x << " " << way.y << " " << way.z;
        EXPECT_LE(bound, 1.6 * pixels) << "no more than need be";
    }
    View within = key;
    within.eye = {0, 0, 0.5};
    EXPECT_TRUE(std::isinf(displacement(picture, within, scene->image)));
    EXPECT_FALSE(facing_picture(cloud, within, scene->image)) << "the eye is in it";
}

TEST(FlightImpostors, DrawnAgainWhereTheBoundIsCrossedAndNotBefore) {
    const std::string text = three_clouds({"", "", "[0,0,40]", "[4,0,40]"});
    const Scene scene = scene_of(text);
    const Flight flight = fly(text, {Impostors::kOn, 0.1});
    ASSERT_TRUE(flight.report.on);
    const Settled settled = settle(scene, Settling::kMeasured, {nullptr, 1}, Deadline{}).value();
    const std::vector<View> views = views_of_frames(settled);
    std::uint32_t again = 0;
    for (std::size_t r = 0; r < flight.runs.size(); ++r) {
        const ImpostorRun& run = flight.runs[r];
        for (std::uint64_t i = run.first; i <= run.last; ++i)
            EXPECT_LE(displacement(run.picture, views[i], scene->image), 0.1);
        EXPECT_GE(run.key, run.first);
        EXPECT_LE(run.key, run.last);
        const bool follows = r + 1 < flight.runs.size() && flight.runs[r + 1].cloud == run.cloud &&
                             flight.runs[r + 1].first == run.last + 1;
        if (!follows) continue;
        ++again;
        EXPECT_GT(displacement(run.picture, views[run.last + 1], scene->image), 0.1);
    }
    EXPECT_GT(again, 0U) << "this bound is crossed";
    std::uint32_t redrawn = 0;
    for (const ImpostorFrame& frame : flight.of_frames) redrawn += frame.redrawn;
    EXPECT_EQ(redrawn, again);
}

TEST(FlightImpostors, CloudsThatInterpenetrateAreDrawnTogether) {
    const auto clouds_of = [](double gap) {
        const std::string other = "[" + std::to_string(gap) + ",0,0]";
        const Scene scene = scene_of(
            R"({"cubes":[{"particles":60,"size":[3,2,2],"radius":0.7,"center":[0,0,0]},
                {"particles":60,"size":[3,2,2],"radius":0.7,"center":)" +
            other + R"(},{"particles":60,"size":[3,2,2],"radius":0.7,"center":[0,0,-30]}]})");
        const Planned planned = plan_still(scene, 1, Deadline{}, {}, {}).value();
        return separate_clouds(planned.particles, planned.survey.islands);
    };
    EXPECT_EQ(clouds_of(12).list.size(), 3U);
    const SeparateClouds near = clouds_of(2.5);
    ASSERT_EQ(near.list.size(), 2U);
    EXPECT_EQ(near.list[0].particles.size() + near.list[1].particles.size(), 180U);
    for (const double z : {20., -60.}) {
        const auto order = front_to_back(near, {0, 0, z});
        ASSERT_EQ(order.size(), 2U);
        const auto middle = [&](std::size_t i) {
            return std::abs(near.list[order[i]].shows.min.z - z);
        };
        EXPECT_LT(middle(0), middle(1)) << "nearest first, seen from " << z;
    }
}

TEST(FlightImpostors, AnEyeWithinACloudSeesItDrawnWhole) {
    const std::string text = three_clouds({"", "", "[-3,0,0.1]", "[-3,0,0]"});
    const Flight whole = fly(text, {Impostors::kOff, 1});
    const Flight flight = fly(text, {Impostors::kOn, 1});
    ASSERT_TRUE(flight.report.on) << flight.report.reason;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < flight.frames.size(); ++i) {
        if (flight.of_frames[i].kept + flight.of_frames[i].drawn == 0) continue;
        EXPECT_GE(flight.of_frames[i].whole, 1U);
        EXPECT_LT(relative_error(flight.frames[i], whole.frames[i]), 0.03) << i;
        ++nearest;
    }
    EXPECT_GT(nearest, 0U);
}

TEST(FlightImpostors, AutoLeavesThemOffWhereTheyDoNotPay) {
    // A turn around one cloud that fills the picture: no picture of it serves two frames.
    SceneDraft draft = parse_scene(R"({"cubes":[{"particles":60,"size":[3,1,2],"center":[0,0,0],"radius":0.6}],
            "image":{"width":48,"height":32}})")
                           .value();
    FlightWish wish;
    wish.frames = 12;
    const Scene orbit = flight_of(draft, wish, 1, Deadline{}).value();
    const Settled settled = settle(orbit, Settling::kMeasured, {nullptr, 1}, Deadline{}).value();
    const Planned planned = plan_frame(frame_at(settled, 0), 1, Deadline{}, {}).value();
    const SeparateClouds clouds = separate_clouds(planned.particles, planned.survey.islands);
    const ImpostorPlan plan =
        plan_impostors({Impostors::kAuto, 1}, orbit, clouds, views_of_frames(settled));
    EXPECT_FALSE(plan.on);
    EXPECT_TRUE(plan.runs.empty());
    EXPECT_FALSE(plan.reason.empty());
}

}  // namespace
}  // namespace awan
