// read_particles_csv()
#include <algorithm>
#include <vector>

#include "core/formats/cell_numbers.h"
#include "core/formats/delimited.h"
#include "core/formats/numbers.h"
#include "core/formats/particle_files.h"
#include "core/formats/ready_columns.h"
#include "core/formats/table_header.h"
#include "core/formats/vector_cells.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// More columns than any real table has.
constexpr std::size_t kMaxColumns = 256;

Error at_cell(std::size_t line, std::size_t column, std::string message) {
    return {ErrorCode::kMalformed,
            "line " + std::to_string(line) + ", column " + std::to_string(column + 1),
            std::move(message)};
}

// Whether a particle may be without this.
bool may_be_empty(Says says) {
    return says == Says::kDensity || says == Says::kOpacity || says == Says::kRed ||
           says == Says::kGreen || says == Says::kBlue;
}

std::string must_be_number(Says says, std::string_view cell, char separator) {
    std::string message =
        std::string(name_of(says)) + " must be a finite number, not " + short_quote(cell);
    if (separator == ',' && cell.find(',') != std::string_view::npos)
        message += "; a decimal comma needs another separator of cells, ; or a tab";
    return message;
}

// What separates the numbers of a line that holds nothing else; 0: it holds other things too.
char separator_of_numbers(std::string_view line) {
    for (const char separator : {',', ';', '\t', ' '}) {
        DelimitedText cells(line, separator, 1);
        if (!cells.next() || cells.cells().size() < 3) continue;
        CellNumbers numbers(separator);
        const auto is_number = [&](std::string_view cell) {
            return numbers.read(cell).has_value();
        };
        if (std::all_of(cells.cells().begin(), cells.cells().end(), is_number)) return separator;
    }
    return 0;
}

// The header, with the names of three numbers a line, which are a place where the radius is known.
TableHeader take_header(std::string_view& text, const ParticleReading& reading) {
    const std::string_view whole = text;
    TableHeader header = take_table_header(text);
    if (header.is_found || !reading.radius) return header;
    const char separator = separator_of_numbers(header.text);
    DelimitedText cells(header.text, separator, 1);
    if (separator == 0 || !cells.next() || cells.cells().size() != 3) return header;
    if (reading.notes != nullptr)
        reading.notes->push_back("no names of columns: taken for x, y, z");
    text = whole.substr(static_cast<std::size_t>(header.text.data() - whole.data()));
    return {separator,
            header.line,
            separator == ' '   ? "x y z"
            : separator == ',' ? "x,y,z"
            : separator == ';' ? "x;y;z"
                               : "x\ty\tz",
            header.line,
            0,
            true};
}

// The first record of the data that is no comment.
std::vector<std::string_view> first_row(DelimitedText records) {
    while (records.next())
        if (!without_comment_mark(records.cells()[0])) return records.cells();
    return {};
}

// Reads the rows of one table.
class TableRows {
  public:
    TableRows(const TableHeader& header, const VectorColumns& vectors,
              const std::vector<std::optional<Says>>& used, std::size_t cells,
              const ParticleReading& reading, ReadyColumns& columns)
        : header_(header),
          vectors_(vectors),
          used_(used),
          cells_(cells),
          reading_(reading),
          columns_(columns),
          numbers_(header.separator),
          // A first cell that is a number, or nothing, cannot begin with the mark of a comment.
          marks_are_comments_(used[0].has_value()) {}

    Status read(DelimitedText records);

  private:
    void note(std::string text) const {
        if (reading_.notes != nullptr) reading_.notes->push_back(std::move(text));
    }
    // One record; what stands before the first particle may be no row.
    Status take(const DelimitedText& records);
    bool is_preface(const DelimitedText& records);
    Status take_row(std::size_t line);
    Status check_preface(std::size_t last_line) const;

    const TableHeader& header_;
    const VectorColumns& vectors_;
    const std::vector<std::optional<Says>>& used_;
    // Of the file's columns.
    const std::size_t cells_;
    const ParticleReading& reading_;
    ReadyColumns& columns_;
    CellNumbers numbers_;
    const bool marks_are_comments_;
    // A cell without a name before the others, as R writes the names of rows.
    bool row_names_ = false;
    bool begun_ = false;
    // Lines that were passed over: one number, how many points there are; words below the names, their units.
    std::size_t count_line_ = 0, units_line_ = 0;
    std::uint64_t count_ = 0;
    // One row, without the name of it, and with vectors as three cells.
    std::vector<std::string_view> row_, spread_;
};

// Point clouds have their number between names and data, spreadsheets units below the names.
bool TableRows::is_preface(const DelimitedText& records) {
    const std::vector<std::string_view>& cells = records.cells();
    if (count_line_ == 0 && cells_ > 1 && records.cell_count() == 1) {
        const auto count = read_number<std::uint64_t>(cells[0]);
        if (!count) return false;
        count_ = *count;
        count_line_ = records.line();
        return true;
    }
    if (units_line_ != 0 || vectors_.any() || cells.size() < used_.size()) return false;
    for (std::size_t i = 0; i < used_.size(); ++i) {
        const bool place = used_[i] == Says::kX || used_[i] == Says::kY || used_[i] == Says::kZ;
        if (place && (cells[i].empty() || is_no_value(cells[i]) || begins_as_number(cells[i])))
            return false;
    }
    units_line_ = records.line();
    const auto at = std::find(used_.begin(), used_.end(), Says::kX) - used_.begin();
    note("line " + std::to_string(units_line_) + " is not used: " +
         short_quote(cells[static_cast<std::size_t>(at)]) + ", ... below the names");
    return true;
}

