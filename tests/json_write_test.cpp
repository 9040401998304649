// Answers as JSON: they parse, they hold what was put in, and a written scene reads back the same.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/formats/awn.h"
#include "core/scene/fingerprint.h"
#include "server/document/json.h"
#include "tests/scene_checks.h"

namespace awan {
namespace {

using nlohmann::json;
using namespace scene_checks;

// Equal in every value: written again, they give the same text, and they have one fingerprint.
void expect_round_trip(const SceneDraft& draft) {
    const std::string text = scene_to_json(draft);
    const Result<SceneDraft> again = parse_scene(text);
    ASSERT_TRUE(again.ok()) << again.error().pointer << ": " << again.error().message << "\n"
                            << text;
    EXPECT_EQ(scene_to_json(*again), text);
    EXPECT_EQ(again->top_level_cubes, draft.top_level_cubes);
    const Result<Scene> before = validate(draft), after = validate(*again);
    ASSERT_EQ(before.ok(), after.ok());
    if (before.ok()) {
        EXPECT_EQ(fingerprint(*before), fingerprint(*after)) << text;
    } else {
        EXPECT_EQ(before.error().pointer, after.error().pointer);
    }
}

TEST(SceneToJson, ReadsBackTheSame) {
    const char* const cube = R"("particles": 1, "size": [0.1, 1e-9, 3], "center": [-0.6, 1e9, 0],
                                "radius": 0.30000000000000004)";
    const std::string cubes =
        std::string("{\"cubes\": [{") + cube + R"(}, {)" + cube + R"(, "density": 0.1}])";
    for (const std::string& text :
         {cubes + "}", std::string(R"({"cubes": []})"), std::string(R"({"clouds": []})"),
          cubes + R"(, "fill": "gardner", "seed": 18446744073709551615, "density": 0.1,
             "medium": {"albedo": 0.1, "g": -0.3, "phase": "cornette-shanks"},
             "sun": {"elevation": 1, "azimuth": 2, "color": [0.1, 0.2, 0.3], "intensity": 0},
             "sky": {"zenith": [0, 0, 0], "horizon": [1, 1, 1], "intensity": 1e-300},
             "camera": {"eye": [1, 2, 3], "target": [0, 0, 0], "up": [0, 0, 1], "fov": 0.1},
             "image": {"width": 1, "height": 2, "format": "exr", "background": "transparent",
                       "exposure": 0, "precision": "float"},
             "effects": {"self_shadow": true, "texture": false}, "accuracy": {"rung": "harris"}})",
          cubes + R"(, "sun": {"direction": [1, 2, 3]}, "sky": "none", "fill": "printed"})",
          cubes + R"(, "sun": {"color": "auto"}})", cubes + R"(, "accuracy": {"error": 0.1}})",
          cubes + R"(, "accuracy": {"time_ms": 0.1}})",
          cubes + R"(, "sky": "physical", "haze": {"extinction": 0.1, "scale_height": 3}})",
          cubes + R"(, "sky": {"model": "physical", "turbidity": 2.5, "intensity": 0.1},
             "sun": {"color": "auto"}, "ground": {}, "detail": {}})",
          cubes + R"(, "sun": {"color": "auto"}, "sky": {"turbidity": 7, "zenith": [0, 0, 1]}})",
          cubes + R"(, "haze": {"extinction": 1e-9, "height": -0.1, "scale_height": 0.1,
             "albedo": [0.1, 0.2, 0.3], "g": -0.1}, "detail": {"amount": 0.1, "size": 0.3},
             "effects": {"light_shafts": false, "sun_color": true}})",
          cubes + R"(, "ground": {"height": 1, "albedo": [0.1, 0.2, 0.3]}})",
          std::string(R"({"clouds": [{"model": "cubes", "cubes": [{)") + cube +
              R"(, "texture": "a\"b\\c\u0001\u20ac"}]},
              {"cubes": [], "translate": [1, 2, 3], "scale": 0.1, "rotate_y": -7, "fill": "uniform",
               "density": 0, "seed": 0},
              {"model": "particles", "positions": [[0.1, 0.2, 0.3], [1e9, -1e9, 0]],
               "radii": [0.1, 1e-6], "densities": [0.3, 0], "colors": [[0.1, 0.2, 0.3], [1, 1, 1]]},
              {"model": "particles", "positions": [], "radii": []}]})"})
        expect_round_trip(draft_of(text));
}

