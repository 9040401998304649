// Light scattered by one sphere that absorbs nothing: the series of Lorenz and Mie, as Bohren & Huffman 1983 (chapter
// 4, appendix A) sum it.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace awan {

// The coefficients a_n and b_n, n = 1..terms, of a sphere of size x = pi diameter / wavelength (> 0) and refractive
// index n (> 0, not 1) relative to its surroundings.
struct MieSeries {
    double x = 1;
    std::vector<std::complex<double>> a, b;
};
MieSeries mie_series(double x, double index);

// Cross sections over the sphere's own, of all light that is scattered and (4 pi times) of that which goes straight
// back, and the mean cosine of the angle by which light turns.
struct MieEfficiencies {
    double scattered = 0, back = 0, asymmetry = 0;
};
MieEfficiencies mie_efficiencies(const MieSeries& series);

// Adds share * (|S1|^2 + |S2|^2) for the directions of cosine 1 - less[i] to ahead[i], and for those of cosine less[i]
// - 1 to behind[i]. less: each 0..1; both sums are as long.
void add_intensities(const MieSeries& series, double share, std::span<const double> less,
                     std::span<double> ahead, std::span<double> behind);

}  // namespace awan
