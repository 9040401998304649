// The hierarchy of spheres as Gaussians of extinction, as deep as the picture needs.
#include "core/scene/spheres.h"
#include "core/base/exact_math.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/generate/models.h"
#include "core/generate/spheres/cluster.h"
#include "core/generate/spheres/cut.h"
#include "core/generate/spheres/extinction.h"
#include "core/generate/spheres/walk.h"
#include "core/scene/limits.h"

namespace awan::spheres {
namespace {

constexpr std::uint64_t kCoarseSpheres = 625;
// Radians. Where only the cloud's place matters, spheres that look smaller than this are not divided.
constexpr double kCoarsePixel = 0.0267;

struct Part {
    std::vector<GaussianBlob> blobs;
    // The mass of all, and of those that stand for more than a leaf.
    double mass = 0, cut_mass = 0;
    // The mass of the cut ones by how many levels are below them, and the same times their radii.
    std::array<double, limits::kMaxSphereLevels + 1> mass_of_level{}, mass_radius{};
};

// What cutting does to a picture, root mean square over root mean square. A cut cluster becomes a round blob as wide
// as it is. So what matters is how many pixels wide the cut spheres are; how much of the cloud is in them (the third
// root of their mass, as they stand where the cloud ends); and how porous they are: a ray through a sphere meets 5
// E(I_j^2) of its children (`met`), less than one where ratios are small.
//
// It is above all that was measured, on clouds of 6 to 8 levels against all their leaves, lit by transport-32 in
// pictures 300 and 450 pixels high:
//   ratios .26...76, extinctions .2 and 2: cut at 1.5 pixels .0017, 3: .010, 6: .023, 12: .071, 24: .18;
//   ratios .2...7: cut at 1.5 pixels .0014, 3: .006, 6: .04;
//   ratios .1...6: cut at 1.5 pixels .009, 3: .036, 6: .17, 12: .34, 24: .48.
// spheres_cut_test does it smaller. Where little is cut it is up to ten times too high. It does not cover deep leaves
// that leave open what the blob in their place hides: lost_in_lumps().
//
// What was measured had five parts; other numbers come in by how many of them a ray meets.
double error_of_cut(double met, double pixels, double mass_share) {
    const double porous = std::clamp((1.1 - met) / (1.1 - 0.72), 0.0, 1.0);
    return exact::cbrt(mass_share) *
           std::min(0.014 * (1 + porous) * pixels * std::sqrt(pixels), 0.7);
}
// The angle of a pixel where a request names none, radians: of a picture 1080 pixels high and 40 degrees.
constexpr double kUsualPixel = 0.00067;

double mass_of(const GaussianBlob& blob) {
    return blob.peak * blob.s * blob.s * blob.s;
}

std::uint64_t bits(double value) {
    return std::bit_cast<std::uint64_t>(value + 0.0);
}

// A hash of all that decides which spheres are cut.
std::uint64_t variant_of(const SphereCut& cut) {
    std::uint64_t hash = keyed(bits(cut.smallest), cut.eye.has_value());
    if (cut.eye)
        for (int axis = 0; axis < 3; ++axis) hash = keyed(hash, bits((*cut.eye)[axis]));
    // Never 0, which says that the eye does not matter.
    return hash | 1;
}

}  // namespace

Result<ModelParticles> make_particles(const SpheresCloud& cloud, const ModelRequest& request,
                                      const Deadline& deadline) {
    const SphereTree tree(cloud, request.key, request.place, request.time);
    // Coarse: spheres of less than 4% of the first are not even counted.
    const auto chosen =
        request.coarse ? choose_cut(tree, std::nullopt, std::max(request.pixel_angle, kCoarsePixel),
                                    kCoarseSpheres, request.threads, deadline)
                       : choose_cut(tree, request.eye, request.pixel_angle,
                                    limits::kMaxSpheresParticles, request.threads, deadline);
    if (!chosen.ok()) return chosen.error();
    const SphereCut& cut = *chosen;

    const std::vector<ClusterMoments> moments = cluster_moments(tree);
    std::vector<Part> parts(walk_tasks(tree));
    const bool whole = walk_spheres(
        tree, request.threads, deadline, [&](const SphereNode& node, int level, std::size_t task) {
            Part& part = parts[task];
            if (level == tree.levels()) {
                part.blobs.push_back(leaf_blob(node.sphere));
                part.mass += mass_of(part.blobs.back());
                return false;
            }
            if (!cut.cuts(node.sphere, tree.ratios())) return true;
            const auto below = static_cast<std::size_t>(tree.levels() - level - 1);
            part.blobs.push_back(cluster_blob(tree.children(node, level), moments[below]));
            part.mass += mass_of(part.blobs.back());
            part.cut_mass += mass_of(part.blobs.back());
            part.mass_of_level[below + 1] += mass_of(part.blobs.back());
            part.mass_radius[below + 1] += mass_of(part.blobs.back()) * node.sphere.radius;
            return false;
        });
    if (!whole) return *deadline.over();

    ModelParticles made;
    made.extinctions = true;
    const double sigma = extinction_of(cloud, request.density);
    std::size_t count = 0;
    double mass = 0, cut_mass = 0;
    for (const Part& part : parts) {
        count += part.blobs.size();
        mass += part.mass;
        cut_mass += part.cut_mass;
    }
    made.particles.positions.reserve(count);
    made.particles.radii.reserve(count);
    made.particles.densities.reserve(count);
    for (const Part& part : parts)
        for (const GaussianBlob& blob : part.blobs) {
            made.particles.positions.push_back(blob.center);
            made.particles.radii.push_back(static_cast<float>(2 * blob.s));
            made.particles.densities.push_back(
                static_cast<float>(std::min(blob.peak * sigma, limits::kMaxDensity)));
        }
    if (cut_mass > 0) {
        const double angle = request.pixel_angle > 0 ? request.pixel_angle : kUsualPixel;
        made.variant = variant_of(cut);
        double lumps = 0;
        for (std::size_t below = 1; below <= limits::kMaxSphereLevels; ++below) {
            double own = 0, radius = 0;
            for (const Part& part : parts) {
                own += part.mass_of_level[below];
                radius += part.mass_radius[below];
            }
            if (own > 0)
                lumps += own / mass *
                         lost_in_lumps(tree, moments, radius / own, static_cast<int>(below), sigma);
        }
        made.error = exact::hypot(
            error_of_cut(tree.met(), 2 * cut.smallest / angle, cut_mass / mass), lumps);
    }
    return made;
}

}  // namespace awan::spheres
