#include "server/document/json_place.h"

#include <algorithm>

namespace awan {
namespace {

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// What may have been meant, as a sentence's end; "" where nobody knows.
std::string likely_meant(std::string_view text, std::size_t at) {
    if (at >= text.size()) return "";
    const char c = text[at];
    const std::size_t before =
        at == 0 ? std::string_view::npos : text.find_last_not_of(" \t\r\n", at - 1);
    const char last = before == std::string_view::npos ? '\0' : text[before];
    if (c == '/' || c == '#' || (last == '/' && (c == '*' || is_letter(c))))
        return "; JSON has no comments, but keys that begin with _ may say anything";
    if ((c == '}' || c == ']') && last == ',')
        return std::string("; no comma may stand before ") + c;
    if (c == '\'') return "; JSON writes strings in double quotes";
    if (c == '+' || c == '.') return "; JSON writes numbers as 1, -1, 0.5, 1e3";
    std::size_t first = at;
    while (first > 0 && is_letter(text[first - 1])) --first;
    const std::string_view word = text.substr(first, at + 1 - first);
    if (word.starts_with("N") || word.starts_with("I") || word.starts_with("na") ||
        word.starts_with("i"))
        return "; JSON has no NaN and no Infinity";
    if (is_letter(c) && first == at) return "; words and keys stand in double quotes";
    return "";
}

}  // namespace

std::string line_and_column(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, offset);
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n');
    const std::string_view line =
        start == std::string_view::npos ? before : before.substr(start + 1);
    const auto letters = std::count_if(line.begin(), line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    });
    return "line " + std::to_string(lines + 1) + ", column " + std::to_string(letters + 1);
}

std::string not_json(std::string_view text, std::size_t read, std::string_view reason) {
    const bool ended = reason.find("unexpected end of input") != std::string_view::npos;
    const std::size_t at = ended || read == 0 ? text.size() : read - 1;
    return "not JSON at " + line_and_column(text, at) + ": " + std::string(reason) +
           (ended ? std::string() : likely_meant(text, at));
}

}  // namespace awan
