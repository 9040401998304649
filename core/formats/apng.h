// PNG files -> one animated PNG (https://wiki.mozilla.org/APNG_Specification, PNG third edition 11.3.6): the chunks of
// pixels of every frame are kept as they are, under other names.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace awan {

// Makes an animated PNG of PNG files, frame by frame.
class ApngWriter {
  public:
    // delay_ms: how long a frame is shown, 1..65535; frames: how many will come, >= 1.
    ApngWriter(std::uint16_t delay_ms, std::uint32_t frames);
    // png: a whole PNG file. All are of one size and kind.
    Status add(std::string_view png);
    std::string end();

  private:
    void chunk(std::string_view type, std::string_view data);
    std::uint16_t delay_ms_;
    std::uint32_t frames_;
    std::uint32_t sequence_ = 0;
    // The chunk IHDR of the first frame.
    std::string header_;
    std::string out_;
};

}  // namespace awan
