#include "core/formats/delimited.h"

#include <algorithm>

#include "core/formats/numbers.h"

namespace awan {
namespace {

bool ends_line(char c) {
    return c == '\n' || c == '\r';
}

}  // namespace

void DelimitedText::keep(std::string_view cell) {
    if (count_++ < kMostCells) cells_.push_back(cell);
}

// The end of a line stands at the front of rest_, or the text has ended.
void DelimitedText::end_line() {
    if (rest_.empty()) return;
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
    ++next_line_;
}

// A cell that begins with a quote, which stands at the front. What follows the closing quote up to the separator may
// be blanks alone.
bool DelimitedText::take_quoted() {
    const std::size_t opened = next_line_;
    std::string_view text = rest_.substr(1);
    std::string* copy = nullptr;
    std::size_t i = 0;
    for (;; ++i) {
        if (i == text.size()) {
            error_ = at_line(opened, "a quote opens here and is not closed");
            return false;
        }
        if (text[i] == '\n' || (text[i] == '\r' && text.substr(i + 1, 1) != "\n")) ++next_line_;
        if (text[i] != '"') {
            if (copy != nullptr) *copy += text[i];
            continue;
        }
        if (text.substr(i + 1, 1) != "\"") break;
        if (copy == nullptr) {
            if (unquoted_count_ == unquoted_.size()) unquoted_.emplace_back();
            copy = &unquoted_[unquoted_count_++];
            copy->assign(text.substr(0, i));
        }
        *copy += '"';
        ++i;
    }
    // Strings that grow move their text, so a view is taken when the cell is whole; the vector of them is not grown
    // while views of short strings stand (see next()).
    keep(trim(copy != nullptr ? std::string_view(*copy) : text.substr(0, i)));
    rest_.remove_prefix(i + 2);
    while (!rest_.empty() && is_blank(rest_.front()) && rest_.front() != separator_ &&
           !ends_line(rest_.front()))
        rest_.remove_prefix(1);
    if (rest_.empty() || ends_line(rest_.front())) return true;
    if (rest_.front() == separator_ || separator_ == ' ') return true;
    error_ = at_line(next_line_,
                     "text stands behind the closing quote of cell " + std::to_string(count_));
    return false;
}

// Leaves what follows the cell at the front: its separator, the line's end, or nothing.
bool DelimitedText::take_cell() {
    while (!rest_.empty() && is_blank(rest_.front()) && rest_.front() != separator_ &&
           !ends_line(rest_.front()))
        rest_.remove_prefix(1);
    if (!rest_.empty() && rest_.front() == '"') return take_quoted();
    const bool blanks = separator_ == ' ';
    std::size_t end = 0;
    while (end < rest_.size() && rest_[end] != separator_ && !ends_line(rest_[end]) &&
           !(blanks && rest_[end] == '\t'))
        ++end;
    keep(trim(rest_.substr(0, end)));
    rest_.remove_prefix(end);
    return true;
}

bool DelimitedText::next() {
    for (;;) {
        if (rest_.empty() || error_) return false;
        cells_.clear();
        count_ = 0;
        unquoted_count_ = 0;
        // Room for all, so that none moves while a cell is looked at.
        unquoted_.reserve(kMostCells);
        line_ = next_line_;
        for (;;) {
            if (separator_ == ' ') {
                while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t'))
                    rest_.remove_prefix(1);
                if (rest_.empty() || ends_line(rest_.front())) break;
            }
            if (unquoted_count_ == kMostCells) {
                error_ = at_line(
                    line_, "at most " + std::to_string(kMostCells) + " cells may hold quotes");
                return false;
            }
            if (!take_cell()) return false;
            if (rest_.empty() || ends_line(rest_.front())) break;
            if (separator_ != ' ') rest_.remove_prefix(1);
            if (separator_ != ' ' && (rest_.empty() || ends_line(rest_.front()))) {
                // A separator at the end: one more cell, empty.
                keep({});
                break;
            }
        }
        end_line();
        // Lines of nothing but separators, as spreadsheets leave them below a table, are none.
        if (std::any_of(cells_.begin(), cells_.end(),
                        [](std::string_view cell) { return !cell.empty(); }))
            return true;
        if (count_ > kMostCells) return true;
    }
}

}  // namespace awan
