// The document of a cloud of ellipsoids: what is read, written back, and refused where.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>

#include "core/scene/fingerprint.h"
#include "core/scene/limits.h"
#include "core/scene/rules.h"
#include "tests/ellipsoids_scenes.h"
#include "tests/random_models_ellipsoids.h"
#include "tests/scene_checks.h"

namespace awan {
namespace {

using namespace scene_checks;
using test::Dice;

std::string document(const std::string& members) {
    return cloud_with(R"("model": "ellipsoids", "ellipsoids": {)" + members + "}");
}
const std::string kAt = "/clouds/0/ellipsoids";

TEST(EllipsoidsJson, ReadsEveryField) {
    const SceneDraft draft = draft_of(document(R"(
        "texture": {"form": "printed", "terms": 4, "frequency_x": 2, "frequency_z": 3, "offset": 0.5},
        "shading": {"specular": 0.2, "texture": 0.3, "ambient": 0.4, "shininess": 5},
        "threshold": 0.1, "threshold_edge": 0.9, "range": 0.05,
        "plane": {"altitude": 5, "extent": 50, "thickness": 2, "threshold": 0.4, "range": 0.6,
                  "density": 3, "resolution": 64, "texture": {"terms": 5, "offset": 2}},
        "formations": [{"kind": "vertical", "count": 7, "center": [1, 2, 3], "radii": [4, 5, 6],
                        "variation": 0.1, "link": 0.2, "heading": 30, "spread": 40}, {}],
        "ellipsoids": [{"center": [1, 2, 3], "radii": [4, 5, 6], "rotate_y": 7, "threshold": 0.3,
                        "threshold_edge": 0.7, "range": 0.2},
                       {"center": [0, 0, 0], "radii": [1, 1, 1]}],
        "drift": [0.1, 0.2, 0.3], "density": 4, "resolution": 32)"));
    ASSERT_TRUE(draft.clouds[0].ellipsoids);
    const EllipsoidsCloud& cloud = *draft.clouds[0].ellipsoids;
    EXPECT_EQ(cloud.texture.form, TextureForm::kPrinted);
    EXPECT_EQ(cloud.texture.terms, 4u);
    EXPECT_EQ(cloud.texture.frequency_x, 2);
    EXPECT_EQ(cloud.texture.frequency_z, 3);
    EXPECT_EQ(cloud.texture.offset, 0.5);
    EXPECT_EQ(cloud.shading.specular, 0.2);
    EXPECT_EQ(cloud.shading.texture, 0.3);
    EXPECT_EQ(cloud.shading.ambient, 0.4);
    EXPECT_EQ(cloud.shading.shininess, 5);
    EXPECT_EQ(cloud.translucence.threshold, 0.1);
    EXPECT_EQ(cloud.translucence.threshold_edge, 0.9);
    EXPECT_EQ(cloud.translucence.range, 0.05);
    ASSERT_TRUE(cloud.plane);
    EXPECT_EQ(cloud.plane->altitude, 5);
    EXPECT_EQ(cloud.plane->extent, 50);
    EXPECT_EQ(cloud.plane->thickness, 2);
    EXPECT_EQ(cloud.plane->threshold, 0.4);
    EXPECT_EQ(cloud.plane->range, 0.6);
    EXPECT_EQ(cloud.plane->density, 3);
    EXPECT_EQ(cloud.plane->resolution, 64u);
    EXPECT_EQ(cloud.plane->texture.terms, 5u);
    EXPECT_EQ(cloud.plane->texture.offset, 2);
    EXPECT_EQ(cloud.plane->texture.frequency_x, SkyPlane{}.texture.frequency_x);
    ASSERT_EQ(cloud.formations.size(), 2u);
    EXPECT_EQ(cloud.formations[0].kind, FormationKind::kVertical);
    EXPECT_EQ(cloud.formations[0].count, 7u);
    EXPECT_EQ(cloud.formations[0].center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cloud.formations[0].radii, glm::dvec3(4, 5, 6));
    EXPECT_EQ(cloud.formations[0].variation, 0.1);
    EXPECT_EQ(cloud.formations[0].link, 0.2);
    EXPECT_EQ(cloud.formations[0].heading, 30);
    EXPECT_EQ(cloud.formations[0].spread, 40);
    EXPECT_EQ(cloud.formations[1].kind, FormationKind::kCombined);
    ASSERT_EQ(cloud.ellipsoids.size(), 2u);
    EXPECT_EQ(cloud.ellipsoids[0].center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cloud.ellipsoids[0].radii, glm::dvec3(4, 5, 6));
    EXPECT_EQ(cloud.ellipsoids[0].rotate_y, 7);
    EXPECT_EQ(cloud.ellipsoids[0].threshold, 0.3);
    EXPECT_EQ(cloud.ellipsoids[0].threshold_edge, 0.7);
    EXPECT_EQ(cloud.ellipsoids[0].range, 0.2);
    EXPECT_FALSE(cloud.ellipsoids[1].threshold);
    EXPECT_EQ(cloud.drift, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(cloud.density, 4);
    EXPECT_EQ(cloud.resolution, 32u);
    EXPECT_TRUE(validate(draft).ok());
    EXPECT_TRUE(read(document("")).ok()) << "an empty object is a cloud";
    EXPECT_TRUE(read(document(R"("plane": "none")")).ok());
}

TEST(EllipsoidsJson, RandomCloudsReadBackTheSame) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Dice dice(seed);
        SceneDraft draft;
        draft.top_level_cubes = false;
        draft.clouds.push_back(
            test::random_ellipsoids(dice, {{1, 2, 3}, dice.log_between(0.1, 100)}));
        const std::string text = scene_to_json(draft);
        const SceneDraft again = draft_of(text);
        ASSERT_EQ(scene_to_json(again), text);
        const Scene before = test::valid(draft), after = test::valid(again);
        ASSERT_EQ(fingerprint(before), fingerprint(after)) << text;
    }
}

TEST(EllipsoidsJson, EveryFieldTellsItsFingerprint) {
    const std::string standard = fingerprint(*read(document("")));
    for (const char* const members :
         {R"("texture": {"form": "printed"})",
          R"("texture": {"terms": 5})",
          R"("texture": {"frequency_x": 2})",
          R"("texture": {"frequency_z": 2})",
          R"("texture": {"offset": 2})",
          R"("shading": {"specular": 0.9})",
          R"("shading": {"texture": 0.9})",
          R"("shading": {"ambient": 0.9})",
          R"("shading": {"shininess": 9})",
          R"("threshold": 0.9)",
          R"("threshold_edge": 0.9)",
          R"("range": 0.9)",
          R"("plane": {})",
          R"("formations": [{}])",
          R"("ellipsoids": [{"center": [0, 0, 0], "radii": [1, 1, 1]}])",
          R"("drift": [1, 0, 0])",
          R"("density": 1)",
          R"("resolution": 63)",
          R"("join": 0.5)",
          R"("quadrics": [{}])",
          R"("texture": {"sines": [{}]})",
          R"("translucence_min": 0.1)",
          R"("translucence_max": 0.9)",
          R"("formations": [{"tilt": 5}])",
          R"("plane": {"horizon": 50})",
          R"("plane": {"patterns": [{}]})",
          R"("ellipsoids": [{"center": [0, 0, 0], "radii": [1, 1, 2], "rotate_x": 9}])"})
        EXPECT_NE(fingerprint(*read(document(members))), standard) << members;
    // -0 is 0.
    EXPECT_EQ(fingerprint(*read(document(R"("drift": [-0.0, 0, 0])"))), standard);
}

TEST(EllipsoidsJson, RefusesWhatIsOutOfRangeByItsPlace) {
    struct Case {
        const char* members;
        const char* pointer;
        std::initializer_list<const char*> words;
    };
    const Case cases[] = {
        {R"("texture": {"terms": 0})", "/texture/terms", {"1", "8"}},
        {R"("texture": {"terms": 9})", "/texture/terms", {"8", "9"}},
        {R"("texture": {"frequency_x": 0})", "/texture/frequency_x", {"1e-06"}},
        {R"("texture": {"frequency_z": 1e7})", "/texture/frequency_z", {"1e+06"}},
        {R"("texture": {"offset": -1})", "/texture/offset", {"100"}},
        {R"("texture": {"form": "neat"})", "/texture/form", {"clean"}},
        {R"("shading": {"specular": 2})", "/shading/specular", {"0 to 1"}},
        {R"("shading": {"texture": -1})", "/shading/texture", {"0 to 1"}},
        {R"("shading": {"ambient": 1.5})", "/shading/ambient", {"0 to 1"}},
        {R"("shading": {"shininess": 0})", "/shading/shininess", {"1000"}},
        {R"("threshold": 11)", "/threshold", {"10"}},
        {R"("threshold_edge": -11)", "/threshold_edge", {"-10"}},
        {R"("range": 0)", "/range", {"0.001"}},
        {R"("join": 2)", "/join", {"0 to 1"}},
        {R"("translucence_min": 0.6, "translucence_max": 0.5)", "/translucence_min", {"0.5"}},
        {R"("plane": {"translucence_min": 1, "translucence_max": 0})",
         "/plane/translucence_min",
         {"translucence_max"}},
        {R"("plane": {"horizon": 0})", "/plane/horizon", {"0.01"}},
        {R"("plane": {"patterns": [{"edge": 2}]})", "/plane/patterns/0/edge", {"0 to 1"}},
        {R"("texture": {"sines": [{"amplitude": 0}]})", "/texture/sines/0/amplitude", {"100"}},
        {R"("texture": {"sines": [{},{},{},{},{},{},{},{},{}]})", "/texture/sines/8", {"8"}},
        {R"("formations": [{"tilt": 91}])", "/formations/0/tilt", {"90"}},
        {R"("quadrics": [{}, {"q1": -1}])", "/quadrics/1/q1", {"1e-12"}},
        {R"("quadrics": [{"q0": 1}])", "/quadrics/0", {"no ellipsoid"}},
        {R"("quadrics": [{"q4": 3}])", "/quadrics/0", {"positive definite"}},
        {R"("quadrics": [{"q0": -1e7}])", "/quadrics/0", {"semi-axes", "1000"}},
        {R"("plane": {"altitude": 1e7})", "/plane/altitude", {"1e+06"}},
        {R"("plane": {"extent": 0})", "/plane/extent", {"0.01"}},
        {R"("plane": {"extent": 1, "thickness": 2})", "/plane/thickness", {"0 to 1"}},
        {R"("plane": {"resolution": 7})", "/plane/resolution", {"8", "1000"}},
        {R"("plane": {"resolution": 1000, "thickness": 100})", "/plane/resolution", {"4194304"}},
        {R"("plane": {"texture": {"terms": 0}})", "/plane/texture/terms", {}},
        {R"("plane": {"density": -1})", "/plane/density", {}},
        {R"("plane": "some")", "/plane", {"none"}},
        {R"("formations": [{}, {"kind": "diagonal"}])", "/formations/1/kind", {"vertical"}},
        {R"("formations": [{"count": 0}])", "/formations/0/count", {"1000"}},
        {R"("formations": [{"count": 600}, {"count": 401}])", "/formations/1/count", {"1000"}},
        {R"("formations": [{"center": [0, 2e6, 0]}])", "/formations/0/center/1", {"1e+06"}},
        {R"("formations": [{"radii": [1, 1, 0]}])", "/formations/0/radii/2", {"0.001"}},
        {R"("formations": [{"variation": 1}])", "/formations/0/variation", {"0.9"}},
        {R"("formations": [{"link": 1}])", "/formations/0/link", {"0.95"}},
        {R"("formations": [{"heading": 1e7}])", "/formations/0/heading", {}},
        {R"("formations": [{"spread": 181}])", "/formations/0/spread", {"180"}},
        {R"("ellipsoids": [{"center": [0, 0, 0]}])", "/ellipsoids/0", {"radii"}},
        {R"("ellipsoids": [{"radii": [1, 1, 1]}])", "/ellipsoids/0", {"center"}},
        {R"("ellipsoids": [{"center": [0, 0], "radii": [1, 1, 1]}])", "/ellipsoids/0/center", {}},
        {R"("ellipsoids": [{"center": [0, 0, 0], "radii": [1, 2e3, 1]}])",
         "/ellipsoids/0/radii/1",
         {"1000"}},
        {R"("ellipsoids": [{"center": [0, 0, 0], "radii": [1, 1, 1], "rotate_y": 1e7}])",
         "/ellipsoids/0/rotate_y",
         {}},
        {R"("ellipsoids": [{"center": [0, 0, 0], "radii": [1, 1, 1], "range": 0}])",
         "/ellipsoids/0/range",
         {}},
        {R"("drift": [0, 1e7, 0])", "/drift/1", {"1e+06"}},
        {R"("density": -1)", "/density", {}},
        {R"("resolution": 161)", "/resolution", {"8", "160"}},
        {R"("resolution": 7.5)", "/resolution", {"integer"}},
        {R"("cells": 7)", "/cells", {"resolution"}},
    };
    for (const Case& one : cases)
        expect_invalid(document(one.members), kAt + one.pointer, one.words);
}

TEST(EllipsoidsJson, NotANumberIsRefusedEverywhere) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](const EllipsoidsCloud& cloud) {
        const Status wrong = check_model(cloud, "/at");
        return wrong && wrong->code == ErrorCode::kInvalidScene &&
               wrong->message.find("not a number") != std::string::npos;
    };
    const auto with = [&](auto set) {
        EllipsoidsCloud cloud;
        cloud.plane.emplace();
        cloud.formations.emplace_back();
        cloud.ellipsoids.emplace_back();
        EXPECT_FALSE(check_model(cloud, ""));
        set(cloud);
        return cloud;
    };
    using C = EllipsoidsCloud&;
    EXPECT_TRUE(refused(with([&](C c) { c.texture.frequency_x = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.texture.offset = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.shading.ambient = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.translucence.threshold = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.translucence.range = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.plane->altitude = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.plane->extent = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.plane->thickness = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.plane->texture.frequency_z = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.formations[0].center.y = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.formations[0].link = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.ellipsoids[0].radii.z = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.ellipsoids[0].threshold_edge = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.drift.x = nan; })));
    EXPECT_TRUE(refused(with([&](C c) { c.density = nan; })));
}

TEST(EllipsoidsJson, TooManyByOne) {
    std::string text;
    for (std::uint64_t i = 0; i <= limits::kMaxEllipsoids; ++i)
        text += std::string(i == 0 ? "" : ",") + R"({"center": [0, 0, 0], "radii": [1, 1, 1]})";
    const Result<Scene> scene = read(document(R"("ellipsoids": [)" + text + "]"));
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().pointer.rfind(kAt + "/ellipsoids", 0), 0u) << scene.error().pointer;
}

TEST(EllipsoidsJson, ItsPresetsAreValid) {
    for (const char* const name :
         {"gardner-cumulus", "gardner-sky", "ellipsoids-volume", "ellipsoids-stratus"}) {
        std::ifstream file(std::string(AWAN_SOURCE_DIR) + "/web/presets/" + name + ".json");
        ASSERT_TRUE(file) << name;
        const std::string text((std::istreambuf_iterator<char>(file)), {});
        const Result<Scene> scene = read(text);
        EXPECT_TRUE(scene.ok()) << name << " " << scene.error().pointer << ": "
                                << scene.error().message;
    }
}

}  // namespace
}  // namespace awan
