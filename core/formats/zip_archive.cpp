#include "core/formats/zip_archive.h"

#include <minizip/zip.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <utility>

#include "core/base/thrown.h"

namespace awan {
namespace {

Error zip_failure() {
    return {ErrorCode::kInternal, "", "the ZIP archive could not be written"};
}

// 1980-01-01 00:00 as MS-DOS has it.
constexpr uLong kZipTimeBegins = (1u << 21) | (1u << 16);
// Made on Unix, by version 2.0 of the format; a plain file that all may read.
constexpr uLong kMadeBy = (3u << 8) | 20u, kPlainFile = 0100644ul << 16;

// What minizip writes, gathered in a string. It goes back to fill in sizes and checksums. Nothing is thrown through it,
// since it is C: what there was no memory for is remembered.
struct ZipBytes {
    std::string bytes;
    std::size_t at = 0;
    bool no_memory = false;
};

ZipBytes& zip_bytes_of(void* stream) {
    return *static_cast<ZipBytes*>(stream);
}

voidpf zip_open(voidpf opaque, const void*, int) {
    return opaque;
}
uLong zip_read(voidpf, voidpf, void*, uLong) {
    return 0;
}
uLong zip_write(voidpf, voidpf stream, const void* from, uLong size) {
    ZipBytes& out = zip_bytes_of(stream);
    try {
        const std::size_t over = std::min<std::size_t>(size, out.bytes.size() - out.at);
        out.bytes.replace(out.at, over, static_cast<const char*>(from), size);
    } catch (const std::bad_alloc&) {
        out.no_memory = true;
        return 0;
    }
    out.at += size;
    return size;
}
ZPOS64_T zip_tell(voidpf, voidpf stream) {
    return zip_bytes_of(stream).at;
}
long zip_seek(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
    ZipBytes& out = zip_bytes_of(stream);
    const ZPOS64_T from = origin == ZLIB_FILEFUNC_SEEK_END   ? out.bytes.size()
                          : origin == ZLIB_FILEFUNC_SEEK_CUR ? out.at
                                                             : 0;
    if (from + offset > out.bytes.size()) return -1;
    out.at = from + offset;
    return 0;
}
int zip_close(voidpf, voidpf) {
    return 0;
}
int zip_stream_error(voidpf, voidpf stream) {
    return zip_bytes_of(stream).no_memory ? 1 : 0;
}

}  // namespace

struct ZipArchive::State {
    ZipBytes out;
    zipFile zip = nullptr;

    ~State() {
        if (zip != nullptr) zipClose(zip, nullptr);
    }
    Error failed() const { return out.no_memory ? out_of_memory() : zip_failure(); }
};

ZipArchive::ZipArchive(std::unique_ptr<State> state) : state_(std::move(state)) {}
ZipArchive::ZipArchive(ZipArchive&& other) noexcept = default;
ZipArchive& ZipArchive::operator=(ZipArchive&& other) noexcept = default;
ZipArchive::~ZipArchive() = default;

Result<ZipArchive> ZipArchive::begin() {
    auto state = std::make_unique<State>();
    zlib_filefunc64_def functions{};
    functions.zopen64_file = zip_open;
    functions.zread_file = zip_read;
    functions.zwrite_file = zip_write;
    functions.ztell64_file = zip_tell;
    functions.zseek64_file = zip_seek;
    functions.zclose_file = zip_close;
    functions.zerror_file = zip_stream_error;
    functions.opaque = &state->out;
    state->zip = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
    if (state->zip == nullptr) return state->failed();
    return ZipArchive(std::move(state));
}

Status ZipArchive::add(const std::string& name, std::string_view bytes) {
    zip_fileinfo about{};
    about.dosDate = kZipTimeBegins;
    about.external_fa = kPlainFile;
    constexpr int kStored = 0;
    if (zipOpenNewFileInZip4_64(state_->zip, name.c_str(), &about, nullptr, 0, nullptr, 0, nullptr,
                                kStored, 0, 0, -MAX_WBITS, DEF_MEM_LEVEL, Z_DEFAULT_STRATEGY,
                                nullptr, 0, kMadeBy, 0, 0) != ZIP_OK ||
        zipWriteInFileInZip(state_->zip, bytes.data(), static_cast<unsigned>(bytes.size())) !=
            ZIP_OK ||
        zipCloseFileInZip(state_->zip) != ZIP_OK)
        return state_->failed();
    return std::nullopt;
}

std::size_t ZipArchive::bytes() const {
    return state_->out.bytes.size();
}

Result<std::string> ZipArchive::end() {
    if (zipClose(std::exchange(state_->zip, nullptr), nullptr) != ZIP_OK) return state_->failed();
    return std::move(state_->out.bytes);
}

}  // namespace awan
