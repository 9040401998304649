// What a JSON parser stumbled over, for people.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace awan {

// "line 3, column 14" of the character at `offset`; both from 1, columns in letters of UTF-8.
std::string line_and_column(std::string_view text, std::size_t offset);

// The message for a text that is not JSON. read: how many bytes the parser has taken, the last of them the wrong one.
// reason: the parser's own, in which no text of the client's stands. What people often write and JSON does not have is
// named: comments, commas before a closing bracket, single quotes, NaN, bare words.
std::string not_json(std::string_view text, std::size_t read, std::string_view reason);

}  // namespace awan
