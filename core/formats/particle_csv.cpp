// read_particles_csv()
#include <vector>

#include "core/formats/numbers.h"
#include "core/formats/particle_files.h"
#include "core/formats/ready_columns.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// Takes the text up to the next comma off `line`. `more` says whether there was a comma.
std::string_view take_cell(std::string_view& line, bool& more) {
    const std::size_t comma = line.find(',');
    const std::string_view cell = trim(line.substr(0, comma));
    more = comma != std::string_view::npos;
    line.remove_prefix(more ? comma + 1 : line.size());
    return cell;
}

// Names of columns may stand in double quotes, as spreadsheets write them.
std::string_view without_quotes(std::string_view name) {
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"')
        return name.substr(1, name.size() - 2);
    return name;
}

}  // namespace

Result<SceneDraft> read_particles_csv(std::string_view text) {
    // More columns than any real table has.
    constexpr std::size_t kMaxColumns = 256;
    text = without_byte_order_mark(text);
    ReadyColumns columns;
    std::vector<std::optional<Column>> layout;
    std::size_t number = 1;
    std::string_view header = take_line(text);
    for (bool more = true; more;) {
        const std::string_view name = without_quotes(take_cell(header, more));
        if (layout.size() == kMaxColumns)
            return at_line(number,
                           "at most " + std::to_string(kMaxColumns) + " columns are allowed");
        layout.push_back(column_from_name(name));
        if (layout.back() && !columns.declare(*layout.back()))
            return at_line(
                number, std::string("the column ") + column_name(*layout.back()) + " stands twice");
    }
    if (const std::optional<std::string> missing = columns.missing())
        return at_line(number,
                       "must name the columns, x,y,z,radius and optionally "
                       "density,r,g,b: " +
                           *missing);

    while (!text.empty()) {
        std::string_view line = take_line(text);
        ++number;
        if (trim(line).empty()) continue;
        if (columns.size() == limits::kMaxParticles)
            return too_many_particles("line " + std::to_string(number));
        std::array<double, kColumnCount> values{};
        std::size_t cells = 0;
        for (bool more = true; more; ++cells) {
            const std::string_view cell = take_cell(line, more);
            if (cells >= layout.size() || !layout[cells]) continue;
            const std::optional<double> value = read_number<double>(cell);
            if (!value)
                return at_line(number, std::string(column_name(*layout[cells])) +
                                           " must be a finite number, not " + short_quote(cell));
            values[static_cast<std::size_t>(*layout[cells])] = *value;
        }
        if (cells != layout.size())
            return at_line(number, "must have as many cells as the header, " +
                                       std::to_string(layout.size()) + ", not " +
                                       std::to_string(cells));
        columns.add(values);
    }
    return columns.take();
}

}  // namespace awan
