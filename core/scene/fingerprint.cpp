// XXH3-128 over a canonical byte serialisation.
//
// A walk over the tables puts every field in, in their order: every list, optional and string preceded by its length or
// presence, so that no two scenes share their bytes by running together. Numbers go in as their little-endian bytes
// (the engine is built for x86-64 only), with -0 as 0.
//
// Equal scenes may be written in several ways, and some values have no meaning beside others. Those, and only those,
// are named here (Instead): another value stands for the member, or the member is left out. What is not named goes in
// as it is, so a new field is part of every fingerprint until somebody says otherwise.
#include "core/scene/fingerprint.h"

#define XXH_STATIC_LINKING_ONLY  // the state may stand on the stack
#include <xxhash.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <span>

#include "core/scene/automaton.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
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
    void text(std::string_view s) {
        integer(s.size());
        raw(s.data(), s.size());
    }
    template <typename T>
    void list(const std::vector<T>& values) {
        integer(values.size());
        raw(values.data(), values.size() * sizeof(T));
    }
    void raw(const void* data, std::size_t size) { XXH3_128bits_update(&state_, data, size); }

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
    XXH3_state_t state_;
};

// What stands for members of one scene. Keeps the values that it is given.
class Instead {
  public:
    // As if the member were absent.
    template <typename Member>
    void leave_out(const Member& member) {
        at(member) = nullptr;
    }
    // `value`: of the type that the member holds (of an optional, its value's).
    template <typename Member>
    void put(const Member& member, double value) {
        at(member) = &numbers_.emplace_back(value);
    }
    template <typename Member>
    void put(const Member& member, const glm::dvec3& value) {
        at(member) = &vectors_.emplace_back(value);
    }
    template <typename Member>
    void put(const Member& member, std::uint64_t value) {
        at(member) = &integers_.emplace_back(value);
    }
    template <typename Member>
    void put(const Member& member, Fill value) {
        at(member) = &fills_.emplace_back(value);
    }
    template <typename Member>
    void put(const Member& member, std::string_view value) {
        at(member) = &texts_.emplace_back(value);
    }
    template <typename Member, typename Model>
    void put(const Member& member, std::shared_ptr<const Model> value) {
        at(member) = value.get();
        models_.push_back(std::move(value));
    }

    // The value that goes in for a field: null when there is none.
    const void* value_of(const Field& field, const void* object) const {
        const auto found = of_.find({field.access.member(object), field.access.type});
        return found == of_.end() ? field.access.get(object) : found->second;
    }

  private:
    using Place = std::pair<const void*, const void*>;  // address and type

    template <typename Member>
    const void*& at(const Member& member) {
        return of_[{&member, &kTypeTag<Member>}];
    }

    std::map<Place, const void*> of_;
    // Places do not move.
    std::deque<double> numbers_;
    std::deque<glm::dvec3> vectors_;
    std::deque<std::uint64_t> integers_;
    std::deque<Fill> fills_;
    std::deque<std::string> texts_;
    std::vector<std::shared_ptr<const void>> models_;
};

void add_object(Hasher& hash, const Table& table, const void* object, const Instead& instead);

void add_value(Hasher& hash, const Field& field, const void* value, const Instead& instead) {
    switch (field.access.holds) {
        case Holds::kNumber:
            return hash.number(*static_cast<const double*>(value));
        case Holds::kInteger:
            return hash.integer(*static_cast<const std::uint64_t*>(value));
        case Holds::kInt:
            return hash.integer(static_cast<std::uint64_t>(*static_cast<const int*>(value)));
        case Holds::kVector:
            return hash.vector(*static_cast<const glm::dvec3*>(value));
        case Holds::kWord:
            return hash.integer(field.access.word(value));
        case Holds::kText:
            return hash.text(*static_cast<const std::string*>(value));
        case Holds::kSwitch:
            return hash.integer(static_cast<std::uint64_t>(*static_cast<const Switch*>(value)));
        case Holds::kObject:
            return add_object(hash, field.access.table(), value, instead);
        case Holds::kObjects: {
            const std::size_t size = field.access.size(value);
            hash.integer(size);
            for (std::size_t i = 0; i < size; ++i)
                add_object(hash, field.access.table(), field.access.element(value, i), instead);
            return;
        }
        case Holds::kFloats:
            return hash.list(*static_cast<const std::vector<float>*>(value));
        case Holds::kPoints:
            return hash.list(*static_cast<const std::vector<glm::dvec3>*>(value));
        case Holds::kColors:
            return hash.list(*static_cast<const std::vector<glm::vec3>*>(value));
        case Holds::kAbsence:
        case Holds::kOutside:
            return;
    }
}

