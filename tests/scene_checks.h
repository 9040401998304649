// Short documents around one field, and checks of how they are refused. A refusal by the reader and
// one by validate() look the same to a client, so both are tested through one door.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "core/scene/validate.h"
#include "server/document/json.h"

namespace awan::scene_checks {

inline constexpr const char* kCube =
    R"({"particles": 200, "size": [7.4, 1.07, 2.9], "center": [-3.4, -3.3, -0.6], "radius": 2.1})";

inline std::string scene_with(const std::string& member) {
    return std::string(R"({"cubes": [)") + kCube + "]" + (member.empty() ? "" : ", " + member) +
           "}";
}

inline std::string cube_with(const std::string& member) {
    return R"({"cubes": [{"particles": 2, "size": [1, 1, 1], "center": [0, 0, 0], "radius": 1, )" +
           member + "}]}";
}

inline std::string cloud_with(const std::string& members) {
    return R"({"clouds": [{)" + members + "}]}";
}

inline Result<Scene> read(std::string_view text) {
    Result<SceneDraft> draft = parse_scene(text);
    if (!draft) return draft.error();
    return validate(std::move(*draft));
}

inline SceneDraft draft_of(std::string_view text) {
    Result<SceneDraft> draft = parse_scene(text);
    EXPECT_TRUE(draft.ok()) << text << "\n"
                            << (draft ? "" : draft.error().pointer + ": " + draft.error().message);
    return draft ? *draft : SceneDraft{};
}

inline void expect_error(std::string_view text, ErrorCode code, const std::string& pointer,
                         std::initializer_list<const char*> words = {}) {
    const std::string shown(text.substr(0, 300));
    const Result<Scene> scene = read(text);
    ASSERT_FALSE(scene.ok()) << shown;
    const Error& error = scene.error();
    EXPECT_EQ(error.code, code) << shown << "\n" << error.message;
    EXPECT_EQ(error.pointer, pointer) << shown << "\n" << error.message;
    for (const char* const word : words)
        EXPECT_NE(error.message.find(word), std::string::npos)
            << '"' << error.message << "\" lacks " << word;
    EXPECT_LT(error.message.size(), 400u) << error.message;
    for (const char c : error.message)
        EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' && c != '\x7f') << error.message;
}

inline void expect_invalid(std::string_view text, const std::string& pointer,
                           std::initializer_list<const char*> words = {}) {
    expect_error(text, ErrorCode::kInvalidScene, pointer, words);
}

inline void expect_malformed(std::string_view text, std::initializer_list<const char*> words = {}) {
    expect_error(text, ErrorCode::kMalformed, "", words);
}

}  // namespace awan::scene_checks
