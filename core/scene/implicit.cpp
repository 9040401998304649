#include "core/scene/implicit.h"

#include <algorithm>

#include "core/scene/limits.h"

namespace awan {
namespace {

// Numbers in a row.
struct Figures {
    std::vector<double> list;

    void add(double value) { list.push_back(value + 0.0); }
    void add(std::uint64_t value) { add(static_cast<double>(value)); }
    void add(bool value) { add(value ? 1.0 : 0.0); }
    void add(const glm::dvec3& v) { add(v.x), add(v.y), add(v.z); }
    void add(const ImplicitKey& key) {
        add(key.time);
        optional(key.center), optional(key.radius), optional(key.weight);
    }
    void add(const ImplicitPrimitive& p) {
        add(static_cast<double>(p.shape));
        add(p.center), add(p.radius), add(p.radii), add(p.core), add(p.rotate), add(p.weight);
        all(p.points), all(p.keys);
    }
    void add(const ImplicitGrowth& g) {
        add(g.seeds), add(g.most), add(g.radius), add(g.shrink), add(g.weight), add(g.center);
        add(g.spread), add(g.velocity), add(g.force), add(g.turbulence), add(g.drag);
        add(g.lifetime), add(g.rate), add(g.duration);
    }
    void add(const ImplicitAttractor& a) { add(a.at), add(a.strength), add(a.reach); }
    void add(const ImplicitVortex& v) { add(v.at), add(v.axis), add(v.angle), add(v.reach); }
    void add(const ImplicitFlow& f) { add(f.min), add(f.max), add(f.size), all(f.vectors); }

    template <typename T>
    void all(const std::vector<T>& values) {
        add(static_cast<double>(values.size()));
        for (const T& value : values) add(value);
    }
    template <typename T>
    void optional(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }
};

}  // namespace

std::vector<double> figures_of(const ImplicitCloud& cloud) {
    const ImplicitSettings s = resolved(cloud);
    Figures f;
    f.all(s.primitives);
    f.optional(cloud.growth);
    f.add(cloud.smooth_keys);
    f.optional(s.base);
    f.add(s.amount), f.add(s.exponent), f.add(s.blend), f.add(s.displacement);
    f.add(cloud.diagonal);
    f.add(s.noise_size), f.add(s.octaves), f.add(s.gain), f.add(s.stretch);
    f.add(s.jet), f.add(s.jet_turbulence), f.add(cloud.warp_from), f.add(cloud.warp_to);
    f.all(cloud.attractors), f.all(cloud.vortices), f.optional(cloud.flow);
    f.add(s.ripple), f.add(s.ripple_depth), f.add(s.ripple_turbulence);
    f.add(cloud.swirl), f.add(cloud.printed_swirl);
    f.add(cloud.resolution), f.add(cloud.threshold);
    return f.list;
}

std::uint64_t most_particles(const ImplicitCloud& cloud) {
    const std::uint64_t n = std::min(cloud.resolution, limits::kMaxImplicitResolution);
    return n * n * n;
}

}  // namespace awan
