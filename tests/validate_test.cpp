// What no scene can be, by document and by draft (core/scene/validate.h), and the laws of scene
// values (core/scene/scene.h).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/scene/fingerprint.h"
#include "core/scene/limits.h"
#include "core/scene/rungs.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "tests/scene_checks.h"

namespace awan {
namespace {

using namespace scene_checks;

// --- out of range

TEST(SceneJson, RejectsCubesOutOfRange) {
    const auto cube = [](const std::string& size, const std::string& center,
                         const std::string& radius) {
        return std::string(R"({"cubes": [)") + kCube + R"(, {"particles": 1, "size": )" + size +
               R"(, "center": )" + center + R"(, "radius": )" + radius + "}]}";
    };
    EXPECT_TRUE(read(cube("[1, 1, 1]", "[0, 0, 0]", "1")).ok());
    expect_invalid(cube("[1, 0, 1]", "[0, 0, 0]", "1"), "/cubes/1/size/1", {"1e-09"});
    expect_invalid(cube("[1, 1, -1]", "[0, 0, 0]", "1"), "/cubes/1/size/2", {"-1"});
    expect_invalid(cube("[1e10, 1, 1]", "[0, 0, 0]", "1"), "/cubes/1/size/0", {"1e+09"});
    expect_invalid(cube("[1, 1, 1]", "[0, 2e9, 0]", "1"), "/cubes/1/center/1", {"1e+09"});
    expect_invalid(cube("[1, 1, 1]", "[0, 0, 0]", "0"), "/cubes/1/radius", {"1e-06"});
    expect_invalid(cube("[1, 1, 1]", "[0, 0, 0]", "-2"), "/cubes/1/radius", {"1e-06", "-2"});
    expect_invalid(cube("[1, 1, 1]", "[0, 0, 0]", "1e7"), "/cubes/1/radius", {"1e+06"});
    expect_invalid(cube_with(R"("density": -1)"), "/cubes/0/density", {"0"});
    expect_invalid(cube_with(R"("density": 1e7)"), "/cubes/0/density");
}

TEST(SceneJson, RejectsTotalsOverTheLimitAtTheFirstElementTooMany) {
    const auto cube = [](std::uint64_t particles) {
        return "{\"particles\": " + std::to_string(particles) +
               R"(, "size": [1, 1, 1], "center": [0, 0, 0], "radius": 1})";
    };
    const std::uint64_t half = limits::kMaxParticles / 2;
    EXPECT_TRUE(read(R"({"cubes": [)" + cube(half) + "," + cube(half) + "]}").ok());
    expect_invalid(R"({"cubes": [)" + cube(half) + "," + cube(half) + "," + cube(1) + "]}",
                   "/cubes/2/particles", {"4194304"});
    expect_invalid(R"({"cubes": [)" + cube(UINT64_MAX) + "]}", "/cubes/0/particles");
    expect_invalid(
        R"({"clouds": [{"cubes": [)" + cube(half) + R"(]}, {"cubes": [)" + cube(half + 1) + "]}]}",
        "/clouds/1/cubes/0/particles");

    std::string cubes;
    for (std::uint64_t i = 0; i < limits::kMaxCubes; ++i) cubes += cube(0) + ",";
    expect_invalid(R"({"cubes": [)" + cubes + cube(0) + "]}", "/cubes/10000", {"10000"});
    std::string clouds;
    for (std::uint64_t i = 0; i < limits::kMaxClouds; ++i) clouds += R"({"cubes": []},)";
    expect_invalid(R"({"clouds": [)" + clouds + R"({"cubes": []}]})", "/clouds/1000", {"1000"});
}

TEST(SceneJson, RejectsCloudsOutOfRange) {
    expect_invalid(cloud_with(R"("cubes": [], "scale": 0)"), "/clouds/0/scale");
    expect_invalid(cloud_with(R"("cubes": [], "scale": -1)"), "/clouds/0/scale");
    expect_invalid(cloud_with(R"("cubes": [], "translate": [0, 0, 1e10])"),
                   "/clouds/0/translate/2");
    expect_invalid(cloud_with(R"("cubes": [], "rotate_y": 1e7)"), "/clouds/0/rotate_y");
    expect_invalid(cloud_with(R"("cubes": [], "density": -1)"), "/clouds/0/density");
    expect_invalid(scene_with(R"("density": -1)"), "/density");
}

TEST(SceneJson, RejectsWhatLeavesTheLimitsOnlyAfterTheCloudsTransform) {
    const std::string cube = std::string(R"("cubes": [)") + kCube + "]";
    expect_invalid(cloud_with(R"("model": "particles", "positions": [[0, 0, 0]], "radii": [0.5],
                                 "scale": 1e-6)"),
                   "/clouds/0/radii/0", {"scale"});
    expect_invalid(cloud_with(cube + R"(, "scale": 1e6)"), "/clouds/0/cubes/0/radius", {"scale"});
    expect_invalid(cloud_with(R"("model": "particles", "positions": [[1e8, 0, 0]], "radii": [1],
                                 "scale": 100)"),
                   "/clouds/0/positions/0", {"scale"});
    expect_invalid(cloud_with(R"("model": "particles", "positions": [[0, 9e8, 0]], "radii": [1],
                                 "translate": [0, 9e8, 0])"),
                   "/clouds/0/positions/0", {"translate"});
}

TEST(SceneJson, RejectsReadyParticlesOutOfRangeOrOfUnequalLengths) {
    const auto ready = [](const std::string& lists) {
        return cloud_with(R"("model": "particles", "positions": [[0, 0, 0], [1, 1, 1]], )" + lists);
    };
    EXPECT_TRUE(read(ready(R"("radii": [1, 1])")).ok());
    expect_invalid(ready(R"("radii": [1])"), "/clouds/0/radii", {"2", "1"});
    expect_invalid(ready(R"("radii": [1, 1, 1])"), "/clouds/0/radii", {"2", "3"});
    expect_invalid(ready(R"("radii": [1, 0])"), "/clouds/0/radii/1");
    expect_invalid(ready(R"("radii": [1, 1], "densities": [1])"), "/clouds/0/densities");
    expect_invalid(ready(R"("radii": [1, 1], "densities": [1, -1])"), "/clouds/0/densities/1");
    expect_invalid(ready(R"("radii": [1, 1], "colors": [[1, 1, 1]])"), "/clouds/0/colors");
    expect_invalid(ready(R"("radii": [1, 1], "colors": [[1, 1, 1], [0, 1.5, 0]])"),
                   "/clouds/0/colors/1/1");
    expect_invalid(
        cloud_with(
            R"("model": "particles", "positions": [[0, 0, 0], [1, 2e9, 1]], "radii": [1, 1])"),
        "/clouds/0/positions/1/1");
}

TEST(SceneJson, RejectsLightOutOfRange) {
    const char* const wrong[][2] = {
        {R"("medium": {"albedo": 1.5})", "/medium/albedo"},
        {R"("medium": {"albedo": -0.5})", "/medium/albedo"},
        {R"("medium": {"g": 1})", "/medium/g"},
        {R"("medium": {"g": -1})", "/medium/g"},
        {R"("medium": {"phase": "mie", "g": 0.5})", "/medium/g"},
        {R"("medium": {"droplet": 20})", "/medium/droplet"},
        {R"("medium": {"phase": "mie", "droplet": 60})", "/medium/droplet"},
        {R"("sun": {"elevation": 91})", "/sun/elevation"},
        {R"("sun": {"azimuth": 1e7})", "/sun/azimuth"},
        {R"("sun": {"direction": [0, 0, 0]})", "/sun/direction"},
        {R"("sun": {"direction": [0, 1e10, 0]})", "/sun/direction/1"},
        {R"("sun": {"color": [1, -1, 1]})", "/sun/color/1"},
        {R"("sun": {"color": [1, 1, 2000]})", "/sun/color/2"},
        {R"("sun": {"intensity": -1})", "/sun/intensity"},
        {R"("sun": {"intensity": 1e7})", "/sun/intensity"},
        {R"("sky": {"zenith": [-1, 0, 0]})", "/sky/zenith/0"},
        {R"("sky": {"horizon": [0, 0, -1]})", "/sky/horizon/2"},
        {R"("sky": {"intensity": -1})", "/sky/intensity"},
        {R"("sky": {"model": "physical", "turbidity": 1.9})", "/sky/turbidity"},
        {R"("sky": {"turbidity": 10.5})", "/sky/turbidity"},
        {R"("ground": {"height": 1e10})", "/ground/height"},
        {R"("ground": {"albedo": 1.5})", "/ground/albedo/0"},
        {R"("haze": {"extinction": -1, "scale_height": 1})", "/haze/extinction"},
        {R"("haze": {"extinction": 1, "scale_height": 0})", "/haze/scale_height"},
        {R"("haze": {"extinction": 1, "scale_height": -1})", "/haze/scale_height"},
        {R"("haze": {"extinction": 1, "scale_height": 1, "height": 1e10})", "/haze/height"},
        {R"("haze": {"extinction": 1, "scale_height": 1, "albedo": [0, 2, 0]})", "/haze/albedo/1"},
        {R"("haze": {"extinction": 1, "scale_height": 1, "g": 1})", "/haze/g"},
        {R"("detail": {"amount": 1.1})", "/detail/amount"},
        {R"("detail": {"amount": -0.1})", "/detail/amount"},
        {R"("detail": {"size": 0})", "/detail/size"},
        {R"("detail": {"size": 1e6})", "/detail/size"},
    };
    for (const auto& [member, pointer] : wrong)
        expect_invalid(scene_with(member), pointer, {"must"});
}

TEST(SceneJson, RejectsCamerasThatCannotLook) {
    const auto camera = [](const std::string& members) {
        return scene_with(R"("camera": {"eye": [0, 0, 5], )" + members + "}");
    };
    EXPECT_TRUE(read(camera(R"("target": [0, 0, 0])")).ok());
    expect_invalid(camera(R"("target": [0, 0, 5])"), "/camera/target", {"eye"});
    expect_invalid(camera(R"("target": [0, 0, 0], "up": [0, 0, 0])"), "/camera/up");
    expect_invalid(camera(R"("target": [0, 0, 0], "up": [0, 0, 2])"), "/camera/up", {"parallel"});
    expect_invalid(camera(R"("target": [0, 9, 5])"), "/camera/up", {"parallel"});
    expect_invalid(camera(R"("target": [0, 0, 0], "fov": 0)"), "/camera/fov");
    expect_invalid(camera(R"("target": [0, 0, 0], "fov": 180)"), "/camera/fov");
    expect_invalid(camera(R"("target": [0, 0, 1e10])"), "/camera/target/2");
}

TEST(SceneJson, RejectsPicturesOutOfRange) {
    expect_invalid(scene_with(R"("image": {"width": 0})"), "/image/width", {"8192"});
    expect_invalid(scene_with(R"("image": {"height": 8193})"), "/image/height", {"8192"});
    expect_invalid(scene_with(R"("image": {"width": 8192, "height": 8192})"), "/image",
                   {"33554432"});
    EXPECT_TRUE(read(scene_with(R"("image": {"width": 8192, "height": 4096})")).ok());
    expect_invalid(scene_with(R"("image": {"exposure": 65})"), "/image/exposure", {"64"});
}

TEST(SceneJson, RejectsAccuraciesThatAreNotPositive) {
    expect_invalid(scene_with(R"("accuracy": {"error": 0})"), "/accuracy/error", {"> 0"});
    expect_invalid(scene_with(R"("accuracy": {"time_ms": -1})"), "/accuracy/time_ms", {"> 0"});
}

TEST(SceneJson, TakesEveryRungAndNamesThemToWhoAsksForAnother) {
    for (const Rung& rung : ladder())
        EXPECT_TRUE(
            read(scene_with(R"("accuracy": {"rung": ")" + std::string(rung.name) + "\"}")).ok())
            << rung.name;
    expect_invalid(scene_with(R"("accuracy": {"rung": "perfect"})"), "/accuracy/rung",
                   {"\"additive\"", "\"harris\"", "\"truth\""});
    EXPECT_TRUE(read(scene_with(R"("accuracy": {"error": 0.05})")).ok());
    EXPECT_TRUE(read(scene_with(R"("accuracy": {"time_ms": 50})")).ok());
}

TEST(SceneJson, AGroundIsInEveryRung) {
    const std::string ground = R"("ground": {"height": -1, "albedo": 0.5}, "accuracy": )";
    for (const char* const wish :
         {R"({"rung": "truth"})", R"({"rung": "harris"})", R"({"error": 0.1})"})
        EXPECT_TRUE(read(scene_with(ground + wish)).ok()) << wish;
}

TEST(Fingerprint, NoAccuracyIsTheDefaultAccuracy) {
    EXPECT_EQ(fingerprint(*read(scene_with(R"("seed": 1)"))),
              fingerprint(*read(scene_with(R"("accuracy": {"error": 0.1})"))));
}

// --- all of the contract

TEST(SceneJson, TakesEveryEffect) {
    expect_invalid(scene_with(R"("ground": {"albedo": [0.1, 0.2, 1.3]})"), "/ground/albedo/2");
    for (const char* const effect :
         {"self_shadow", "multiple_scattering", "view_extinction", "sky_light", "ground_light",
          "ground_shadow", "sun_color", "aerial_perspective", "light_shafts", "detail", "interior",
          "texture"})
        EXPECT_TRUE(read(scene_with(std::string(R"("effects": {")") + effect + "\": true}")).ok())
            << effect;
}

// --- drafts from C++

TEST(Validate, RejectsNaNAndInfinityEverywhere) {
    const double nan = std::nan("");
    const double infinity = std::numeric_limits<double>::infinity();
    const SceneDraft good = draft_of(R"({"clouds": [
        {"cubes": [{"particles": 1, "size": [1, 1, 1], "center": [0, 0, 0], "radius": 1}],
         "density": 1},
        {"model": "particles", "positions": [[0, 0, 0]], "radii": [1], "densities": [1],
         "colors": [[1, 1, 1]]}],
        "density": 1, "camera": {"eye": [0, 0, 1], "target": [0, 0, 0]},
        "image": {"exposure": 0}})");
    ASSERT_TRUE(validate(good).ok());
    for (const double bad : {nan, infinity, -infinity}) {
        const auto expect_pointer = [&](const std::string& pointer, auto spoil) {
            SceneDraft draft = good;
            spoil(draft);
            const Result<Scene> scene = validate(draft);
            ASSERT_FALSE(scene.ok()) << pointer << " = " << bad;
            EXPECT_EQ(scene.error().code, ErrorCode::kInvalidScene);
            EXPECT_EQ(scene.error().pointer, pointer);
        };
        const auto small = static_cast<float>(bad);
        const auto cube = [](SceneDraft& d) -> Cube& { return d.clouds[0].cubes[0]; };
        const auto ready = [](SceneDraft& d) -> ReadyParticles& { return d.clouds[1].ready; };
        const std::string at = "/clouds/0/cubes/0", at1 = "/clouds/1";
        expect_pointer("/density", [&](SceneDraft& d) { d.density = bad; });
        expect_pointer("/clouds/0/density", [&](SceneDraft& d) { d.clouds[0].density = bad; });
        expect_pointer("/clouds/0/translate/1",
                       [&](SceneDraft& d) { d.clouds[0].translate.y = bad; });
        expect_pointer("/clouds/0/scale", [&](SceneDraft& d) { d.clouds[0].scale = bad; });
        expect_pointer("/clouds/0/rotate_y", [&](SceneDraft& d) { d.clouds[0].rotate_y = bad; });
        expect_pointer(at + "/size/0", [&](SceneDraft& d) { cube(d).size.x = bad; });
        expect_pointer(at + "/center/2", [&](SceneDraft& d) { cube(d).center.z = bad; });
        expect_pointer(at + "/radius", [&](SceneDraft& d) { cube(d).radius = bad; });
        expect_pointer(at + "/density", [&](SceneDraft& d) { cube(d).density = bad; });
        expect_pointer(at1 + "/positions/0/1",
                       [&](SceneDraft& d) { ready(d).positions[0].y = bad; });
        expect_pointer(at1 + "/radii/0", [&](SceneDraft& d) { ready(d).radii[0] = small; });
        expect_pointer(at1 + "/densities/0", [&](SceneDraft& d) { ready(d).densities[0] = small; });
        expect_pointer(at1 + "/colors/0/2", [&](SceneDraft& d) { ready(d).colors[0].z = small; });
        expect_pointer("/medium/albedo", [&](SceneDraft& d) { d.medium.albedo = bad; });
        expect_pointer("/medium/g", [&](SceneDraft& d) { d.medium.g = bad; });
        expect_pointer("/sun/elevation", [&](SceneDraft& d) { d.sun.elevation = bad; });
        expect_pointer("/sun/azimuth", [&](SceneDraft& d) { d.sun.azimuth = bad; });
        expect_pointer("/sun/direction/0", [&](SceneDraft& d) { d.sun.direction = {bad, 0, 0}; });
        expect_pointer("/sun/color/1", [&](SceneDraft& d) { d.sun.color.y = bad; });
        expect_pointer("/sun/intensity", [&](SceneDraft& d) { d.sun.intensity = bad; });
        expect_pointer("/sky/zenith/0", [&](SceneDraft& d) { d.sky.zenith.x = bad; });
        expect_pointer("/sky/horizon/0", [&](SceneDraft& d) { d.sky.horizon.x = bad; });
        expect_pointer("/sky/intensity", [&](SceneDraft& d) { d.sky.intensity = bad; });
        expect_pointer("/sky/turbidity", [&](SceneDraft& d) { d.sky.turbidity = bad; });
        expect_pointer("/haze/extinction",
                       [&](SceneDraft& d) { d.haze.emplace().extinction = bad; });
        expect_pointer("/haze/height", [&](SceneDraft& d) { d.haze.emplace().height = bad; });
        expect_pointer("/haze/scale_height",
                       [&](SceneDraft& d) { d.haze.emplace().scale_height = bad; });
        expect_pointer("/haze/albedo/2", [&](SceneDraft& d) { d.haze.emplace().albedo.z = bad; });
        expect_pointer("/haze/g", [&](SceneDraft& d) { d.haze.emplace().g = bad; });
        expect_pointer("/detail/amount", [&](SceneDraft& d) { d.detail.emplace().amount = bad; });
        expect_pointer("/detail/size", [&](SceneDraft& d) { d.detail.emplace().size = bad; });
        expect_pointer("/ground/height", [&](SceneDraft& d) { d.ground.emplace().height = bad; });
        expect_pointer("/ground/albedo/0",
                       [&](SceneDraft& d) { d.ground.emplace().albedo.x = bad; });
        expect_pointer("/camera/eye/0", [&](SceneDraft& d) { d.camera.eye.x = bad; });
        expect_pointer("/camera/target/0", [&](SceneDraft& d) { d.camera.target.x = bad; });
        expect_pointer("/camera/up/0", [&](SceneDraft& d) { d.camera.up.x = bad; });
        expect_pointer("/camera/fov", [&](SceneDraft& d) { d.camera.fov = bad; });
        expect_pointer("/image/exposure", [&](SceneDraft& d) { d.image.exposure = bad; });
        expect_pointer("/accuracy/error", [&](SceneDraft& d) { d.accuracy.error = bad; });
        expect_pointer("/accuracy/time_ms", [&](SceneDraft& d) { d.accuracy.time_ms = bad; });
    }
}

