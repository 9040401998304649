// awan_pictures: a program that reads one picture (picture_program.h). The only user of OpenImageIO.
#include <OpenImageIO/imageio.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include "core/base/descriptor.h"
#include "core/formats/picture_program.h"
#include "core/scene/limits.h"

namespace {

// Kinds of still pictures, those first that are told for sure by their first bytes. Videos, volumes, camera raws and
// what runs other programs are not among them.
constexpr const char* kKinds[] = {"png",  "jpeg",      "tiff", "openexr", "webp", "gif",
                                  "bmp",  "psd",       "dds",  "hdr",     "dpx",  "cineon",
                                  "fits", "jpeg2000",  "iff",  "sgi",     "ico",  "pnm",
                                  "rla",  "softimage", "targa"};

// Standard input, for readers of every kind take a path.
constexpr const char* kPath = "/proc/self/fd/0";

constexpr const char* kTooLarge = "it has more than 16384 pixels along a side or 16777216 in all";
static_assert(awan::limits::kMaxTexturePixels == 16777216 &&
                  awan::limits::kMaxTexturePictureSide == 16384,
              "the text above says it");

void limit(int what, unsigned long long most) {
    const rlimit both{most, most};
    setrlimit(static_cast<__rlimit_resource>(what), &both);
}

// Nothing of the program that started this one is of use here; and when that one goes, this goes too.
void keep_within_bounds() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close_range(STDERR_FILENO + 1, ~0u, 0);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, awan::kPictureSeconds);
#ifndef AWAN_SANITIZED
    limit(RLIMIT_DATA, awan::kPictureMemory);
#endif
}

void say(const awan::PictureHead& head, std::string_view rest) {
    awan::write_all(STDOUT_FILENO, {reinterpret_cast<const char*>(&head), sizeof head});
    awan::write_all(STDOUT_FILENO, rest);
}

std::unique_ptr<OIIO::ImageInput> open_picture(OIIO::ImageSpec& spec) {
    for (const char* const kind : kKinds) {
        std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(kind);
        if (!input) {
            OIIO::geterror();
            continue;
        }
        try {
            if (input->open(kPath, spec)) return input;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception&) {
        }
        input->geterror();
    }
    return nullptr;
}

// The luminance of a picture whose alpha does not count, by rows as they come, as means over areas.
class Heights {
  public:
    Heights(int width, int height)
        : width_(width), height_(height), across_(side(width)), down_(side(height)) {
        sums_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_));
    }
    int across() const { return across_; }
    int down() const { return down_; }
    // A pixel is shared out among those of the map that it lies in, along either side.
    void add_row(int y, const std::vector<float>& row) {
        for (int j = first(y, height_, down_); j < down_; ++j) {
            const double down_share = overlap(y, height_, j, down_);
            if (!(down_share > 0)) break;
            for (int x = 0; x < width_; ++x)
                for (int i = first(x, width_, across_); i < across_; ++i) {
                    const double share = overlap(x, width_, i, across_);
                    if (!(share > 0)) break;
                    sums_[static_cast<std::size_t>(j) * static_cast<std::size_t>(across_) +
                          static_cast<std::size_t>(i)] +=
                        share * down_share * static_cast<double>(row[static_cast<std::size_t>(x)]);
                }
        }
    }
    std::vector<std::uint16_t> numbers() const {
        std::vector<std::uint16_t> all;
        for (const double sum : sums_)
            all.push_back(static_cast<std::uint16_t>(std::clamp(sum, 0.0, 65535.0) + 0.5));
        return all;
    }

  private:
    int side(int own) const {
        const int longer = std::max(width_, height_);
        if (longer <= awan::kPictureHeights) return own;
        return std::max(
            1, static_cast<int>(static_cast<long long>(own) * awan::kPictureHeights / longer));
    }
    static int first(int pixel, int pixels, int parts) {
        return static_cast<int>(static_cast<long long>(pixel) * parts / pixels);
    }
    // Share of part `part` of all that pixel `pixel` covers.
    static double overlap(int pixel, int pixels, int part, int parts) {
        const double ratio = static_cast<double>(parts) / pixels;
        return std::min((pixel + 1) * ratio, part + 1.0) - std::max(pixel * ratio, 1.0 * part);
    }

    int width_, height_, across_, down_;
    std::vector<double> sums_;
};

