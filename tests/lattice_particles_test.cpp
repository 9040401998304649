#include "core/generate/lattice_particles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include "tests/gaussian_sums.h"

namespace awan {
namespace {

// A field of n^3 cells around the middle; value(p) at every sample.
template <typename Value>
LatticeField sampled(int n, double cell, glm::dvec3 middle, const Value& value) {
    LatticeField field;
    field.cell = cell;
    field.origin = middle - cell * 0.5 * glm::dvec3(n - 1);
    field.nx = field.ny = field.nz = n;
    field.values.resize(static_cast<std::size_t>(n * n * n));
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                field.values[field.index(i, j, k)] =
                    static_cast<float>(value(field.origin + cell * glm::dvec3(i, j, k)));
    return field;
}

double mass_of(const ReadyParticles& particles) {
    double mass = 0;
    for (std::size_t i = 0; i < particles.positions.size(); ++i)
        mass +=
            static_cast<double>(particles.densities[i]) *
            std::pow(std::sqrt(2 * std::numbers::pi) * static_cast<double>(particles.radii[i]) / 2,
                     3);
    return mass;
}

TEST(LatticeParticles, AConstantFieldComesBack) {
    const LatticeField field = sampled(15, 0.3, {5, -2, 1}, [](glm::dvec3) { return 2.5; });
    const ReadyParticles particles = lattice_particles(field, {}, 1);
    ASSERT_EQ(particles.positions.size(), 15u * 15 * 15);
    // Five cells from the faces, where the Gaussians cut off there are below exp(-25): within three axes' 4.8e-4.
    for (int step = 0; step <= 10; ++step) {
        const glm::dvec3 p = glm::dvec3(5, -2, 1) + 0.06 * step * glm::dvec3(1, 0.7, 0.3);
        EXPECT_NEAR(test::extinction_at(particles, p), 2.5, 2.5 * 3 * 4.9e-4) << step;
    }
    // As the header says: s in one axis.
    EXPECT_NEAR(2 * std::exp(-2 * std::pow(std::numbers::pi * kLatticeS, 2)), 4.8e-4, 1e-5);
}

double bump(glm::dvec3 p) {
    return std::exp(-glm::dot(p, p) / (2 * 0.8 * 0.8)) * (1 + 0.3 * std::sin(3 * p.x));
}

TEST(LatticeParticles, ASmoothFieldComesBackAndSharperWithLessBlur) {
    const double cell = 0.2;
    const LatticeField field = sampled(40, cell, {0, 0, 0}, bump);
    const ReadyParticles plain = lattice_particles(field, {}, 1);
    const ReadyParticles sharp = lattice_particles(field, {.sharpen = true}, 1);
    double plain_error = 0, sharp_error = 0;
    for (int step = 0; step < 60; ++step) {
        const glm::dvec3 p = 1.3 * glm::dvec3(std::sin(1.7 * step), std::cos(2.9 * step),
                                              std::sin(0.31 * step * step));
        plain_error = std::max(plain_error, std::abs(test::extinction_at(plain, p) - bump(p)));
        sharp_error = std::max(sharp_error, std::abs(test::extinction_at(sharp, p) - bump(p)));
    }
    // Blur adds (s^2 / 2) of the second derivatives, here at most 8: .068. Of the sharpened, fourth order.
    EXPECT_LT(plain_error, 0.068);
    EXPECT_LT(sharp_error, 0.01);
    EXPECT_LT(sharp_error, 0.3 * plain_error);
}

TEST(LatticeParticles, MassIsKeptExactlyWhateverIsLeftOut) {
    const LatticeField field = sampled(24, 0.35, {100, 7, 0}, [](glm::dvec3 p) {
        const glm::dvec3 q = p - glm::dvec3(100, 7, 0);
        return std::max(0.0, 1 - glm::length(q) / 3.5);
    });
    const double mass = lattice_mass(field);
    EXPECT_NEAR(mass, std::numbers::pi / 3 * std::pow(3.5, 3), 0.01 * mass);  // of a cone's ball
    for (const float threshold : {0.0f, 0.05f, 0.5f})
        for (const bool sharpen : {false, true}) {
            const ReadyParticles particles = lattice_particles(field, {threshold, sharpen}, 1);
            EXPECT_NEAR(mass_of(particles) / mass, 1, 1e-7) << threshold << sharpen;
        }
}

TEST(LatticeParticles, CellsAtOrBelowTheThresholdAreLeftOut) {
    const LatticeField field =
        sampled(4, 1, {0, 0, 0}, [](glm::dvec3 p) { return p.x > 0 ? 1 : .1; });
    EXPECT_EQ(lattice_particles(field, {}, 1).positions.size(), 64u);
    EXPECT_EQ(lattice_particles(field, {.threshold = 0.1f}, 1).positions.size(), 32u);
    EXPECT_TRUE(lattice_particles(field, {.threshold = 1}, 1).positions.empty());
    EXPECT_TRUE(lattice_particles(LatticeField{}, {}, 3).positions.empty());
}

TEST(LatticeParticles, TheSameBytesOnAnyNumberOfThreads) {
    const LatticeField field = sampled(21, 0.3, {0, 0, 0}, bump);
    const ReadyParticles one = lattice_particles(field, {0.01f, true}, 1);
    for (const int threads : {2, 7}) {
        const ReadyParticles other = lattice_particles(field, {0.01f, true}, threads);
        EXPECT_EQ(one.positions, other.positions);
        EXPECT_EQ(one.radii, other.radii);
        EXPECT_EQ(one.densities, other.densities);
    }
}

}  // namespace
}  // namespace awan