// Of a traceless field that is there.
bool says_nothing(const Field& field, const void* value) {
    if (field.access.holds == Holds::kObjects) return field.access.size(value) == 0;
    return field.access.holds == Holds::kSwitch &&
           *static_cast<const Switch*>(value) == Switch::kAuto;
}

void add_field(Hasher& hash, const Field& field, const void* object, const Instead& instead) {
    if (field.access.holds == Holds::kOutside || field.access.holds == Holds::kAbsence) return;
    const void* const value = instead.value_of(field, object);
    const bool idle = field.idle != nullptr && field.idle(object);
    const bool used = value != nullptr && !idle &&
                      !(field.access.unused != nullptr && *field.access.unused(object));
    if (field.traceless) {
        if (!used || says_nothing(field, value)) return;
        hash.text(field.name);
    }
    // Of an optional field "not given" is one thing, and its word another.
    if (field.access.optional && field.access.unused != nullptr && *field.access.unused(object))
        hash.text(field.absent);
    hash.integer(used);
    if (used) add_value(hash, field, value, instead);
}

void add_object(Hasher& hash, const Table& table, const void* object, const Instead& instead) {
    const bool absent = is_absent(table, object);
    hash.integer(absent);
    if (absent) return;
    for (const Field& field : table.fields) add_field(hash, field, object, instead);
}

// --- what stands for what

// A list that only repeats the default says the same as no list.
template <typename T>
void leave_out_if_all(Instead& instead, const std::vector<T>& values, const T& standard) {
    if (std::all_of(values.begin(), values.end(), [&](const T& v) { return v == standard; }))
        instead.leave_out(values);
}

void settle_model(Instead& instead, const SceneDraft& scene, const Cloud& cloud) {
    if (cloud.implicit)
        instead.put(cloud.implicit,
                    std::shared_ptr<const ImplicitCloud>(
                        std::make_shared<ImplicitCloud>(spelled_out(*cloud.implicit))));
    if (cloud.automaton) {
        auto all = std::make_shared<AutomatonCloud>(*cloud.automaton);
        all->random = random_ellipsoids_of(*cloud.automaton);
        all->wind = spelled_out(cloud.automaton->wind);
        // By whatever names, textures are what they show.
        all->drawing.textures.clear();
        for (const std::string_view name : names_in(cloud.automaton->drawing.textures))
            all->drawing.textures.append(find_texture(scene, name)).append(",");
        instead.put(cloud.automaton, std::shared_ptr<const AutomatonCloud>(std::move(all)));
    }
    if (cloud.spheres) {
        // Ranges that only repeat the kind's say the same as none.
        const Span ratios = ratios_of(*cloud.spheres), shifts = shifts_of(*cloud.spheres);
        auto all = std::make_shared<SpheresCloud>(*cloud.spheres);
        all->kind = SpheresKind::kCumulus;
        all->ratio_min = ratios.low;
        all->ratio_max = ratios.high;
        all->shift_min = shifts.low;
        all->shift_max = shifts.high;
        if (all->bump && all->bump->texture) {
            const std::string_view hash = find_texture(scene, *all->bump->texture);
            if (hash.empty())
                all->bump->texture.reset();
            else
                all->bump->texture = std::string(hash);
        }
        instead.put(cloud.spheres, std::shared_ptr<const SpheresCloud>(std::move(all)));
    }
}

// By whatever name and from wherever it comes, a texture is what it shows; billboards are particles.
void settle_textures(Instead& instead, const SceneDraft& scene, const Cloud& cloud) {
    const auto settle = [&](const auto& member, std::string_view hash) {
        if (!hash.empty())
            instead.put(member, hash);
        else if (member)
            instead.leave_out(member);
    };
    const bool cubes = cloud.model == CloudModel::kCubes;
    settle(cloud.texture, cubes ? std::string_view() : texture_of(scene, cloud, nullptr));
    if (cloud.billboards) instead.leave_out(cloud.billboards);
    for (const Cube& cube : cloud.cubes) {
        settle(cube.texture, texture_of(scene, cloud, &cube));
        if (cube.billboards) instead.leave_out(cube.billboards);
        const std::uint64_t particles = particles_of(scene, cloud, cube);
        if (particles != cube.particles) instead.put(cube.particles, particles);
    }
}

