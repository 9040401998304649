#include "core/formats/table_header.h"

#include <algorithm>

#include "core/formats/column_names.h"
#include "core/formats/delimited.h"
#include "core/formats/numbers.h"

namespace awan {
namespace {

// Lines in which titles may stand.
constexpr std::size_t kMostTitles = 32;

// How many names of the line are known, when this separates them. A vector in one column counts as the three that it
// is.
std::size_t known_names(std::string_view line, char separator) {
    DelimitedText cells(line, separator, 1);
    std::size_t known = 0;
    if (!cells.next()) return 0;
    for (const std::string_view name : cells.cells())
        known += known_name(name) ? 1 : is_vector_name(name) ? 3 : 0;
    return known;
}

// The separator that makes most of the line's names known; of equals the first. 0: none makes three known, x, y and z.
char separator_of(std::string_view line) {
    char best = 0;
    std::size_t most = 2;
    for (const char separator : {',', ';', '\t', '|', ' '}) {
        const std::size_t known = known_names(line, separator);
        if (known <= most) continue;
        most = known;
        best = separator;
    }
    return best;
}

// Takes a line off the text, and those after it that a quote in it reaches into.
std::string_view take_record(std::string_view& text, std::size_t& lines) {
    const std::string_view before = text;
    std::size_t quotes = 0, length = 0;
    do {
        const std::string_view line = take_line(text);
        ++lines;
        quotes += static_cast<std::size_t>(std::count(line.begin(), line.end(), '"'));
        length = static_cast<std::size_t>(line.data() - before.data()) + line.size();
    } while (quotes % 2 == 1 && !text.empty());
    return before.substr(0, length);
}

// Spreadsheets say what separates in a line of its own.
bool is_nothing(std::string_view record) {
    return trim(record).empty() || (trim(record).size() == 5 && record.starts_with("sep="));
}

// The names below titles; nothing where none of the lines has them. lines: those that were taken before.
std::optional<TableHeader> header_below(std::string_view& text, std::size_t lines) {
    std::string_view rest = text;
    std::size_t titles = 0;
    while (!rest.empty() && titles < kMostTitles) {
        const std::size_t line = lines + 1;
        const std::string_view record = take_record(rest, lines);
        if (is_nothing(record) || without_comment_mark(trim(record))) continue;
        if (const char separator = separator_of(record)) {
            text = rest;
            return TableHeader{separator, line, record, lines + 1, titles, true};
        }
        ++titles;
    }
    return {};
}

}  // namespace

std::optional<std::string_view> without_comment_mark(std::string_view line) {
    for (const std::string_view mark : {"#", "//", "%"})
        if (line.starts_with(mark)) return trim(line.substr(mark.size()));
    return {};
}

TableHeader take_table_header(std::string_view& text) {
    std::optional<TableHeader> commented;
    std::size_t lines = 0;
    while (!text.empty()) {
        const std::string_view before = text;
        const std::size_t line = lines + 1;
        if (const auto inner = without_comment_mark(trim(take_line(text)))) {
            ++lines;
            if (const char separator = separator_of(*inner))
                commented = {separator, line, *inner, line + 1, 0, true};
            continue;
        }
        text = before;
        const std::size_t lines_before = lines;
        const std::string_view record = take_record(text, lines);
        if (is_nothing(record)) continue;
        if (const char separator = separator_of(record))
            return {separator, line, record, lines + 1, 0, true};
        if (commented) {
            // These are data already.
            text = before;
            commented->next_line = line;
            return *commented;
        }
        std::string_view from_here = before;
        if (const auto below = header_below(from_here, lines_before)) {
            text = from_here;
            return *below;
        }
        return {',', line, record, lines + 1, 0, false};
    }
    return commented.value_or(TableHeader{});
}

}  // namespace awan