// The hue of a picture: its colours as means over areas, by rows as they come. What is bright counts for more, and of a
// picture with alpha what is opaque, as its colours are premultiplied.
class Hues {
  public:
    Hues(int width, int height)
        : part_(static_cast<double>(std::max(width, height)) / kSide),
          left_(0.5 * (std::max(width, height) - width)),
          top_(0.5 * (std::max(width, height) - height)),
          sums_(3 * kSide * kSide) {}
    void add_row(int y, const std::vector<std::uint16_t>& row) {
        const double low = (y + top_) / part_, high = (y + 1 + top_) / part_;
        for (int j = static_cast<int>(low); j < std::min(high, 1.0 * kSide); ++j) {
            const double down = std::min(high, j + 1.0) - std::max(low, 1.0 * j);
            for (std::size_t x = 0; 3 * x < row.size(); ++x) add(x, down, j, &row[3 * x]);
        }
    }
    // EMPTY where it is grey all over, but for dither and rounding. Where it is dark these would be all the hue that
    // there is, so the darker a place, the more it is as the mean.
    std::vector<unsigned char> bytes() const {
        double mean[3]{}, brightest = 0, apart = 0;
        for (std::size_t i = 0; i < sums_.size(); i += 3) {
            const auto [least, most] = std::minmax({sums_[i], sums_[i + 1], sums_[i + 2]});
            brightest += most;
            apart += std::max(most - least - 2 * kCode, 0.0);
            for (std::size_t c = 0; c < 3; ++c) mean[c] += sums_[i + c];
        }
        if (!(apart > kGrey * brightest)) return {};
        const double scale = 4 * kCode / std::max({mean[0], mean[1], mean[2]});
        std::vector<unsigned char> hues(sums_.size());
        for (std::size_t i = 0; i < hues.size(); i += 3) {
            double own[3];
            for (std::size_t c = 0; c < 3; ++c) own[c] = sums_[i + c] + scale * mean[c];
            const double most = std::max({own[0], own[1], own[2]});
            for (std::size_t c = 0; c < 3; ++c)
                hues[i + c] = static_cast<unsigned char>(255 * own[c] / most + 0.5);
        }
        return hues;
    }

  private:
    static constexpr int kSide = awan::kPictureHues;
    // One of 8 bits.
    static constexpr double kCode = 257;
    static constexpr double kGrey = 0.005;

    void add(std::size_t x, double down, int j, const std::uint16_t* color) {
        const double low = (static_cast<double>(x) + left_) / part_, high = low + 1 / part_;
        for (int i = static_cast<int>(low); i < std::min(high, 1.0 * kSide); ++i) {
            const double share = down * (std::min(high, i + 1.0) - std::max(low, 1.0 * i));
            double* const to = &sums_[3 * static_cast<std::size_t>(j * kSide + i)];
            for (int c = 0; c < 3; ++c) to[c] += std::max(share, 0.0) * color[c];
        }
    }

    // Pixels along a side of one of the square's parts; how many are missing before the picture.
    double part_, left_, top_;
    std::vector<double> sums_;
};

// Once more, its colours in 16 bits. False: it cannot be read so.
bool read_heights(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, Heights& heights,
                  Hues& hues) {
    const int count = spec.nchannels < 3 ? 1 : 3;
    const auto width = static_cast<std::size_t>(spec.width);
    std::vector<std::uint16_t> pixels(width * static_cast<std::size_t>(spec.height) *
                                      static_cast<std::size_t>(count));
    if (!input.read_image(0, 0, 0, count, OIIO::TypeDesc::UINT16, pixels.data())) {
        input.geterror();
        return false;
    }
    std::vector<float> row(width);
    std::vector<std::uint16_t> colors;
    const std::uint16_t* from = pixels.data();
    for (int y = 0; y < spec.height; ++y) {
        for (float& one : row) {
            one = count == 1 ? static_cast<float>(from[0])
                             : 0.2126F * static_cast<float>(from[0]) +
                                   0.7152F * static_cast<float>(from[1]) +
                                   0.0722F * static_cast<float>(from[2]);
            from += count;
        }
        heights.add_row(y, row);
        if (count != 3) continue;
        colors.assign(from - 3 * width, from);
        hues.add_row(y, colors);
    }
    return true;
}

