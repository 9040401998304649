#include "core/formats/animation.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/thrown.h"
#include "core/formats/apng.h"
#include "core/formats/image_file.h"

namespace awan {
namespace {

// Quality of lossy WebP, of 100. At 90 no blocks show in a smooth sky.
constexpr float kWebpQuality = 90;

Error failed(const std::string& what) {
    return {ErrorCode::kInternal, "", "the animation could not be encoded: " + what};
}

bool is_no_memory(WebPEncodingError error) {
    return error == VP8_ENC_ERROR_OUT_OF_MEMORY || error == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY;
}

// The longest side that libwebp takes, pixels.
constexpr int kLongestSide = WEBP_MAX_DIMENSION;

struct DeleteEncoder {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};

// A frame as libwebp takes it. Frees its memory.
class Picture {
  public:
    Picture() { ok_ = WebPPictureInit(&picture_) != 0; }
    ~Picture() { WebPPictureFree(&picture_); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;
    bool import(const Image& image, const FilmSettings& film) {
        if (!ok_) return false;
        picture_.width = image.width;
        picture_.height = image.height;
        picture_.use_argb = 1;
        const std::vector<std::uint8_t> pixels = display_pixels(image, film);
        return (image.opaque
                    ? WebPPictureImportRGB(&picture_, pixels.data(), 3 * image.width)
                    : WebPPictureImportRGBA(&picture_, pixels.data(), 4 * image.width)) != 0;
    }
    WebPPicture* get() { return &picture_; }

  private:
    WebPPicture picture_{};
    bool ok_ = false;
};

}  // namespace

struct Animation::State {
    AnimationFormat format = AnimationFormat::kWebp;
    double frame_ms = 40;
    std::uint64_t count = 0;
    std::unique_ptr<WebPAnimEncoder, DeleteEncoder> webp;
    std::optional<ApngWriter> apng;

    int at_ms() const {
        return static_cast<int>(std::lround(frame_ms * static_cast<double>(count)));
    }
};

Animation::Animation(std::unique_ptr<State> state) : state_(std::move(state)) {}
Animation::Animation(Animation&& other) noexcept = default;
Animation& Animation::operator=(Animation&& other) noexcept = default;
Animation::~Animation() = default;

Result<Animation> Animation::begin(AnimationFormat format, double frames_per_second,
                                   std::uint64_t frames) {
    auto state = std::make_unique<State>();
    state->format = format;
    state->frame_ms = std::clamp(1000 / frames_per_second, 1.0, 65535.0);
    if (format == AnimationFormat::kApng)
        state->apng.emplace(static_cast<std::uint16_t>(std::lround(state->frame_ms)),
                            static_cast<std::uint32_t>(frames));
    return Animation(std::move(state));
}

Status Animation::add(const Image& image, const FilmSettings& film, const Deadline& deadline) {
    State& state = *state_;
    if (Status over = deadline.over()) return over;
    if (state.apng) {
        auto png = encode_png(image, film, 8, deadline);
        if (!png.ok()) return png.error();
        return state.apng->add(*png);
    }
    WebPConfig config;
    if (WebPConfigInit(&config) == 0) return failed("libwebp is of another version");
    config.quality = kWebpQuality;
    config.alpha_quality = 100;
    if (!state.webp) {
        WebPAnimEncoderOptions options;
        if (WebPAnimEncoderOptionsInit(&options) == 0)
            return failed("libwebp is of another version");
        state.webp.reset(WebPAnimEncoderNew(image.width, image.height, &options));
        if (!state.webp && std::max(image.width, image.height) > kLongestSide)
            return failed("a side is over " + std::to_string(kLongestSide) + " pixels");
        if (!state.webp) return out_of_memory();
    }
    Picture picture;
    if (!picture.import(image, film)) return out_of_memory();
    if (WebPAnimEncoderAdd(state.webp.get(), picture.get(), state.at_ms(), &config) == 0)
        return is_no_memory(picture.get()->error_code)
                   ? out_of_memory()
                   : failed(WebPAnimEncoderGetError(state.webp.get()));
    ++state.count;
    return std::nullopt;
}

Result<std::string> Animation::end() {
    State& state = *state_;
    if (state.apng) return state.apng->end();
    if (!state.webp) return failed("it has no frames");
    if (WebPAnimEncoderAdd(state.webp.get(), nullptr, state.at_ms(), nullptr) == 0)
        return failed(WebPAnimEncoderGetError(state.webp.get()));
    WebPData data;
    WebPDataInit(&data);
    if (WebPAnimEncoderAssemble(state.webp.get(), &data) == 0)
        return failed(WebPAnimEncoderGetError(state.webp.get()));
    std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    return bytes;
}

}  // namespace awan
