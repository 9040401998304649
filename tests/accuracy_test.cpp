// The sweep, over renders whose errors and times are known: pictures made from the path tracer's own
// by a factor, times as the test says.
#include "core/accuracy/accuracy.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <thread>

#include "core/accuracy/accuracy_pictures.h"
#include "nlohmann/json.hpp"
#include "server/document/accuracy_text.h"
#include "tests/accuracy_reports.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using json = nlohmann::json;
using test::balls;
using test::valid;

SceneDraft thin_ball() {
    SceneDraft draft = balls({{{0, 0, 0}, 6, 0.3}});
    draft.image.width = 48;
    draft.image.height = 36;
    return draft;
}

AccuracyOptions quick() {
    AccuracyOptions options;
    options.reference_side = 24;
    options.samples = 64;
    options.threads = 2;
    return options;
}

// Renders every rung as the truth times its gain, in the time the test says.
struct FakeRungs {
    struct Rung {
        double gain = 1;
        std::vector<double> times_ms = {10};  // of the runs at the scene's own size, in turn
        std::optional<Error> error;
    };
    std::map<std::string, Rung> rungs;
    std::map<std::string, int> own_runs;
    std::vector<std::string> calls;
    Background own_background = Background::kTransparent;
    Image truth;  // at the reference's size, traced once

    RenderScene renderer(const Scene& whole) {
        return [this, width = whole->image.width](const Scene& scene,
                                                  const Deadline& deadline) -> Result<Rendered> {
            const std::string name = scene->accuracy.rung.value_or("none");
            calls.push_back(name);
            const Rung& rung = rungs[name];
            if (rung.error) return *rung.error;
            auto planned = plan_scene(scene, 1, deadline);
            if (!planned) return planned.error();
            Rendered rendered{planned->survey, planned->plan, {}, {}};
            const bool own = scene->image.width == width;
            if (own) {
                own_background = scene->image.background;
                const auto run = static_cast<std::size_t>(own_runs[name]++);
                rendered.times.light_ms = rung.times_ms[std::min(run, rung.times_ms.size() - 1)];
                rendered.image.width = scene->image.width;
                rendered.image.height = scene->image.height;
                return rendered;
            }
            EXPECT_EQ(scene->image.background, Background::kTransparent);
            if (truth.pixels.empty()) {
                TruthOptions options;
                options.samples = 256;
                options.threads = 2;
                auto traced = trace_truth(scene, planned->particles, planned->survey.view, options,
                                          Progress{}, deadline);
                if (!traced) return traced.error();
                truth = mean_of(*traced);
            }
            rendered.image = truth;
            for (std::size_t i = 0; i < rendered.image.pixels.size(); ++i)
                if (i % 4 != 3) rendered.image.pixels[i] *= static_cast<float>(rung.gain);
            return rendered;
        };
    }
};

Result<AccuracyReport> sweep(const Scene& scene, FakeRungs& fake, AccuracyOptions options,
                             const Progress& progress = {}, const Deadline& deadline = {}) {
    return measure_accuracy(scene, options, fake.renderer(scene), progress, deadline);
}

TEST(Accuracy, MeasuresThePictureOfTheScenesTime) {
    SceneDraft draft = thin_ball();
    draft.camera.automatic = true;
    draft.clouds[0].velocity = {0.5, 0, 0};
    draft.time = 1;
    FakeRungs one, two;
    one.rungs["harris"] = two.rungs["harris"] = {0.8, {40}, {}};
    const auto still = sweep(valid(draft), one, quick());
    draft.sequence = Sequence{0, 20, 2};  // its camera would hold twenty seconds' way
    const auto of_sequence = sweep(valid(draft), two, quick());
    ASSERT_TRUE(still && of_sequence);
    ASSERT_EQ(still->rungs.size(), of_sequence->rungs.size());
    for (std::size_t i = 0; i < still->rungs.size(); ++i)
        if (still->rungs[i].rung == std::string("harris")) {
            EXPECT_EQ(still->rungs[i].error.nrmse, of_sequence->rungs[i].error.nrmse);
        }
}

