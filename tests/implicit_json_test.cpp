// The document of implicit clouds: what may be written, what is refused and where, and that what is written reads back.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "core/scene/fingerprint.h"
#include "core/scene/implicit.h"
#include "core/scene/limits.h"
#include "core/scene/rules.h"
#include "server/document/overrides.h"
#include "tests/random_models_implicit.h"
#include "tests/scene_checks.h"

namespace awan {
namespace {

// Over every field of it.
std::string all_fields_of(const ImplicitCloud& cloud) {
    const ImplicitCloud all = spelled_out(cloud);
    return fingerprint_of(table_of<ImplicitCloud>(), &all);
}

using namespace scene_checks;

std::string implicit_with(const std::string& members) {
    return cloud_with(R"("model": "implicit", "implicit": {)" + members + "}");
}

const ImplicitCloud& cloud_of(const SceneDraft& draft) {
    return *draft.clouds.at(0).implicit;
}

TEST(ImplicitJson, AnEmptyObjectIsTheCumulus) {
    const SceneDraft draft = draft_of(implicit_with(""));
    const ImplicitSettings s = resolved(cloud_of(draft));
    EXPECT_EQ(s.primitives.size(), 9u);
    // The values of Ebert 2002: .2 to .4, .5, .4, .7.
    EXPECT_EQ(s.amount, 0.4);
    EXPECT_EQ(s.exponent, 0.5);
    EXPECT_EQ(s.blend, 0.4);
    EXPECT_EQ(s.displacement, 0.7);
    EXPECT_TRUE(read(implicit_with("")).ok());
}

TEST(ImplicitJson, ExplicitFieldsOverrideThePresetInAnyOrder) {
    const SceneDraft a = draft_of(implicit_with(R"("amount": 0.3, "preset": "cirrus")")),
                     b = draft_of(implicit_with(R"("preset": "cirrus", "amount": 0.3)"));
    EXPECT_EQ(all_fields_of(cloud_of(a)), all_fields_of(cloud_of(b)));
    EXPECT_EQ(resolved(cloud_of(a)).amount, 0.3);
    EXPECT_EQ(resolved(cloud_of(a)).exponent, 3);
    // Primitives of one's own replace the preset's, and its base; growth replaces them too.
    const SceneDraft own = draft_of(implicit_with(R"("primitives": [])")),
                     grows = draft_of(implicit_with(R"("growth": {})"));
    EXPECT_TRUE(resolved(cloud_of(own)).primitives.empty());
    EXPECT_FALSE(resolved(cloud_of(own)).base);
    EXPECT_TRUE(resolved(cloud_of(grows)).primitives.empty());
}

TEST(ImplicitJson, EveryFieldHasItsPlace) {
    const SceneDraft draft = draft_of(implicit_with(R"(
        "preset": "mackerel", "interpolation": "linear", "base": 3, "amount": 0.1, "exponent": 2,
        "blend": 0.3, "displacement": 0.4, "displace": "diagonal", "noise_size": 5, "octaves": 6,
        "gain": 0.7, "stretch": 8, "jet": [1, 2, 3], "jet_turbulence": 4, "warp_from": 5,
        "warp_to": 6, "ripple": [1, 0, 2], "ripple_depth": 0.5, "ripple_turbulence": 7,
        "swirl": 30, "swirl_path": "printed", "resolution": 20, "threshold": 0.1,
        "attractors": [{"at": [1, 2, 3], "strength": -0.5, "reach": 4}],
        "vortices": [{"at": [1, 2, 3], "axis": [0, 0, 2], "angle": 90, "reach": 5}],
        "flow": {"min": [0, 0, 0], "max": [1, 2, 3], "size": [2, 1, 1], "vectors": [[1, 0, 0], [0, 1, 0]]},
        "growth": {"seeds": 5, "most": 150, "radius": 2, "shrink": 0.5, "weight": 0.5, "center": [1, 1, 1],
                   "spread": [1, 2, 3], "velocity": [0, 1, 0], "force": [0, 2, 0], "turbulence": 0.1,
                   "drag": 0.2, "lifetime": 9, "rate": 2, "duration": 30},
        "primitives": [{"shape": "segment", "points": [[0, 0, 0], [1, 1, 1]], "core": 0.5},
                       {"shape": "ellipsoid", "center": [1, 2, 3], "radius": 2, "radii": [1, 0.5, 2],
                        "rotate": [10, 20, 30], "weight": -1,
                        "keys": [{"time": 1, "center": [0, 0, 0]}, {"time": 2, "radius": 3, "weight": 1}]}])"));
    ASSERT_TRUE(validate(draft).ok());
    const ImplicitCloud& c = cloud_of(draft);
    EXPECT_EQ(c.preset, ImplicitPreset::kMackerel);
    EXPECT_TRUE(c.linear_keys);
    EXPECT_TRUE(c.diagonal && c.printed_swirl);
    EXPECT_EQ(c.octaves, 6u);
    EXPECT_EQ(c.resolution, 20u);
    EXPECT_EQ(c.attractors.at(0).strength, -0.5);
    EXPECT_EQ(c.vortices.at(0).angle, 90);
    EXPECT_EQ(c.flow->vectors.size(), 2u);
    EXPECT_EQ(c.growth->most, 150u);
    EXPECT_EQ(c.primitives->at(0).points.at(1), glm::dvec3(1));
    EXPECT_EQ(c.primitives->at(1).keys.at(1).radius, 3);
    // And everything comes back.
    const Result<Scene> scene = read(scene_to_json(draft));
    ASSERT_TRUE(scene.ok()) << scene.error().pointer << scene.error().message;
    EXPECT_EQ(fingerprint(*scene), fingerprint(*validate(draft)));
}

TEST(ImplicitJson, RandomCloudsReadBackAsTheyWere) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        test::Dice dice(seed);
        SceneDraft draft;
        draft.top_level_cubes = false;
        draft.clouds.push_back(test::random_implicit(dice, {}));
        const Result<Scene> scene = validate(draft);
        ASSERT_TRUE(scene.ok()) << seed << scene.error().pointer << scene.error().message;
        const std::string text = scene_to_json(**scene);
        const Result<Scene> again = read(text);
        ASSERT_TRUE(again.ok()) << again.error().pointer << again.error().message << text;
        EXPECT_EQ(fingerprint(*again), fingerprint(*scene)) << text;
        EXPECT_EQ(scene_to_json(**again), text);
    }
}

void refuse(const std::string& members, const std::string& pointer,
            std::initializer_list<const char*> words = {}) {
    expect_error(implicit_with(members), ErrorCode::kInvalidScene, "/clouds/0/implicit" + pointer,
                 words);
}

TEST(ImplicitJson, WrongTypesAndNamesAreRefusedWhereTheyStand) {
    refuse(R"("preset": "nimbus")", "/preset", {"cumulus", "creature"});
    refuse(R"("preset": 3)", "/preset");
    refuse(R"("octaves": 2.5)", "/octaves", {"integer"});
    refuse(R"("jet": [1, 2])", "/jet", {"three numbers"});
    refuse(R"("primitives": [{"shape": "cube"}])", "/primitives/0/shape", {"segment"});
    refuse(R"("primitives": [{}, {"radus": 1}])", "/primitives/1/radus", {"radius"});
    refuse(R"("primitives": [{"keys": [{"radius": 1}]}])", "/primitives/0/keys/0", {"time"});
    refuse(R"("attractors": [{"reach": 1}])", "/attractors/0", {"strength"});
    refuse(R"("flow": {"min": [0, 0, 0]})", "/flow", {"max"});
    refuse(R"("growth": {"seeds": -1})", "/growth/seeds");
    refuse(R"("growth": 3)", "/growth", {"object"});
    refuse(R"("swirl_path": "round")", "/swirl_path", {"steady"});
}

TEST(ImplicitJson, KeysFitTheirPrimitive) {
    refuse(R"("primitives": [{"keys": [{"time": 0, "points": [[0, 0, 0]]}]}])",
           "/primitives/0/keys/0/points", {"cylinder"});
    refuse(R"("primitives": [{"shape": "cylinder", "points": [[0, 0, 0], [1, 0, 0]],
                              "keys": [{"time": 0, "points": [[0, 0, 0]]}]}])",
           "/primitives/0/keys/0/points", {"as many", "2, not 1"});
    refuse(R"("primitives": [{"keys": [{"time": 0, "radii": [1, 1, 1]}]}])",
           "/primitives/0/keys/0/radii", {"ellipsoid"});
    refuse(R"("primitives": [{"shape": "ellipsoid", "keys": [{"time": 0, "core": 1}]}])",
           "/primitives/0/keys/0/core", {"spheres"});
    refuse(R"("primitives": [{"shape": "ellipsoid", "radius": 90000,
                              "keys": [{"time": 0, "radii": [1, 2, 1]}]}])",
           "/primitives/0/keys/0/radii/1", {"1e+05"});
    refuse(R"("keys": [{"time": 1}, {"time": 1}])", "/keys/1/time", {"later"});
    refuse(R"("squash": {"keys": [{"time": 1, "amount": 2}, {"time": 0, "amount": 2}]})",
           "/squash/keys/1/time", {"later"});
    refuse(R"("squash": {"axis": [0, 0, 0]})", "/squash/axis", {"1e-6"});
    refuse(R"("squash": {"amount": 11})", "/squash/amount", {"0.1", "10"});
}

