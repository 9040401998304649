#include "core/flight_impostors.h"

#include <algorithm>
#include <list>
#include <utility>

#include "core/scene/camera_keys.h"

namespace awan {
namespace {

std::size_t frame_pixels(const Scene& scene) {
    return static_cast<std::size_t>(scene->image.width) *
           static_cast<std::size_t>(scene->image.height);
}

std::size_t most_bytes(const Scene& scene) {
    return std::min(kMostImpostorFrames * frame_pixels(scene) * 4 * sizeof(float),
                    kMostImpostorBytes);
}

// Why a flight can have none; EMPTY: it may.
std::string none_because(const Scene& scene, const Settled& settled) {
    if (scene->look != Look::kPhysical || scene->display != Display::kLit)
        return "its pictures are not made of light";
    if (frame_pixels(scene) > kLargestImpostorFrame) return "its frames are too large";
    if (settled.sequence.camera.empty() || !clouds_stand(*scene)) return "its clouds do not stand";
    return {};
}

bool same_matter(const Planned& planned, std::size_t particles, std::uint64_t variant) {
    return planned.particles.size() == particles && planned.particles.variant == variant;
}

}  // namespace

std::size_t impostor_bytes(const Scene& scene) {
    if (frame_pixels(scene) > kLargestImpostorFrame) return 0;
    // The light and what is left of it, and one layer.
    return most_bytes(scene) + frame_pixels(scene) * 11 * sizeof(float);
}

FlightImpostors::FlightImpostors(const FlightImpostorWish& wish, const Scene& scene,
                                 const Settled& settled) {
    report_.wish = wish;
    report_.reason =
        wish.mode == Impostors::kOff ? "they are switched off" : none_because(scene, settled);
    begun_ = !report_.reason.empty();
    if (begun_) return;
    report_.reason = "its rung does not march";
    views_ = views_of_frames(settled);
}

void FlightImpostors::begin(const Scene& scene, const Planned& planned) {
    begun_ = true;
    clouds_ = separate_clouds(planned.particles, planned.survey.islands);
    particles_ = planned.particles.size();
    variant_ = planned.particles.variant;
    plan_ = plan_impostors(report_.wish, scene, clouds_, views_);
    report_.on = plan_.on;
    report_.reason = plan_.reason;
    report_.saved = plan_.saved;
    report_.clouds = clouds_.list.size();
}

std::vector<const ImpostorRun*> FlightImpostors::runs_at(std::uint64_t frame) const {
    std::vector<const ImpostorRun*> runs(clouds_.list.size());
    for (const ImpostorRun& run : plan_.runs)
        if (run.first <= frame && frame <= run.last) runs[run.cloud] = &run;
    return runs;
}

Status FlightImpostors::draw_pictures(const std::vector<const ImpostorRun*>& runs,
                                      std::uint64_t frame, const Scene& scene,
                                      const ParticleSet& particles, const TransportLight& light,
                                      const MarchSettings& settings, int threads,
                                      const Deadline& deadline, ImpostorFrame& of_frame) {
    const std::size_t most = most_bytes(scene);
    for (std::size_t cloud = 0; cloud < runs.size(); ++cloud) {
        const auto old = kept_.find(cloud);
        const bool same = old != kept_.end() && old->second.run == runs[cloud];
        if (same) {
            ++of_frame.kept;
            continue;
        }
        const bool crossed = old != kept_.end() && runs[cloud] != nullptr &&
                             old->second.run->last + 1 == runs[cloud]->first;
        if (old != kept_.end()) {
            bytes_ -= old->second.bytes();
            kept_.erase(old);
        }
        if (runs[cloud] == nullptr || runs[cloud]->last == frame) continue;
        const FacingPicture& facing = runs[cloud]->picture;
        const std::size_t bytes = static_cast<std::size_t>(facing.width) *
                                  static_cast<std::size_t>(facing.height) * 4 * sizeof(float);
        if (bytes_ + bytes > most) continue;
        const ParticleSet matter = some_of(particles, clouds_.list[cloud].particles);
        auto picture = march_picture(scene, {&matter, {clouds_.list[cloud].all}}, facing, light,
                                     settings, threads, deadline);
        if (!picture) return picture.error();
        kept_.emplace(cloud, Kept{runs[cloud], *std::move(picture)});
        bytes_ += bytes;
        ++of_frame.drawn;
        if (crossed) ++of_frame.redrawn;
    }
    return std::nullopt;
}

std::vector<FlightImpostors::Group> FlightImpostors::groups(const View& view,
                                                            const ImageSettings& image,
                                                            ImpostorFrame& of_frame) const {
    struct Placed {
        Group group;
        PictureBox box;
    };
    std::vector<Placed> placed;
    for (const std::size_t cloud : front_to_back(clouds_, view.eye)) {
        const PictureBox box = picture_box(view, image, clouds_.list[cloud].all);
        if (!box.any()) continue;
        const auto kept = kept_.find(cloud);
        if (kept != kept_.end()) {
            placed.push_back({{&kept->second.picture, {cloud}}, box});
            continue;
        }
        ++of_frame.whole;
        // Into the last group that is marched, past pictures that it does not meet.
        auto at = placed.rbegin();
        while (at != placed.rend() && at->group.picture != nullptr && !at->box.meets(box)) ++at;
        if (at == placed.rend() || at->group.picture != nullptr) {
            placed.push_back({{nullptr, {cloud}}, box});
            continue;
        }
        at->group.clouds.push_back(cloud);
        at->box = at->box.with(box);
    }
    std::vector<Group> groups;
    for (Placed& one : placed) groups.push_back(std::move(one.group));
    return groups;
}

Result<std::optional<Image>> FlightImpostors::draw(std::uint64_t frame, const Scene& scene,
                                                   const Planned& planned,
                                                   const TransportLight& light,
                                                   const MarchSettings& settings, int threads,
                                                   const Deadline& deadline, EffectTimes* times,
                                                   ImpostorFrame& of_frame) {
    if (!begun_) begin(scene, planned);
    if (!plan_.on || frame >= plan_.frames.size() ||
        !plan_.frames[static_cast<std::size_t>(frame)] ||
        !same_matter(planned, particles_, variant_))
        return std::optional<Image>();
    const auto start = Deadline::Clock::now();
    if (const Status failed = draw_pictures(runs_at(frame), frame, scene, planned.particles, light,
                                            settings, threads, deadline, of_frame))
        return *failed;
    of_frame.pictures_ms = ms_since(start);
    const View& view = planned.survey.view;
    std::list<ParticleSet> matter;
    std::vector<CloudLayer> layers;
    for (const Group& group : groups(view, scene->image, of_frame)) {
        CloudLayer& layer = layers.emplace_back();
        layer.picture = group.picture;
        if (group.picture != nullptr) continue;
        std::vector<std::uint32_t> indices;
        for (const std::size_t cloud : group.clouds) {
            const SeparateCloud& own = clouds_.list[cloud];
            indices.insert(indices.end(), own.particles.begin(), own.particles.end());
            layer.clouds.boxes.push_back(own.all);
        }
        std::sort(indices.begin(), indices.end());
        layer.clouds.particles = &matter.emplace_back(some_of(planned.particles, indices));
    }
    auto image = march_layers(scene, planned.particles, view, light, settings, layers, threads,
                              deadline, times);
    of_frame.frame_ms = ms_since(start) - of_frame.pictures_ms;
    if (!image) return image.error();
    return std::optional<Image>(*std::move(image));
}

}  // namespace awan
