// Numbers and lines of text files, read without a locale and without throwing.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/base/result.h"

namespace awan {

// The whole of `text` as a finite T, else nothing. -0 reads as 0, so that equal values are equal
// bytes further on.
template <typename T>
std::optional<T> read_number(std::string_view text) {
    T value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end) return std::nullopt;
    if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value)) return std::nullopt;
        value += T(0);
    }
    return value;
}

// What is wrong with a line of a text file, counted from 1.
inline Error at_line(std::size_t line, std::string message) {
    return {ErrorCode::kMalformed, "line " + std::to_string(line), std::move(message)};
}

inline bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

inline std::string_view trim(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

// Takes the first line off `text`, without its line feed; the carriage return of Windows files is
// blank space to trim().
inline std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

// Takes off the byte order mark that editors on Windows put before UTF-8 text.
inline std::string_view without_byte_order_mark(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    return text;
}

// A client's text for a message: short, and printable ASCII only.
inline std::string short_quote(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string out = "\"";
    for (const char c : text.substr(0, kLongest)) out += c >= ' ' && c <= '~' ? c : '?';
    return out + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace awan
