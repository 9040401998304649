// read_particles_csv()
#include <algorithm>
#include <vector>

#include "core/formats/delimited.h"
#include "core/formats/numbers.h"
#include "core/formats/particle_files.h"
#include "core/formats/ready_columns.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// More columns than any real table has.
constexpr std::size_t kMaxColumns = 256;

// What separates the cells, and where the names stand.
struct TableHeader {
    char separator = ',';
    std::size_t line = 1;
    std::string_view text;
    // The number of the line that follows.
    std::size_t next_line = 2;
};

// How many names of the line are known, when this separates them.
std::size_t known_names(std::string_view line, char separator) {
    DelimitedText cells(line, separator, 1);
    std::size_t known = 0;
    if (cells.next())
        for (const std::string_view name : cells.cells())
            if (known_name(name)) ++known;
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

// The line without the mark of a comment; nothing when it has none.
std::optional<std::string_view> comment(std::string_view line) {
    for (const std::string_view mark : {"#", "//", "%"})
        if (line.starts_with(mark)) return trim(line.substr(mark.size()));
    return {};
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

// Takes lines off the text up to and with the header: the first line that is neither blank nor a comment, or, where
// that holds no names, the last comment that does ("//X;Y;Z", as point cloud tools write it).
TableHeader take_header(std::string_view& text) {
    std::optional<TableHeader> commented;
    std::size_t lines = 0;
    while (!text.empty()) {
        const std::string_view before = text;
        const std::size_t line = lines + 1;
        if (const auto inner = comment(trim(take_line(text)))) {
            ++lines;
            if (const char separator = separator_of(*inner))
                commented = {separator, line, *inner, line + 1};
            continue;
        }
        text = before;
        const std::string_view record = take_record(text, lines);
        // Spreadsheets say what separates in a line of its own.
        if (trim(record).empty() || (trim(record).size() == 5 && record.starts_with("sep=")))
            continue;
        if (const char separator = separator_of(record))
            return {separator, line, record, lines + 1};
        if (!commented) return {',', line, record, lines + 1};
        // These are data already.
        text = before;
        commented->next_line = line;
        return *commented;
    }
    return commented.value_or(TableHeader{});
}

Error at_cell(std::size_t line, std::size_t column, std::string message) {
    return {ErrorCode::kMalformed,
            "line " + std::to_string(line) + ", column " + std::to_string(column + 1),
            std::move(message)};
}

// Reads cells as numbers, and keeps apart decimal points and decimal commas.
class CellNumbers {
  public:
    explicit CellNumbers(char separator) : commas_allowed_(separator != ',') {}

    std::optional<double> read(std::string_view cell) {
        const std::optional<double> value = read_number<double>(cell);
        if (!commas_allowed_) return value;
        if (value) {
            points_ = points_ || cell.find('.') != std::string_view::npos;
            return value;
        }
        const std::size_t comma = cell.find(',');
        if (comma == std::string_view::npos || cell.find('.') != std::string_view::npos) return {};
        text_ = cell;
        text_[comma] = '.';
        commas_ = true;
        return read_number<double>(text_);
    }
    // "1,234" beside "1.5" is a thousand and more, or it is not: nobody knows.
    bool mixed() const { return points_ && commas_; }
    bool commas() const { return commas_; }

  private:
    bool commas_allowed_;
    bool points_ = false, commas_ = false;
    std::string text_;
};

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

}  // namespace

Result<SceneDraft> read_particles_csv(std::string_view text, const ParticleReading& reading) {
    text = without_byte_order_mark(text);
    const TableHeader header = take_header(text);
    DelimitedText names(header.text, header.separator, header.line);
    names.next();
    if (names.error()) return at_line(header.line, names.error()->message);
    if (names.cell_count() > kMaxColumns)
        return at_line(header.line,
                       "at most " + std::to_string(kMaxColumns) + " columns are allowed");
    ReadyColumns columns(reading);
    const auto used = columns.choose({names.cells().begin(), names.cells().end()});
    if (!used)
        return at_line(header.line,
                       "the first line must name the columns: " + used.error().message);

    DelimitedText records(text, header.separator, header.next_line);
    // A first cell that is a number, or nothing, cannot begin with the mark of a comment.
    const bool marks_are_comments = (*used)[0].has_value();
    CellNumbers numbers(header.separator);
    while (records.next()) {
        const std::size_t line = records.line();
        const std::vector<std::string_view>& cells = records.cells();
        const bool marked = !cells.empty() && comment(cells[0]).has_value();
        if (marked && (marks_are_comments || records.cell_count() != used->size())) continue;
        if (columns.size() == limits::kMaxParticles)
            return too_many_particles("line " + std::to_string(line));
        bool as_many = records.cell_count() >= used->size() &&
                       records.cell_count() <= DelimitedText::kMostCells;
        // Separators at a line's end are cells more, of nothing.
        for (std::size_t i = used->size(); as_many && i < cells.size(); ++i)
            as_many = cells[i].empty();
        if (!as_many)
            return at_line(line, "must have as many cells as the header, " +
                                     std::to_string(used->size()) + ", not " +
                                     std::to_string(records.cell_count()));
        ReadyRow row;
        for (std::size_t i = 0; i < used->size(); ++i) {
            const std::optional<Says> says = (*used)[i];
            if (!says) continue;
            if (cells[i].empty() && may_be_empty(*says)) {
                row.leave_empty(*says);
                continue;
            }
            const std::optional<double> value = numbers.read(cells[i]);
            if (!value) return at_cell(line, i, must_be_number(*says, cells[i], header.separator));
            if (numbers.mixed())
                return at_cell(
                    line, i,
                    "some numbers have a decimal comma and some a decimal point, as in " +
                        short_quote(cells[i]));
            row[*says] = *value;
        }
        if (const Status wrong = columns.add(row)) return at_line(line, wrong->message);
    }
    if (records.error()) return *records.error();
    if (numbers.commas() && reading.notes != nullptr)
        reading.notes->push_back("numbers: with decimal commas");
    return columns.take();
}

}  // namespace awan
