// Moving pictures for looking at, made frame by frame: animated WebP (lossy, libwebp) and APNG (lossless).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/deadline.h"
#include "core/base/image.h"
#include "core/base/result.h"
#include "core/formats/tone.h"

namespace awan {

enum class AnimationFormat { kWebp, kApng };

// Plays for ever. Frames are all of one size, shown for equal times.
class Animation {
  public:
    // frames_per_second > 0; frames: how many will be added.
    static Result<Animation> begin(AnimationFormat format, double frames_per_second,
                                   std::uint64_t frames);
    Animation(Animation&& other) noexcept;
    Animation& operator=(Animation&& other) noexcept;
    ~Animation();

    // The picture goes through the same curve as in encode_png. libwebp cannot be told to stop: of WebP the deadline is
    // looked at before a frame.
    Status add(const Image& image, const FilmSettings& film, const Deadline& deadline = {});
    // The file, once all frames were added.
    Result<std::string> end();

  private:
    struct State;
    explicit Animation(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace awan
