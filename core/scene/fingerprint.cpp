// fingerprint(): XXH3-128 over a canonical byte serialisation.
//
// Canonical means: what is inherited is resolved (a cloud's density is the one that holds for it,
// wherever it was written), what has no meaning is left out (the eye of an automatic camera), and
// every list, optional and string is preceded by its length or presence, so that no two scenes
// share their bytes by running together. Numbers go in as their little-endian bytes (the engine is
// built for x86-64 only), with -0 as 0.
#define XXH_STATIC_LINKING_ONLY  // the state may stand on the stack
#include <xxhash.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>

#include "core/scene/automaton.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
#include "core/scene/scene.h"
#include "core/scene/spheres.h"

namespace awan {
namespace {

class Hasher {
  public:
    Hasher() { XXH3_128bits_reset(&state_); }

    void integer(std::uint64_t v) { raw(&v, sizeof v); }
    void number(double v) {
        v += 0.0;
        raw(&v, sizeof v);
    }
    void vector(const glm::dvec3& v) {
        number(v.x);
        number(v.y);
        number(v.z);
    }
    void text(const std::string& s) {
        integer(s.size());
        raw(s.data(), s.size());
    }
    template <typename T>
    void list(std::span<const T> values) {
        static_assert(std::has_unique_object_representations_v<T> || sizeof(T) % 4 == 0);
        integer(values.size());
        raw(values.data(), values.size_bytes());
    }
    template <typename E>
    void choice(E v) {
        static_assert(std::is_enum_v<E>);
        integer(static_cast<std::uint64_t>(v));
    }
    template <typename T, typename Add>
    void optional(const std::optional<T>& v, Add add) {
        integer(v.has_value());
        if (v) add(*v);
    }

    std::string hex() const {
        XXH128_canonical_t bytes;
        XXH128_canonicalFromHash(&bytes, XXH3_128bits_digest(&state_));
        std::string text;
        for (const unsigned char byte : bytes.digest) {
            text += "0123456789abcdef"[byte >> 4];
            text += "0123456789abcdef"[byte & 15];
        }
        return text;
    }

  private:
    void raw(const void* data, std::size_t size) { XXH3_128bits_update(&state_, data, size); }
    XXH3_state_t state_;
};

void add_cube(Hasher& hash, const Cube& cube) {
    hash.integer(cube.particles);
    hash.vector(cube.size);
    hash.vector(cube.center);
    hash.number(cube.radius);
    hash.number(cube.density);
    hash.optional(cube.texture, [&](const std::string& name) { hash.text(name); });
}

// A list that only repeats the default says the same as no list.
template <typename T>
std::span<const T> unless_all(const std::vector<T>& values, const T& standard) {
    const bool all = std::all_of(values.begin(), values.end(),
                                 [&](const T& value) { return value == standard; });
    return all ? std::span<const T>() : std::span<const T>(values);
}

void add_cloud(Hasher& hash, const SceneDraft& scene, const Cloud& cloud) {
    hash.choice(cloud.model);
    hash.integer(cloud.cubes.size());
    for (const Cube& cube : cloud.cubes) add_cube(hash, cube);
    hash.list(std::span<const glm::dvec3>(cloud.ready.positions));
    hash.list(std::span<const float>(cloud.ready.radii));
    hash.list(unless_all(cloud.ready.densities, 1.0f));
    hash.list(unless_all(cloud.ready.colors, glm::vec3(1.0f)));
    const auto add_model = [&](const auto& model) {
        if (model) hash.list(std::span<const double>(figures_of(*model)));
    };
    add_model(cloud.automaton);
    add_model(cloud.spheres);
    add_model(cloud.implicit);
    add_model(cloud.ellipsoids);
    hash.vector(cloud.translate);
    hash.vector(scene.time * cloud.velocity);
    hash.number(is_procedural(cloud) ? scene.time : 0.0);
    hash.number(cloud.scale);
    hash.number(cloud.rotate_y);
    hash.choice(cloud.fill.value_or(scene.fill));
    hash.number(cloud.density.value_or(scene.density.value_or(kDefaultDensity)));
    hash.integer(cloud.seed.value_or(scene.seed));
}

void add_lights(Hasher& hash, const SceneDraft& scene) {
    hash.number(scene.medium.albedo);
    hash.number(scene.medium.g);
    hash.choice(scene.medium.phase);
    hash.vector(sun_direction(scene.sun));
    hash.integer(scene.sun.auto_color);
    hash.integer(scene.effects[static_cast<int>(Effect::kSunColor)] == Switch::kOff);
    if (!scene.sun.auto_color) hash.vector(scene.sun.color);
    hash.number(scene.sun.intensity);
    hash.integer(scene.sky.none);
    if (!scene.sky.none) {
        hash.integer(scene.sky.physical);
        if (!scene.sky.physical) {
            hash.vector(scene.sky.zenith);
            hash.vector(scene.sky.horizon);
        }
        hash.number(scene.sky.intensity);
    }
    if (scene.sun.auto_color || (!scene.sky.none && scene.sky.physical))
        hash.number(scene.sky.turbidity);
    hash.optional(scene.ground, [&](const Ground& ground) {
        hash.number(ground.height);
        hash.vector(ground.albedo);
    });
    hash.optional(scene.detail, [&](const Detail& detail) {
        hash.number(detail.amount);
        hash.number(detail.size);
    });
}

void add_picture(Hasher& hash, const SceneDraft& scene) {
    hash.optional(scene.haze, [&](const Haze& haze) {
        hash.number(haze.extinction);
        hash.number(haze.height);
        hash.number(haze.scale_height);
        hash.vector(haze.albedo);
        hash.number(haze.g);
    });
    hash.integer(scene.camera.automatic);
    if (!scene.camera.automatic) {
        hash.vector(scene.camera.eye);
        hash.vector(scene.camera.target);
        hash.vector(scene.camera.up);
        hash.number(scene.camera.fov);
    }
    hash.integer(static_cast<std::uint64_t>(scene.image.width));
    hash.integer(static_cast<std::uint64_t>(scene.image.height));
    hash.choice(scene.image.format);
    hash.choice(scene.image.background);
    hash.choice(scene.image.precision);
    hash.optional(scene.image.exposure, [&](double stops) { hash.number(stops); });
    for (const Switch effect : scene.effects) hash.choice(effect);
    hash.choice(scene.look);
    hash.optional(scene.sequence, [&](const Sequence& sequence) {
        hash.number(sequence.from);
        hash.number(sequence.to);
    });
    const Accuracy& accuracy = scene.accuracy;
    const bool none = !accuracy.error && !accuracy.time_ms && !accuracy.rung;
    hash.optional(none ? kDefaultError : accuracy.error, [&](double error) { hash.number(error); });
    hash.optional(accuracy.time_ms, [&](double time_ms) { hash.number(time_ms); });
    hash.optional(accuracy.rung, [&](const std::string& rung) { hash.text(rung); });
}

}  // namespace

std::string light_fingerprint(const Scene& scene) {
    Hasher hash;
    hash.integer(scene->clouds.size());
    for (const Cloud& cloud : scene->clouds) add_cloud(hash, *scene, cloud);
    add_lights(hash, *scene);
    return hash.hex();
}

std::string fingerprint(const Scene& scene) {
    Hasher hash;
    hash.integer(scene->seed);  // also where every cloud has its own: answers quote it
    hash.integer(scene->clouds.size());
    for (const Cloud& cloud : scene->clouds) add_cloud(hash, *scene, cloud);
    add_lights(hash, *scene);
    add_picture(hash, *scene);
    return hash.hex();
}

}  // namespace awan
