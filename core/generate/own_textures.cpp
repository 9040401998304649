// Each texture is a function of a point (x, y) of the square from -1 to 1, y up: how deep the matter is there, 0 to 1,
// 0 from the unit circle on. Noise is of a lattice (values at whole points, smooth between, octaves added), and nothing
// but sums, products, roots and exact_math goes in, so that every machine makes the same bytes.
#include "core/generate/own_textures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/exact_math.h"
#include "core/generate/keyed_random.h"
#include "core/scene/scene.h"

namespace awan {
namespace {

double value_at(std::uint64_t key, double x, double y) {
    const auto ix = static_cast<std::int64_t>(x), iy = static_cast<std::int64_t>(y);
    return unit_open(static_cast<std::uint32_t>(
        keyed(keyed(key, static_cast<std::uint64_t>(ix)), static_cast<std::uint64_t>(iy)) >> 32));
}

double smooth(double t) {
    return t * t * t * (t * (6 * t - 15) + 10);
}

// 0..1, of features about as large as 1.
double noise(std::uint64_t key, double x, double y) {
    const double x0 = std::floor(x), y0 = std::floor(y);
    const double u = smooth(x - x0), v = smooth(y - y0);
    const double low = value_at(key, x0, y0) * (1 - u) + value_at(key, x0 + 1, y0) * u;
    const double high = value_at(key, x0, y0 + 1) * (1 - u) + value_at(key, x0 + 1, y0 + 1) * u;
    return low * (1 - v) + high * v;
}

// Octaves of noise, each half as large and half as strong, turned by the angle whose cosine is .8 so that their
// lattices do not show; about 0..1.
double octaves(std::uint64_t key, double x, double y, int count) {
    double sum = 0, weight = 0, share = 1;
    for (int i = 0; i < count; ++i, share *= 0.5) {
        sum += share * noise(keyed(key, static_cast<std::uint64_t>(i)), x, y);
        weight += share;
        const double turned = 2 * (0.8 * x - 0.6 * y);
        y = 2 * (0.6 * x + 0.8 * y);
        x = turned;
    }
    return sum / weight;
}

double rise(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

constexpr std::uint64_t kKey = 0x617761;

double soft(double x, double y) {
    const double rim = exact::seeded_exp(-4.5);
    return (exact::seeded_exp(-4.5 * (x * x + y * y)) - rim) / (1 - rim);
}

// As deep as a ball, its radius by noise.
double puff(std::uint64_t key, double x, double y) {
    const double r = std::sqrt(x * x + y * y);
    const double bumps = octaves(key, 2.6 * x + 9, 2.6 * y + 9, 5);
    const double inside = 0.8 - r + 0.7 * (bumps - 0.5);
    return rise(0, 0.55, inside) * (0.7 + 0.6 * (bumps - 0.5)) * rise(1, 0.85, r);
}

struct Lobe {
    double x, y, r;
};

// Balls upon the rims of balls.
std::vector<Lobe> lobes() {
    std::vector<Lobe> all = {{0, -0.05, 0.5}};
    std::uint64_t bits = keyed(kKey, 2);
    const auto random = [&bits] {
        bits = keyed(bits, 1);
        return unit_open(static_cast<std::uint32_t>(bits >> 32));
    };
    std::size_t first = 0;
    for (const int children : {11, 5, 4}) {
        const std::size_t last = all.size();
        for (std::size_t parent = first; parent < last; ++parent)
            for (int i = 0; i < children; ++i) {
                const exact::SinCos way =
                    exact::sincos_degrees(360 * (i + 0.8 * random()) / children);
                const Lobe of = all[parent];
                const double r = of.r * (0.36 + 0.2 * random()),
                             out = of.r * (0.72 + 0.2 * random());
                const Lobe child{of.x + out * way.cos, of.y + out * way.sin, r};
                if (std::sqrt(child.x * child.x + child.y * child.y) + r < 0.98)
                    all.push_back(child);
            }
        first = last;
    }
    return all;
}

double cauliflower(const std::vector<Lobe>& balls, double x, double y) {
    // The small balls share what the large ones leave, so that their rims show on the body.
    double left = 1;
    for (const Lobe& ball : balls) {
        const double dx = x - ball.x, dy = y - ball.y;
        const double chord2 = ball.r * ball.r - dx * dx - dy * dy;
        if (chord2 > 0) left *= 1 - (0.3 + 0.9 * ball.r) * std::sqrt(chord2) / ball.r;
    }
    return 1 - left;
}

double torn(double x, double y) {
    const double r2 = x * x + y * y;
    const double wide = octaves(kKey + 3, 2.2 * x + 7, 2.2 * y + 7, 6);
    const double ridge = 1 - std::abs(2 * octaves(kKey + 4, 3 * x + 5, 3 * y + 5, 5) - 1);
    return rise(0.18, 0.75, 1.15 * wide * ridge * (1 - r2) + 0.25 * (wide - 0.5)) *
           rise(1, 0.7, r2);
}

double wisp(double x, double y) {
    const double bent = y + 0.22 * (octaves(kKey + 5, 1.3 * x + 3, 3, 3) - 0.5) + 0.1 * x * x;
    const double threads =
        1 - std::abs(2 * octaves(kKey + 6, 1.1 * x + 4, 7 * bent + 4 + 0.8 * x, 5) - 1);
    const double body = std::max(0.0, 1 - x * x - 6.5 * bent * bent);
    return rise(0.55, 1.05, threads) * body * rise(1, 0.8, x * x + y * y);
}

double hard(double x, double y) {
    const double r = std::sqrt(x * x + y * y);
    const double rim = 0.72 + 0.5 * (octaves(kKey + 7, 3.1 * x + 8, 3.1 * y + 8, 5) - 0.5);
    if (!(r < rim)) return 0;
    const double in = r / rim;
    return (0.45 + 0.55 * std::sqrt(1 - in * in)) * rise(0.98, 0.9, r);
}

}  // namespace

std::vector<std::uint8_t> own_texture_depth(std::size_t place) {
    const std::vector<Lobe> balls = lobes();
    const auto at = [&](double x, double y) {
        switch (place) {
            case 0:
                return soft(x, y);
            case 1:
                return puff(kKey + 1, x, y);
            case 2:
                return cauliflower(balls, x, y);
            case 3:
                return torn(x, y);
            case 4:
                return wisp(x, y);
            default:
                return hard(x, y);
        }
    };
    // The mean of so many points a side.
    constexpr int kPoints = 3;
    std::vector<double> depth;
    const double step = 2.0 / (kTextureSide * kPoints);
    for (int row = 0; row < kTextureSide; ++row)
        for (int column = 0; column < kTextureSide; ++column) {
            double sum = 0;
            for (int i = 0; i < kPoints * kPoints; ++i) {
                const double x = step * (kPoints * column + i % kPoints + 0.5) - 1;
                const double y = 1 - step * (kPoints * row + i / kPoints + 0.5);
                sum += x * x + y * y < 1 ? std::max(0.0, at(x, y)) : 0;
            }
            depth.push_back(sum);
        }
    const double most = *std::max_element(depth.begin(), depth.end());
    std::vector<std::uint8_t> bytes;
    for (const double one : depth)
        bytes.push_back(static_cast<std::uint8_t>(255 * one / most + 0.5));
    return bytes;
}

std::vector<float> generated_puff(std::uint64_t key, int side) {
    std::vector<float> texels;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double x = (2 * column + 1.0) / side - 1, y = 1 - (2 * row + 1.0) / side;
            const double depth = x * x + y * y < 1 ? puff(key, x, y) : 0;
            texels.push_back(static_cast<float>(std::clamp(depth, 0.0, 1.0)));
        }
    return texels;
}

std::shared_ptr<const Texture> texture_of_hash(const SceneDraft& scene, std::string_view hash) {
    for (const auto& given : scene.textures)
        if (hash == given->hash) return given;
    for (std::size_t i = 0; i < kOwnTextures.size(); ++i)
        if (hash == kOwnTextures[i].hash)
            return std::make_shared<const Texture>(
                Texture{kOwnTextures[i].name, kOwnTextures[i].hash, own_texture_depth(i),
                        kOwnTextures[i].upright});
    return nullptr;
}

// sRGB, by its own curve.
std::vector<float> linear_colors(const Texture& texture) {
    std::vector<float> texels(3 * texture.depth.size(), 1.0F);
    if (texture.color.empty()) return texels;
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const double code = static_cast<double>(i) / 255;
        linear[i] = static_cast<float>(code <= 0.04045 ? code / 12.92
                                                       : exact::pow((code + 0.055) / 1.055, 2.4));
    }
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = linear[texture.color[i]];
    return texels;
}

}  // namespace awan
