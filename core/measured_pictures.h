// The pictures that tell by how much lights differ: what the error that is stated for a picture is measured with.
#pragma once

#include <list>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/image.h"
#include "core/draw/behind_peak.h"
#include "core/draw/march.h"
#include "core/draw/march_bins.h"
#include "core/planning.h"

namespace awan {

// Of one scene, each made once: a sample of the picture's own blocks, the same ones of every light, with a ray in the
// middle of every pixel and nothing behind. Scene, plan, deadline and lights outlive it.
class MeasuredPictures {
  public:
    // blocks: how many, > 0. Errors: those of validate().
    static Result<MeasuredPictures> of(const Scene& scene, const Planned& planned, int blocks,
                                       int threads, const Deadline& deadline);

    // All pictures are marched as finely as that light's would be; the first call counts. Without one they are as the
    // first light of them asks for.
    void march_like(const TransportLight& light);

    // By how much the picture of `coarser` is off where that of `finer` is the truth (picture_difference()). Errors:
    // kOverDeadline, kCancelled.
    Result<double> difference(const TransportLight& coarser, const TransportLight& finer);

    // The same of the scene's own picture, made without a grid, of its whole size and with what stands behind it.
    Result<double> difference(const Image& picture, const TransportLight& light);

    // How many pictures were made.
    std::size_t made() const { return made_.size(); }

  private:
    MeasuredPictures(const Scene& scene, Scene measured, const Planned& planned, int blocks,
                     int threads, const Deadline& deadline)
        : scene_(&scene),
          measured_(std::move(measured)),
          planned_(&planned),
          deadline_(&deadline),
          blocks_(blocks),
          threads_(threads) {}

    const std::vector<SeenParticle>& seen();
    Result<Image> draw(const Scene& scene, const TransportLight& light);
    Result<const Image*> of(const TransportLight& light);
    Result<Image> with_behind(const Image& measured, const TransportLight& light);

    const Scene* scene_;
    Scene measured_;  // over nothing, and of fewer pixels where there are many
    const Planned* planned_;
    const Deadline* deadline_;
    int blocks_, threads_;
    std::vector<SeenParticle> seen_;
    MarchFinenesses fineness_;  // of all of them
    // Of the sky alone: a ground is lit by each light in its own way.
    std::optional<BehindPeak> through_peak_;
    std::list<std::pair<const TransportLight*, Image>> made_;
};

}  // namespace awan
