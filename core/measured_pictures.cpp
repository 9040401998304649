#include "core/measured_pictures.h"

#include <algorithm>

#include "core/draw/backdrop.h"
#include "core/draw/march_setup.h"
#include "core/draw/picture_difference.h"
#include "core/scene/outside.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

// `measured` plus what the pixels of `picture` that are nearest to its own have more than `with_behind`, a picture of
// its size; of those in which it has something, as only these are compared.
Image moved_by(const Image& measured, const Image& with_behind, const Image& picture) {
    Image moved = measured;
    const auto nearest = [](int at, int of, int from) {
        return static_cast<std::size_t>(
            std::min(static_cast<int>((at + 0.5) * from / of), from - 1));
    };
    std::size_t to = 0;
    for (int y = 0; y < measured.height; ++y)
        for (int x = 0; x < measured.width; ++x, ++to) {
            if (!(measured.pixels[4 * to + 3] > 0)) continue;
            const std::size_t from = nearest(y, measured.height, picture.height) *
                                         static_cast<std::size_t>(picture.width) +
                                     nearest(x, measured.width, picture.width);
            for (std::size_t c = 0; c < 3; ++c)
                moved.pixels[4 * to + c] +=
                    picture.pixels[4 * from + c] - with_behind.pixels[4 * to + c];
        }
    return moved;
}

// Blocks in which there is something to see: 1 for each, row by row.
std::vector<std::uint8_t> blocks_with_alpha(const Image& image) {
    const auto across = static_cast<std::size_t>(blocks_in(image.width));
    std::vector<std::uint8_t> blocks(across * static_cast<std::size_t>(blocks_in(image.height)));
    const auto width = static_cast<std::size_t>(image.width);
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
        if (image.pixels[4 * i + 3] > 0)
            blocks[i / width / kBlockSide * across + i % width / kBlockSide] = 1;
    return blocks;
}

}  // namespace

Result<MeasuredPictures> MeasuredPictures::of(const Scene& scene, const Planned& planned,
                                              int blocks, int threads, const Deadline& deadline) {
    auto measured = for_measuring(scene);
    if (!measured.ok()) return measured.error();
    return MeasuredPictures(scene, *std::move(measured), planned, blocks, threads, deadline);
}

const std::vector<SeenParticle>& MeasuredPictures::seen() {
    if (seen_.empty())
        seen_ = see_particles(planned_->particles, planned_->survey.view, measured_->image.width,
                              measured_->image.height, threads_);
    return seen_;
}

void MeasuredPictures::march_like(const TransportLight& light) {
    if (fineness_.empty())
        fineness_ = fineness_of(planned_->survey.view, light, planned_->particles, seen());
}

Result<Image> MeasuredPictures::draw(const Scene& scene, const TransportLight& light) {
    const ParticleSet& particles = planned_->particles;
    const View& view = planned_->survey.view;
    march_like(light);
    MarchSettings settings;
    settings.seen = &seen();
    settings.fineness = fineness_;
    if (!scene->ground && light.sky && light.peak_share > 0 && outside_of(scene).sky.shines) {
        if (!through_peak_)
            through_peak_ = behind_through_peak(
                scene, view, scene->image.width, scene->image.height, light.ground,
                {light.peak_from, light.peak_share}, true, false, threads_);
        settings.through_peak = &*through_peak_;
    }
    settings.eye_effects = planned_->plan.eye_effects();
    settings.one_ray = true;
    settings.sampled_blocks = blocks_;
    return march(scene, particles, view, light, settings, threads_, *deadline_);
}

Result<const Image*> MeasuredPictures::of(const TransportLight& light) {
    for (const auto& [of, picture] : made_)
        if (of == &light) return &picture;
    auto made = draw(measured_, light);
    if (!made.ok()) return made.error();
    made_.emplace_back(&light, *std::move(made));
    return &made_.back().second;
}

Result<double> MeasuredPictures::difference(const TransportLight& coarser,
                                            const TransportLight& finer) {
    const auto own = of(finer);
    if (!own.ok()) return own.error();
    const auto before = of(coarser);
    if (!before.ok()) return before.error();
    return picture_difference(**before, **own);
}

// What stands behind is the same in both: with it, they differ by the cloud alone.
Result<Image> MeasuredPictures::with_behind(const Image& measured, const TransportLight& light) {
    const Background background = (*scene_)->image.background;
    if (background == Background::kTransparent) return measured;
    // What hills send comes through the haze before them.
    if ((*scene_)->haze && light.ground.relief) {
        SceneDraft draft = *measured_;
        draft.image.background = background;
        const auto over_it = validate(std::move(draft));
        if (!over_it.ok()) return over_it.error();
        return draw(*over_it, light);
    }
    Image over = measured;
    lay_under(over,
              make_backdrop(measured_, planned_->survey.view, over.width, over.height, light.ground,
                            threads_, nullptr, nullptr, blocks_with_alpha(over)));
    return over;
}

Result<double> MeasuredPictures::difference(const Image& picture, const TransportLight& light) {
    const auto own = of(light);
    if (!own.ok()) return own.error();
    const auto over_it = with_behind(**own, light);
    if (!over_it.ok()) return over_it.error();
    return picture_difference(moved_by(**own, *over_it, picture), **own);
}

}  // namespace awan
