// The scene document as text: what is read, what is refused and where (server/document/json.h).
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/limits.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "tests/scene_checks.h"

namespace awan {
namespace {

using namespace scene_checks;

// --- what is read

TEST(SceneJson, TheSmallestDocumentHasEveryDefault) {
    const SceneDraft draft = draft_of(scene_with(""));
    const SceneDraft standard;
    EXPECT_TRUE(draft.top_level_cubes);
    ASSERT_EQ(draft.clouds.size(), 1u);
    ASSERT_EQ(draft.clouds[0].cubes.size(), 1u);
    const Cube& cube = draft.clouds[0].cubes[0];
    EXPECT_EQ(cube.particles, 200u);
    EXPECT_EQ(cube.size, glm::dvec3(7.4, 1.07, 2.9));
    EXPECT_EQ(cube.center, glm::dvec3(-3.4, -3.3, -0.6));
    EXPECT_EQ(cube.radius, 2.1);
    EXPECT_EQ(cube.density, 1);
    EXPECT_EQ(draft.seed, 1u);
    EXPECT_EQ(draft.fill, Fill::kCumulus);
    EXPECT_TRUE(draft.sky.physical && draft.sun.auto_color);
    EXPECT_TRUE(draft.detail && draft.detail->automatic);
    EXPECT_FALSE(draft.density);
    EXPECT_TRUE(draft.camera.automatic);
    EXPECT_EQ(draft.image.width, standard.image.width);
    EXPECT_FALSE(draft.image.exposure);
    EXPECT_TRUE(validate(draft).ok());
}

TEST(SceneJson, EveryFieldArrivesWhereItBelongs) {
    const SceneDraft draft = draft_of(R"({
        "clouds": [
            {"model": "cubes", "cubes": [{"particles": 3, "size": [1, 2, 3], "center": [4, 5, 6],
                "radius": 7, "density": 0.5}], "translate": [1, 2, 3], "scale": 2, "rotate_y": 90,
                "fill": "gardner", "density": 0.25, "seed": 9},
            {"positions": [[1, 2, 3], [4, 5, 6]], "radii": [1, 2], "densities": [0.5, 1],
                "colors": [[1, 0.5, 0], [0, 0, 1]], "model": "particles"}],
        "fill": "printed", "seed": 18446744073709551615, "density": 0.75,
        "medium": {"albedo": 0.9, "g": 0.5, "phase": "cornette-shanks"},
        "sun": {"elevation": 10, "azimuth": 20, "color": [0.1, 0.2, 0.3], "intensity": 4},
        "sky": {"zenith": [0, 0.1, 0.2], "horizon": [0.3, 0.4, 0.5], "intensity": 6},
        "ground": "none",
        "camera": {"eye": [1, 2, 3], "target": [4, 5, 6], "up": [0, 0, 1], "fov": 50},
        "image": {"width": 320, "height": 200, "format": "exr", "background": "transparent",
            "exposure": -1.5, "precision": "float"},
        "effects": {"interior": true, "sky_light": false, "detail": "auto"},
        "accuracy": {"rung": "harris"}})");
    EXPECT_FALSE(draft.top_level_cubes);
    ASSERT_EQ(draft.clouds.size(), 2u);
    const Cloud& cubes = draft.clouds[0];
    EXPECT_EQ(cubes.translate, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cubes.scale, 2);
    EXPECT_EQ(cubes.rotate_y, 90);
    EXPECT_EQ(cubes.fill, Fill::kGardner);
    EXPECT_EQ(cubes.density, 0.25);
    EXPECT_EQ(cubes.seed, 9u);
    EXPECT_EQ(cubes.cubes[0].density, 0.5);
    const ReadyParticles& ready = draft.clouds[1].ready;
    EXPECT_EQ(draft.clouds[1].model, CloudModel::kParticles);
    EXPECT_EQ(ready.positions, (std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(ready.radii, (std::vector<float>{1, 2}));
    EXPECT_EQ(ready.densities, (std::vector<float>{0.5f, 1}));
    EXPECT_EQ(ready.colors, (std::vector<glm::vec3>{{1, 0.5f, 0}, {0, 0, 1}}));
    EXPECT_EQ(draft.fill, Fill::kPrinted);
    EXPECT_EQ(draft.seed, UINT64_MAX);
    EXPECT_EQ(draft.density, 0.75);
    EXPECT_EQ(draft.medium.albedo, 0.9);
    EXPECT_EQ(draft.medium.g, 0.5);
    EXPECT_EQ(draft.medium.phase, PhaseFunction::kCornetteShanks);
    EXPECT_EQ(draft.sun.elevation, 10);
    EXPECT_EQ(draft.sun.azimuth, 20);
    EXPECT_EQ(draft.sun.color, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(draft.sun.intensity, 4);
    EXPECT_EQ(draft.sky.zenith, glm::dvec3(0, 0.1, 0.2));
    EXPECT_EQ(draft.sky.horizon, glm::dvec3(0.3, 0.4, 0.5));
    EXPECT_EQ(draft.sky.intensity, 6);
    EXPECT_FALSE(draft.ground);
    EXPECT_FALSE(draft.camera.automatic);
    EXPECT_EQ(draft.camera.eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(draft.camera.target, glm::dvec3(4, 5, 6));
    EXPECT_EQ(draft.camera.up, glm::dvec3(0, 0, 1));
    EXPECT_EQ(draft.camera.fov, 50);
    EXPECT_EQ(draft.image.width, 320);
    EXPECT_EQ(draft.image.height, 200);
    EXPECT_EQ(draft.image.format, ImageFormat::kExr);
    EXPECT_EQ(draft.image.background, Background::kTransparent);
    EXPECT_EQ(draft.image.exposure, -1.5);
    EXPECT_EQ(draft.image.precision, Precision::kFloat);
    EXPECT_EQ(draft.effects[static_cast<int>(Effect::kInterior)], Switch::kOn);
    EXPECT_EQ(draft.effects[static_cast<int>(Effect::kSkyLight)], Switch::kOff);
    EXPECT_EQ(draft.effects[static_cast<int>(Effect::kDetail)], Switch::kAuto);
    EXPECT_EQ(draft.accuracy.rung, "harris");
    EXPECT_TRUE(validate(draft).ok()) << validate(draft).error().message;
}

TEST(SceneJson, ReadsAPhysicalSkyHazeGroundAndDetail) {
    const SceneDraft word = draft_of(scene_with(R"("sky": "physical", "sun": {"color": "auto"})"));
    EXPECT_TRUE(word.sky.physical);
    EXPECT_FALSE(word.sky.none);
    EXPECT_EQ(word.sky.intensity, kPhysicalSkyIntensity);
    EXPECT_EQ(word.sky.turbidity, 2);
    EXPECT_TRUE(word.sun.auto_color);
    const SceneDraft full = draft_of(scene_with(
        R"("sky": {"model": "physical", "turbidity": 5, "intensity": 0.5},
           "ground": {"height": -2, "albedo": [0.1, 0.2, 0.3]},
           "haze": {"extinction": 0.01, "height": -1, "scale_height": 9, "albedo": [0.9, 0.8, 0.7], "g": 0.4},
           "detail": {"amount": 0.25, "size": 0.75})"));
    EXPECT_TRUE(full.sky.physical);
    EXPECT_EQ(full.sky.turbidity, 5);
    EXPECT_EQ(full.sky.intensity, 0.5);
    EXPECT_TRUE(full.sun.auto_color);
    EXPECT_FALSE(full.detail->automatic);
    ASSERT_TRUE(full.ground && full.haze && full.detail);
    EXPECT_EQ(full.ground->height, -2);
    EXPECT_EQ(full.ground->albedo, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(full.haze->extinction, 0.01);
    EXPECT_EQ(full.haze->height, -1);
    EXPECT_EQ(full.haze->scale_height, 9);
    EXPECT_EQ(full.haze->albedo, glm::dvec3(0.9, 0.8, 0.7));
    EXPECT_EQ(full.haze->g, 0.4);
    EXPECT_EQ(full.detail->amount, 0.25);
    EXPECT_EQ(full.detail->size, 0.75);
    EXPECT_TRUE(validate(full).ok());
    // Of a physical sky without an intensity, whatever the order, the default is its own.
    for (const char* const sky :
         {R"({"model": "physical", "turbidity": 4})", R"({"turbidity": 4, "model": "physical"})"})
        EXPECT_EQ(draft_of(scene_with(std::string("\"sky\": ") + sky)).sky.intensity,
                  kPhysicalSkyIntensity);
    EXPECT_EQ(draft_of(scene_with(R"("sky": {"model": "gradient"})")).sky.intensity,
              kGradientSkyIntensity);
    // Colours of a gradient make it one, whatever the order.
    for (const char* const colors :
         {R"("sky": {"zenith": [0, 0, 1]})", R"("sky": {"intensity": 2, "horizon": [1, 1, 1]})"})
        EXPECT_FALSE(draft_of(scene_with(colors)).sky.physical) << colors;
    EXPECT_EQ(draft_of(scene_with(R"("sky": {"zenith": [0, 0, 1]})")).sky.intensity,
              kGradientSkyIntensity);
    EXPECT_TRUE(draft_of(scene_with(R"("sky": {"turbidity": 5})")).sky.physical);
    EXPECT_TRUE(draft_of(scene_with(R"("detail": "auto")")).detail->automatic);
    EXPECT_FALSE(draft_of(scene_with(R"("detail": "none")")).detail);
    EXPECT_FALSE(draft_of(scene_with(R"("density": "auto")")).density);
    EXPECT_FALSE(draft_of(scene_with(R"("sun": {"color": [1, 1, 1]})")).sun.auto_color);
    // A number stands for a grey albedo.
    EXPECT_EQ(draft_of(scene_with(R"("haze": {"extinction": 1, "scale_height": 1, "albedo": 0.5})"))
                  .haze->albedo,
              glm::dvec3(0.5));
    expect_invalid(scene_with(R"("haze": {"scale_height": 1})"), "/haze", {"extinction"});
    expect_invalid(scene_with(R"("sky": {"model": "cloudy"})"), "/sky/model", {"\"physical\""});
    expect_invalid(scene_with(R"("haze": {"density": 1})"), "/haze/density", {"extinction"});
}

TEST(SceneJson, WordsThatMeanTheDefaultAreAllowed) {
    for (const char* const member :
         {R"("sky": "none")", R"("ground": "none")", R"("camera": "auto")", R"("effects": "auto")",
          R"("image": {"exposure": "auto"})", R"("sky": {})", R"("sun": {})", R"("image": {})",
          R"("effects": {})", R"("medium": {})", R"("accuracy": {"rung": "harris"})"})
        EXPECT_TRUE(read(scene_with(member)).ok()) << member;
    EXPECT_TRUE(draft_of(scene_with(R"("sky": "none")")).sky.none);
}

TEST(SceneJson, EmptyScenesAreScenes) {
    EXPECT_TRUE(read(R"({"cubes": []})").ok());
    EXPECT_TRUE(read(R"({"clouds": []})").ok());
    EXPECT_TRUE(read(cloud_with(R"("cubes": [])")).ok());
    EXPECT_TRUE(read(cloud_with(R"("model": "particles", "positions": [], "radii": [])")).ok());
    EXPECT_TRUE(
        read(
            R"({"cubes": [{"particles": 0, "size": [1, 1, 1], "center": [0, 0, 0], "radius": 1}]})")
            .ok());
}

TEST(SceneJson, AnIntegerWrittenAtLengthIsAnInteger) {
    EXPECT_EQ(draft_of(scene_with(R"("seed": 200.0)")).seed, 200u);
    EXPECT_EQ(draft_of(scene_with(R"("seed": 1e3)")).seed, 1000u);
    EXPECT_EQ(draft_of(scene_with(R"("image": {"width": 640.0})")).image.width, 640);
    EXPECT_EQ(draft_of(scene_with(R"("seed": -0)")).seed, 0u);
}

TEST(SceneJson, AByteOrderMarkAndEscapedNamesAreRead) {
    EXPECT_TRUE(read("\xEF\xBB\xBF" + scene_with("")).ok());
    EXPECT_TRUE(read(R"({"\u0063ubes": []})").ok());
}

TEST(SceneJson, NegativeZeroIsZero) {
    const SceneDraft draft =
        draft_of(scene_with(R"("sun": {"azimuth": -0.0, "color": [-0.0, 1, 1]})"));
    EXPECT_FALSE(std::signbit(draft.sun.azimuth));
    EXPECT_FALSE(std::signbit(draft.sun.color.x));
}

// --- not JSON

TEST(SceneJson, RejectsAnEmptyBody) {
    expect_malformed("", {"line 1, column 1"});
    expect_malformed(" \n", {"line 2, column 1"});
}

TEST(SceneJson, RejectsTrailingGarbage) {
    expect_malformed(scene_with("") + "x", {"line 1, column "});
    expect_malformed(scene_with("") + "{}", {"line 1, column "});
    expect_malformed(scene_with("") + "]", {"line 1, column "});
}

TEST(SceneJson, RejectsInvalidUtf8) {
    expect_malformed(scene_with("\"\xff\": 1"), {"UTF-8"});
    expect_malformed(scene_with("\"fill\": \"\xc0\x80\""), {"UTF-8"});
    expect_malformed(scene_with("\"fill\": \"\xed\xa0\x80\""), {"UTF-8"});
}

TEST(SceneJson, RejectsWhatOtherParsersLetPass) {
    for (const char* const bad :
         {R"("seed": 01)", R"("seed": +1)", R"("seed": NaN)", R"("seed": Infinity)",
          R"("seed": 1,)", R"("seed": .5)", R"("seed": 0x10)", R"('seed': 1)",
          R"("seed": 1 /* one */)", "\"fill\": \"a\nb\"", R"("fill": "\ud800")"})
        expect_malformed(scene_with(bad));
}

TEST(SceneJson, SaysWhereTheTextBreaks) {
    expect_malformed(R"({"cubes": [},)", {"line 1, column 12"});
    expect_malformed("nonsense", {"line 1, column 2", "invalid literal"});
}

// --- JSON, but not a scene

TEST(SceneJson, RejectsADocumentThatIsNoObject) {
    for (const char* const text : {"[]", "1", "-1", "1.5", "true", "null", "\"cubes\""})
        expect_invalid(text, "", {"object"});
}

TEST(SceneJson, RejectsASceneWithNeitherCubesNorCloudsAndOneWithBoth) {
    expect_invalid("{}", "", {"cubes", "clouds"});
    expect_invalid(R"({"seed": 1})", "", {"cubes", "clouds"});
    expect_invalid(R"({"cubes": [], "clouds": []})", "", {"not both"});
    expect_invalid(R"({"clouds": [], "cubes": []})", "", {"not both"});
}

TEST(SceneJson, RejectsUnknownFieldsAndListsTheAllowed) {
    expect_invalid(scene_with(R"("cube": [])"), "/cube", {"\"cube\"", "\"cubes\"", "\"accuracy\""});
    expect_invalid(cube_with(R"("colour": 1)"), "/cubes/0/colour", {"\"texture\"", "\"size\""});
    expect_invalid(cloud_with(R"("sise": 1)"), "/clouds/0/sise", {"\"positions\""});
    expect_invalid(scene_with(R"("medium": {"G": 1})"), "/medium/G", {"\"g\""});
    expect_invalid(scene_with(R"("sun": {"colour": 1})"), "/sun/colour", {"\"color\""});
    expect_invalid(scene_with(R"("sky": {"top": 1})"), "/sky/top", {"\"zenith\""});
    expect_invalid(scene_with(R"("ground": {"h": 1})"), "/ground/h", {"\"height\""});
    expect_invalid(scene_with(R"("camera": {"from": 1})"), "/camera/from", {"\"eye\""});
    expect_invalid(scene_with(R"("image": {"size": 1})"), "/image/size", {"\"precision\""});
    expect_invalid(scene_with(R"("effects": {"fog": true})"), "/effects/fog",
                   {"\"self_shadow\"", "\"texture\""});
    expect_invalid(scene_with(R"("accuracy": {"ms": 1})"), "/accuracy/ms", {"\"time_ms\""});
}

TEST(SceneJson, EscapesPointersAndClipsNamesThatComeFromTheClient) {
    expect_invalid(scene_with(R"("a/b~c": 1)"), "/a~1b~0c");
    expect_invalid(scene_with("\"" + std::string(100'000, 'n') + "\": 1"), "", {"nnn..."});
    expect_invalid(scene_with(R"("\u0000\n\u20ac": 1)"), "", {"unknown field \"\\x00\\x0A€\""});
    expect_invalid(scene_with("\"fill\": \"" + std::string(100'000, 'f') + "\""), "/fill");
    expect_invalid(scene_with("\"fill\": \"" + std::string(200, 'f') + "\""), "/fill", {"fff..."});
    expect_invalid(scene_with("\"seed\": -1" + std::string(300, '0') + ".5"), "/seed", {"..."});
}

TEST(SceneJson, RejectsDuplicateKeys) {
    expect_invalid(scene_with(R"("seed": 1, "seed": 1)"), "/seed", {"twice"});
    expect_invalid(scene_with(R"("cubes": [])"), "/cubes", {"twice"});
    expect_invalid(cube_with(R"("radius": 1)"), "/cubes/0/radius", {"twice"});
    expect_invalid(scene_with(R"("effects": {"detail": false, "detail": false})"),
                   "/effects/detail", {"twice"});
    expect_invalid(R"({"cubes": [], "\u0063ubes": []})", "/cubes", {"twice"});
}

TEST(SceneJson, RejectsMissingFieldsOfACubeAndNamesThem) {
    expect_invalid(R"({"cubes": [{}]})", "/cubes/0", {"particles"});
    expect_invalid(R"({"cubes": [{"particles": 1, "size": [1, 1, 1], "center": [0, 0, 0]}]})",
                   "/cubes/0", {"radius"});
    expect_invalid(scene_with(R"("camera": {"target": [0, 0, 0]})"), "/camera", {"eye"});
    expect_invalid(scene_with(R"("camera": {"eye": [0, 0, 0]})"), "/camera", {"target"});
}

TEST(SceneJson, RejectsWrongTypes) {
    const char* const wrong[][2] = {
        {R"("fill": 1)", "/fill"},
        {R"("fill": ["uniform"])", "/fill"},
        {R"("density": "1")", "/density"},
        {R"("density": null)", "/density"},
        {R"("density": [1])", "/density"},
        {R"("density": {})", "/density"},
        {R"("density": true)", "/density"},
        {R"("medium": [])", "/medium"},
        {R"("medium": "auto")", "/medium"},
        {R"("sun": {"color": 1})", "/sun/color"},
        {R"("sun": {"direction": {"x": 1}})", "/sun/direction"},
        {R"("sun": {"color": [1, 1, "1"]})", "/sun/color/2"},
        {R"("sun": {"color": [1, [1], 1]})", "/sun/color/1"},
        {R"("sun": {"color": [1, null, 1]})", "/sun/color/1"},
        {R"("sun": {"color": [{}, 1, 1]})", "/sun/color/0"},
        {R"("sky": true)", "/sky"},
        {R"("camera": [])", "/camera"},
        {R"("image": {"exposure": true})", "/image/exposure"},
        {R"("effects": true)", "/effects"},
        {R"("effects": {"detail": 1})", "/effects/detail"},
        {R"("effects": {"detail": null})", "/effects/detail"},
        {R"("accuracy": 0.1)", "/accuracy"},
    };
    for (const auto& [member, pointer] : wrong)
        expect_invalid(scene_with(member), pointer, {"must be"});
    expect_invalid(R"({"cubes": {}})", "/cubes", {"list"});
    expect_invalid(R"({"cubes": [1]})", "/cubes/0", {"object"});
    expect_invalid(R"({"cubes": [[]]})", "/cubes/0", {"object"});
    expect_invalid(R"({"clouds": ["cubes"]})", "/clouds/0", {"object"});
}

TEST(SceneJson, RejectsUnknownWordsAndListsTheAllowed) {
    expect_invalid(scene_with(R"("fill": "Uniform")"), "/fill", {"\"uniform\"", "\"Uniform\""});
    expect_invalid(scene_with(R"("medium": {"phase": "rayleigh"})"), "/medium/phase", {"cornette"});
    expect_invalid(scene_with(R"("sun": {"color": "red"})"), "/sun/color", {"\"auto\""});
    expect_invalid(scene_with(R"("sky": "blue")"), "/sky", {"\"none\""});
    expect_invalid(scene_with(R"("ground": "flat")"), "/ground", {"\"none\""});
    expect_invalid(scene_with(R"("camera": "top")"), "/camera", {"\"auto\""});
    expect_invalid(scene_with(R"("image": {"format": "jpg"})"), "/image/format", {"\"exr\""});
    expect_invalid(scene_with(R"("image": {"background": "red"})"), "/image/background", {"sky"});
    expect_invalid(scene_with(R"("image": {"exposure": "bright"})"), "/image/exposure", {"auto"});
    expect_invalid(scene_with(R"("image": {"precision": "double"})"), "/image/precision", {"half"});
    expect_invalid(scene_with(R"("effects": {"detail": "on"})"), "/effects/detail", {"true"});
    expect_invalid(cloud_with(R"("model": "blob")"), "/clouds/0/model", {"\"particles\""});
}

TEST(SceneJson, RejectsNumbersThatOverflow) {
    expect_invalid(scene_with(R"("density": 1e999)"), "/density", {"finite"});
    expect_invalid(scene_with(R"("sun": {"color": [1, -1e400, 1]})"), "/sun/color/1", {"finite"});
    expect_invalid(cloud_with(R"("model": "particles", "positions": [[0, 0, 0]], "radii": [1e39])"),
                   "/clouds/0/radii/0", {"from"});
}

TEST(SceneJson, RejectsIntegersThatAreNot) {
    for (const char* const bad :
         {"2.9", "-1", "-0.5", "1e300", "18446744073709551616", "1.8446744073709552e19", "true",
          "\"1\"", "null", "[1]", "-9223372036854775809"})
        expect_invalid(scene_with(std::string("\"seed\": ") + bad), "/seed", {"integer"});
    for (const char* const bad : {"2.9", "-1", "3e9", "4294967297", "true", "\"800\""})
        expect_invalid(scene_with(std::string(R"("image": {"width": )") + bad + "}"),
                       "/image/width", {"8192"});
    expect_invalid(R"({"cubes": [{"particles": 0.5}]})", "/cubes/0/particles", {"integer"});
    expect_invalid(R"({"cubes": [{"particles": -4}]})", "/cubes/0/particles", {"integer", "-4"});
}

TEST(SceneJson, RejectsVectorsThatDoNotHaveThreeNumbers) {
    expect_invalid(scene_with(R"("sun": {"color": [1, 1]})"), "/sun/color", {"not 2"});
    expect_invalid(scene_with(R"("sun": {"color": []})"), "/sun/color", {"not 0"});
    expect_invalid(scene_with(R"("sun": {"color": [1, 1, 1, 1]})"), "/sun/color", {"more"});
    expect_invalid(cloud_with(R"("model": "particles", "positions": [[1, 2, 3], [1, 2]])"),
                   "/clouds/0/positions/1", {"not 2"});
    expect_invalid(cloud_with(R"("model": "particles", "colors": [[1, 2, 3, 4]])"),
                   "/clouds/0/colors/0", {"more"});
}

TEST(SceneJson, RejectsASunWithBothADirectionAndAngles) {
    expect_invalid(scene_with(R"("sun": {"direction": [0, 1, 0], "elevation": 4})"),
                   "/sun/direction", {"either"});
    expect_invalid(scene_with(R"("sun": {"azimuth": 4, "direction": [0, 1, 0]})"), "/sun/direction",
                   {"either"});
}

TEST(SceneJson, RejectsAnAccuracyThatIsNotExactlyOneWish) {
    expect_invalid(scene_with(R"("accuracy": {})"), "/accuracy", {"exactly one"});
    expect_invalid(scene_with(R"("accuracy": {"error": 0.1, "rung": "harris"})"), "/accuracy",
                   {"exactly one"});
}

TEST(SceneJson, RejectsFieldsOfAnotherCloudModel) {
    expect_invalid(cloud_with(R"("positions": [], "radii": [])"), "/clouds/0/positions", {"cubes"});
    expect_invalid(cloud_with(R"("model": "particles", "cubes": [])"), "/clouds/0/cubes",
                   {"particles"});
    expect_invalid(cloud_with(R"("cubes": [], "model": "particles")"), "/clouds/0/cubes");
    expect_invalid(cloud_with(R"("model": "cubes")"), "/clouds/0", {"\"cubes\""});
    expect_invalid(cloud_with(R"("model": "particles", "positions": [])"), "/clouds/0",
                   {"\"radii\""});
}

}  // namespace
}  // namespace awan
