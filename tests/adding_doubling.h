// Light in an even, plane-parallel sheet, to many digits: adding and doubling of layers (van de Hulst 1980), a Fourier
// series in the azimuth. It shares nothing with the transport pass: no grid, no discrete time, no delta-M.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace awan::test {

// Henyey-Greenstein scattering.
struct SheetMatter {
    double depth = 1;  // optical, straight through
    double albedo = 1;
    double g = 0;
};

// What leaves a sheet that a beam of irradiance 1 (across the beam) meets under the cosine `sun`: radiance, without the
// beam that goes straight through. Cosines are > 0; azimuth: between the directions in which the beam and the light
// that leaves go, 0: onward.
class Sheet {
    static constexpr int kGauss = 32;  // directions up, and as many down
    static constexpr double kThinnest = 1e-7;

  public:
    // `cosines`: those that are asked for later, as suns or views. modes: of the Fourier series at most; shares of the
    // light need one.
    explicit Sheet(const SheetMatter& matter, const std::vector<double>& cosines = {},
                   int modes = 2 * kGauss)
        : matter_(matter) {
        gauss(kGauss);
        for (const double cosine : cosines) {
            cosine_.push_back(cosine);
            weight_.push_back(0);
        }
        for (int m = 0; m < modes; ++m) {
            modes_.push_back(mode(m));
            if (m > 0 && largest(modes_.back()) < 1e-9) break;
        }
    }

    // Radiance back from the lit side, or through to the other.
    double back(double view, double sun, double azimuth) const {
        return sum(view, sun, azimuth, &Mode::back);
    }
    double through(double view, double sun, double azimuth) const {
        return sum(view, sun, azimuth, &Mode::through);
    }
    // Irradiance that leaves either side for one of 1 on the sheet (across it: the beam's is sun x 1), scattered at
    // least once.
    double back_share(double sun) const { return share(sun, modes_[0].back); }
    double through_share(double sun) const { return share(sun, modes_[0].through); }
    double straight_share(double sun) const { return std::exp(-matter_.depth / sun); }
    // The share of light from all directions alike that comes through.
    double diffuse_through() const {
        double sum = 0;
        for (std::size_t j = 0; j < kGauss; ++j)
            sum += 2 * weight_[j] * cosine_[j] *
                   (through_share(cosine_[j]) + straight_share(cosine_[j]));
        return sum;
    }

  private:
    using Matrix = std::vector<double>;  // [to][from], radiance for a beam of irradiance 1
    struct Mode {
        Matrix back, through;
    };

    std::size_t n() const { return cosine_.size(); }

    // Gauss-Legendre on 0..1.
    void gauss(int count) {
        for (int i = 0; i < count; ++i) {
            double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 0;
            for (int step = 0; step < 50; ++step) {
                double p = 1, before = 0;
                for (int l = 1; l <= count; ++l) {
                    const double next = ((2 * l - 1) * x * p - (l - 1) * before) / l;
                    before = p;
                    p = next;
                }
                slope = count * (x * p - before) / (x * x - 1);
                x -= p / slope;
            }
            cosine_.push_back(0.5 * (1 + x));
            weight_.push_back(1 / ((1 - x * x) * slope * slope));
        }
    }

    // Associated Legendre functions of order m with sqrt((l-m)!/(l+m)!), l = m..2 kGauss - 1.
    static std::vector<double> legendre(int m, double x) {
        std::vector<double> p(2 * kGauss);
        double start = 1;
        for (int k = 1; k <= m; ++k) start *= std::sqrt((1 - x * x) * (2 * k - 1) / (2.0 * k));
        p[static_cast<std::size_t>(m)] = start;
        double before = 0, here = start;
        for (int l = m; l + 1 < 2 * kGauss; ++l) {
            const double next = ((2 * l + 1) * x * here - std::sqrt(1.0 * l * l - m * m) * before) /
                                std::sqrt((l + 1.0) * (l + 1) - m * m);
            p[static_cast<std::size_t>(l + 1)] = next;
            before = here;
            here = next;
        }
        return p;
    }

    // A layer so thin that light is scattered in it once. What little is scattered again must not be lost, or a deep
    // sheet would lose it a thousand times: columns are scaled to what the beam leaves in the layer.
    Mode thin_layer(int m, double depth) {
        std::vector<std::vector<double>> p;
        for (const double cosine : cosine_) p.push_back(legendre(m, cosine));
        Mode layer{Matrix(n() * n()), Matrix(n() * n())};
        for (std::size_t i = 0; i < n(); ++i)
            for (std::size_t j = 0; j < n(); ++j) {
                double same = 0, other = 0, power = std::pow(matter_.g, m);
                for (int l = m; l < 2 * kGauss; ++l) {
                    const double term = (2 * l + 1) * power * p[i][static_cast<std::size_t>(l)] *
                                        p[j][static_cast<std::size_t>(l)];
                    same += term;
                    other += (l + m) % 2 == 0 ? term : -term;
                    power *= matter_.g;
                }
                const double scale = matter_.albedo / (4 * std::numbers::pi);
                const double v = 1 / cosine_[i], s = 1 / cosine_[j];
                const double apart = v - s;
                layer.back[i * n() + j] =
                    scale * other * v * -std::expm1(-depth * (v + s)) / (v + s);
                layer.through[i * n() + j] =
                    scale * same * v * std::exp(-depth * s) *
                    (std::abs(apart) * depth < 1e-12 ? depth : -std::expm1(-depth * apart) / apart);
            }
        if (m == 0)
            for (std::size_t j = 0; j < n(); ++j) {
                double sent = 0;
                for (std::size_t i = 0; i < kGauss; ++i)
                    sent += 2 * std::numbers::pi * weight_[i] * cosine_[i] *
                            (layer.back[i * n() + j] + layer.through[i * n() + j]);
                kept_.push_back(matter_.albedo * cosine_[j] * -std::expm1(-depth / cosine_[j]) /
                                sent);
            }
        for (std::size_t i = 0; i < n() * n(); ++i) {
            layer.back[i] *= kept_[i % n()];
            layer.through[i] *= kept_[i % n()];
        }
        return layer;
    }

