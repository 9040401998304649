#include "server/service/kept_file.h"

#include <xxhash.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace awan {
namespace {

constexpr std::string_view kKeptMagic = "AWANKEPT";
constexpr std::uint32_t kKeptVersion = 1;
// The header without its own checksum.
constexpr std::size_t kSealedBytes = kKeptHeaderBytes - sizeof(std::uint64_t);

void append_little_endian(std::uint64_t value, std::size_t bytes, std::string& out) {
    for (std::size_t i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
}

std::string digest_bytes(std::string_view bytes) {
    XXH128_canonical_t digest;
    XXH128_canonicalFromHash(&digest, XXH3_128bits(bytes.data(), bytes.size()));
    return {reinterpret_cast<const char*>(digest.digest), sizeof digest.digest};
}

// The header of this text and body. There is one way to write it, so reading is comparing.
std::string kept_header(std::string_view text, std::string_view body) {
    std::string header(kKeptMagic);
    append_little_endian(kKeptVersion, 4, header);
    append_little_endian(text.size(), 4, header);
    append_little_endian(body.size(), 8, header);
    header += digest_bytes(text) + digest_bytes(body);
    append_little_endian(XXH3_64bits(header.data(), kSealedBytes), sizeof(std::uint64_t), header);
    return header;
}

std::uint32_t kept_text_bytes(std::string_view header) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= std::uint32_t{static_cast<unsigned char>(header[12 + i])} << (8 * i);
    return value;
}

std::string_view next_kept_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
}

}  // namespace

std::string kept_head(const std::string& tag, const KeptResult& result) {
    std::string text = tag + '\n';
    for (const auto& [name, value] : result.headers) {
        if (name.find_first_of(":\n") != std::string::npos || value.find('\n') != std::string::npos)
            return {};
        text.append(name).append(": ").append(value) += '\n';
    }
    return kept_header(text, *result.body) + text;
}

std::optional<KeptResult> read_kept(std::string file, const std::string& tag) {
    if (file.size() < kKeptHeaderBytes) return std::nullopt;
    const std::string_view all = file;
    const std::size_t text_size = kept_text_bytes(all);
    if (text_size > file.size() - kKeptHeaderBytes) return std::nullopt;
    std::string_view text = all.substr(kKeptHeaderBytes, text_size);
    const std::string_view body = all.substr(kKeptHeaderBytes + text_size);
    if (kept_header(text, body) != all.substr(0, kKeptHeaderBytes)) return std::nullopt;
    if (next_kept_line(text) != tag) return std::nullopt;
    KeptResult result;
    while (!text.empty()) {
        const std::string_view line = next_kept_line(text);
        const std::size_t colon = line.find(": ");
        if (colon == std::string_view::npos) return std::nullopt;
        result.headers.emplace_back(line.substr(0, colon), line.substr(colon + 2));
    }
    // Where it is, without a second one.
    file.erase(0, kKeptHeaderBytes + text_size);
    result.body = std::make_shared<const std::string>(std::move(file));
    return result;
}

}  // namespace awan
