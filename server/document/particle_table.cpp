#include "server/document/particle_table.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/formats/numbers.h"
#include "core/formats/quote.h"
#include "core/scene/limits.h"
#include "server/document/json_text.h"

namespace awan {
namespace {

constexpr std::array kColumns = {"time", "id", "x", "y", "z", "radius", "weight"};
constexpr std::size_t kId = 1, kWeight = 6;
using Cells = std::vector<std::string_view>;

// By commas, semicolons or tabs where there are any, else by blanks.
Cells cells_of(std::string_view line) {
    Cells cells;
    const bool signs = line.find_first_of(",;\t") != std::string_view::npos;
    const char* const between = signs ? ",;\t" : " ";
    while (true) {
        const std::size_t end = line.find_first_of(between);
        const std::string_view cell = trim(line.substr(0, end));
        if (signs || !cell.empty()) cells.push_back(cell);
        if (end == std::string_view::npos) return cells;
        line.remove_prefix(end + 1);
    }
}

std::string lower(std::string_view text) {
    std::string all(text);
    for (char& c : all)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return all;
}

class Reader {
  public:
    explicit Reader(std::string pointer) : pointer_(std::move(pointer)) {}

    Status line(std::string_view text) {
        ++line_;
        text = trim(text);
        if (text.empty() || text.front() == '#') return std::nullopt;
        if (!named_) return names(cells_of(text));
        if (++rows_ > limits::kMaxImplicitRows)
            return wrong("more than " + std::to_string(limits::kMaxImplicitRows) + " rows");
        return row(cells_of(text));
    }

    Result<std::string> end() {
        if (!named_) return wrong("there are no names");
        return out_ + "]";
    }

  private:
    Error wrong(const std::string& what) const {
        return {ErrorCode::kInvalidScene, pointer_,
                "line " + std::to_string(line_) + " of the table: " + what};
    }

    Status names(const Cells& cells) {
        named_ = true;
        for (std::size_t i = 0; i < kColumns.size(); ++i) {
            for (std::size_t k = 0; k < cells.size(); ++k) {
                if (lower(cells[k]) != kColumns[i]) continue;
                if (at_[i]) return wrong(std::string("`") + kColumns[i] + "` stands twice");
                at_[i] = k;
            }
            if (!at_[i] && i != kWeight)
                return wrong(std::string("must name time, id, x, y, z, radius and may name "
                                         "weight; there is no `") +
                             kColumns[i] + "`");
        }
        return std::nullopt;
    }

    // A cell as JSON has it, once it is known to be a number.
    Status cell(std::size_t column, const Cells& cells, std::string& text) const {
        const std::size_t at = *at_[column];
        if (at >= cells.size()) return wrong(std::string("there is no `") + kColumns[column] + "`");
        if (column == kId) {
            const auto id = read_number<std::uint64_t>(cells[at]);
            if (!id) return wrong("`id` must be an integer >= 0, not " + short_quote(cells[at]));
            text = std::to_string(*id);
            return std::nullopt;
        }
        const auto number = read_number<double>(cells[at]);
        if (!number || !std::isfinite(*number))
            return wrong(std::string("`") + kColumns[column] + "` must be a number, not " +
                         short_quote(cells[at]));
        text.clear();
        append_json_number(*number, text);
        return std::nullopt;
    }

    Status row(const Cells& cells) {
        std::array<std::string, kColumns.size()> text;
        for (std::size_t i = 0; i < kColumns.size(); ++i)
            if (at_[i])
                if (Status bad = cell(i, cells, text[i])) return bad;
        out_ += out_.size() > 1 ? "," : "";
        out_ += R"({"time":)" + text[0] + R"(,"id":)" + text[1] + R"(,"center":[)" + text[2] + ',' +
                text[3] + ',' + text[4] + R"(],"radius":)" + text[5];
        if (at_[kWeight]) out_ += R"(,"weight":)" + text[kWeight];
        out_ += '}';
        return std::nullopt;
    }

    std::string pointer_;
    std::string out_ = "[";
    std::uint64_t line_ = 0, rows_ = 0;
    bool named_ = false;
    std::array<std::optional<std::size_t>, kColumns.size()> at_;
};

}  // namespace

Result<std::string> particle_table_to_json(std::string_view table, const std::string& pointer) {
    table = without_byte_order_mark(table);
    Reader reader(pointer);
    while (!table.empty())
        if (Status bad = reader.line(take_line(table))) return *bad;
    return reader.end();
}

}  // namespace awan
