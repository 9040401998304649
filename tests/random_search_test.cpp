// Random scenes through the whole pipeline, against what must hold for every one: finite, within physical bounds, the
// same bytes again, in bounded time and memory. A failure names its seed; AWAN_SEARCH_SEED=<seed> AWAN_SEARCH_COUNT=1
// renders that scene alone, AWAN_SEARCH_COUNT=<n> more or fewer of them.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

#include "tests/physical_bounds.h"
#include "tests/random_models.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using test::RandomScene;

constexpr std::uint64_t kFirstSeed = 1;
constexpr std::uint64_t kCount = 400;
// A scene may take so long, of processor: the finest grid on deep matter takes 10 here, two paths a pixel through
// matter that no path crosses 24; other machines are slower.
constexpr double kMaxSeconds = 120;
constexpr long kMaxMemoryKib = 3 << 19;  // of the process at its peak: 1.5 GiB

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

Rendered render(const Scene& scene, int threads) {
    auto planned = plan_scene(scene, threads, {});
    if (!planned.ok()) {
        ADD_FAILURE() << planned.error().message;
        return {};
    }
    planned->plan.samples = 2;  // what rung truth would like takes as long as it takes
    auto rendered =
        render_planned(scene, *std::move(planned), {&test::device(), threads, nullptr, {}, {}}, {});
    if (!rendered.ok()) {
        ADD_FAILURE() << rendered.error().message;
        return {};
    }
    return *std::move(rendered);
}

TEST(RandomSearch, EverySceneKeepsTheLaws) {
    const std::uint64_t first = from_environment("AWAN_SEARCH_SEED", kFirstSeed);
    const std::uint64_t count = from_environment("AWAN_SEARCH_COUNT", kCount);
    int failed = 0, apart = 0;
    std::map<std::string, std::pair<int, double>> spent;  // by rung: scenes, seconds
    for (std::uint64_t seed = first; seed < first + count && failed < 20; ++seed) {
        const RandomScene random = test::random_scene_of_any_model(seed);
        SCOPED_TRACE("AWAN_SEARCH_SEED=" + std::to_string(seed) + " rung " +
                     random.draft.accuracy.rung.value_or("look") +
                     (random.furnace ? " furnace" : ""));
        auto scene = validate(random.draft);
        ASSERT_TRUE(scene.ok()) << scene.error().pointer << " " << scene.error().message;
        const std::clock_t start = std::clock();
        const Rendered rendered = render(*scene, 1);
        const double took = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        EXPECT_LT(took, kMaxSeconds);
        const Rendered again = render(*scene, 2);
        EXPECT_TRUE(again.image.pixels == rendered.image.pixels) << "other bytes on two threads";
        if (::testing::Test::HasFatalFailure()) return;
        test::expect_figures(rendered);
        if (random.draft.look == Look::kPhysical) {
            test::expect_within_bounds(random.draft, rendered);
        }
        apart += rendered.survey.islands.list.empty() ? 0 : 1;
        auto& [scenes, seconds] = spent[rendered.plan.rung];
        ++scenes;
        seconds += took;
        const auto* result = ::testing::UnitTest::GetInstance()->current_test_info()->result();
        if (result->Failed() && result->total_part_count() > failed) {
            failed = result->total_part_count();
        }
    }
    for (const auto& [rung, sum] : spent)
        std::printf("%-13s %5d scenes, %7.1f ms each\n", rung.c_str(), sum.first,
                    1e3 * sum.second / sum.first);
    std::printf("%d scenes of several islands\n", apart);
    if (count >= kCount) {
        EXPECT_GT(apart, 0);
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("most memory: %ld MiB\n", usage.ru_maxrss >> 10);
    EXPECT_LT(usage.ru_maxrss, kMaxMemoryKib);
}

}  // namespace
}  // namespace awan
