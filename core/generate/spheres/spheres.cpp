// The hierarchy of spheres as Gaussians of extinction, as deep as the picture needs.
#include "core/scene/spheres.h"

#include <algorithm>
#include <bit>

#include "core/generate/models.h"
#include "core/generate/spheres/cluster.h"
#include "core/generate/spheres/cut.h"
#include "core/generate/spheres/extinction.h"
#include "core/generate/spheres/walk.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

constexpr std::uint64_t kCoarseSpheres = 625;

struct Part {
    std::vector<GaussianBlob> blobs;
    std::uint64_t cut = 0;  // of them stand for more than a leaf
};

std::uint64_t bits(double value) {
    return std::bit_cast<std::uint64_t>(value + 0.0);
}

// Of what decides which spheres are cut.
std::uint64_t variant_of(const SphereCut& cut) {
    std::uint64_t hash = keyed(bits(cut.smallest), cut.eye.has_value());
    if (cut.eye)
        for (int axis = 0; axis < 3; ++axis) hash = keyed(hash, bits((*cut.eye)[axis]));
    return hash | 1;  // 0 says that the eye does not matter
}

}  // namespace

Result<ModelParticles> spheres_particles(const SpheresCloud& cloud, const ModelRequest& request,
                                         const Deadline& deadline) {
    const SphereTree tree(cloud, request.key, request.place, request.time);
    const std::uint64_t most = request.coarse ? kCoarseSpheres : limits::kMaxSpheresParticles;
    const auto chosen =
        choose_cut(tree, request.eye, request.pixel_angle, most, request.threads, deadline);
    if (!chosen.ok()) return chosen.error();
    const SphereCut& cut = *chosen;

    const std::vector<ClusterMoments> moments = cluster_moments(tree);
    std::vector<Part> parts(kWalkTasks);
    const bool whole = walk_spheres(
        tree, request.threads, deadline, [&](const SphereNode& node, int level, std::size_t task) {
            Part& part = parts[task];
            if (level == tree.levels()) {
                part.blobs.push_back(leaf_blob(node.sphere));
                return false;
            }
            if (!cut.cuts(node.sphere, tree.ratios())) return true;
            const auto below = static_cast<std::size_t>(tree.levels() - level - 1);
            part.blobs.push_back(cluster_blob(tree.children(node, level), moments[below]));
            ++part.cut;
            return false;
        });
    if (!whole) return *deadline.over();

    ModelParticles made;
    made.extinctions = true;
    const double sigma = extinction_of(cloud, request.density);
    std::size_t count = 0;
    std::uint64_t cut_spheres = 0;
    for (const Part& part : parts) {
        count += part.blobs.size();
        cut_spheres += part.cut;
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
    if (cut_spheres > 0) made.variant = variant_of(cut);
    return made;
}

}  // namespace awan
