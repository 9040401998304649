// Error measures on pictures whose error is known.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/accuracy/error_measures.h"
#include "core/truth/path_random.h"

namespace awan {
namespace {

constexpr int kWidth = 48, kHeight = 36;

// Normal noise by Box & Muller.
class Noise {
  public:
    explicit Noise(std::uint64_t key) : random_(key) {}
    double normal() {
        return std::sqrt(-2 * std::log(random_.unit())) *
               std::cos(2 * std::numbers::pi * random_.unit());
    }

  private:
    truth::PathRandom random_;
};

Image blank() {
    Image image{kWidth, kHeight, false, {}};
    image.pixels.resize(4 * image.pixel_count());
    return image;
}

// A smooth cloud in the middle, mean radiance about 1; outside alpha is 0.
Image cloud() {
    Image image = blank();
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double u = (x - 23.5) / 15, v = (y - 17.5) / 11, r = u * u + v * v;
            if (r > 1) continue;
            float* p = image.pixels.data() + 4 * (y * kWidth + x);
            p[0] = static_cast<float>(1 + 0.4 * u);
            p[1] = static_cast<float>(1 + 0.2 * v);
            p[2] = 0.9f;
            p[3] = 1;
        }
    return image;
}

// The same noise in the three channels, as paths of a white medium make it.
Image noisy(const Image& image, double sd, Noise& noise) {
    Image out = image;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const double n = sd * noise.normal();
        for (std::size_t c = 0; c < 3; ++c)
            if (image.pixels[4 * i + 3] > 0) out.pixels[4 * i + c] += static_cast<float>(n);
    }
    return out;
}

double mean_of_cloud(const Image& image) {
    double sum = 0, n = 0;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        if (image.pixels[4 * i + 3] <= 0) continue;
        for (std::size_t c = 0; c < 3; ++c) sum += static_cast<double>(image.pixels[4 * i + c]);
        n += 3;
    }
    return sum / n;
}