TEST(ImplicitJson, AFormulaIsReadWithTheDocument) {
    EXPECT_TRUE(read(implicit_with(R"("formula": "density * height")")).ok());
    refuse(R"("formula": "density +\n rain")", "/formula",
           {"line 2, column 2", "`rain`", "height"});
    refuse(R"("formula": 3)", "/formula", {"a formula"});
    refuse("\"formula\": \"" + std::string(4097, ' ') + "1\"", "/formula", {"4096 bytes"});
    // Names stay short.
    const std::string longest(4095, ' ');
    EXPECT_TRUE(read(implicit_with("\"formula\": \"" + longest + "1\"")).ok());
}

TEST(ImplicitJson, ATableHasEachRowOnce) {
    refuse(R"("particles": [{"time": 0, "id": 1, "center": [0, 0, 0], "radius": 1},
                            {"time": 0, "id": 2, "center": [0, 0, 0], "radius": 1},
                            {"time": 0, "id": 1, "center": [9, 0, 0], "radius": 1}])",
           "/particles/2", {"particle 1", "row 0"});
    refuse(R"("particles": [{"time": 0, "id": 1, "radius": 1}])", "/particles/0", {"center"});
    std::string many;
    for (int i = 0; i <= 1000; ++i)
        many += (i > 0 ? "," : "") +
                (R"({"time": 0, "radius": 1, "center": [0, 0, 0], "id": )" + std::to_string(i)) +
                "}";
    refuse("\"particles\": [" + many + "]", "/particles", {"1000"});
}