TEST(SceneToJson, EveryFloatOfAReadyParticleSurvives) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    Cloud& cloud = draft.clouds.emplace_back();
    cloud.model = CloudModel::kParticles;
    std::uint32_t bits = 1;
    for (int i = 0; i < 20'000; ++i) {
        bits = bits * 1664525u + 1013904223u;
        const float u = static_cast<float>(bits >> 8) / 16777216.0f;
        cloud.ready.positions.emplace_back(std::exp(20 * double{u}), 1.0 / (1 + double{u}), -u);
        cloud.ready.radii.push_back(std::exp(26 * u - 13));
        cloud.ready.densities.push_back(u);
        cloud.ready.colors.emplace_back(u, u * u, 1 - u);
    }
    const SceneDraft again = draft_of(scene_to_json(draft));
    ASSERT_EQ(again.clouds.size(), 1u);
    EXPECT_EQ(again.clouds[0].ready.positions, cloud.ready.positions);
    EXPECT_EQ(again.clouds[0].ready.radii, cloud.ready.radii);
    EXPECT_EQ(again.clouds[0].ready.densities, cloud.ready.densities);
    EXPECT_EQ(again.clouds[0].ready.colors, cloud.ready.colors);
}

TEST(SceneToJson, LeavesOutDefaults) {
    const std::string text = scene_to_json(draft_of(R"({"cubes": [{"particles": 1,
        "size": [1, 2, 3], "center": [4, 5, 6], "radius": 7}]})"));
    EXPECT_EQ(text,
              "{\n  \"cubes\": [\n    { \"particles\": 1, \"size\": [1,2,3], \"center\": [4,5,6], "
              "\"radius\": 7 }\n  ]\n}\n");
}

