#include "core/formats/cell_numbers.h"

#include <strings.h>

#include <algorithm>

#include "core/formats/numbers.h"

namespace awan {

std::optional<double> CellNumbers::read(std::string_view cell) {
    if (const std::optional<double> value = read_number<double>(cell)) {
        points_ = points_ || (commas_allowed_ && cell.find('.') != std::string_view::npos);
        return value;
    }
    text_ = cell;
    // U+2212, as word processors and Python's formatting for people write the minus.
    if (text_.starts_with("\xE2\x88\x92")) text_.replace(0, 3, "-");
    // Exponents of Fortran's double precision.
    if (const std::size_t at = text_.find_first_of("dD");
        at != std::string::npos && at > 0 && text_.find_first_of("eE") == std::string::npos)
        text_[at] = 'e';
    const std::size_t comma = text_.find(',');
    if (comma != std::string::npos) {
        if (!commas_allowed_ || text_.find('.') != std::string::npos) return {};
        text_[comma] = '.';
        commas_ = true;
    }
    return read_number<double>(text_);
}

bool is_no_value(std::string_view cell) {
    for (const std::string_view word : {"nan", "-nan", "na", "n/a", "#n/a", "null", "none", "-"})
        if (cell.size() == word.size() && strncasecmp(cell.data(), word.data(), word.size()) == 0)
            return true;
    return false;
}

bool begins_as_number(std::string_view cell) {
    const std::size_t at = cell.find_first_not_of("+-.,");
    return at != std::string_view::npos && cell[at] >= '0' && cell[at] <= '9';
}

}  // namespace awan
