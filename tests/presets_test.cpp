// Documents that begin with a preset.
#include "server/document/presets.h"

#include <gtest/gtest.h>

#include "core/scene/limits.h"
#include "core/scene/validate.h"
#include "server/document/json.h"

namespace awan {
namespace {

SceneDraft parsed(std::string_view text) {
    auto draft = parse_scene(text);
    EXPECT_TRUE(draft.ok()) << text << ": " << draft.error().pointer << " "
                            << draft.error().message;
    return draft.ok() ? *draft : SceneDraft{};
}

std::string wrong(std::string_view text) {
    const auto draft = parse_scene(text);
    return draft.ok() ? "" : draft.error().pointer + ": " + draft.error().message;
}

TEST(Presets, StandForTheirDocument) {
    for (const PresetEntry& preset : preset_entries()) {
        const std::string name(preset.name);
        const std::string own = scene_to_json(parsed(preset.text));
        EXPECT_EQ(scene_to_json(parsed("{\"preset\":\"" + name + "\"}")), own) << name;
        if (preset.genus.empty()) continue;
        EXPECT_EQ(scene_to_json(parsed("{\"preset\":\"" + std::string(preset.genus) + "\"}")), own);
    }
}

TEST(Presets, GiveWayToWhatTheDocumentSays) {
    const SceneDraft whole = parsed(R"({"preset": "congestus"})");
    const SceneDraft changed = parsed(
        R"({"sun": {"elevation": 7.5}, "seed": 5, "preset": "Cumulus Congestus", "image": {"width": 33}})");
    EXPECT_EQ(changed.sun.elevation, 7.5);
    EXPECT_EQ(changed.sun.azimuth, whole.sun.azimuth);
    EXPECT_EQ(changed.seed, 5U);
    EXPECT_EQ(changed.image.width, 33);
    EXPECT_EQ(changed.image.height, whole.image.height);
    EXPECT_EQ(changed.clouds.size(), whole.clouds.size());
    // Lists take the place of lists, and one way to say a thing that of another.
    const SceneDraft other =
        parsed(R"({"preset": "congestus", "cubes":)"
               R"([{"particles": 9, "size": [2, 2, 2], "center": [0, 0, 0], "radius": 1}]})");
    EXPECT_EQ(other.clouds[0].cubes.size(), 1U);
    EXPECT_TRUE(parsed(R"({"preset": "congestus", "accuracy": {"rung": "single"}})").accuracy.rung);
    const SceneDraft sunlit = parsed(R"({"preset": "congestus", "sun": {"direction": [0, 1, 0]}})");
    EXPECT_TRUE(validate(sunlit).ok());
    EXPECT_FALSE(parsed(R"({"preset": "noon-cumulus", "ground": null})").ground);
    EXPECT_TRUE(parsed(R"({"preset": "noon-cumulus"})").ground);
    // A word takes what a preset has away: its hills, and the rest of its ground stays.
    const SceneDraft hills = parsed(R"({"preset": "mountain-cumulus"})");
    const SceneDraft level =
        parsed(R"({"preset": "mountain-cumulus", "ground": {"terrain": "none"}})");
    ASSERT_TRUE(hills.ground && hills.ground->terrain && level.ground);
    EXPECT_FALSE(level.ground->terrain);
    EXPECT_EQ(level.ground->albedo, hills.ground->albedo);
    // To say so where there are none is to say nothing.
    EXPECT_EQ(scene_to_json(parsed(R"({"ground": {"terrain": "none"}, "cubes": []})")),
              scene_to_json(parsed(R"({"ground": {}, "cubes": []})")));
}

TEST(Presets, AreToldApartFromMistakes) {
    EXPECT_NE(wrong(R"({"preset": "cumulos"})")
                  .find("/preset: must be the name of a preset, not \"cumulos\""),
              std::string::npos);
    EXPECT_NE(wrong(R"({"preset": "cumulos"})").find("congestus (cumulus congestus)"),
              std::string::npos);
    EXPECT_NE(wrong(R"({"preset": 3})").find("/preset: must be the name of a preset"),
              std::string::npos);
    EXPECT_EQ(wrong(R"({"preset": "congestus", "sun": {"elevaton": 3}})")
                  .find("/sun/elevaton: unknown field"),
              0U);
    EXPECT_NE(wrong("{\"preset\": \"congestus\",\n \"sun\": }").find("line 2, column 9"),
              std::string::npos)
        << wrong("{\"preset\": \"congestus\",\n \"sun\": }");
    EXPECT_NE(wrong("{\"preset\": \"congestus\", \"_deep\": " + std::string(100, '[') +
                    std::string(100, ']') + "}"),
              "");
    EXPECT_NE(wrong("{\"preset\": \"congestus\", \"_long\": \"" +
                    std::string(limits::kMaxPresetDocument, 'a') + "\"}"),
              "");
    // Of a cloud it is another thing.
    EXPECT_NE(wrong(R"({"clouds": [{"preset": "congestus"}]})"), "");
}

}  // namespace
}  // namespace awan
