// Answers that outlive the server: whatever happens to their files, what is served is what was kept, or nothing.
#include "server/service/disk_cache.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "server/service/kept_file.h"
#include "server/service/negotiation.h"
#include "service_fixture.h"

namespace awan::test {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const KeptResult> result_of(const std::string& body) {
    return std::make_shared<const KeptResult>(
        KeptResult{{{"Content-Type", "image/png"}, {"Awan-Rung", "harris"}, {"Empty", ""}},
                   std::make_shared<const std::string>(body)});
}

std::string tag_of(const std::string& what) {
    return make_etag({what});
}

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
void write_bytes(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

class DiskCacheTest : public testing::Test {
  protected:
    DiskCacheTest() {
        std::string name = (fs::temp_directory_path() / "awan-disk-XXXXXX").string();
        root = mkdtemp(name.data());
        folder = root / "kept";
    }
    ~DiskCacheTest() override { fs::remove_all(root); }

    std::shared_ptr<DiskCache> open(std::size_t bytes = 64u << 20) {
        DiskCacheOptions options;
        options.folder = folder.string();
        options.bytes = bytes;
        options.say = [this](const std::string& what) { said.push_back(what); };
        auto cache = DiskCache::open(std::move(options));
        EXPECT_TRUE(cache.ok());
        return *std::move(cache);
    }
    fs::path file_of(const std::string& what) const {
        return folder / (tag_of(what).substr(1, 32) + ".kept");
    }
    void keep(DiskCache& cache, const std::string& what, const std::string& body) {
        cache.keep(tag_of(what), result_of(body));
        cache.flush();
    }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    fs::path root, folder;
    std::vector<std::string> said;
};

TEST_F(DiskCacheTest, WhatIsKeptOutlivesIt) {
    std::string body(100'000, '\0');
    for (std::size_t i = 0; i < body.size(); ++i) body[i] = static_cast<char>(i * i >> 3);
    keep(*open(), "a", body);
    const auto cache = open();
    EXPECT_EQ(cache->counts().entries, 1u);
    const auto found = cache->find(tag_of("a"));
    ASSERT_TRUE(found);
    EXPECT_EQ(*found->body, body);
    EXPECT_EQ(found->headers, result_of("")->headers);
    EXPECT_FALSE(cache->find(tag_of("b")));
    EXPECT_FALSE(cache->find("no tag"));
    EXPECT_FALSE(cache->find("\"../../../../../../../../etc/passwd\""));
    EXPECT_EQ(cache->counts().hits, 1u);
    EXPECT_EQ(cache->counts().damaged, 0u);
    struct stat about {};
    ASSERT_EQ(stat(file_of("a").c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 077, 0u) << "others need not read what was asked for";
}

TEST_F(DiskCacheTest, ClosingWritesWhatWaits) {
    {
        const auto cache = open();
        for (int i = 0; i < 20; ++i) cache->keep(tag_of(std::to_string(i)), result_of("x"));
    }
    EXPECT_EQ(files(), 20u);
}

// --- damage

// After each change to the file nothing is found, the file is gone, and it is counted.
TEST_F(DiskCacheTest, NoDamagedFileIsServed) {
    const auto cache = open();
    keep(*cache, "a", "some body");
    const std::string whole = bytes_of(file_of("a"));
    std::size_t damaged = 0;
    const auto expect_dropped = [&](const std::string& bytes, const std::string& what) {
        write_bytes(file_of("a"), bytes);
        EXPECT_FALSE(cache->find(tag_of("a"))) << what;
        EXPECT_FALSE(fs::exists(file_of("a"))) << what;
        EXPECT_EQ(cache->counts().damaged, ++damaged) << what;
    };
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const int bit : {0, 3, 7}) {
            std::string bytes = whole;
            bytes[i] = static_cast<char>(bytes[i] ^ (1 << bit));
            expect_dropped(bytes, "byte " + std::to_string(i));
        }
    for (std::size_t length = 0; length < whole.size(); ++length)
        expect_dropped(whole.substr(0, length), "cut at " + std::to_string(length));
    expect_dropped(whole + '\0', "a byte more");
    expect_dropped(whole + whole, "twice");
    expect_dropped(std::string(whole.size(), '\0'), "zeros, as after a power cut");
    expect_dropped("{\"a\": \"JSON file\"}", "another program's");
    write_bytes(file_of("a"), whole);
    EXPECT_TRUE(cache->find(tag_of("a"))) << "it was the damage";
}

TEST_F(DiskCacheTest, FilesThatWereSwappedAreNoOnesAnswer) {
    const auto cache = open();
    keep(*cache, "a", "the body of a");
    keep(*cache, "b", "the body of b");
    fs::rename(file_of("a"), root / "c");
    fs::rename(file_of("b"), file_of("a"));
    fs::rename(root / "c", file_of("b"));
    EXPECT_FALSE(cache->find(tag_of("a")));
    EXPECT_FALSE(cache->find(tag_of("b")));
    EXPECT_EQ(cache->counts().damaged, 2u);
    EXPECT_EQ(files(), 0u);
}

TEST_F(DiskCacheTest, ThePartsOfTwoFilesMakeNone) {
    const auto cache = open();
    keep(*cache, "a", "body 1");
    const std::string first = bytes_of(file_of("a"));
    keep(*cache, "a", "body 2");
    const std::string second = bytes_of(file_of("a"));
    ASSERT_EQ(first.size(), second.size());
    for (const std::size_t cut : {kKeptHeaderBytes, first.size() - 6}) {
        write_bytes(file_of("a"), first.substr(0, cut) + second.substr(cut));
        EXPECT_FALSE(cache->find(tag_of("a"))) << cut;
    }
}

TEST_F(DiskCacheTest, WhatIsNoFileIsNotRead) {
    const auto cache = open();
    write_bytes(root / "elsewhere", kept_head(tag_of("a"), *result_of("x")) + "x");
    fs::create_symlink(root / "elsewhere", file_of("a"));
    EXPECT_FALSE(cache->find(tag_of("a")));
    EXPECT_TRUE(fs::exists(root / "elsewhere"));
    ASSERT_EQ(mkfifo(file_of("b").c_str(), 0600), 0);
    EXPECT_FALSE(cache->find(tag_of("b"))) << "and nobody waits for its writer";
    fs::create_directory(file_of("c"));
    EXPECT_FALSE(cache->find(tag_of("c")));
    keep(*cache, "a", "x");
    EXPECT_TRUE(cache->find(tag_of("a")));
}

// --- bounds

TEST_F(DiskCacheTest, WhatWasUsedLastStays) {
    constexpr std::size_t kEach = 8 * 4096;
    const auto cache = open(10 * kEach);
    const std::string body(kEach - 1000, 'x');
    for (int i = 0; i < 10; ++i) {
        keep(*cache, std::to_string(i), body);
        // Times of files come in steps of a few ms.
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
    EXPECT_EQ(cache->counts().bytes, 10 * kEach);
    EXPECT_TRUE(cache->find(tag_of("0")));
    keep(*cache, "10", body);
    EXPECT_TRUE(cache->find(tag_of("0")));
    EXPECT_FALSE(cache->find(tag_of("1"))) << "the oldest but the one that was used";
    EXPECT_TRUE(cache->find(tag_of("10")));
    EXPECT_EQ(cache->counts().evicted, 2u) << "down to nine tenths";
    EXPECT_LE(cache->counts().bytes, 10 * kEach);
    keep(*cache, "large", std::string(10 * kEach / 8, 'x'));
    EXPECT_FALSE(cache->find(tag_of("large"))) << "one answer must not push out all others";
}

TEST_F(DiskCacheTest, TheBoundHoldsForWhatAnotherServerWrote) {
    constexpr std::size_t kEach = 8 * 4096;
    const std::string body(kEach - 1000, 'x');
    const auto one = open(10 * kEach), other = open(10 * kEach);
    for (int i = 0; i < 40; ++i) keep(i % 2 == 0 ? *one : *other, std::to_string(i), body);
    EXPECT_LE(files(), 20u) << "each has counted the other's";
    keep(*open(5 * kEach), "last", "x");
    EXPECT_LE(files(), 5u) << "a smaller bound holds from the first answer on";
}

TEST_F(DiskCacheTest, OthersFilesAreLeftAlone) {
    fs::create_directory(folder);
    for (const char* name : {"notes.txt", "0123.kept", ".awan-x.tmp2"})
        write_bytes(folder / name, std::string(10'000, 'x'));
    const auto cache = open(8 * 4096);
    for (int i = 0; i < 20; ++i) keep(*cache, std::to_string(i), "x");
    for (const char* name : {"notes.txt", "0123.kept", ".awan-x.tmp2"})
        EXPECT_EQ(fs::file_size(folder / name), 10'000u);
}

TEST_F(DiskCacheTest, LeftoversOfKilledWritesAreCleaned) {
    fs::create_directory(folder);
    write_bytes(folder / ".awan-1-0.tmp", "half");
    write_bytes(folder / ".awan-1-1.tmp", "of one that is being written");
    const int busy = ::open((folder / ".awan-1-1.tmp").c_str(), O_RDONLY);
    ASSERT_EQ(flock(busy, LOCK_EX), 0);
    open();
    EXPECT_FALSE(fs::exists(folder / ".awan-1-0.tmp"));
    EXPECT_TRUE(fs::exists(folder / ".awan-1-1.tmp"));
    ::close(busy);
}

// --- a disk that fails

TEST_F(DiskCacheTest, AFullDiskIsSaidOnceAndCounted) {
    const auto cache = open();
    const auto before = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit full{4096, limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    for (int i = 0; i < 3; ++i) keep(*cache, std::to_string(i), std::string(10'000, 'x'));
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, before);
    EXPECT_EQ(files(), 0u) << "no half of one either";
    EXPECT_EQ(cache->counts().failed, 3u);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find(folder.string()), std::string::npos) << said[0];
    keep(*cache, "a", "x");
    EXPECT_TRUE(cache->find(tag_of("a"))) << "once there is room again";
}

TEST_F(DiskCacheTest, AFolderThatGoesIsNoFailureButOfKeeping) {
    const auto cache = open();
    keep(*cache, "a", "x");
    fs::remove_all(folder);
    EXPECT_FALSE(cache->find(tag_of("a")));
    keep(*cache, "b", "x");
    EXPECT_EQ(cache->counts().failed, 1u);
    EXPECT_EQ(said.size(), 1u);
    EXPECT_EQ(cache->counts().damaged, 0u);
}

TEST_F(DiskCacheTest, AFolderThatCannotBeIsSaidAtTheStart) {
    write_bytes(root / "file", "x");
    for (const std::string path : {"file", "file/below", "none/below"}) {
        DiskCacheOptions options;
        options.folder = (root / path).string();
        const auto cache = DiskCache::open(std::move(options));
        ASSERT_FALSE(cache.ok()) << path;
        EXPECT_EQ(cache.error().code, ErrorCode::kIo);
        EXPECT_NE(cache.error().message.find(path), std::string::npos);
    }
}

TEST_F(DiskCacheTest, NoMoreWaitsThanMay) {
    DiskCacheOptions options;
    options.folder = (root / "b").string();
    options.most_waiting = 1;
    const auto cache = DiskCache::open(std::move(options));
    ASSERT_TRUE(cache.ok());
    for (int i = 0; i < 200; ++i)
        (*cache)->keep(tag_of(std::to_string(i)), result_of(std::string(100'000, 'x')));
    (*cache)->flush();
    const DiskCache::Counts counts = (*cache)->counts();
    EXPECT_GT(counts.entries, 0u);
    EXPECT_EQ(counts.entries + counts.skipped, 200u);
}

TEST_F(DiskCacheTest, ManyThreadsAtOnce) {
    const auto cache = open(40 * 4096);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&cache, t] {
            for (int i = 0; i < 100; ++i) {
                const std::string what = std::to_string((7 * i + t) % 30);
                if (const auto found = cache->find(tag_of(what))) {
                    EXPECT_EQ(*found->body, what);
                }
                cache->keep(tag_of(what), result_of(what));
            }
        });
    for (std::thread& thread : threads) thread.join();
    cache->flush();
    EXPECT_EQ(cache->counts().damaged, 0u);
    EXPECT_EQ(cache->counts().failed, 0u);
}

// --- of the service

class ServiceOnDisk : public DiskCacheTest {
  protected:
    // One answer of a service that begins anew.
    Response ask(const std::string& scene, std::size_t memory = 0) {
        FakeRenderer renderer;
        RenderThread thread(renderer.opener());
        Metrics metrics;
        ServiceOptions options;
        options.on_processor = renderer.on_processor();
        options.disk = open();
        options.cache_bytes = memory;
        Service service(thread, metrics, options);
        Response first = service.answer(make_request("POST", "/v1/render", scene));
        begun += renderer.begun();
        options.disk->flush();
        text = service.answer(make_request("GET", "/metrics")).body;
        if (memory > 0) {
            const Response again = service.answer(make_request("POST", "/v1/render", scene));
            EXPECT_EQ(again.header("Awan-Cache"), "hit") << "what came from disk is in memory then";
        }
        return first;
    }
    int begun = 0;
    std::string text;
};

TEST_F(ServiceOnDisk, AnswersAreFoundByTheServerAfterThisOne) {
    const Response first = ask(kScene);
    EXPECT_EQ(first.header("Awan-Cache"), "miss");
    EXPECT_NE(text.find("awan_cache_disk_entries 1\n"), std::string::npos);
    for (const std::size_t memory : {0u, 1u << 20}) {
        const Response again = ask(" " + std::string(kScene), memory);
        EXPECT_EQ(again.header("Awan-Cache"), "disk");
        EXPECT_EQ(again.reason, "disk hit");
        EXPECT_EQ(again.bytes(), first.bytes());
        for (const char* name : {"ETag", "Awan-Rung", "Awan-Error", "Content-Type", "Vary"})
            EXPECT_EQ(again.header(name), first.header(name));
        EXPECT_NE(text.find("awan_cache_disk_hits_total 1\n"), std::string::npos) << text;
    }
    EXPECT_EQ(begun, 1);
}

TEST_F(ServiceOnDisk, DamageIsRenderedAnew) {
    const Response first = ask(kScene);
    ASSERT_EQ(files(), 1u);
    const fs::path file = fs::directory_iterator(folder)->path();
    std::string bytes = bytes_of(file);
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    write_bytes(file, bytes);
    const Response again = ask(kScene);
    EXPECT_EQ(again.status, 200);
    EXPECT_EQ(again.header("Awan-Cache"), "miss");
    EXPECT_EQ(again.bytes(), first.bytes());
    EXPECT_NE(text.find("awan_cache_disk_damaged_total 1\n"), std::string::npos);
    EXPECT_EQ(begun, 2);
    EXPECT_EQ(ask(kScene).header("Awan-Cache"), "disk");
}

}  // namespace
}  // namespace awan::test