TEST(SceneToJson, ALayoutThereAndBackIsTheSameLayout) {
    for (const char* const name : {"table-4.2.awn", "table-4.3.awn", "table-4.4.awn"}) {
        std::ifstream file(std::string(AWAN_TEST_DATA) + "/" + name, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        const Result<SceneDraft> layout = read_awn(text);
        ASSERT_TRUE(layout.ok());
        expect_round_trip(*layout);
        EXPECT_EQ(*write_awn(draft_of(scene_to_json(*layout))), *write_awn(*layout));
    }
}

ParticleSet some_particles(std::size_t count, bool colored) {
    ParticleSet set;
    for (std::size_t i = 0; i < count; ++i) {
        const double u = static_cast<double>(i * 7919 % 10007) / 10007;
        set.center.emplace_back(u, -1e9 * u, u / 3);
        set.radius.push_back(static_cast<float>(u + 0.1));
        set.density.push_back(static_cast<float>(u / 7));
        if (colored) set.color.emplace_back(static_cast<float>(u), 0.5f, 1.0f);
    }
    return set;
}

std::string in_pieces(const ParticleSet& set, std::size_t step) {
    std::string out = particles_json_head(set, UINT64_MAX);
    for (std::size_t i = 0; i < set.size(); i += step)
        append_particles_json(set, i, std::min(i + step, set.size()), out);
    return out + particles_json_tail();
}

TEST(ParticlesJson, HoldsWhatWasPutIn) {
    for (const bool colored : {false, true}) {
        const ParticleSet set = some_particles(50, colored);
        const json answer = json::parse(in_pieces(set, 50));
        EXPECT_EQ(answer["count"], 50);
        EXPECT_EQ(answer["seed"].get<std::uint64_t>(), UINT64_MAX);
        EXPECT_EQ(answer["bounds"]["min"][1].get<double>(), bounds_of(set).min.y);
        EXPECT_EQ(answer["bounds"]["max"][2].get<double>(), bounds_of(set).max.z);
        ASSERT_EQ(answer["particles"].size(), 50u);
        for (std::size_t i = 0; i < 50; ++i) {
            const json& particle = answer["particles"][i];
            EXPECT_EQ(particle.size(), 4u);
            EXPECT_EQ(particle["center"],
                      json({set.center[i].x, set.center[i].y, set.center[i].z}));
            EXPECT_EQ(particle["radius"].get<float>(), set.radius[i]);
            EXPECT_EQ(particle["density"].get<float>(), set.density[i]);
            EXPECT_EQ(particle["color"][0].get<float>(), colored ? set.color[i].x : 1.0f);
        }
    }
}

TEST(ParticlesJson, IsTheSameTextInWhateverPieces) {
    const ParticleSet set = some_particles(100, true);
    for (const std::size_t step : {std::size_t{1}, std::size_t{7}, std::size_t{99}})
        EXPECT_EQ(in_pieces(set, step), in_pieces(set, 100));
}

TEST(ParticlesJson, NoParticlesAreAnAnswerToo) {
    const json answer = json::parse(in_pieces(ParticleSet{}, 1));
    EXPECT_EQ(answer["count"], 0);
    EXPECT_TRUE(answer["particles"].empty());
    EXPECT_EQ(answer["bounds"]["min"], json({0, 0, 0}));
}

#ifndef AWAN_SANITIZED
TEST(ParticlesJson, AMillionParticlesAreWrittenAndReadInSeconds) {
    const ParticleSet set = some_particles(1'000'000, false);
    const auto start = std::chrono::steady_clock::now();
    std::string piece;
    for (std::size_t i = 0; i < set.size(); i += 10'000) {
        piece.clear();
        append_particles_json(set, i, i + 10'000, piece);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 3.0);  // 0.4 s on a quiet core

    SceneDraft draft;
    draft.top_level_cubes = false;
    Cloud& cloud = draft.clouds.emplace_back();
    cloud.model = CloudModel::kParticles;
    cloud.ready.positions = set.center;
    cloud.ready.radii = cloud.ready.densities = set.radius;
    cloud.ready.colors.assign(set.size(), glm::vec3(0.25f, 0.5f, 0.75f));
    const std::string text = scene_to_json(draft);
    const auto read_start = std::chrono::steady_clock::now();
    const SceneDraft again = draft_of(text);
    const std::chrono::duration<double> read_seconds =
        std::chrono::steady_clock::now() - read_start;
    EXPECT_EQ(again.clouds[0].ready.positions.size(), set.size());
    EXPECT_LT(read_seconds.count(), 6.0);  // 0.9 s on a busy core
}
#endif

TEST(PlanToJson, IsFiniteJsonWithTheFieldsThatScriptsRead) {
    Survey survey;
    survey.particles = 3;
    survey.cloud_density = {0.5, 7};
    survey.bounds = {{-1, -2, -3}, {1, 2, 3}};
    survey.volume.cells = {4, 5, 6};
    survey.volume.cell = 0.5;
    survey.optical_depth_sun = 1.5;
    survey.optical_depth_zenith = std::nan("");
    survey.min_projected_px = 2;
    survey.max_projected_px = std::numeric_limits<double>::infinity();
    survey.eye_inside = true;
    Plan plan;
    for (int i = 0; i < kEffectCount; ++i)
        plan.effects[static_cast<std::size_t>(i)] = {static_cast<Effect>(i), i % 2 == 0,
                                                     "because \"3 > 2\"", 0.25};
    plan.rung = "harris";
    plan.rung_reason = "cheapest under 50%";
    for (const Rung& rung : ladder()) plan.forecasts.push_back({&rung, 0.25, 12.5, 4096});
    plan.forecasts.back().time_ms = std::numeric_limits<double>::infinity();
    plan.predicted = plan.forecasts[1];
    const json answer = json::parse(plan_to_json(survey, plan));
    const json& figures = answer["survey"];
    EXPECT_EQ(figures["particles"], 3);
    EXPECT_EQ(figures["density"], json({0.5, 7}));
    EXPECT_EQ(figures["bounds"], json({{"min", {-1, -2, -3}}, {"max", {1, 2, 3}}}));
    EXPECT_EQ(figures["optical_depth"], json({{"sun", 1.5}, {"zenith", nullptr}, {"eye", 0}}));
    EXPECT_EQ(figures["projected_px"], json({{"min", 2}, {"max", nullptr}}));
    EXPECT_EQ(figures["volume"], json({{"cells", {4, 5, 6}}, {"cell", 0.5}}));
    EXPECT_EQ(figures["eye_inside"], true);
    for (const char* const name : {"total_mass", "max_extinction", "max_sigma_s"})
        EXPECT_TRUE(figures[name].is_number()) << name;
    ASSERT_EQ(answer["effects"].size(), std::size_t{kEffectCount});
    EXPECT_EQ(answer["effects"][0], json({{"name", "self_shadow"},
                                          {"on", true},
                                          {"available", true},
                                          {"reason", "because \"3 > 2\""},
                                          {"error_left_out", 0.25}}));
    EXPECT_EQ(answer["rung"], "harris");
    EXPECT_EQ(answer["rung_reason"], "cheapest under 50%");
    EXPECT_EQ(answer["predicted"], json({{"error", 0.25}, {"time_ms", 12.5}}));
    ASSERT_EQ(answer["rungs"].size(), ladder().size());
    EXPECT_EQ(answer["rungs"][1], json({{"rung", "harris"},
                                        {"simulates", find_rung("harris")->simulates},
                                        {"error", 0.25},
                                        {"time_ms", 12.5},
                                        {"memory_bytes", 4096}}));
    EXPECT_EQ(answer["rungs"].back()["time_ms"], nullptr) << "JSON cannot say infinite";
    plan.predicted = {};
    EXPECT_EQ(json::parse(plan_to_json(survey, plan))["predicted"],
              json({{"error", nullptr}, {"time_ms", nullptr}}))
        << "nothing is predicted of no rung";
}

TEST(ProblemToJson, SaysAPointerWhereThereIsOne) {
    const json scene =
        json::parse(problem_to_json(422, "Unprocessable Content", "must be > 0", "", "id-1"));
    EXPECT_EQ(scene, json({{"type", "about:blank"},
                           {"title", "Unprocessable Content"},
                           {"status", 422},
                           {"detail", "must be > 0"},
                           {"pointer", ""},
                           {"request_id", "id-1"}}));
    EXPECT_EQ(json::parse(problem_to_json(400, "t", "d", "line 4", "i"))["pointer"], "line 4");
    EXPECT_FALSE(json::parse(problem_to_json(404, "t", "d", "", "i")).contains("pointer"));
}

TEST(ProblemToJson, IsJsonWhateverBytesItQuotes) {
    std::string bytes;
    for (int c = 0; c < 256; ++c) bytes += static_cast<char>(c);
    bytes += "\xE2\x82\xAC \xF0\x9F\x8C\xA5 \xED\xA0\x80 \xC0\x80 \xF5\x80\x80\x80 \xE2\x82";
    const json problem = json::parse(problem_to_json(400, "t", bytes, "", "i"));
    const std::string detail = problem["detail"];
    EXPECT_EQ(detail.substr(0, 128), bytes.substr(0, 128));
    EXPECT_NE(detail.find("\xE2\x82\xAC \xF0\x9F\x8C\xA5"), std::string::npos);
}

TEST(PresetsToJson, ListsNamesTitlesAndAddresses) {
    const PresetEntry entries[] = {{"cumulus", "Cumulus \"humilis\"", "{}"},
                                   {"flat", "Flat", "{}"}};
    const json answer = json::parse(presets_to_json(entries, 2));
    ASSERT_EQ(answer["presets"].size(), 2u);
    EXPECT_EQ(answer["presets"][0]["name"], "cumulus");
    EXPECT_EQ(answer["presets"][0]["title"], "Cumulus \"humilis\"");
    EXPECT_EQ(answer["presets"][1]["href"], "/v1/presets/flat");
    EXPECT_TRUE(json::parse(presets_to_json(nullptr, 0))["presets"].empty());
}

TEST(VersionToJson, SaysTheRendererOrWhyThereIsNone) {
    const DeviceInfo device{"llvmpipe", "4.5 Mesa", "surfaceless", true};
    const json with = json::parse(version_to_json(&device, ""));
    EXPECT_EQ(with["name"], "awan");
    EXPECT_EQ(with["version"], AWAN_VERSION);
    EXPECT_EQ(with["renderer"]["name"], "llvmpipe");
    EXPECT_EQ(with["renderer"]["software"], true);
    EXPECT_TRUE(with["reason"].is_null());
    const json without = json::parse(version_to_json(nullptr, "eglInitialize failed"));
    EXPECT_TRUE(without["renderer"].is_null());
    EXPECT_EQ(without["reason"], "eglInitialize failed");
}

}  // namespace
}  // namespace awan