    // One after the other: what leaves b goes into a. Radiance is summed over directions.
    Matrix after(const Matrix& a, const Matrix& b) const {
        Matrix made(n() * n());
        for (std::size_t i = 0; i < n(); ++i)
            for (std::size_t k = 0; k < n(); ++k) {
                const double by = a[i * n() + k] * 2 * std::numbers::pi * weight_[k];
                if (by == 0) continue;
                for (std::size_t j = 0; j < n(); ++j) made[i * n() + j] += by * b[k * n() + j];
            }
        return made;
    }

    // x = a + a after x: light that goes to and fro any number of times.
    Matrix repeated(const Matrix& a) const {
        const std::size_t size = n();
        Matrix left(size * size), right = a;
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t k = 0; k < size; ++k)
                left[i * size + k] =
                    (i == k ? 1 : 0) - a[i * size + k] * 2 * std::numbers::pi * weight_[k];
        for (std::size_t c = 0; c < size; ++c)
            for (std::size_t i = c + 1; i < size; ++i) {
                const double by = left[i * size + c] / left[c * size + c];
                if (by == 0) continue;
                for (std::size_t k = c; k < size; ++k)
                    left[i * size + k] -= by * left[c * size + k];
                for (std::size_t k = 0; k < size; ++k)
                    right[i * size + k] -= by * right[c * size + k];
            }
        for (std::size_t c = size; c-- > 0;)
            for (std::size_t k = 0; k < size; ++k) {
                double sum = right[c * size + k];
                for (std::size_t i = c + 1; i < size; ++i)
                    sum -= left[c * size + i] * right[i * size + k];
                right[c * size + k] = sum / left[c * size + c];
            }
        return right;
    }

    // Two layers alike, one upon the other, each of a depth through which exp(-depth / cosine) = straight goes
    // unhindered.
    Mode doubled(const Mode& layer, const std::vector<double>& straight) const {
        const std::size_t size = n();
        const auto sum = [&](Matrix to, const Matrix& from, bool row, bool column) {
            for (std::size_t i = 0; i < size; ++i)
                for (std::size_t j = 0; j < size; ++j)
                    to[i * size + j] +=
                        from[i * size + j] * (row ? straight[i] : 1) * (column ? straight[j] : 1);
            return to;
        };
        const Matrix again = repeated(after(layer.back, layer.back));
        // Between the layers, downward and upward.
        Matrix down = sum(after(again, layer.through), layer.through, false, false);
        down = sum(std::move(down), again, false, true);
        const Matrix up = sum(after(layer.back, down), layer.back, false, true);
        Mode both;
        both.back = sum(sum(after(layer.through, up), layer.back, false, false), up, true, false);
        both.through =
            sum(sum(after(layer.through, down), down, true, false), layer.through, false, true);
        return both;
    }

    Mode mode(int m) {
        const int times =
            std::max(0, static_cast<int>(std::ceil(std::log2(matter_.depth / kThinnest))));
        double depth = std::ldexp(matter_.depth, -times);
        Mode made = thin_layer(m, depth);
        std::vector<double> straight(n());
        for (int i = 0; i < times; ++i, depth *= 2) {
            for (std::size_t k = 0; k < n(); ++k) straight[k] = std::exp(-depth / cosine_[k]);
            made = doubled(made, straight);
        }
        return made;
    }

    double largest(const Mode& mode) const {
        double most = 0;
        for (std::size_t i = 0; i < n() * n(); ++i)
            most = std::max({most, std::abs(mode.back[i]), std::abs(mode.through[i])});
        return most;
    }
    std::size_t index_of(double cosine) const {
        return static_cast<std::size_t>(std::min_element(cosine_.begin() + kGauss, cosine_.end(),
                                                         [&](double a, double b) {
                                                             return std::abs(a - cosine) <
                                                                    std::abs(b - cosine);
                                                         }) -
                                        cosine_.begin());
    }
    double sum(double view, double sun, double azimuth, Matrix Mode::*side) const {
        const std::size_t at = index_of(view) * n() + index_of(sun);
        double sum = 0;
        for (std::size_t m = 0; m < modes_.size(); ++m)
            sum += (m == 0 ? 1 : 2) * std::cos(static_cast<double>(m) * azimuth) *
                   (modes_[m].*side)[at];
        return sum;
    }
    double share(double sun, const Matrix& side) const {
        const auto exact = std::find(cosine_.begin(), cosine_.end(), sun);
        const auto j = static_cast<std::size_t>(exact - cosine_.begin());
        double sum = 0;
        for (std::size_t i = 0; i < kGauss; ++i)
            sum += 2 * std::numbers::pi * weight_[i] * cosine_[i] * side[i * n() + j];
        return sum / sun;
    }

    SheetMatter matter_;
    std::vector<double> kept_;  // a thin layer's scale, by the direction that light comes from
    std::vector<double> cosine_,
        weight_;  // kGauss of a quadrature, then those asked for, with weight 0
    std::vector<Mode> modes_;
};

}  // namespace awan::test
