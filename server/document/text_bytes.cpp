#include "server/document/text_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>

#include "core/base/thrown.h"

namespace awan {
namespace {

Error cannot_read(std::string message) {
    return {ErrorCode::kMalformed, "", std::move(message)};
}

void append_utf8(std::uint32_t letter, std::string& out) {
    const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
    if (letter < 0x80) return put(letter);
    if (letter < 0x800) {
        put(0xC0 | letter >> 6);
    } else if (letter < 0x10000) {
        put(0xE0 | letter >> 12);
        put(0x80 | (letter >> 6 & 0x3F));
    } else {
        put(0xF0 | letter >> 18);
        put(0x80 | (letter >> 12 & 0x3F));
        put(0x80 | (letter >> 6 & 0x3F));
    }
    put(0x80 | (letter & 0x3F));
}

enum class Order { kNone, kLittle, kBig };

// By the byte order mark, which is taken off, or by the zeros of two letters of ASCII.
Order order_of(std::string_view& bytes) {
    const auto mark = bytes.substr(0, 2);
    if (mark == "\xFF\xFE" || mark == "\xFE\xFF") {
        bytes.remove_prefix(2);
        return mark[0] == '\xFF' ? Order::kLittle : Order::kBig;
    }
    if (bytes.size() < 4) return Order::kNone;
    const auto zero = [&](std::size_t i) { return bytes[i] == '\0'; };
    if (!zero(0) && zero(1) && !zero(2) && zero(3)) return Order::kLittle;
    if (zero(0) && !zero(1) && zero(2) && !zero(3)) return Order::kBig;
    return Order::kNone;
}

}  // namespace

Result<std::optional<std::string>> from_utf16(std::string_view bytes) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\xFF\xFE\0\0"sv) || bytes.starts_with("\0\0\xFE\xFF"sv))
        return cannot_read("the text is in UTF-32; save it as UTF-8");
    const Order order = order_of(bytes);
    if (order == Order::kNone) return std::optional<std::string>();
    if (bytes.size() % 2 != 0)
        return cannot_read("the text is in UTF-16 and breaks off within a letter");
    const auto unit = [&](std::size_t i) {
        const auto first = static_cast<unsigned char>(bytes[i]),
                   second = static_cast<unsigned char>(bytes[i + 1]);
        return order == Order::kLittle ? std::uint32_t{first} | std::uint32_t{second} << 8
                                       : std::uint32_t{second} | std::uint32_t{first} << 8;
    };
    std::string out;
    out.reserve(bytes.size() / 2);
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
        std::uint32_t letter = unit(i);
        if (letter >= 0xD800 && letter < 0xE000) {
            const std::uint32_t low = i + 2 < bytes.size() ? unit(i + 2) : 0;
            if (letter >= 0xDC00 || low < 0xDC00 || low >= 0xE000)
                return cannot_read("the text is in UTF-16 and has half a letter at byte " +
                                   std::to_string(i));
            letter = 0x10000 + ((letter - 0xD800) << 10) + (low - 0xDC00);
            i += 2;
        }
        append_utf8(letter, out);
    }
    return std::optional<std::string>(std::move(out));
}

bool is_gzip(std::string_view bytes) {
    return bytes.starts_with("\x1F\x8B\x08");
}

Result<std::string> gunzip(std::string_view bytes, std::size_t most) {
    z_stream stream{};
    // 15: the largest window; 16: gzip.
    if (const int result = inflateInit2(&stream, 15 + 16); result != Z_OK)
        return result == Z_MEM_ERROR ? out_of_memory()
                                     : Error{ErrorCode::kInternal, "", "zlib could not begin"};
    struct End {
        z_stream& stream;
        ~End() { inflateEnd(&stream); }
    } end{stream};
    std::string out;
    std::array<char, 64u << 10> piece;
    std::string_view rest = bytes;
    // Whether a member has ended; whether what it holds has been taken as far as its bytes go.
    bool ended = false, drained = true;
    while (!ended || stream.avail_in > 0 || !rest.empty()) {
        if (stream.avail_in == 0 && drained) {
            // zlib counts in 32 bits. It reads what it is given and writes nothing there, but has no word for that.
            const std::size_t now = std::min<std::size_t>(rest.size(), 1u << 30);
            if (now == 0) return cannot_read("the gzip data end early");
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest.data()));
            stream.avail_in = static_cast<uInt>(now);
            rest.remove_prefix(now);
        }
        if (ended) {
            // Another member follows.
            if (*stream.next_in != 0x1F) return cannot_read("there are bytes behind the gzip data");
            inflateReset(&stream);
        }
        stream.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream.avail_out = static_cast<uInt>(piece.size());
        const int result = inflate(&stream, Z_NO_FLUSH);
        const std::size_t made = piece.size() - stream.avail_out;
        if (result == Z_MEM_ERROR) return out_of_memory();
        // Z_BUF_ERROR: there was nothing left to take.
        if (result != Z_OK && result != Z_STREAM_END && !(result == Z_BUF_ERROR && made == 0))
            return cannot_read("the gzip data are damaged");
        if (out.size() + made > most)
            return Error{ErrorCode::kTooLarge, "",
                         "the gzip data hold more than " + std::to_string(most) + " bytes"};
        out.append(piece.data(), made);
        ended = result == Z_STREAM_END;
        drained = ended || stream.avail_out > 0;
    }
    return out;
}

}  // namespace awan
