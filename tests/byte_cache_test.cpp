// What is kept within so many bytes, least recently used first to go.
#include "core/base/byte_cache.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace awan {
namespace {

struct Text {
    std::string text;
    std::size_t bytes() const { return text.size(); }
};

std::shared_ptr<const Text> text_of(std::size_t bytes, char c = 'x') {
    return std::make_shared<const Text>(Text{std::string(bytes, c)});
}

TEST(ByteCache, WhatWasUsedLastStays) {
    ByteCache<Text> cache(30);
    for (const char* key : {"a", "b", "c"}) cache.keep(key, text_of(10));
    EXPECT_TRUE(cache.find("a"));
    cache.keep("d", text_of(10));
    EXPECT_FALSE(cache.find("b"));
    EXPECT_TRUE(cache.find("a") && cache.find("c") && cache.find("d"));
    EXPECT_EQ(cache.entries(), 3u);
    EXPECT_EQ(cache.bytes_in_use(), 30u);
    cache.keep("e", text_of(11));
    EXPECT_EQ(cache.entries(), 2u) << "one byte more takes the room of two";
    EXPECT_TRUE(cache.find("e") && cache.find("d"));
}

TEST(ByteCache, WhatTakesAnothersPlaceTakesItsBytesToo) {
    ByteCache<Text> cache(30);
    cache.keep("other", text_of(10));
    for (int i = 0; i < 9; ++i) cache.keep("same", text_of(20));
    EXPECT_EQ(cache.bytes_in_use(), 30u);
    cache.keep("same", text_of(5, 'y'));
    EXPECT_EQ(cache.bytes_in_use(), 15u);
    EXPECT_EQ(cache.find("same")->text, "yyyyy");
    EXPECT_TRUE(cache.find("other"));
}

TEST(ByteCache, OneValuePushesOutNoMoreThanItsShare) {
    ByteCache<Text> cache(80, 10);
    for (int i = 0; i < 8; ++i) cache.keep(std::to_string(i), text_of(10));
    cache.keep("large", text_of(11));
    EXPECT_FALSE(cache.find("large"));
    EXPECT_EQ(cache.entries(), 8u);
}

TEST(ByteCache, OfNoBytesKeepsNothing) {
    ByteCache<Text> cache(0);
    EXPECT_FALSE(cache.keeps());
    cache.keep("a", text_of(1));
    EXPECT_FALSE(cache.find("a"));
    EXPECT_TRUE(ByteCache<Text>(1).keeps());
}

TEST(ByteCache, ManyThreadsAtOnce) {
    ByteCache<Text> cache(1000);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&cache, t] {
            for (int i = 0; i < 500; ++i) {
                const int key = (7 * i + t) % 40;
                const auto found = cache.find(std::to_string(key));
                if (found) {
                    EXPECT_EQ(found->bytes(), static_cast<std::size_t>(10 + key));
                }
                cache.keep(std::to_string(key), text_of(static_cast<std::size_t>(10 + key)));
                EXPECT_LE(cache.bytes_in_use(), 1000u);
            }
        });
    for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace awan