// A small reference is of the same cloud: with lumps, where the scene's own picture is large enough to show them.
TEST(Accuracy, TheReferenceHasTheDetailOfTheScenesOwnPicture) {
    SceneDraft draft = test::table_4_4();
    draft.detail = kAutomaticDetail;
    draft.accuracy = {};
    AccuracyOptions options = quick();
    options.rungs = {"transport-16"};
    options.runs = 1;
    const RenderScene render = [](const Scene& scene, const Deadline& deadline) {
        return render_scene(scene, {nullptr, 2, nullptr, {}, {}}, deadline);
    };
    for (const int width : {640, 32}) {
        draft.image.width = width;
        draft.image.height = width * 3 / 4;
        const Scene scene = valid(draft);
        const bool lumpy = plan_scene(scene, 2, {})->particles.detail != nullptr;
        EXPECT_EQ(lumpy, width == 640);
        bool small = false;
        const auto report =
            measure_accuracy(scene, options,
                             [&](const Scene& asked, const Deadline& deadline) {
                                 if (asked->image.width <= options.reference_side)
                                     small = plan_scene(asked, 2, {})->particles.detail != nullptr;
                                 return render(asked, deadline);
                             },
                             {}, {});
        ASSERT_TRUE(report.ok());
        EXPECT_EQ(small, lumpy) << width;
    }
}

TEST(Accuracy, ALookHasNoErrorToMeasure) {
    SceneDraft draft = test::plain_draft();
    draft.top_level_cubes = false;
    draft.look = Look::kGardner;
    FakeRungs fake;
    const auto report = sweep(valid(draft), fake, quick());
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().pointer, "/look");
}

TEST(Accuracy, MeasuresEveryRungButTheReference) {
    FakeRungs fake;
    fake.rungs["additive"] = {1.5, {3}, {}};
    fake.rungs["harris"] = {0.8, {40}, {}};
    fake.rungs["transport-32"] = {1.05, {60}, {}};
    const Scene scene = valid(thin_ball());
    const auto report = sweep(scene, fake, quick());
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->width, 48);
    EXPECT_EQ(report->height, 36);
    EXPECT_EQ(report->reference.width, 24);
    EXPECT_EQ(report->reference.height, 18);
    EXPECT_EQ(report->reference.samples, 64u);
    EXPECT_GT(report->reference.noise, 0);
    EXPECT_GT(report->reference.time_ms, 0);
    EXPECT_GT(report->reference.cpu_ms, 0);
    EXPECT_EQ(report->reference.picture.width, 24);
    EXPECT_TRUE(report->reference.picture.opaque) << "with the scene's background";
    EXPECT_EQ(report->rungs.size(), ladder().size() - 1);
    for (std::size_t i = 0; i < report->rungs.size(); ++i) {
        const RungCost& rung = report->rungs[i];
        EXPECT_NE(rung.rung, "truth");
        EXPECT_EQ(rung.runs, 3);
        EXPECT_EQ(rung.picture.pixel_count(), 24u * 18u);
        EXPECT_EQ(rung.difference.size(), 24u * 18u);
        if (i > 0) {
            EXPECT_GE(rung.time_ms, report->rungs[i - 1].time_ms) << "cheapest first";
        }
        const double expected = fake.rungs[rung.rung].gain - 1;
        EXPECT_NEAR(rung.error.bias, expected, 0.03) << rung.rung;
        if (expected != 0) {
            EXPECT_GE(rung.error.nrmse, std::abs(expected) - 0.03) << rung.rung;
            EXPECT_GT(rung.flip, 0) << rung.rung;
        }
    }
    EXPECT_EQ(report->rungs[0].rung, "additive");
    EXPECT_EQ(report->rungs[0].time_ms, 3);
    EXPECT_EQ(fake.own_background, Background::kSky) << "timed as the scene is";
}

TEST(Accuracy, MarksWhatNothingBeats) {
    FakeRungs fake;
    fake.rungs["additive"] = {1.5, {3}, {}};
    fake.rungs["harris"] = {2.0, {40}, {}};
    fake.rungs["transport-32"] = {1.2, {60}, {}};
    AccuracyOptions options = quick();
    options.rungs = {"transport-32", "additive", "harris", "harris"};
    const auto report = sweep(valid(thin_ball()), fake, options);
    ASSERT_TRUE(report);
    ASSERT_EQ(report->rungs.size(), 3u);
    EXPECT_TRUE(report->rungs[0].pareto);
    EXPECT_FALSE(report->rungs[1].pareto) << "harris: slower and worse than additive";
    EXPECT_TRUE(report->rungs[2].pareto);
}