Status TableRows::take(const DelimitedText& records) {
    const std::size_t line = records.line();
    const std::vector<std::string_view>& cells = records.cells();
    const bool marked = !cells.empty() && without_comment_mark(cells[0]).has_value();
    if (marked && (marks_are_comments_ || records.cell_count() != cells_)) return std::nullopt;
    if (!begun_ && is_preface(records)) return std::nullopt;
    if (!begun_) {
        // Where the comma separates, a cell more may be the half of a number.
        row_names_ = records.cell_count() == cells_ + 1 && !cells.back().empty() &&
                     (header_.separator == ' ' || header_.separator == '\t' ||
                      !read_number<double>(cells[0]));
        if (row_names_) note("not used: the first cell of every line, which has no name");
        begun_ = true;
    }
    if (columns_.size() == limits::kMaxParticles)
        return too_many_particles("line " + std::to_string(line));
    const std::size_t before = row_names_ ? 1 : 0;
    bool as_many = records.cell_count() >= cells_ + before &&
                   records.cell_count() <= DelimitedText::kMostCells;
    // Separators at a line's end are cells more, of nothing.
    for (std::size_t i = cells_ + before; as_many && i < cells.size(); ++i)
        as_many = cells[i].empty();
    if (!as_many)
        return at_line(line, "must have as many cells as the header, " + std::to_string(cells_) +
                                 ", not " + std::to_string(records.cell_count() - before));
    row_.assign(cells.begin() + static_cast<std::ptrdiff_t>(before), cells.end());
    return take_row(line);
}

Status TableRows::take_row(std::size_t line) {
    if (vectors_.any()) {
        vectors_.spread(row_, spread_);
        std::swap(row_, spread_);
    }
    const auto column = [&](std::size_t i) { return vectors_.column_of(i) + (row_names_ ? 1 : 0); };
    ReadyRow row;
    for (std::size_t i = 0; i < used_.size(); ++i) {
        const std::optional<Says> says = used_[i];
        if (!says) continue;
        if (may_be_empty(*says) && (row_[i].empty() || is_no_value(row_[i]))) {
            row.leave_empty(*says);
            continue;
        }
        const std::optional<double> value = numbers_.read(row_[i]);
        if (!value)
            return at_cell(line, column(i), must_be_number(*says, row_[i], header_.separator));
        if (numbers_.mixed())
            return at_cell(line, column(i),
                           "some numbers have a decimal comma and some a decimal point, as in " +
                               short_quote(row_[i]));
        row[*says] = *value;
    }
    if (const Status wrong = columns_.add(row)) return at_line(line, wrong->message);
    return std::nullopt;
}

// What was passed over is what it was taken for.
Status TableRows::check_preface(std::size_t last_line) const {
    if (units_line_ != 0 && columns_.size() == 0)
        return at_line(units_line_, "x, y and z must be finite numbers");
    if (count_line_ == 0 || count_ == columns_.size()) return std::nullopt;
    return at_line(count_line_, "says " + std::to_string(count_) + " particles, but there are " +
                                    std::to_string(columns_.size()) + " up to line " +
                                    std::to_string(last_line));
}

Status TableRows::read(DelimitedText records) {
    std::size_t last_line = header_.line;
    while (records.next()) {
        last_line = records.line();
        if (Status wrong = take(records)) return wrong;
    }
    if (records.error()) return records.error();
    if (Status wrong = check_preface(last_line)) return wrong;
    if (numbers_.commas()) note("numbers: with decimal commas");
    return std::nullopt;
}

}  // namespace

Result<SceneDraft> read_particles_csv(std::string_view text, const ParticleReading& reading) {
    text = without_byte_order_mark(text);
    const TableHeader header = take_header(text, reading);
    DelimitedText names(header.text, header.separator, header.line);
    names.next();
    if (names.error()) return at_line(header.line, names.error()->message);
    if (names.cell_count() > kMaxColumns)
        return at_line(header.line,
                       "at most " + std::to_string(kMaxColumns) + " columns are allowed");
    if (names.cells().empty())
        return at_line(header.line, "must name the columns, x, y, z and radius; there is nothing");
    if (header.titles > 0 && reading.notes != nullptr)
        reading.notes->push_back("not used: what stands above line " + std::to_string(header.line) +
                                 ", which has the names");
    DelimitedText records(text, header.separator, header.next_line);
    const VectorColumns vectors(names.cells(), first_row(records));
    ReadyColumns columns(reading);
    const auto used = columns.choose(vectors.names());
    if (!used)
        return at_line(header.line,
                       "the first line must name the columns: " + used.error().message +
                           (!header.is_found && separator_of_numbers(header.text) != 0
                                ? "; put a line of names above the numbers, such as x,y,z,radius"
                                : ""));
    TableRows rows(header, vectors, *used, names.cells().size(), reading, columns);
    if (const Status wrong = rows.read(std::move(records))) return *wrong;
    return columns.take();
}

}  // namespace awan