TEST(ImplicitJson, ATableMayComeAsText) {
    constexpr const char* kPlace = "/clouds/0/implicit/particles";
    SceneDraft draft = draft_of(implicit_with(""));
    ASSERT_FALSE(set_in_scene(kPlace,
                              "# from elsewhere\nid, Time, x,y,z, speed, radius\r\n"
                              "7, 0.5, 1,2,3, 9, 4\n\n7, 2, 3,2,1, 9, 5\n",
                              draft));
    const auto& rows = cloud_of(draft).particles;
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1].id, 7u);
    EXPECT_EQ(rows[1].time, 2);
    EXPECT_EQ(rows[0].center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(rows[0].radius, 4);
    EXPECT_EQ(rows[0].weight, 1);
    const auto wrong = [&](const char* table) {
        const Status status = set_in_scene(kPlace, table, draft);
        return status ? status->pointer + ": " + status->message : "";
    };
    const auto says = [&](const char* table, const char* words) {
        EXPECT_NE(wrong(table).find(words), std::string::npos) << wrong(table);
    };
    says("time id x y z\n0 1 0 0 0\n", "line 1 of the table: must name");
    says("time id x y z radius\n0 1 0 0 0 1\n0 1.5 0 0 0 1\n", "line 3 of the table: `id`");
    says("time;id;x;y;z;radius\n0;1;0;;0;1\n", "line 2 of the table: `y` must be a number");
    says("time;id;x;y;z;radius\n0;1;0;0;0\n", "there is no `radius`");
    says("time,time,id,x,y,z,radius\n0,0,1,0,0,0,1\n", "`time` stands twice");
    EXPECT_EQ(wrong("time,id,x,y,z,radius\n0,1,0,0,0,-1\n"), "");
    const auto scene = validate(draft);
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().pointer, std::string(kPlace) + "/0/radius");
}

