#include "server/service/compression.h"

#include <zlib.h>

#include <array>
#include <memory>

#include "server/service/negotiation.h"
#include "server/service/state.h"

namespace awan {
namespace {

// Below it the head of the answer is the larger part.
constexpr std::size_t kWorthIt = 1024;
// An answer is packed once and thrown away, so it is packed fast; what is kept is packed well.
constexpr int kFast = 2, kWell = 9;

bool is_packable(std::string_view type) {
    // Events leave when they happen; a packer would wait for more.
    if (type.starts_with("text/event-stream")) return false;
    return type.starts_with("text/") || type.starts_with("application/json") ||
           type.starts_with("application/problem+json") || type.starts_with("application/x-ply") ||
           type.starts_with("application/javascript") || type.starts_with("image/svg+xml");
}

// A gzip file in the making.
class Packer {
  public:
    explicit Packer(int level) {
        ready_ = deflateInit2(&stream_, level, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK;
    }
    ~Packer() {
        if (ready_) deflateEnd(&stream_);
    }
    Packer(const Packer&) = delete;
    Packer& operator=(const Packer&) = delete;

    bool ready() const { return ready_; }

    // Appends to `out` what comes of `text`; `last`: nothing follows.
    void pack(std::string_view text, bool last, std::string& out) {
        // zlib counts in 32 bits. It reads what it is given and writes nothing there, but has no word for that.
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
        stream_.avail_in = static_cast<uInt>(text.size());
        std::array<char, 32u << 10> piece;
        do {
            stream_.next_out = reinterpret_cast<Bytef*>(piece.data());
            stream_.avail_out = static_cast<uInt>(piece.size());
            deflate(&stream_, last ? Z_FINISH : Z_NO_FLUSH);
            out.append(piece.data(), piece.size() - stream_.avail_out);
        } while (stream_.avail_out == 0);
    }

  private:
    z_stream stream_{};
    bool ready_ = false;
};

void mark(Response& response) {
    for (auto& [name, value] : response.headers) {
        if (name == "ETag" && value.size() > 1) value.insert(value.size() - 1, "-gzip");
        if (name == "Vary") value += ", Accept-Encoding";
    }
    if (response.header("Vary").empty()) response.headers.emplace_back("Vary", "Accept-Encoding");
    response.headers.emplace_back("Content-Encoding", "gzip");
}

}  // namespace

void compress(const Request& request, Response& response) {
    if (response.abandoned || response.status == 204 || response.status == 304) return;
    if (!response.header("Content-Encoding").empty() ||
        !is_packable(response.header("Content-Type")))
        return;
    if (!response.stream &&
        (response.bytes().size() < kWorthIt || response.bytes().size() > (1u << 30)))
        return;
    if (!takes_gzip(joined_header(request, "Accept-Encoding"))) return;
    auto packer = std::make_shared<Packer>(kFast);
    if (!packer->ready()) return;
    mark(response);
    if (!response.stream) {
        std::string packed;
        packed.reserve(response.bytes().size() / 3);
        packer->pack(response.bytes(), true, packed);
        response.shared.reset();
        response.body = std::move(packed);
        return;
    }
    response.stream = [packer, inner = std::move(response.stream)](std::string& piece) {
        std::string text;
        const bool more = inner(text);
        packer->pack(text, !more, piece);
        return more;
    };
}

std::string packed_whole(std::string_view text) {
    std::string packed;
    Packer packer(kWell);
    if (text.size() < kWorthIt || !packer.ready()) return packed;
    packer.pack(text, true, packed);
    return packed.size() < text.size() ? packed : std::string();
}

void send_packed(const Request& request, std::string_view packed, Response& response) {
    if (packed.empty() || response.status != 200) return;
    if (!takes_gzip(joined_header(request, "Accept-Encoding"))) return;
    response.body = packed;
    mark(response);
}

}  // namespace awan
