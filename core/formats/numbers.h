// Numbers and lines of text files, read without a locale and without throwing.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/base/result.h"
#include "core/formats/quote.h"

namespace awan {

// The whole of `text` as a finite T, else nothing: as people and tools write numbers, +1, 1. and .5 too. -0 reads as 0,
// so that equal values are equal bytes further on.
template <typename T>
std::optional<T> read_number(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
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

// Takes the first line off `text`, without its end: a line feed, the two characters of Windows, or the carriage return
// alone of old Macintosh files.
inline std::string_view take_line(std::string_view& text) {
    std::size_t end = 0;
    while (end < text.size() && text[end] != '\n' && text[end] != '\r') ++end;
    const std::string_view line = text.substr(0, end), rest = text.substr(end);
    text.remove_prefix(std::min(text.size(), end + (rest.starts_with("\r\n") ? 2 : 1)));
    return line;
}

// Takes off the byte order mark that editors on Windows put before UTF-8 text.
inline std::string_view without_byte_order_mark(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    return text;
}

}  // namespace awan