TEST(ImplicitJson, EveryRangeIsQuoted) {
    refuse(R"("amount": -1)", "/amount", {"0", "100"});
    refuse(R"("amount": 101)", "/amount");
    refuse(R"("exponent": 0)", "/exponent", {"0.1", "8"});
    refuse(R"("blend": 1.01)", "/blend");
    refuse(R"("displacement": 4.5)", "/displacement", {"4"});
    refuse(R"("noise_size": 0)", "/noise_size", {"0.01"});
    refuse(R"("octaves": 0)", "/octaves", {"1", "10"});
    refuse(R"("octaves": 11)", "/octaves");
    refuse(R"("gain": 2)", "/gain");
    refuse(R"("stretch": 0.5)", "/stretch");
    refuse(R"("jet": [0, 21, 0])", "/jet/1", {"20"});
    refuse(R"("jet_turbulence": -1)", "/jet_turbulence");
    refuse(R"("warp_from": 2e6)", "/warp_from");
    refuse(R"("ripple": [0.001, 0, 0])", "/ripple/0", {"0.01"});
    refuse(R"("ripple_depth": 2)", "/ripple_depth");
    refuse(R"("ripple_turbulence": 101)", "/ripple_turbulence");
    refuse(R"("swirl": 1001)", "/swirl");
    refuse(R"("resolution": 15)", "/resolution", {"16", "400"});
    refuse(R"("resolution": 401)", "/resolution");
    refuse(R"("threshold": 0.6)", "/threshold");
    refuse(R"("base": 1e7)", "/base");
    refuse(R"("attractors": [{"strength": -1, "reach": 1}])", "/attractors/0/strength", {"-0.9"});
    refuse(R"("attractors": [{"strength": 1, "reach": 0}])", "/attractors/0/reach");
    refuse(R"("vortices": [{"angle": 9, "reach": 1, "axis": [0, 0, 0]}])", "/vortices/0/axis");
    refuse(R"("vortices": [{"angle": 4000, "reach": 1}])", "/vortices/0/angle", {"3600"});
    const std::string flow = R"("flow": {"min": [0, 0, 0], "max": [1, 1, 1], )";
    refuse(flow + R"("size": [2, 1, 1], "vectors": [[0, 0, 0]]})", "/flow/vectors", {"2", "1"});
    refuse(flow + R"("size": [1.5, 1, 1], "vectors": [[0, 0, 0]]})", "/flow/size/0", {"whole"});
    refuse(flow + R"("size": [1, 1, 1], "vectors": [[0, 2e5, 0]]})", "/flow/vectors/0/1");
    refuse(
        R"("flow": {"min": [0, 0, 0], "max": [1, 0, 1], "size": [1, 1, 1], "vectors": [[0, 0, 0]]})",
        "/flow/max/1");
    refuse(R"("growth": {"seeds": 20, "most": 10})", "/growth/most", {"20", "500"});
    refuse(R"("growth": {"seeds": 501, "most": 501})", "/growth/seeds");
    refuse(R"("growth": {"lifetime": 0})", "/growth/lifetime");
    refuse(R"("growth": {"spread": [0, -1, 0]})", "/growth/spread/1");
}

TEST(ImplicitJson, PrimitivesAreHeldToTheirShapes) {
    refuse(R"("primitives": [{"radius": 0}])", "/primitives/0/radius", {"0.01"});
    refuse(R"("primitives": [{"center": [0, 2e6, 0]}])", "/primitives/0/center/1");
    refuse(R"("primitives": [{"weight": 101}])", "/primitives/0/weight");
    refuse(R"("primitives": [{"radii": [1, 2, 1]}])", "/primitives/0/radii", {"ellipsoid"});
    refuse(R"("primitives": [{"points": [[0, 0, 0]]}])", "/primitives/0/points", {"segment"});
    refuse(R"("primitives": [{"shape": "segment", "points": [[0, 0, 0]]}])", "/primitives/0/points",
           {"two"});
    refuse(R"("primitives": [{"shape": "cylinder", "points": [[0,0,0],[1,0,0],[2,0,0]]}])",
           "/primitives/0/points", {"two ends", "3"});
    refuse(R"("primitives": [{"shape": "ellipsoid", "core": 1}])", "/primitives/0/core");
    refuse(R"("primitives": [{"shape": "ellipsoid", "radius": 9e4, "radii": [1, 2, 1]}])",
           "/primitives/0/radii/1");
    refuse(R"("primitives": [{"keys": [{"time": 1}, {"time": 1}]}])", "/primitives/0/keys/1/time",
           {"later"});
    refuse(R"("primitives": [{"keys": [{"time": 1, "radius": 0}]}])",
           "/primitives/0/keys/0/radius");
    std::string points = "[0, 0, 0]";
    for (int i = 0; i < 600; ++i) points += ", [1, " + std::to_string(i) + ", 0]";
    const std::string skeleton = R"({"shape": "segment", "points": [)" + points + "]}";
    refuse(R"("primitives": [)" + skeleton + ", " + skeleton + "]", "/primitives/1", {"1000"});
}

TEST(ImplicitJson, WhatIsNotANumberIsInNoRange) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](const ImplicitCloud& cloud, const char* pointer) {
        const Status wrong = check_model(cloud, "/x");
        ASSERT_TRUE(wrong) << pointer;
        EXPECT_EQ(wrong->pointer, pointer);
        EXPECT_EQ(wrong->code, ErrorCode::kInvalidScene);
    };
    ImplicitCloud cloud;
    cloud.amount = nan;
    refused(cloud, "/x/amount");
    cloud = {};
    cloud.primitives.emplace(2);
    cloud.primitives->at(1).center.y = nan;
    refused(cloud, "/x/primitives/1/center/1");
    cloud = {};
    cloud.growth.emplace().rate = nan;
    refused(cloud, "/x/growth/rate");
    cloud = {};
    cloud.vortices = {{glm::dvec3(0), glm::dvec3(0, 1, 0), nan, 1}};
    refused(cloud, "/x/vortices/0/angle");
    cloud = {};
    cloud.ripple = glm::dvec3(0, nan, 0);
    refused(cloud, "/x/ripple/1");
    cloud = {};
    cloud.swirl = std::numeric_limits<double>::infinity();
    refused(cloud, "/x/swirl");
}

}  // namespace
}  // namespace awan
