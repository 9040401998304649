// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for
// Alternating Images", Proc. ACM on Computer Graphics and Interactive Techniques 3(2). Names and numbers as there.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/accuracy/error_measures.h"
#include "core/base/exact_math.h"

namespace awan {
namespace {

using Color = std::array<double, 3>;
using Plane = std::vector<float>;  // row by row

struct Size {
    int width, height;
    std::size_t count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

constexpr Color kWhite{0.950428545, 1.0, 1.088900371};  // XYZ of D65

// Rec. 709 primaries with a D65 white.
Color xyz_of(const Color& c) {
    return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / 24577794,
            (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]) / 12288897,
            (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2]) / 73733382};
}

Color rgb_of(const Color& c) {
    return {3.241003275 * c[0] - 1.537398934 * c[1] - 0.498615861 * c[2],
            -0.969224334 * c[0] + 1.875930071 * c[1] + 0.041554224 * c[2],
            0.055639423 * c[0] - 0.204011202 * c[1] + 1.057148933 * c[2]};
}

// The linear opponent space in which the eye's contrast sensitivity is stated: CIELAB without its cube roots.
Color ycxcz_of(const Color& xyz) {
    const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Color xyz_of_ycxcz(const Color& c) {
    const double y = (c[0] + 16) / 116;
    return {(y + c[1] / 500) * kWhite[0], y * kWhite[1], (y - c[2] / 200) * kWhite[2]};
}

// CIELAB, its chroma dimmed with lightness (Hunt's effect).
Color hunt_lab_of(const Color& rgb) {
    const Color xyz = xyz_of(rgb);
    const auto f = [](double t) {
        constexpr double kDelta = 6.0 / 29;
        return t > kDelta * kDelta * kDelta ? exact::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
    };
    const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1] / kWhite[1]), z = f(xyz[2] / kWhite[2]);
    const double l = 116 * y - 16;
    return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}

double hyab(const Color& a, const Color& b) {
    return std::abs(a[0] - b[0]) + exact::hypot(a[1] - b[1], a[2] - b[2]);
}

// Odd-sized, its middle at size / 2.
using Kernel = std::vector<float>;

// Sum 1; where it has negative parts, these and the positive ones are each scaled to a sum of 1.
Kernel normalised(std::vector<double> k) {
    double positive = 0, negative = 0;
    for (const double w : k) (w > 0 ? positive : negative) += w;
    Kernel kernel;
    for (const double w : k)
        kernel.push_back(static_cast<float>(w > 0          ? w / positive
                                            : negative < 0 ? -w / negative
                                                           : 0));
    return kernel;
}

template <typename F>
Kernel kernel(int radius, const F& f) {
    std::vector<double> k;
    for (int i = -radius; i <= radius; ++i) k.push_back(f(static_cast<double>(i)));
    return normalised(std::move(k));
}

// out[i] = sum of scaled, shifted rows: one pass of a separable filter. The edge's pixels go on beyond it.
Plane filtered(const Plane& in, const Size& size, const Kernel& across, const Kernel& down) {
    const int w = size.width, h = size.height;
    const int ra = static_cast<int>(across.size()) / 2, rd = static_cast<int>(down.size()) / 2;
    const auto row = static_cast<std::size_t>(w);
    Plane half(size.count()), out(size.count());
    std::vector<float> padded(static_cast<std::size_t>(w + 2 * ra));
    for (int y = 0; y < h; ++y) {
        const float* from = in.data() + row * static_cast<std::size_t>(y);
        for (int x = -ra; x < w + ra; ++x)
            padded[static_cast<std::size_t>(x + ra)] = from[std::clamp(x, 0, w - 1)];
        float* to = half.data() + row * static_cast<std::size_t>(y);
        for (std::size_t k = 0; k < across.size(); ++k)
            for (std::size_t x = 0; x < row; ++x) to[x] += across[k] * padded[x + k];
    }
    for (int y = 0; y < h; ++y) {
        float* to = out.data() + row * static_cast<std::size_t>(y);
        for (int k = -rd; k <= rd; ++k) {
            const float* from =
                half.data() + row * static_cast<std::size_t>(std::clamp(y + k, 0, h - 1));
            const float weight = down[static_cast<std::size_t>(k + rd)];
            for (std::size_t x = 0; x < row; ++x) to[x] += weight * from[x];
        }
    }
    return out;
}

// Linear light of an sRGB byte (IEC 61966-2-1).
double linear_of(std::uint8_t byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : exact::pow((v + 0.055) / 1.055, 2.4);
}

std::array<Plane, 3> opponent_planes(const std::vector<std::uint8_t>& bytes, const Size& size) {
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < 256; ++i) linear[i] = linear_of(static_cast<std::uint8_t>(i));
    std::array<Plane, 3> planes;
    for (Plane& plane : planes) plane.resize(size.count());
    for (std::size_t i = 0; i < size.count(); ++i) {
        const Color c = ycxcz_of(
            xyz_of({linear[bytes[3 * i]], linear[bytes[3 * i + 1]], linear[bytes[3 * i + 2]]}));
        for (std::size_t p = 0; p < 3; ++p) planes[p][i] = static_cast<float>(c[p]);
    }
    return planes;
}

