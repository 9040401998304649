// Tables as text: cells that something separates, quoted or not (RFC 4180).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace awan {

// Reads a text record by record. A cell in double quotes may hold the separator, line ends, and quotes written twice.
// Blanks around cells are no part of them.
class DelimitedText {
  public:
    // separator ' ': any run of blanks or tabs. line: the number of the text's first line.
    DelimitedText(std::string_view text, char separator, std::size_t line)
        : rest_(text), separator_(separator), next_line_(line) {}

    // The next record that is not empty; false at the end, or at an error.
    bool next();

    // More than kMostCells are counted, but not kept.
    static constexpr std::size_t kMostCells = 1024;
    const std::vector<std::string_view>& cells() const { return cells_; }
    std::size_t cell_count() const { return count_; }
    // The line on which the record begins.
    std::size_t line() const { return line_; }
    const Status& error() const { return error_; }

  private:
    bool take_cell();
    bool take_quoted();
    void keep(std::string_view cell);
    void end_line();

    std::string_view rest_;
    char separator_;
    std::size_t next_line_;
    std::size_t line_ = 0;
    std::vector<std::string_view> cells_;
    std::size_t count_ = 0;
    // Text of quoted cells with quotes in them, by cell; made once and used again.
    std::vector<std::string> unquoted_;
    std::size_t unquoted_count_ = 0;
    Status error_;
};

}  // namespace awan