TEST(Validate, RejectsADraftThatHasNothing) {
    const Result<Scene> scene = validate(SceneDraft{});
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().pointer, "");
}

TEST(Validate, RejectsDensitiesWhoseProductIsTooLarge) {
    expect_invalid(cloud_with(R"("density": 1e4, "cubes": [{"particles": 1, "size": [1, 1, 1],
                                 "center": [0, 0, 0], "radius": 1, "density": 1e3}])"),
                   "/clouds/0/cubes/0/density", {"times the cloud's density"});
    expect_invalid(cloud_with(R"("density": 1e4, "model": "particles", "positions": [[0, 0, 0]],
                                 "radii": [1], "densities": [1e3])"),
                   "/clouds/0/densities/0", {"times the cloud's density"});
}

// --- scene

TEST(Scene, TheSunStandsWhereItsAnglesSay) {
    const auto direction = [](double elevation, double azimuth) {
        Sun sun;
        sun.elevation = elevation;
        sun.azimuth = azimuth;
        return sun_direction(sun);
    };
    EXPECT_EQ(direction(90, 123), glm::dvec3(0, 1, 0));
    EXPECT_EQ(direction(-90, 123), glm::dvec3(0, -1, 0));
    EXPECT_EQ(direction(0, 0), glm::dvec3(0, 0, 1));
    EXPECT_EQ(direction(0, 90), glm::dvec3(1, 0, 0));
    EXPECT_EQ(direction(0, 180), glm::dvec3(0, 0, -1));
    EXPECT_EQ(direction(0, -90), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(direction(0, 270), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(direction(30, 40), direction(30, 400));
    EXPECT_NEAR(direction(30, 0).y, 0.5, 1e-15);
    for (double elevation = -90; elevation <= 90; elevation += 7)
        for (double azimuth = -400; azimuth <= 400; azimuth += 13) {
            const glm::dvec3 d = direction(elevation, azimuth);
            EXPECT_NEAR(d.x * d.x + d.y * d.y + d.z * d.z, 1, 1e-15);
            EXPECT_NEAR(d.x * std::cos(azimuth * M_PI / 180), d.z * std::sin(azimuth * M_PI / 180),
                        1e-14);
        }
}

TEST(Scene, ASunDirectionOfAnyLengthPointsTheSameWay) {
    Sun sun;
    for (const double length : {1e-200, 1e-9, 1.0, 1e9}) {
        sun.direction = glm::dvec3(0, 3 * length, 4 * length);
        EXPECT_NEAR(sun_direction(sun).y, 0.6, 1e-15);
        EXPECT_NEAR(sun_direction(sun).z, 0.8, 1e-15);
    }
}

TEST(Scene, EveryEffectIsFoundByItsName) {
    for (int i = 0; i < kEffectCount; ++i)
        EXPECT_EQ(effect_from_name(effect_name(static_cast<Effect>(i))), static_cast<Effect>(i));
    EXPECT_FALSE(effect_from_name("fog"));
    EXPECT_FALSE(effect_from_name(""));
}

TEST(Scene, EqualScenesHaveEqualFingerprintsHoweverWritten) {
    const auto print = [](const std::string& text) {
        const Result<Scene> scene = read(text);
        EXPECT_TRUE(scene.ok()) << text;
        return scene ? fingerprint(*scene) : "";
    };
    const std::string plain = print(scene_with(""));
    EXPECT_EQ(plain.size(), 32u);
    EXPECT_EQ(plain.find_first_not_of("0123456789abcdef"), std::string::npos);
    for (const std::string& same :
         {scene_with(R"("seed": 1.0)"), scene_with(R"("camera": "auto")"),
          scene_with(
              R"("density": "auto", "detail": "auto", "sky": "physical", "fill": "cumulus")"),
          scene_with(R"("effects": {"detail": "auto"})"), scene_with(R"("sun": {"azimuth": 470})"),
          std::string(R"({"clouds": [{"cubes": [)") + kCube + "]}]}",
          std::string(R"({"seed": 5, "clouds": [{"seed": 1, "cubes": [)") + kCube + "]}]}"})
        EXPECT_EQ(print(same) == plain, same.find("\"seed\": 5") == std::string::npos) << same;

    const std::string ready = R"("model": "particles", "positions": [[0, 0, 0]], "radii": [1])";
    EXPECT_EQ(print(cloud_with(ready)),
              print(cloud_with(ready + R"(, "colors": [[1, 1, 1]], "densities": [1])")));
}

TEST(Scene, ScenesThatDifferInOneValueHaveDifferentFingerprints) {
    std::vector<std::string> texts = {
        scene_with(""),
        cube_with(R"("density": 1)"),
        cube_with(R"("density": 2)"),
        R"({"cubes": []})",
        R"({"clouds": []})",
        R"({"clouds": [{"cubes": []}, {"cubes": []}]})",
        cloud_with(R"("cubes": [], "translate": [0, 1, 0])"),
        cloud_with(R"("cubes": [], "translate": [0, 0, 1])"),
        cloud_with(R"("cubes": [], "scale": 2)"),
        cloud_with(R"("cubes": [], "rotate_y": 2)"),
        cloud_with(R"("cubes": [], "seed": 2)"),
        cloud_with(R"("cubes": [], "fill": "printed")"),
        cloud_with(R"("model": "particles", "positions": [], "radii": [])"),
        cloud_with(R"("model": "particles", "positions": [[0, 0, 0]], "radii": [1])"),
        cloud_with(R"("model": "particles", "positions": [[0, 0, 1]], "radii": [1])"),
        cloud_with(R"("model": "particles", "positions": [[0, 0, 0]], "radii": [2])"),
        cloud_with(
            R"("model": "particles", "positions": [[0, 0, 0]], "radii": [1], "densities": [2])"),
        cloud_with(
            R"("model": "particles", "positions": [[0, 0, 0]], "radii": [1], "colors": [[1, 1, 0]])"),
    };
    for (const char* const member :
         {R"("fill": "gardner")",
          R"("fill": "printed")",
          R"("seed": 2)",
          R"("density": 1)",
          R"("medium": {"albedo": 0.5})",
          R"("medium": {"g": 0.5})",
          R"("medium": {"phase": "cornette-shanks"})",
          R"("sun": {"elevation": 41})",
          R"("sun": {"azimuth": 61})",
          R"("sun": {"color": [1, 1, 1]})",
          R"("sun": {"intensity": 41})",
          R"("sky": "none")",
          R"("sky": {"zenith": [0, 0, 1]})",
          R"("sky": {"horizon": [0, 0, 1]})",
          R"("sky": {"intensity": 2})",
          R"("sky": "gradient")",
          R"("sky": {"model": "physical", "turbidity": 4})",
          R"("sky": {"daylight": "preetham"})",
          R"("sky": {"model": "gradient", "intensity": 2})",
          R"("sun": {"color": [0.5, 1, 1]})",
          R"("sky": "gradient", "sun": {"color": [0.5, 1, 1]})",
          R"("sky": {"model": "gradient", "turbidity": 4})",
          R"("effects": {"sun_color": false})",
          R"("detail": "none")",
          R"("fill": "stratus")",
          R"("density": 0.2)",
          R"("ground": {})",
          R"("ground": {"height": 1})",
          R"("ground": {"albedo": 0.5})",
          R"("haze": {"extinction": 1, "scale_height": 1})",
          R"("haze": {"extinction": 2, "scale_height": 1})",
          R"("haze": {"extinction": 1, "scale_height": 2})",
          R"("haze": {"extinction": 1, "scale_height": 1, "height": 1})",
          R"("haze": {"extinction": 1, "scale_height": 1, "albedo": 0.5})",
          R"("haze": {"extinction": 1, "scale_height": 1, "g": 0.5})",
          R"("detail": {})",
          R"("detail": {"amount": 0.25})",
          R"("detail": {"size": 0.25})",
          R"("camera": {"eye": [0, 0, 9], "target": [0, 0, 0]})",
          R"("camera": {"eye": [0, 0, 8], "target": [0, 0, 0]})",
          R"("camera": {"eye": [0, 0, 9], "target": [0, 0, 1]})",
          R"("camera": {"eye": [0, 0, 9], "target": [0, 0, 0], "up": [1, 1, 0]})",
          R"("camera": {"eye": [0, 0, 9], "target": [0, 0, 0], "fov": 41})",
          R"("image": {"width": 801})",
          R"("image": {"height": 601})",
          R"("image": {"format": "exr"})",
          R"("image": {"background": "transparent"})",
          R"("image": {"exposure": 0})",
          R"("image": {"precision": "float"})",
          R"("effects": {"self_shadow": true})",
          R"("effects": {"self_shadow": false})",
          R"("effects": {"detail": false})",
          R"("accuracy": {"rung": "harris"})"})
        texts.push_back(scene_with(member));
    std::vector<std::string> prints;
    for (const std::string& text : texts) {
        const Result<Scene> scene = read(text);
        ASSERT_TRUE(scene.ok()) << text << scene.error().message;
        prints.push_back(fingerprint(*scene));
        for (std::size_t i = 0; i + 1 < prints.size(); ++i)
            EXPECT_NE(prints[i], prints.back()) << texts[i] << "\n" << text;
    }
}

}  // namespace
}  // namespace awan
