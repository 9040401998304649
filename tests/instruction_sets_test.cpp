// Every instruction set that this processor has gives the same particles and pictures, bit for bit. A process takes one
// set when it begins, so each set has a child process of its own.
#include "core/base/instruction_sets.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/pipeline.h"
#include "core/scene/automaton.h"
#include "core/scene/implicit.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "tests/patience.h"
#include "tests/scenes.h"

namespace awan {
namespace {

// Between them they call every kernel: cells of an automaton, an implicit field and its growth; transport with and
// without directions, and the march, with detail and in haze.
struct Case {
    const char* preset;
    void (*change)(SceneDraft&);
};
void change_nothing(SceneDraft&) {}
void overlapping_by_the_first(SceneDraft& draft) {
    AutomatonCloud cloud = *draft.clouds[0].automaton;
    cloud.overlap = AutomatonOverlap::kFirst;
    draft.clouds[0].automaton = std::make_shared<const AutomatonCloud>(std::move(cloud));
}
void by_a_formula(SceneDraft& draft) {
    ImplicitCloud cloud = *draft.clouds[0].implicit;
    cloud.resolution = 40;
    cloud.squash = ImplicitSquash{{1, 2, 3}, {1, 3, 1}, 1.3, {}};
    cloud.formula =
        "a = fbm(x / 40, y / 40, z / 40, 4) + sin(x / 30) * cos(z / 20); b = exp(-height) * log(2 "
        "+ a);"
        "density * smoothstep(-0.5, 0.5, b) + (turb > 0.4 ? mdens ^ 1.7 : primitives(x, y + 9, z) "
        "/ 9)";
    draft.clouds[0].implicit = std::make_shared<const ImplicitCloud>(std::move(cloud));
}
constexpr Case kCases[] = {
    {"automaton-cumulus", change_nothing},
    {"automaton-cumulus", overlapping_by_the_first},
    {"implicit-growth", change_nothing},
    {"implicit-cumulus", by_a_formula},
    {"fog-shafts", change_nothing},
    {"noon-cumulus", [](SceneDraft& draft) { draft.medium.g = 0; }},
};

template <typename Value>
void append(std::string& to, const std::vector<Value>& values) {
    to.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

// The particles and the picture of a case, as they lie in memory.
std::string bytes_of(const Case& one) {
    std::ifstream file(std::string(AWAN_SOURCE_DIR "/web/presets/") + one.preset + ".json");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    Result<SceneDraft> draft = parse_scene(text);
    if (!draft.ok()) return draft.error().message;
    one.change(*draft);
    draft->image.width = test::or_fewer(96, 16);
    draft->image.height = test::or_fewer(72, 12);
    // Goes on from coarser grids, as all do.
    draft->accuracy = {{}, {}, test::kSanitized ? "transport-16" : "transport-24"};
    const Scene scene = test::valid(*std::move(draft));
    Result<Planned> planned = plan_scene(scene, 2, {});
    if (!planned.ok()) return planned.error().message;
    std::string bytes;
    append(bytes, planned->particles.center);
    append(bytes, planned->particles.radius);
    append(bytes, planned->particles.density);
    Tools tools;
    tools.threads = 2;
    const Result<Rendered> rendered = render_planned(scene, *std::move(planned), tools, {});
    if (!rendered.ok()) return rendered.error().message;
    append(bytes, rendered->image.pixels);
    return bytes;
}

struct Answer {
    InstructionSet used;
    std::vector<std::size_t> hashes, sizes;  // of each case
};

bool write_all(int to, const void* from, std::size_t count) {
    return write(to, from, count) == static_cast<ssize_t>(count);
}
bool read_all(int from, void* to, std::size_t count) {
    return read(from, to, count) == static_cast<ssize_t>(count);
}

// In a child process that wished for a set; before this one has asked which it has.
Answer with(const char* wish) {
    int ends[2];
    if (pipe(ends) != 0) return {};
    const pid_t child = fork();
    if (child == 0) {
        setenv("AWAN_INSTRUCTIONS", wish, 1);
        const InstructionSet used = instruction_set();
        bool sent = write_all(ends[1], &used, sizeof used);
        for (const Case& one : kCases) {
            const std::string bytes = bytes_of(one);
            const std::size_t hash = std::hash<std::string_view>{}(bytes), size = bytes.size();
            sent = sent && write_all(ends[1], &hash, sizeof hash) &&
                   write_all(ends[1], &size, sizeof size);
        }
        _exit(sent ? 0 : 1);
    }
    close(ends[1]);
    Answer answer{};
    bool got = read_all(ends[0], &answer.used, sizeof answer.used);
    for (std::size_t i = 0; got && i < std::size(kCases); ++i) {
        std::size_t hash = 0, size = 0;
        got = read_all(ends[0], &hash, sizeof hash) && read_all(ends[0], &size, sizeof size);
        answer.hashes.push_back(hash);
        answer.sizes.push_back(size);
    }
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(got && status == 0) << wish;
    return answer;
}

TEST(InstructionSets, GiveTheSameBits) {
    const Answer widest = with("");
    for (const std::size_t size : widest.sizes) EXPECT_GT(size, 16u * 12u * 16u);
    const struct {
        const char* wish;
        InstructionSet set;
    } narrower[] = {{"plain", InstructionSet::kPlain}, {"avx2", InstructionSet::kAvx2}};
    for (const auto& [wish, set] : narrower) {
        if (widest.used <= set) continue;  // this processor has none that is wider
        const Answer answer = with(wish);
        EXPECT_EQ(answer.used, set) << wish;
        EXPECT_EQ(answer.hashes, widest.hashes) << wish;
        EXPECT_EQ(answer.sizes, widest.sizes) << wish;
    }
}

TEST(InstructionSets, AWishNarrowsAndNeverWidens) {
    using enum InstructionSet;
    EXPECT_EQ(instruction_set_for("", kAvx512), kAvx512);
    EXPECT_EQ(instruction_set_for("avx2", kAvx512), kAvx2);
    EXPECT_EQ(instruction_set_for("plain", kAvx512), kPlain);
    EXPECT_EQ(instruction_set_for("avx2", kPlain), kPlain);
    EXPECT_EQ(instruction_set_for("avx512", kAvx2), kAvx2);
    EXPECT_EQ(instruction_set_for("sse9", kAvx2), kAvx2);
}

}  // namespace
}  // namespace awan
