#include "core/draw/march.h"

#include <optional>
#include <span>

#include "core/draw/march_setup.h"

namespace awan {
namespace {

// Haze that only dims.
Air dark(Air air) {
    air.ambient = air.sun = glm::dvec3(0);
    return air;
}

Image blank(const MarchScene& scene) {
    Image image{scene.width, scene.height, false, {}};
    image.pixels.resize(4 * image.pixel_count());
    return image;
}

// What is marched beside a picture. It refers to all that it is made from.
class Beside {
  public:
    // `picture`: what the picture is marched through.
    Beside(const Scene& scene, const ParticleSet& particles, const MarchSettings& settings,
           int threads, const MarchScene& picture, const LightsOnce* lights)
        : picture_(picture), with_light_(lights != nullptr) {
        if (picture.air != nullptr) air_ = dark(*picture.air);
        const auto in_light = [&](const TransportLight& light) {
            MarchScene other = march_scene(scene, picture.view, light, particles, *picture.seen,
                                           settings.step_error, threads);
            other.sky.backdrop = picture.sky.backdrop;  // rays end at its ground
            other.air = air_ ? &*air_ : nullptr;
            return other;
        };
        // In the picture's own light, so that its steps are the picture's.
        MarchScene measured = picture;
        measured.sky.behind = measured.sky.peak = false;
        measured.measures = true;
        along.push_back({measured, blank(picture)});
        if (lights == nullptr) return;
        along.push_back({in_light(lights->sun), blank(picture)});
        along.push_back({in_light(lights->sky), blank(picture)});
        along.back().scene.sun = glm::vec3(0);
        if (!air_) return;
        MarchScene all = picture;
        all.air = &*air_;
        all.sky.behind = false;
        along.push_back({all, blank(picture)});
    }
    Beside(const Beside&) = delete;
    Beside& operator=(const Beside&) = delete;

    // False: the deadline passed.
    bool take(int threads, const Deadline& deadline, MarchedBeside& to) {
        to.distance = std::move(along[0].image);
        if (with_light_) {
            to.sun = std::move(along[1].image);
            to.sky = std::move(along[2].image);
            if (air_) to.all = std::move(along[3].image);
        }
        to.behind = blank(picture_);
        if (!picture_.sky.behind) return true;
        MarchScene bare = picture_;
        const std::vector<SeenParticle> none;
        bare.seen = &none;
        bare.air = air_ ? &*air_ : nullptr;
        return march_blocks(bare, threads, deadline, to.behind);
    }

    std::vector<MarchedAlong> along;

  private:
    const MarchScene& picture_;
    const bool with_light_;
    std::optional<Air> air_;
};

}  // namespace

Result<Image> march(const Scene& scene, const ParticleSet& particles, const View& view,
                    const TransportLight& light, const MarchSettings& settings, int threads,
                    const Deadline& deadline, EffectTimes* times, MarchedBeside* beside,
                    const LightsOnce* lights) {
    EffectTimes took;
    if (auto error = deadline.over()) return *error;
    const bool behind = scene->image.background == Background::kSky;
    Image image{scene->image.width, scene->image.height, behind, {}};
    image.pixels.resize(4 * image.pixel_count());
    std::vector<SeenParticle> own;
    if (settings.seen == nullptr)
        own = see_particles(particles, view, image.width, image.height, threads);
    const std::vector<SeenParticle>& seen = settings.seen != nullptr ? *settings.seen : own;
    MarchScene march =
        march_scene(scene, view, light, particles, seen, settings.step_error, threads);
    march.one_ray = settings.one_ray;
    if (!settings.fineness.empty()) set_fineness(settings.fineness, march);
    if (settings.sampled_blocks > 0)
        march.wanted = sample_blocks(seen, image.width, image.height, settings.sampled_blocks);
    MarchBehind around;
    set_behind(scene, light, settings, image.width, image.height, threads, took, around, march);

    if (auto error = deadline.over()) return *error;
    std::optional<Beside> others;
    if (beside != nullptr) others.emplace(scene, particles, settings, threads, march, lights);
    if (!march_blocks(march, threads, deadline, image,
                      others ? std::span<MarchedAlong>(others->along) : std::span<MarchedAlong>()))
        if (auto error = deadline.over()) return *error;
    if (others && !others->take(threads, deadline, *beside))
        if (auto error = deadline.over()) return *error;
    if (times != nullptr) times->add(took);
    return image;
}

}  // namespace awan
