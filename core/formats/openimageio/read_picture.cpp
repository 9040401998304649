// awan_read_picture(): the module's only function, and the only user of OpenImageIO.
#include <ImfThreading.h>
#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "core/formats/picture_module.h"

namespace {

// Kinds of still pictures, those first that are told for sure by their first bytes. Videos, volumes, camera raws and
// what runs other programs are not among them.
constexpr const char* kKinds[] = {"png",  "jpeg",      "tiff", "openexr", "webp", "gif",
                                  "bmp",  "psd",       "dds",  "hdr",     "dpx",  "cineon",
                                  "fits", "jpeg2000",  "iff",  "sgi",     "ico",  "pnm",
                                  "rla",  "softimage", "targa"};

// The bytes as a file without a name on any disk: readers of every kind take a path.
class FileOfBytes {
  public:
    FileOfBytes(const char* bytes, std::size_t size) : file_(memfd_create("picture", MFD_CLOEXEC)) {
        for (std::size_t done = 0; file_ >= 0 && done < size;) {
            const ssize_t wrote = write(file_, bytes + done, size - done);
            if (wrote <= 0) return;
            done += static_cast<std::size_t>(wrote);
        }
        whole_ = file_ >= 0;
    }
    FileOfBytes(const FileOfBytes&) = delete;
    FileOfBytes& operator=(const FileOfBytes&) = delete;
    ~FileOfBytes() {
        if (file_ >= 0) close(file_);
    }
    bool whole() const { return whole_; }
    std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

  private:
    int file_;
    bool whole_ = false;
};

std::unique_ptr<OIIO::ImageInput> open_picture(const std::string& path, OIIO::ImageSpec& spec) {
    for (const char* const kind : kKinds) {
        std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(kind);
        if (!input) {
            OIIO::geterror();
            continue;
        }
        try {
            if (input->open(path, spec)) return input;
        } catch (const std::exception&) {
        }
        input->geterror();
    }
    return nullptr;
}

const char* read(const char* bytes, std::size_t size, const awan::PictureBounds& bounds,
                 awan::TakePicture* take, void* to) {
    // OpenEXR has one set of threads for the whole process: it stays as it is.
    const int threads = Imf::globalThreadCount();
    OIIO::attribute("exr_threads", threads == 0 ? -1 : threads);
    OIIO::attribute("threads", 1);
    const FileOfBytes file(bytes, size);
    if (!file.whole()) return "there is no room to read it";
    OIIO::ImageSpec spec;
    const std::unique_ptr<OIIO::ImageInput> input = open_picture(file.path(), spec);
    if (!input)
        return "it is no picture of a kind that is read (PNG, JPEG, TIFF, OpenEXR, WebP ...)";
    if (spec.width < 1 || spec.height < 1 || spec.depth != 1 || spec.nchannels < 1 || spec.deep)
        return "it holds no flat picture";
    if (spec.width > bounds.side || spec.height > bounds.side ||
        static_cast<unsigned long long>(spec.width) * static_cast<unsigned long long>(spec.height) >
            bounds.pixels)
        return bounds.too_large;
    if (spec.nchannels > 16 || spec.tile_width > spec.width + 4096 ||
        spec.tile_height > spec.height + 4096)
        return "it has too many channels, or tiles that are larger than it is";
    const bool has_alpha = spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels;
    const int first = has_alpha ? spec.alpha_channel : 0;
    const int count = has_alpha || spec.nchannels < 3 ? 1 : 3;
    const std::size_t pixels =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    std::vector<unsigned char> values(pixels * static_cast<std::size_t>(count));
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
    take(to, spec.width, spec.height, values.data());
    return nullptr;
}

}  // namespace

extern "C" const char* awan_read_picture(const char* bytes, std::size_t size,
                                         const awan::PictureBounds& bounds, awan::TakePicture* take,
                                         void* to) {
    try {
        return read(bytes, size, bounds, take, to);
    } catch (const std::exception&) {
        return "it cannot be read";
    }
}
