// Clouds for FlightGear (core/formats/flightgear.h). What SimGear makes of them: tests/farm/flightgear.sh.
#include "core/formats/flightgear.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/generate/generate.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

Scene scene_of(std::vector<Cube> cubes) {
    SceneDraft draft;
    Cloud cloud;
    cloud.fill = Fill::kUniform;
    cloud.cubes = std::move(cubes);
    draft.clouds = {cloud};
    auto scene = validate(draft);
    EXPECT_TRUE(scene.ok());
    return *scene;
}

Cube cube(glm::dvec3 size, glm::dvec3 center) {
    Cube made;
    made.particles = 200;
    made.size = size;
    made.center = center;
    made.radius = 0.1;
    return made;
}

std::string written(const Scene& scene, double metres) {
    auto text = write_flightgear(scene, *generate(scene, 1, Deadline{}), metres);
    EXPECT_TRUE(text.ok());
    return text.ok() ? *text : "";
}

// The numbers of all `name` within <placed>, in order.
std::vector<double> placed(const std::string& text, const std::string& name) {
    std::vector<double> values;
    const std::string tag = "<" + name + ">";
    for (auto at = text.find(tag, text.find("<placed>")); at != std::string::npos;
         at = text.find(tag, at + 1))
        values.push_back(std::strtod(text.c_str() + at + tag.size(), nullptr));
    return values;
}

TEST(FlightGear, HeapsStandWhereTheCubesAre) {
    const std::string text =
        written(scene_of({cube({1, 1, 1}, {0, 0, 0}), cube({1, 2, 1}, {4, 3, -2})}), 100);
    const auto x = placed(text, "x-offset-m"), y = placed(text, "y-offset-m"),
               feet = placed(text, "alt-ft"), width = placed(text, "min-cloud-width-m"),
               height = placed(text, "max-cloud-height-m");
    ASSERT_EQ(x.size(), 2u);
    // East is +x, north -z; the second's base is 2.5 units over the first's. A cube is filled up to half a radius.
    EXPECT_NEAR(x[1] - x[0], 400, 10);
    EXPECT_NEAR(y[1] - y[0], 200, 10);
    EXPECT_EQ(feet[0], 0);
    EXPECT_NEAR(feet[1] * 0.3048, 250, 10);
    EXPECT_NEAR(width[0], 110, 15);
    EXPECT_NEAR(height[1], 210, 15);
}

TEST(FlightGear, LengthsAreOfTheUnitThatIsGiven) {
    const Scene scene = scene_of({cube({2, 1, 1.5}, {0, 0, 0})});
    const std::string small = written(scene, 10), large = written(scene, 1000);
    for (const char* const name : {"min-cloud-width-m", "max-sprite-height-m"}) {
        const auto a = placed(small, name), b = placed(large, name);
        ASSERT_EQ(a.size(), b.size());
        ASSERT_FALSE(a.empty());
        // Written to a hundredth of a metre.
        EXPECT_NEAR(100 * a[0], b[0], 1) << name;
    }
    EXPECT_EQ(placed(small, "alpha-factor"), placed(large, "alpha-factor"));
}

TEST(FlightGear, LongCubesAreCutIntoNearlySquareOnes) {
    const std::string text = written(scene_of({cube({8, 1, 1}, {0, 0, 0})}), 1);
    const auto x = placed(text, "x-offset-m");
    EXPECT_EQ(x.size(), 8u);
    for (std::size_t i = 1; i < x.size(); ++i) EXPECT_GT(x[i], x[i - 1]);
}

TEST(FlightGear, ThickCloudsAreDarkBelowAndThinOnesClear) {
    Cube thin = cube({2, 2, 2}, {0, 0, 0}), thick = cube({2, 2, 2}, {9, 0, 0});
    thin.density = 1e-4;
    thick.density = 1000;
    SceneDraft draft;
    Cloud cloud;
    cloud.density = 1.0;
    cloud.cubes = {thin, thick};
    draft.clouds = {cloud};
    auto scene = validate(draft);
    ASSERT_TRUE(scene.ok());
    const std::string text = written(*scene, 1);
    const auto below = placed(text, "min-bottom-lighting-factor"),
               alpha = placed(text, "alpha-factor");
    ASSERT_EQ(below.size(), 2u);
    EXPECT_EQ(below[0], 1);
    EXPECT_LT(below[1], 0.6);
    EXPECT_LT(alpha[0], 0.05);
    EXPECT_GT(alpha[1], 0.9);
}

TEST(FlightGear, NothingIsNoCloud) {
    const Scene scene = scene_of({cube({1, 1, 1}, {0, 0, 0})});
    ParticleSet none;
    none.cloud_begin = {0, 0};
    EXPECT_FALSE(write_flightgear(scene, none, 100).ok());
}

}  // namespace
}  // namespace awan
