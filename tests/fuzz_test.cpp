// What the fuzzers found interesting, once more in every build (tests/fuzz/README.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "tests/fuzz/targets.h"
#include "tests/patience.h"

namespace awan::fuzz {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

struct Target {
    const char* name;
    void (*run)(std::string_view bytes);
};

// For a death: written where a debugger, or the file AWAN_FUZZ_KEEP, finds it.
std::string& last_input() {
    static std::string bytes;
    return bytes;
}
void keep_last_input(int signal) {
    if (const char* const path = std::getenv("AWAN_FUZZ_KEEP"))
        std::ofstream(path, std::ios::binary) << last_input();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}
const auto kKept = std::signal(SIGABRT, keep_last_input);

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, BreaksNoLaw) {
    const auto folder = std::filesystem::path(AWAN_TEST_DATA) / "fuzz" / GetParam().name;
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path().string());
        const std::string bytes = bytes_of(entry.path());
        GetParam().run(bytes);
        // Broken off where a network may break it off.
        GetParam().run(std::string_view(bytes).substr(0, bytes.size() / 2));
        ++count;
    }
    EXPECT_GE(count, 3);
    GetParam().run("");
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus,
                         testing::Values(Target{"json", fuzz_json}, Target{"awn", fuzz_awn},
                                         Target{"ply", fuzz_ply}, Target{"csv", fuzz_csv},
                                         Target{"file", fuzz_file}, Target{"form", fuzz_form},
                                         Target{"head", fuzz_head},
                                         Target{"request", fuzz_request}),
                         [](const auto& info) { return std::string(info.param.name); });

// A small fuzzer without feedback: what no fuzzer has been run on since it changed still meets some thousand inputs.
std::string mutated(std::string bytes, const std::vector<std::string>& others,
                    std::mt19937& chance) {
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : chance() % n; };
    for (std::size_t i = 1 + below(4); i > 0; --i) {
        const std::size_t at = below(bytes.size() + 1);
        const std::size_t length = below(std::min<std::size_t>(bytes.size() - at, 64) + 1);
        switch (below(7)) {
            case 0:  // a byte
                if (at < bytes.size()) bytes[at] = static_cast<char>(chance());
                break;
            case 1:  // a bit
                if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            case 2:  // less
                bytes.erase(at, length);
                break;
            case 3:  // more of the same
                bytes.insert(at, bytes.substr(at, length));
                break;
            case 4: {  // a piece of another
                const std::string& other = others[below(others.size())];
                bytes.insert(at, other.substr(below(other.size() + 1), 64));
                break;
            }
            case 5: {  // a number that is seldom thought of
                static constexpr std::array kNumbers = {
                    "-1",   "0",     "1e999", "4294967296", "nan", "18446744073709551616",
                    "-0.0", "1e-320"};
                bytes.replace(at, below(4), kNumbers[below(kNumbers.size())]);
                break;
            }
            default:  // the end
                bytes.resize(at);
        }
    }
    return bytes;
}

TEST_P(Corpus, MutatedBreaksNoLaw) {
    const auto folder = std::filesystem::path(AWAN_TEST_DATA) / "fuzz" / GetParam().name;
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        all.push_back(bytes_of(entry.path()));
    std::sort(all.begin(), all.end());
    const char* const asked = std::getenv("AWAN_FUZZ_COUNT");
    const long count = asked ? std::atol(asked) : test::or_fewer(10000L, 1000L);
    std::mt19937 chance(7);
    for (long i = 0; i < count; ++i) {
        const std::string bytes = mutated(all[chance() % all.size()], all, chance);
        last_input() = bytes;
        GetParam().run(bytes);
    }
}

TEST(Laws, EndTheProcessWhenTheyAreBroken) {
    EXPECT_DEATH(require(false, "one is two"), "broken law: one is two");
    require(true, "one is one");
}

}  // namespace
}  // namespace awan::fuzz