TEST(Accuracy, TakesTheMedianWithoutTheFirstRun) {
    FakeRungs fake;
    fake.rungs["harris"] = {1, {500, 12, 90, 10}, {}};
    AccuracyOptions options = quick();
    options.rungs = {"harris"};
    auto report = sweep(valid(thin_ball()), fake, options);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->rungs[0].time_ms, 12);
    EXPECT_EQ(report->rungs[0].light_ms, 12);
    EXPECT_EQ(report->rungs[0].runs, 3);

    options.runs = 1;
    fake.own_runs.clear();
    report = sweep(valid(thin_ball()), fake, options);
    EXPECT_EQ(report->rungs[0].time_ms, 500) << "a single run counts";

    options.runs = 4;
    fake.own_runs.clear();
    fake.rungs["harris"].times_ms = {5000, 1};  // never comes to the second
    report = sweep(valid(thin_ball()), fake, options);
    EXPECT_EQ(report->rungs[0].time_ms, 5000) << "and so does one that takes long";
    EXPECT_EQ(report->rungs[0].runs, 1);

    fake.own_runs.clear();
    fake.rungs["harris"].times_ms = {2000, 1800, 1900};
    report = sweep(valid(thin_ball()), fake, options);
    EXPECT_EQ(report->rungs[0].time_ms, 1900) << "two runs are enough, and both count";
    EXPECT_EQ(report->rungs[0].runs, 2);
}

TEST(Accuracy, KeepsTheShapeOfThePicture) {
    EXPECT_EQ(fitted_size(800, 600, 128).height, 96);
    EXPECT_EQ(fitted_size(600, 800, 128).width, 96);
    EXPECT_EQ(fitted_size(100, 50, 128).width, 100) << "never larger than the scene's own";
    EXPECT_EQ(fitted_size(8192, 16, 128).height, 1);
}

TEST(Accuracy, SaysHowFarItHasCome) {
    FakeRungs fake;
    AccuracyOptions options = quick();
    options.rungs = {"harris", "transport-16"};
    std::vector<std::string> steps;
    options.on_step = [&](const std::string& step) { steps.push_back(step); };
    std::vector<double> shares;
    const auto report =
        sweep(valid(thin_ball()), fake, options, [&](double share) { shares.push_back(share); });
    ASSERT_TRUE(report);
    ASSERT_GT(shares.size(), 8u);
    for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_GE(shares[i], shares[i - 1]);
    EXPECT_GE(shares.front(), 0);
    EXPECT_EQ(shares.back(), 1);
    EXPECT_EQ(steps,
              (std::vector<std::string>{"planning", "sizing the reference", "tracing the reference",
                                        "measuring harris", "measuring transport-16"}));
}

TEST(Accuracy, StopsWhenNobodyWaits) {
    const auto gone = std::make_shared<std::atomic<bool>>(false);
    Deadline deadline;
    deadline.cancelled = gone;
    FakeRungs fake;
    AccuracyOptions options = quick();
    // In the midst of the reference, and between two rungs.
    for (const std::string at : {"tracing the reference", "measuring transport-16"}) {
        *gone = false;
        fake.calls.clear();
        options.on_step = [&](const std::string& step) {
            if (step == at) *gone = true;
        };
        const auto report = sweep(valid(thin_ball()), fake, options, {}, deadline);
        ASSERT_FALSE(report) << at;
        EXPECT_EQ(report.error().code, ErrorCode::kCancelled);
        for (const std::string& call : fake.calls) EXPECT_NE(call, "transport-24");
    }
    Deadline past;
    past.until = Deadline::Clock::now() - std::chrono::seconds(1);
    const auto late = sweep(valid(thin_ball()), fake, quick(), {}, past);
    ASSERT_FALSE(late);
    EXPECT_EQ(late.error().code, ErrorCode::kOverDeadline);
}

TEST(Accuracy, FitsTheTimeItIsGiven) {
    FakeRungs fake;
    AccuracyOptions options = quick();
    options.samples = 1u << 20;
    options.time_ms = 400;
    options.rungs = {"harris"};
    fake.rungs["harris"].error = Error{ErrorCode::kOverDeadline, "", "late"};
    const auto start = Deadline::Clock::now();
    const auto report = sweep(valid(thin_ball()), fake, options);
    const std::chrono::duration<double> took = Deadline::Clock::now() - start;
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_LT(report->reference.samples, 1u << 20);
    EXPECT_GE(report->reference.samples, 16u);
    EXPECT_EQ(report->reference.samples % 2, 0u);
    EXPECT_TRUE(report->rungs.empty());
    ASSERT_EQ(report->left_out.size(), 1u);
    EXPECT_EQ(report->left_out[0].rung, "harris");
    EXPECT_NE(report->left_out[0].reason.find("left"), std::string::npos);
    EXPECT_LT(took.count(), 20) << "sanitizers are slow";
}

TEST(Accuracy, HandsOnWhatARenderSays) {
    FakeRungs fake;
    fake.rungs["harris"].error = Error{ErrorCode::kNoRenderer, "", "no renderer here"};
    const auto report = sweep(valid(thin_ball()), fake, quick());
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message, "no renderer here");
}

