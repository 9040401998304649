#include "core/formats/flightgear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <span>

#include "core/base/exact_math.h"
#include "core/formats/particle_files.h"
#include "core/generate/gaussian.h"
#include "core/light/legendre.h"

namespace awan {
namespace {

// No darker: light comes from the sides of a cloud too. And no thinner: it would not be there.
constexpr double kDarkest = 0.2;
constexpr double kThinnest = 0.01;
// FlightGear draws every sprite of every cloud in view: those of its own clouds have up to 40.
constexpr double kMostSprites = 30, kFewestSprites = 4;
constexpr double kFoot = 0.3048;

// What a heap looks like; lengths in metres.
struct Looks {
    double width = 0, height = 0;
    double sprites = 0, sprite_width = 0, sprite_height = 0;
    double lower_light = 1, alpha = 1;
};

struct Heap {
    // Scene units: the middle of its base.
    glm::dvec3 base{0};
    Looks looks;
};

using Members = std::span<std::size_t>;

Bounds bounds_of_members(const ParticleSet& particles, Members members) {
    Bounds box{glm::dvec3(std::numeric_limits<double>::max()),
               glm::dvec3(-std::numeric_limits<double>::max())};
    for (const std::size_t i : members) {
        const glm::dvec3 reach(static_cast<double>(particles.radius[i]));
        box.min = glm::min(box.min, particles.center[i] - reach);
        box.max = glm::max(box.max, particles.center[i] + reach);
    }
    return box;
}

Heap heap_of(const ParticleSet& particles, Members members, double metres, double g) {
    const Bounds box = bounds_of_members(particles, members);
    const glm::dvec3 size = box.max - box.min;
    double mass = 0, radii = 0;
    for (const std::size_t i : members) {
        mass += gaussian_mass(particles, i);
        radii += static_cast<double>(particles.radius[i]);
    }
    const double count = static_cast<double>(members.size());
    const double width = 0.5 * (size.x + size.z), tau = mass / (size.x * size.z);
    Looks looks;
    looks.width = width * metres;
    looks.height = size.y * metres;
    looks.sprites = std::clamp(count, kFewestSprites, kMostSprites);
    // As wide as a particle; wider where there are fewer of them, so that they still fill the space.
    const double sprite =
        std::max(2 * radii / count, 1.3 * exact::cbrt(size.x * size.y * size.z / looks.sprites));
    looks.sprite_width = std::min(sprite, width) * metres;
    looks.sprite_height = std::min({sprite, width, size.y}) * metres;
    looks.lower_light = std::max(kDarkest, 1 / (1 + 0.75 * (1 - g) * tau));
    looks.alpha = std::max(kThinnest, -exact::expm1(-tau));
    return {{0.5 * (box.min.x + box.max.x), box.min.y, 0.5 * (box.min.z + box.max.z)}, looks};
}

// Cuts `members` until a heap is no longer than `longest` on any side and no more than 1.5 times as long as wide.
void add_heaps(const ParticleSet& particles, Members members, double longest, double metres,
               double g, std::vector<Heap>& heaps) {
    const Bounds box = bounds_of_members(particles, members);
    const glm::dvec3 size = box.max - box.min;
    int axis = size.x >= size.z ? 0 : 2;
    bool cut = size[axis] > 1.5 * size[2 - axis];
    if (!cut) {
        if (size.y > size[axis]) axis = 1;
        cut = size[axis] > longest;
    }
    if (cut) {
        const double middle = 0.5 * (box.min[axis] + box.max[axis]);
        const auto half = std::stable_partition(members.begin(), members.end(), [&](std::size_t i) {
            return particles.center[i][axis] < middle;
        });
        const auto first = static_cast<std::size_t>(half - members.begin());
        if (first > 0 && first < members.size()) {
            add_heaps(particles, members.first(first), longest, metres, g, heaps);
            add_heaps(particles, members.subspan(first), longest, metres, g, heaps);
            return;
        }
    }
    heaps.push_back(heap_of(particles, members, metres, g));
}

std::vector<Heap> heaps_of(const Scene& scene, const ParticleSet& particles, double metres) {
    std::vector<std::size_t> members(particles.size());
    std::iota(members.begin(), members.end(), std::size_t{0});
    const double g = phase_moment(scene->medium, 1);
    std::vector<Heap> heaps;
    for (std::size_t k = 0; k + 1 < particles.cloud_begin.size(); ++k) {
        const std::size_t begin = particles.cloud_begin[k],
                          count = particles.cloud_begin[k + 1] - begin;
        if (count == 0) continue;
        const Members cloud = Members(members).subspan(begin, count);
        std::size_t in_cubes = 0;
        for (const Cube& cube : scene->clouds[k].cubes) in_cubes += cube.particles;
        if (in_cubes == count) {
            std::size_t at = 0;
            for (const Cube& cube : scene->clouds[k].cubes) {
                if (cube.particles > 0)
                    add_heaps(particles, cloud.subspan(at, cube.particles),
                              std::numeric_limits<double>::max(), metres, g, heaps);
                at += cube.particles;
            }
            continue;
        }
        const Bounds box = bounds_of_members(particles, cloud);
        const glm::dvec3 size = box.max - box.min;
        add_heaps(particles, cloud, std::max({size.x, size.y, size.z}) / 4, metres, g, heaps);
    }
    return heaps;
}

void append_property(std::string_view indent, std::string_view name, double value,
                     std::string& out) {
    out += indent;
    out += "<" + std::string(name) + ">";
    // Tenths of a metre and hundredths of a share are more than a sprite shows.
    append_number(std::floor(value * 100 + 0.5) / 100, out);
    out += "</" + std::string(name) + ">\n";
}

// The properties that SGNewCloud reads. Largest and smallest are the same: nothing is left to chance but the places of
// sprites.
void append_looks(const Looks& looks, std::string_view indent, std::string& out) {
    const auto both = [&](const std::string& name, double value) {
        append_property(indent, "min-" + name, value, out);
        append_property(indent, "max-" + name, value, out);
    };
    both("cloud-width-m", looks.width);
    both("cloud-height-m", looks.height);
    both("sprite-width-m", looks.sprite_width);
    both("sprite-height-m", looks.sprite_height);
    append_property(indent, "num-sprites", looks.sprites, out);
    // The sheet of FlightGear's own cumulus: bases below, tops above.
    out += std::string(indent) + "<texture>/Textures/Sky/cl_cumulus2.png</texture>\n";
    append_property(indent, "num-textures-x", 4, out);
    append_property(indent, "num-textures-y", 4, out);
    out += std::string(indent) + "<height-map-texture>true</height-map-texture>\n";
    both("bottom-lighting-factor", looks.lower_light);
    both("middle-lighting-factor", 0.5 * (1 + looks.lower_light));
    both("top-lighting-factor", 1);
    both("shade-lighting-factor", looks.lower_light);
    append_property(indent, "alpha-factor", looks.alpha, out);
}

// Heaps that are alike to a quarter of their size are one kind.
struct Kind {
    std::vector<const Heap*> heaps;
};
std::vector<Kind> kinds_of(const std::vector<Heap>& heaps) {
    std::map<std::array<int, 3>, Kind> kinds;
    for (const Heap& heap : heaps) {
        const auto step = [](double x) { return static_cast<int>(std::floor(exact::log2(x) * 2)); };
        kinds[{step(heap.looks.width), step(heap.looks.height), step(heap.looks.lower_light)}]
            .heaps.push_back(&heap);
    }
    std::vector<Kind> out;
    for (auto& [key, kind] : kinds) out.push_back(std::move(kind));
    return out;
}

Looks mean_looks(const Kind& kind) {
    Looks mean;
    const double share = 1 / static_cast<double>(kind.heaps.size());
    mean.lower_light = mean.alpha = 0;
    for (const Heap* heap : kind.heaps)
        for (const auto member :
             {&Looks::width, &Looks::height, &Looks::sprites, &Looks::sprite_width,
              &Looks::sprite_height, &Looks::lower_light, &Looks::alpha})
            mean.*member += share * (heap->looks.*member);
    mean.sprites = std::floor(mean.sprites + 0.5);
    return mean;
}

}  // namespace

Result<std::string> write_flightgear(const Scene& scene, const ParticleSet& particles,
                                     double metres) {
    const std::vector<Heap> heaps = heaps_of(scene, particles, metres);
    if (heaps.empty())
        return Error{ErrorCode::kInvalidScene, "",
                     "there are no particles, and FlightGear has no cloud without sprites"};
    Bounds places{heaps[0].base, heaps[0].base};
    for (const Heap& heap : heaps) {
        places.min = glm::min(places.min, heap.base);
        places.max = glm::max(places.max, heap.base);
    }
    const glm::dvec3 middle = 0.5 * (places.min + places.max);
    const std::vector<Kind> kinds = kinds_of(heaps);

    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<PropertyList>\n  <clouds>\n";
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const std::string name = "awan-" + std::to_string(i + 1);
        out += "    <" + name + ">\n";
        append_looks(mean_looks(kinds[i]), "      ", out);
        out += "    </" + name + ">\n";
    }
    out += "  </clouds>\n  <boxes>\n    <awan>\n";
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        double lowest = std::numeric_limits<double>::max(), highest = -lowest, reach = 0;
        for (const Heap* heap : kinds[i].heaps) {
            lowest = std::min(lowest, heap->base.y);
            highest = std::max(highest, heap->base.y);
            reach = std::max(
                {reach, std::abs(heap->base.x - middle.x), std::abs(heap->base.z - middle.z)});
        }
        out += "      <box>\n        <type>awan-" + std::to_string(i + 1) + "</type>\n";
        // FlightGear takes half of it to one and a half times it, rounded down: of 1, none at half of the places.
        append_property("        ", "count",
                        static_cast<double>(std::max<std::size_t>(2, kinds[i].heaps.size())), out);
        append_property("        ", "width", 2 * reach * metres, out);
        append_property("        ", "height", (highest - lowest) * metres, out);
        append_property("        ", "hdist", 1, out);
        append_property("        ", "vdist", 1, out);
        out += "      </box>\n";
    }
    out += "    </awan>\n  </boxes>\n  <layers>\n";
    for (const char* const layer : {"st", "sc", "cu", "ac", "ns", "cb"})
        out += "    <" + std::string(layer) +
               ">\n      <cloud>\n        <name>awan</name>\n        <count>1</count>\n" +
               "      </cloud>\n      <grid-z-rand type=\"double\">0</grid-z-rand>\n    </" +
               layer + ">\n";
    out += "  </layers>\n  <placed>\n";
    for (std::size_t i = 0; i < heaps.size(); ++i) {
        const glm::dvec3 from =
            metres * (heaps[i].base - glm::dvec3(middle.x, places.min.y, middle.z));
        out += "    <cloud n=\"" + std::to_string(i) + "\">\n";
        append_property("      ", "layer", 0, out);
        append_property("      ", "index", static_cast<double>(i + 1), out);
        append_property("      ", "x-offset-m", from.x, out);
        append_property("      ", "y-offset-m", -from.z, out);
        append_property("      ", "alt-ft", from.y / kFoot, out);
        append_looks(heaps[i].looks, "      ", out);
        out += "    </cloud>\n";
    }
    out += "  </placed>\n</PropertyList>\n";
    return out;
}

}  // namespace awan
