#include "core/formats/quote.h"

namespace awan {
namespace {

// Control characters of ASCII and of Latin-1 (C2 80..9F), and what turns the direction of writing (U+200E, U+200F,
// U+202A..E, U+2066..9): in a message they would be obeyed instead of shown.
bool is_obeyed(std::string_view letter) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(letter[i]); };
    if (letter.size() == 1) return byte(0) < 0x20 || byte(0) == 0x7F;
    if (letter.size() == 2) return byte(0) == 0xC2 && byte(1) < 0xA0;
    if (letter.size() != 3 || byte(0) != 0xE2) return false;
    const bool marks = byte(1) == 0x80 &&
                       (byte(2) == 0x8E || byte(2) == 0x8F || (byte(2) >= 0xA8 && byte(2) <= 0xAE));
    return marks || (byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9);
}

void append_bytes_named(std::string_view bytes, std::string& out) {
    for (const char c : bytes) {
        const auto u = static_cast<unsigned char>(c);
        out += "\\x";
        out += "0123456789ABCDEF"[u >> 4];
        out += "0123456789ABCDEF"[u & 15];
    }
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return text.empty() ? 0 : 1;
    if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
    if (first >= 0xE0 && first <= 0xEF) {
        if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
        return continues(1) && continues(2) ? 3 : 0;
    }
    if (first >= 0xF0 && first <= 0xF4) {
        if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
        return continues(1) && continues(2) && continues(3) ? 4 : 0;
    }
    return 0;
}

std::string short_quote(std::string_view text) {
    constexpr int kLongest = 40;
    // Bytes that are named take four each.
    constexpr std::size_t kMostBytes = 100;
    std::string out = "\"";
    for (int letters = 0; letters < kLongest && out.size() < kMostBytes && !text.empty();
         ++letters) {
        const std::size_t length = utf8_length(text);
        const std::string_view letter = text.substr(0, length == 0 ? 1 : length);
        if (length == 0 || is_obeyed(letter))
            append_bytes_named(letter, out);
        else
            out += letter;
        text.remove_prefix(letter.size());
    }
    return out + (text.empty() ? "\"" : "...\"");
}

}  // namespace awan