TEST(PictureError, DoesNotCountTheTruthsNoise) {
    const Image exact = cloud();
    const double mean = mean_of_cloud(exact);
    for (const double wrong : {0.1, 0.03}) {
        // An error of known size: a pattern of +-wrong.
        Image x = exact;
        for (std::size_t i = 0; i < x.pixel_count(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                if (x.pixels[4 * i + 3] > 0)
                    x.pixels[4 * i + c] += static_cast<float>(i % 2 == 0 ? wrong : -wrong);
        double squares = 0, noises = 0, spread = 0, truth_noise = 0;
        const int trials = 200;
        const double expected = wrong / mean;
        for (int t = 0; t < trials; ++t) {
            Noise noise(static_cast<std::uint64_t>(t));
            const TruthImage truth{noisy(exact, 0.1, noise), noisy(exact, 0.1, noise), 0};
            const PictureError e = picture_error(x, truth);
            squares += e.nrmse * e.nrmse;
            noises += e.nrmse_noise;
            spread += (e.nrmse - expected) * (e.nrmse - expected);
            truth_noise += e.truth_noise;
            EXPECT_EQ(e.pixels, picture_error(exact, truth).pixels);
        }
        // Plain RMSE against the mean picture would say sqrt(wrong^2 + .1^2 / 2).
        EXPECT_NEAR(std::sqrt(squares / trials) / expected, 1, wrong == 0.1 ? 0.005 : 0.02);
        // The stated noise is the spread over trials.
        EXPECT_NEAR(noises / trials / std::sqrt(spread / trials), 1, 0.2);
        EXPECT_NEAR(truth_noise / trials, 0.1 / std::sqrt(2.0) / mean, 0.002);
    }
}

TEST(PictureError, OfTheTruthItselfIsWithinItsNoise) {
    const Image exact = cloud();
    int within = 0;
    for (int t = 0; t < 100; ++t) {
        Noise noise(static_cast<std::uint64_t>(1000 + t));
        const TruthImage truth{noisy(exact, 0.2, noise), noisy(exact, 0.2, noise), 0};
        const PictureError e = picture_error(exact, truth);
        within += e.nrmse < 2 * e.nrmse_noise;
    }
    EXPECT_GT(within, 90);
}

TEST(PictureError, BiasIsSignedAndHasItsNoise) {
    const Image exact = cloud();
    Image brighter = exact;
    for (std::size_t i = 0; i < brighter.pixels.size(); ++i)
        if (i % 4 != 3) brighter.pixels[i] *= 1.1f;
    double sum = 0, spread = 0, noises = 0;
    const int trials = 200;
    for (int t = 0; t < trials; ++t) {
        Noise noise(static_cast<std::uint64_t>(t));
        const TruthImage truth{noisy(exact, 0.3, noise), noisy(exact, 0.3, noise), 0};
        const PictureError e = picture_error(brighter, truth);
        sum += e.bias;
        spread += (e.bias - 0.1) * (e.bias - 0.1);
        noises += e.bias_noise;
    }
    EXPECT_NEAR(sum / trials, 0.1, 0.003);
    EXPECT_NEAR(noises / trials / std::sqrt(spread / trials), 1, 0.2);
    const TruthImage clean{exact, exact, 0};
    const PictureError e = picture_error(brighter, clean);
    EXPECT_NEAR(e.bias, 0.1, 1e-6);
    EXPECT_EQ(e.bias_noise, 0);
    EXPECT_EQ(e.nrmse_noise, 0);
    EXPECT_GT(e.nrmse, 0.1);
}

TEST(PictureError, OfNothing) {
    const TruthImage nothing{blank(), blank(), 0};
    EXPECT_EQ(picture_error(blank(), nothing).pixels, 0u);
    EXPECT_EQ(picture_error(blank(), nothing).nrmse, 0);
    Image black = cloud();  // matter that is black
    for (std::size_t i = 0; i < black.pixels.size(); ++i)
        if (i % 4 != 3) black.pixels[i] = 0;
    const TruthImage dark{black, black, 0};
    EXPECT_EQ(picture_error(black, dark).nrmse, 0);
    EXPECT_EQ(picture_error(cloud(), dark).nrmse, 1);
    EXPECT_GT(picture_error(cloud(), dark).pixels, 100u);
}

TEST(PictureError, LooksAtCloudPixelsOnly) {
    const Image exact = cloud();
    Image x = exact;
    for (std::size_t i = 0; i < x.pixel_count(); ++i)
        if (x.pixels[4 * i + 3] == 0) x.pixels[4 * i] = 100;
    const TruthImage truth{exact, exact, 0};
    EXPECT_EQ(picture_error(x, truth).nrmse, 0);
}

// --- FLIP

using Bytes = std::vector<std::uint8_t>;

Bytes plain(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    Bytes bytes;
    for (int i = 0; i < width * height; ++i) bytes.insert(bytes.end(), {r, g, b});
    return bytes;
}

Bytes waves(int width, int height) {
    Bytes bytes;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                bytes.push_back(static_cast<std::uint8_t>(128 + 60 * std::sin(0.11 * x + c) *
                                                                    std::cos(0.07 * y)));
    return bytes;
}

TEST(Flip, OfEqualPicturesIsNothing) {
    const Bytes a = waves(70, 50);
    const FlipResult result = flip(a, a, 70, 50);
    EXPECT_EQ(result.mean, 0);
    EXPECT_EQ(result.map.size(), 3500u);
}

TEST(Flip, IsTheSameEitherWay) {
    const Bytes a = waves(70, 50), b = plain(70, 50, 120, 140, 100);
    EXPECT_NEAR(flip(a, b, 70, 50).mean, flip(b, a, 70, 50).mean, 1e-9);
}

// Even pictures have no features, so their difference is that of the colours alone; by hand from the paper's
// section 4: white and black are 100 apart in L, blue and green, the farthest, 203.3 in HyAB after Hunt's adjustment.
TEST(Flip, OfEvenPicturesIsTheColorsDifference) {
    const double most = std::pow(203.3, 0.7), knee = 0.4 * most;
    const auto remapped = [&](double hyab) {
        const double e = std::pow(hyab, 0.7);
        return e < knee ? 0.95 / knee * e : 0.95 + 0.05 * (e - knee) / (most - knee);
    };
    EXPECT_NEAR(flip(plain(40, 30, 0, 0, 0), plain(40, 30, 255, 255, 255), 40, 30).mean,
                remapped(100), 0.002);
    // sRGB 119 is L = 50.03 (CIE 1976).
    EXPECT_NEAR(flip(plain(40, 30, 0, 0, 0), plain(40, 30, 119, 119, 119), 40, 30).mean,
                remapped(50.03), 0.002);
    EXPECT_NEAR(flip(plain(40, 30, 0, 255, 0), plain(40, 30, 0, 0, 255), 40, 30).mean, 1, 0.001);
}

TEST(Flip, RisesWithTheDifference) {
    const Bytes a = waves(64, 48);
    double last = 0;
    for (const int change : {2, 5, 10, 20, 40}) {
        Bytes b = a;
        for (std::uint8_t& v : b) v = static_cast<std::uint8_t>(v + change);
        const double mean = flip(a, b, 64, 48).mean;
        EXPECT_GT(mean, last);
        last = mean;
    }
    EXPECT_LT(last, 0.8);
}

TEST(Flip, SeesFineNoiseLessFromAfar) {
    const Bytes a = plain(64, 64, 128, 128, 128);
    Bytes b = a;
    for (std::size_t i = 0; i < b.size(); ++i)
        b[i] = static_cast<std::uint8_t>((i / 3 + i / 192) % 2 == 0 ? 108 : 148);
    const double near = flip(a, b, 64, 64, 20).mean, far = flip(a, b, 64, 64, 120).mean;
    EXPECT_GT(near, 2 * far);
}

TEST(Flip, SharpensWhereEdgesDiffer) {
    const Bytes a = plain(64, 64, 128, 128, 128);
    Bytes line = a, area = a;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto at = static_cast<std::size_t>(3 * (y * 64 + x) + c);
                area[at] = 150;
                if (x >= 32) line[at] = 150;
            }
    // At the edge the step is seen more than the same difference without one.
    const FlipResult with = flip(a, line, 64, 64), without = flip(a, area, 64, 64);
    EXPECT_GT(with.map[32 * 64 + 34], without.map[32 * 64 + 34] + 0.02f);
    EXPECT_NEAR(with.map[32 * 64 + 60], without.map[32 * 64 + 60], 0.01);
    EXPECT_LT(with.map[32 * 64 + 2], 0.01f);
}

TEST(Flip, IsQuick) {
    const Bytes a = waves(512, 384), b = plain(512, 384, 120, 140, 100);
    const auto start = std::chrono::steady_clock::now();
    const FlipResult result = flip(a, b, 512, 384);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_GT(result.mean, 0);
#ifndef AWAN_SANITIZED
    EXPECT_LT(took.count(), 3);  // about .3 s by itself
#endif
    RecordProperty("milliseconds", static_cast<int>(took.count() * 1000));
}

}  // namespace
}  // namespace awan
