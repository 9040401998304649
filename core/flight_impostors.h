// The impostors of one flight while it is flown, frame after frame: what is drawn, kept, shown and let go
// (core/plan/impostor_runs.h says when). Only matter and light that stay the same have them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/draw/march_layers.h"
#include "core/plan/impostor_runs.h"
#include "core/planning.h"
#include "core/sequence.h"

namespace awan {

// What a frame had of them.
struct ImpostorFrame {
    // Clouds that a picture of an earlier frame was shown for; pictures that were drawn, and of those the ones that
    // took the place of one whose bound was crossed; clouds in the picture that were drawn as they are. All 0: the
    // frame was drawn whole.
    std::uint32_t kept = 0, drawn = 0, redrawn = 0, whole = 0;
    // Of drawing the pictures; of all else that the frame's eye pass took.
    double pictures_ms = 0, frame_ms = 0;
};

// How it went.
struct ImpostorReport {
    FlightImpostorWish wish;
    bool on = false;
    std::string reason = "no frame was drawn";
    // Clouds that stand apart; the share of the eye pass's work that was forecast to be saved.
    std::uint64_t clouds = 0;
    double saved = 0;
};

class FlightImpostors {
  public:
    // scene: one with a sequence.
    FlightImpostors(const FlightImpostorWish& wish, const Scene& scene, const Settled& settled);

    // The picture of a frame, made of clouds' pictures; none: it is to be drawn whole. Frames come in their order; one
    // that is left out does no harm. Errors: of march().
    Result<std::optional<Image>> draw(std::uint64_t frame, const Scene& scene,
                                      const Planned& planned, const TransportLight& light,
                                      const MarchSettings& settings, int threads,
                                      const Deadline& deadline, EffectTimes* times,
                                      ImpostorFrame& of_frame);

    const ImpostorReport& report() const { return report_; }
    const std::vector<ImpostorRun>& runs() const { return plan_.runs; }

  private:
    struct Kept {
        const ImpostorRun* run;
        CloudPicture picture;
        std::size_t bytes() const { return picture.texels.pixels.size() * sizeof(float); }
    };

    void begin(const Scene& scene, const Planned& planned);
    // Of the runs that cover a frame, by cloud; null: the cloud has none.
    std::vector<const ImpostorRun*> runs_at(std::uint64_t frame) const;
    Status draw_pictures(const std::vector<const ImpostorRun*>& runs, std::uint64_t frame,
                         const Scene& scene, const ParticleSet& particles,
                         const TransportLight& light, const MarchSettings& settings, int threads,
                         const Deadline& deadline, ImpostorFrame& of_frame);
    // What a frame is made of, front to back: a picture, or clouds that are marched together.
    struct Group {
        const CloudPicture* picture = nullptr;
        std::vector<std::size_t> clouds;
    };
    std::vector<Group> groups(const View& view, const ImageSettings& image,
                              ImpostorFrame& of_frame) const;

    ImpostorReport report_;
    std::vector<View> views_;
    bool begun_ = false;
    SeparateClouds clouds_;
    std::size_t particles_ = 0;
    std::uint64_t variant_ = 0;
    ImpostorPlan plan_;
    std::map<std::size_t, Kept> kept_;  // by cloud
    std::size_t bytes_ = 0;
};

// What all pictures that one flight keeps take at most: frames of its own, and bytes.
inline constexpr std::size_t kMostImpostorFrames = 4, kMostImpostorBytes = 64 << 20;
// Pixels of a frame; larger ones are drawn whole.
inline constexpr std::size_t kLargestImpostorFrame = 1 << 22;

// The most memory that the impostors of a flight take, bytes: pictures, and layers while they are laid.
std::size_t impostor_bytes(const Scene& scene);

}  // namespace awan
