// Where the names of a table's columns stand, and what separates its cells.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace awan {

struct TableHeader {
    char separator = ',';
    // Of the line with the names, from 1.
    std::size_t line = 1;
    std::string_view text;
    // The number of the line that follows.
    std::size_t next_line = 2;
    // Lines before it that are neither blank nor comments: titles, as reports have them.
    std::size_t titles = 0;
    // Whether the line holds x, y and z by name. Else it is the first line of all, and the names are missing.
    bool is_found = false;
};

// Takes lines off the text up to and with the header: the first line that names x, y and z, or, where none of the first
// lines does, the last comment before the data that does ("//X;Y;Z", as point cloud tools write it).
TableHeader take_table_header(std::string_view& text);

// The line without the mark of a comment, #, // or %; nothing when it has none.
std::optional<std::string_view> without_comment_mark(std::string_view line);

}  // namespace awan