TEST(Accuracy, RefusesUnknownRungs) {
    FakeRungs fake;
    AccuracyOptions options = quick();
    options.rungs = {"perfect"};
    const auto report = sweep(valid(thin_ball()), fake, options);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::kInvalidScene);
    EXPECT_NE(report.error().message.find("perfect"), std::string::npos);
    EXPECT_TRUE(fake.calls.empty());
}

// --- pictures

TEST(AccuracyPictures, LieOverTheSky) {
    SceneDraft draft = thin_ball();
    draft.sky = test::plain_draft().sky;
    draft.sky.intensity = 2;
    const Scene scene = valid(draft);
    Image image;
    image.width = 2;
    image.height = 2;
    image.pixels = {1, 1, 1, 1, 0, 0, 0, 0, 0.5F, 0.5F, 0.5F, 0.5F, 0, 0, 0, 0};
    View view;  // level, towards -z
    const Image seen = over_sky(image, scene, view, {});
    EXPECT_TRUE(seen.opaque);
    EXPECT_EQ(seen.pixels[0], 1.0F);
    EXPECT_EQ(seen.pixels[3], 1.0F);
    EXPECT_GT(seen.pixels[6], seen.pixels[4]) << "above the horizon it is blue";
    EXPECT_FLOAT_EQ(seen.pixels[12], 2 * 0.44F) << "below, the horizon's colour";
    EXPECT_FLOAT_EQ(seen.pixels[8], 0.5F + 0.5F * 2 * 0.44F);
    draft.sky.none = true;
    EXPECT_EQ(over_sky(image, valid(draft), view, {}).pixels[4], 0.0F);
}

// --- as text

TEST(AccuracyToJson, HasTheContractsShape) {
    AccuracyReport report = test::fake_report(test::whole_ladder());
    report.rungs[1].predicted_error = std::nan("");
    report.left_out.push_back({"truth", "no \"time\""});
    const std::vector<NamedAccuracy> one = {{"", report}};
    const json answer = json::parse(accuracy_to_json(one));
    EXPECT_EQ(answer["width"], 800);
    EXPECT_EQ(answer["reference"], json({{"rung", "truth"},
                                         {"width", 128},
                                         {"height", 96},
                                         {"samples", 1024},
                                         {"noise", 0.012},
                                         {"time_ms", 14200},
                                         {"cpu_ms", 28000}}));
    ASSERT_EQ(answer["rungs"].size(), 9u);
    EXPECT_EQ(answer["rungs"][0]["rung"], "additive");
    EXPECT_EQ(answer["rungs"][0]["predicted"],
              json({{"error", 3.2}, {"time_ms", 2.4000000000000004}}));
    EXPECT_EQ(answer["rungs"][1]["predicted"]["error"], nullptr);
    for (const char* const field : {"time_ms", "light_ms", "draw_ms", "error", "error_noise",
                                    "bias", "bias_noise", "flip", "stated", "memory_bytes", "runs"})
        EXPECT_TRUE(answer["rungs"][8][field].is_number()) << field;
    EXPECT_EQ(answer["rungs"][8]["pareto"], true);
    EXPECT_EQ(answer["left_out"], json::array({{{"rung", "truth"}, {"reason", "no \"time\""}}}));

    const json two =
        json::parse(accuracy_to_json(std::vector<NamedAccuracy>{{"a", report}, {"b", report}}));
    ASSERT_EQ(two["scenes"].size(), 2u);
    EXPECT_EQ(two["scenes"][1]["scene"], "b");
    EXPECT_EQ(two["scenes"][1]["rungs"].size(), 9u);
}

TEST(AccuracyToCsv, HasALineARung) {
    AccuracyReport report = test::fake_report({{"harris", 40, 0.5}});
    report.rungs[0].predicted_time_ms = std::nan("");
    const std::string one = accuracy_to_csv(std::vector<NamedAccuracy>{{"", report}});
    EXPECT_EQ(one,
              "rung,time_ms,light_ms,draw_ms,error,error_noise,bias,bias_noise,flip,"
              "stated,predicted_error,predicted_time_ms,memory_bytes,runs,pareto\n"
              "harris,40,24,12,0.5,0.002,-0.35,0.001,0.15,0.6,0.8,,4e+07,3,true\n");
    const std::string two =
        accuracy_to_csv(std::vector<NamedAccuracy>{{"a \"b\", c", report}, {"d", report}});
    EXPECT_TRUE(two.starts_with("scene,rung,"));
    EXPECT_NE(two.find("\n\"a \"\"b\"\", c\",harris,"), std::string::npos);
}

}  // namespace
}  // namespace awan