// What is left of colours after the eye's contrast sensitivity, as Hunt-adjusted CIELAB.
std::vector<Color> seen(const std::array<Plane, 3>& planes, const Size& size, double per_degree) {
    constexpr double kWidest = 0.04;
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(kWidest / 2) / std::numbers::pi * per_degree));
    const auto gauss = [&](double b) {
        return [b, per_degree](double i) {
            const double x = i / per_degree;
            return exact::exp(-std::numbers::pi * std::numbers::pi * x * x / b);
        };
    };
    const Kernel light = kernel(radius, gauss(0.0047)), red_green = kernel(radius, gauss(0.0053));
    const Kernel wide = kernel(radius, gauss(0.04)), narrow = kernel(radius, gauss(0.025));
    // Blue-yellow is a sum of two Gaussians, each separable; their shares are their two-dimensional sums.
    const auto volume = [&](double a, double b) {
        double sum = 0;
        for (int i = -radius; i <= radius; ++i) sum += gauss(b)(i);
        return a * std::sqrt(std::numbers::pi / b) * sum * sum;
    };
    const double share = volume(34.1, 0.04) / (volume(34.1, 0.04) + volume(13.5, 0.025));
    const Plane y = filtered(planes[0], size, light, light);
    const Plane cx = filtered(planes[1], size, red_green, red_green);
    const Plane cz1 = filtered(planes[2], size, wide, wide);
    const Plane cz2 = filtered(planes[2], size, narrow, narrow);
    std::vector<Color> lab(size.count());
    for (std::size_t i = 0; i < size.count(); ++i) {
        Color rgb = rgb_of(xyz_of_ycxcz(
            {static_cast<double>(y[i]), static_cast<double>(cx[i]),
             share * static_cast<double>(cz1[i]) + (1 - share) * static_cast<double>(cz2[i])}));
        for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
        lab[i] = hunt_lab_of(rgb);
    }
    return lab;
}

// Strengths of edges and of points in the achromatic plane.
struct Features {
    Plane edge, point;
};
Features features(const Plane& achromatic, const Size& size, double per_degree) {
    const double sd = 0.5 * 0.082 * per_degree;
    const int radius = static_cast<int>(std::ceil(3 * sd));
    const auto gauss = [sd](double x) { return exact::exp(-x * x / (2 * sd * sd)); };
    const Kernel smooth = kernel(radius, gauss);
    const Kernel first = kernel(radius, [&](double x) { return -x * gauss(x); });
    const Kernel second =
        kernel(radius, [&](double x) { return (x * x / (sd * sd) - 1) * gauss(x); });
    Plane light = achromatic;
    for (float& v : light) v = (v + 16) / 116;
    const auto strength = [&](const Kernel& k) {
        Plane x = filtered(light, size, k, smooth);
        const Plane y = filtered(light, size, smooth, k);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = exact::hypot(x[i], y[i]);
        return x;
    };
    return {strength(first), strength(second)};
}

}  // namespace

FlipResult flip(const std::vector<std::uint8_t>& reference, const std::vector<std::uint8_t>& test,
                int width, int height, double pixels_per_degree) {
    const Size size{width, height};
    assert(reference.size() == 3 * size.count() && test.size() == 3 * size.count());
    const auto planes_a = opponent_planes(reference, size), planes_b = opponent_planes(test, size);
    const auto a = seen(planes_a, size, pixels_per_degree),
               b = seen(planes_b, size, pixels_per_degree);
    const Features fa = features(planes_a[0], size, pixels_per_degree),
                   fb = features(planes_b[0], size, pixels_per_degree);

    constexpr double kColorPower = 0.7, kFeaturePower = 0.5, kKnee = 0.4, kAtKnee = 0.95;
    const double most =
        exact::pow(hyab(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1})), kColorPower);
    FlipResult result;
    result.map.resize(size.count());
    for (std::size_t i = 0; i < size.count(); ++i) {
        const double apart = exact::pow(hyab(a[i], b[i]), kColorPower), knee = kKnee * most;
        const double color = apart < knee
                                 ? kAtKnee / knee * apart
                                 : kAtKnee + (apart - knee) / (most - knee) * (1 - kAtKnee);
        const double feature = exact::pow(
            std::max(
                std::abs(static_cast<double>(fa.edge[i]) - static_cast<double>(fb.edge[i])),
                std::abs(static_cast<double>(fa.point[i]) - static_cast<double>(fb.point[i]))) /
                std::numbers::sqrt2,
            kFeaturePower);
        const double value =
            std::clamp(exact::pow(std::min(color, 1.0), 1 - std::min(feature, 1.0)), 0.0, 1.0);
        result.map[i] = static_cast<float>(value);
        result.mean += value;
    }
    if (size.count() > 0) result.mean /= static_cast<double>(size.count());
    return result;
}

}  // namespace awan