// Null, or what is wrong with it.
const char* read(awan::PictureHead& head, std::vector<unsigned char>& values) {
    OIIO::attribute("exr_threads", -1);
    OIIO::attribute("threads", 1);
    OIIO::ImageSpec spec;
    const std::unique_ptr<OIIO::ImageInput> input = open_picture(spec);
    if (!input)
        return "it is no picture of a kind that is read (PNG, JPEG, TIFF, OpenEXR, WebP ...)";
    if (spec.width < 1 || spec.height < 1 || spec.depth != 1 || spec.nchannels < 1 || spec.deep)
        return "it holds no flat picture";
    constexpr auto kSide = static_cast<int>(awan::limits::kMaxTexturePictureSide);
    if (spec.width > kSide || spec.height > kSide ||
        static_cast<unsigned long long>(spec.width) * static_cast<unsigned long long>(spec.height) >
            awan::limits::kMaxTexturePixels)
        return kTooLarge;
    if (spec.nchannels > 16 || spec.tile_width > spec.width + 4096 ||
        spec.tile_height > spec.height + 4096)
        return "it has too many channels, or tiles that are larger than it is";
    const bool has_alpha = spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels;
    const int first = has_alpha ? spec.alpha_channel : 0;
    const int count = has_alpha || spec.nchannels < 3 ? 1 : 3;
    const std::size_t pixels =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    values.resize(pixels * static_cast<std::size_t>(count));
    if (!input->read_image(0, 0, first, first + count, OIIO::TypeDesc::UINT8, values.data())) {
        input->geterror();
        return "it is broken, or ends too soon";
    }
    // Rec. 709.
    if (count == 3)
        for (std::size_t i = 0; i < pixels; ++i)
            values[i] = static_cast<unsigned char>(
                (2126 * values[3 * i] + 7152 * values[3 * i + 1] + 722 * values[3 * i + 2]) /
                10000);
    values.resize(pixels);
    values.shrink_to_fit();
    Heights heights(spec.width, spec.height);
    Hues hues(spec.width, spec.height);
    if (!read_heights(*input, spec, heights, hues)) return "it is broken, or ends too soon";
    const std::vector<std::uint16_t> numbers = heights.numbers();
    const auto* const bytes = reinterpret_cast<const unsigned char*>(numbers.data());
    values.insert(values.end(), bytes, bytes + 2 * numbers.size());
    if (spec.nchannels >= 3) {
        const std::vector<unsigned char> colors = hues.bytes();
        values.insert(values.end(), colors.begin(), colors.end());
        head.colored = colors.empty() ? 0 : 1;
    }
    head.width = spec.width;
    head.height = spec.height;
    head.across = heights.across();
    head.down = heights.down();
    return nullptr;
}

}  // namespace

int main() {
    keep_within_bounds();
    awan::PictureHead head;
    std::vector<unsigned char> values;
    const char* wrong = nullptr;
    try {
        wrong = read(head, values);
    } catch (const std::bad_alloc&) {
        head.outcome = awan::PictureOutcome::kNoMemory;
        wrong = "it takes more memory to read than it may";
    } catch (const std::exception&) {
        wrong = "it cannot be read";
    }
    if (wrong == nullptr) {
        head.outcome = awan::PictureOutcome::kRead;
        say(head, {reinterpret_cast<const char*>(values.data()), values.size()});
    } else {
        if (wrong == kTooLarge) head.outcome = awan::PictureOutcome::kTooLarge;
        say(head, wrong);
    }
    // Not by way of what the libraries do at the end.
    _exit(0);
}
