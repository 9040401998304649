// Numbers in the cells of tables.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace awan {

// Reads cells as numbers, and keeps apart decimal points and decimal commas.
class CellNumbers {
  public:
    // separator: of the cells. Where it is the comma, none is a decimal one.
    explicit CellNumbers(char separator) : commas_allowed_(separator != ',') {}

    // As read_number() (numbers.h), and as other tools write them: "1,5", "1.0D+01", a minus of Unicode.
    std::optional<double> read(std::string_view cell);

    // "1,234" beside "1.5" is a thousand and more, or it is not: nobody knows.
    bool mixed() const { return points_ && commas_; }
    bool commas() const { return commas_; }

  private:
    bool commas_allowed_;
    bool points_ = false, commas_ = false;
    std::string text_;
};

// Whether the cell is a word for no value: "nan", "NA", "null", ... of any case.
bool is_no_value(std::string_view cell);

// Whether it begins as numbers do; units and other words do not.
bool begins_as_number(std::string_view cell);

}  // namespace awan
