// Long lists of numbers, read ahead of the parser.
//
// A million ready particles are eight million numbers, 67 MB. nlohmann's lexer copies each
// character by character and then calls strtod: 2.3 s in all. So where a list of numbers begins,
// its regular part is read here with std::from_chars, 0.6 s in all, and the parser goes on behind
// it. What is not regular (an error, a null, a number that under- or overflows) is left to the
// parser, which knows what to say: reading ahead changes how long a document takes, never what it
// means.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>

namespace awan {

// The place up to which a text is read, shared by the parser and take_run().
struct TextCursor {
    const char* at;
    const char* end;
};

// The parser's way through the text. A default-made one is the end.
class TextIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    TextIterator() = default;
    explicit TextIterator(TextCursor& cursor) : cursor_(&cursor) {}
    reference operator*() const { return *cursor_->at; }
    TextIterator& operator++() {
        ++cursor_->at;
        return *this;
    }
    void operator++(int) { ++*this; }
    bool operator==(const TextIterator& other) const { return is_end() == other.is_end(); }

  private:
    bool is_end() const { return cursor_ == nullptr || cursor_->at == cursor_->end; }
    TextCursor* cursor_ = nullptr;
};

namespace json_runs {

inline bool is_digit(const TextCursor& c) {
    return c.at != c.end && *c.at >= '0' && *c.at <= '9';
}

inline void skip_blanks(TextCursor& c) {
    while (c.at != c.end && (*c.at == ' ' || *c.at == '\n' || *c.at == '\t' || *c.at == '\r'))
        ++c.at;
}

// One character, with blanks around it.
inline bool take_char(TextCursor& c, char wanted) {
    skip_blanks(c);
    if (c.at == c.end || *c.at != wanted) return false;
    ++c.at;
    skip_blanks(c);
    return true;
}

inline bool take_digits(TextCursor& c) {
    if (!is_digit(c)) return false;
    while (is_digit(c)) ++c.at;
    return true;
}

// A number by JSON's grammar, which is stricter than from_chars, and finite.
inline bool take_number(TextCursor& c, double& value) {
    const char* const first = c.at;
    if (c.at != c.end && *c.at == '-') ++c.at;
    const bool zero = c.at != c.end && *c.at == '0';
    if (!take_digits(c)) return false;
    if (zero && c.at - first > 1 + (*first == '-')) return false;  // 01
    if (c.at != c.end && *c.at == '.') {
        ++c.at;
        if (!take_digits(c)) return false;
    }
    if (c.at != c.end && (*c.at == 'e' || *c.at == 'E')) {
        ++c.at;
        if (c.at != c.end && (*c.at == '+' || *c.at == '-')) ++c.at;
        if (!take_digits(c)) return false;
    }
    const auto [stop, error] = std::from_chars(first, c.at, value);
    value += 0.0;  // -0 is 0
    return error == std::errc() && stop == c.at && std::isfinite(value);
}

template <std::size_t N>
bool take_element(TextCursor& c, std::array<double, N>& values) {
    if constexpr (N == 1) return take_number(c, values[0]);
    if (!take_char(c, '[')) return false;
    for (std::size_t i = 0; i < N; ++i)
        if ((i > 0 && !take_char(c, ',')) || !take_number(c, values[i])) return false;
    skip_blanks(c);
    if (c.at == c.end || *c.at != ']') return false;
    ++c.at;
    return true;
}

}  // namespace json_runs

// Reads elements of a list, numbers (N = 1) or [a, b, ...] of N numbers, from just behind the
// list's bracket: at most `most`, each given to take(values). Leaves the cursor where a parser that
// has seen only the bracket finds either the list's end or the element that comes next, so that it
// accepts exactly the lists it would have accepted from the beginning.
template <std::size_t N, typename Take>
std::size_t take_run(TextCursor& cursor, std::size_t most, Take take) {
    std::size_t count = 0;
    std::array<double, N> values{};
    TextCursor c = cursor;
    while (count < most) {
        json_runs::skip_blanks(c);
        if (!json_runs::take_element(c, values)) break;
        json_runs::skip_blanks(c);
        if (c.at == c.end || (*c.at != ',' && *c.at != ']')) break;
        take(values);
        ++count;
        cursor = c;
        if (*c.at == ']') break;
        ++c.at;
        json_runs::skip_blanks(c);
        if (c.at == c.end || *c.at == ']') break;  // a comma with nothing behind: stay before it
        cursor = c;
    }
    return count;
}

}  // namespace awan