void settle_cloud(Instead& instead, const SceneDraft& scene, const Cloud& cloud) {
    leave_out_if_all(instead, cloud.ready.densities, 1.0f);
    leave_out_if_all(instead, cloud.ready.colors, glm::vec3(1.0f));
    settle_model(instead, scene, cloud);
    // Where it stands is what tells two times apart.
    instead.put(cloud.velocity, clouds_time(scene) * cloud.velocity);
    instead.put(cloud.fill, fill_of(scene, cloud));
    if (const auto density = density_of(scene, cloud)) instead.put(cloud.density, *density);
    instead.put(cloud.seed, seed_of(scene, cloud));
    settle_textures(instead, scene, cloud);
}

void settle_lights(Instead& instead, const SceneDraft& scene) {
    // By angles or by a direction: the same sun.
    instead.leave_out(scene.sun.elevation);
    instead.leave_out(scene.sun.azimuth);
    instead.put(scene.sun.direction, sun_direction(scene.sun));
    const bool physical = !scene.sky.none && scene.sky.physical;
    if (!physical && !scene.sun.auto_color) instead.leave_out(scene.sky.turbidity);
    if (!physical) instead.leave_out(scene.sky.daylight);
}

// What holds for light and picture alike.
Instead settled(const SceneDraft& scene) {
    Instead instead;
    // Clouds have the scene's, and there is one way to list them.
    instead.leave_out(scene.fill);
    instead.leave_out(scene.density);
    instead.leave_out(scene.texture);
    instead.leave_out(scene.billboards);
    for (const Cloud& cloud : scene.clouds) settle_cloud(instead, scene, cloud);
    settle_lights(instead, scene);
    // By whatever name it comes, a height map is what it shows.
    if (scene.ground && scene.ground->terrain && scene.ground->terrain->map)
        instead.put(scene.ground->terrain->map, map_hash(scene));
    return instead;
}

// The time moves clouds, which is said of each in settle_cloud(), and shows in those that change.
void settle_time(Instead& instead, const SceneDraft& scene) {
    if (std::any_of(scene.clouds.begin(), scene.clouds.end(), is_procedural))
        instead.put(scene.time, clouds_time(scene));
    else
        instead.leave_out(scene.time);
}

void settle_accuracy(Instead& instead, const Accuracy& accuracy) {
    if (!accuracy.error && !accuracy.time_ms && !accuracy.rung)
        instead.put(accuracy.error, kDefaultError);
}

std::string digest(const SceneDraft& scene, const Instead& instead) {
    Hasher hash;
    // The clouds first, as a list, however the document had them.
    hash.integer(scene.clouds.size());
    for (const Cloud& cloud : scene.clouds) add_object(hash, table_of<Cloud>(), &cloud, instead);
    for (const Field& field : table_of<SceneDraft>().fields)
        if (field.access.holds != Holds::kObjects) add_field(hash, field, &scene, instead);
    return hash.hex();
}

}  // namespace

std::string fingerprint(const Scene& scene) {
    Instead instead = settled(*scene);
    settle_accuracy(instead, scene->accuracy);
    // A picture is of one time, whatever their number.
    if (scene->sequence) instead.leave_out(scene->sequence->frames);
    // A camera that moves is elsewhere at each time.
    if (!scene->sequence || scene->sequence->camera.empty()) settle_time(instead, *scene);
    return digest(*scene, instead);
}

std::string light_fingerprint(const Scene& scene) {
    Instead instead = settled(*scene);
    settle_time(instead, *scene);
    // Clouds have theirs.
    instead.leave_out(scene->seed);
    instead.leave_out(scene->haze);
    instead.leave_out(scene->camera);
    instead.leave_out(scene->image);
    instead.leave_out(scene->sun.disc);
    instead.leave_out(scene->accuracy);
    instead.leave_out(scene->look);
    instead.leave_out(scene->display);
    for (const Cloud& cloud : scene->clouds) {
        instead.leave_out(cloud.texture);
        for (const Cube& cube : cloud.cubes)
            if (!texture_of(*scene, cloud, &cube).empty()) instead.leave_out(cube.texture);
    }
    instead.leave_out(scene->sequence);
    for (const Switch& effect : scene->effects)
        if (!((&effect == &scene->effects[static_cast<std::size_t>(Effect::kSunColor)] ||
               &effect == &scene->effects[static_cast<std::size_t>(Effect::kTerrain)]) &&
              effect == Switch::kOff))
            instead.leave_out(effect);
    return digest(*scene, instead);
}

std::string fingerprint_of(const Table& table, const void* object) {
    Hasher hash;
    add_object(hash, table, object, Instead());
    return hash.hex();
}

}  // namespace awan
