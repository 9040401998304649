#include "core/formats/vector_cells.h"

#include "core/formats/column_names.h"
#include "core/formats/numbers.h"

namespace awan {
namespace {

// x and r are 0, y and g 1, z and b 2, w and a 3; nothing for another.
std::optional<std::size_t> place_of(std::string_view key) {
    constexpr std::string_view kKeys[] = {"xr", "yg", "zb", "wa"};
    if (key.size() != 1) return {};
    for (std::size_t i = 0; i < std::size(kKeys); ++i)
        if (kKeys[i].find(static_cast<char>(key[0] | 0x20)) != std::string_view::npos) return i;
    return {};
}

}  // namespace

std::optional<std::array<std::string_view, 3>> split_vector(std::string_view cell) {
    cell = trim(cell);
    const std::size_t open = cell.find_first_of("([{<");
    if (open != std::string_view::npos) {
        // What stands before it is a type, "Vector3(": letters and digits.
        for (const char c : cell.substr(0, open))
            if (is_blank(c) || c == ',' || c == '=') return {};
        if (cell.find_first_of(")]}>") != cell.size() - 1) return {};
        cell = cell.substr(open + 1, cell.size() - open - 2);
    }
    std::array<std::string_view, 4> parts{};
    std::size_t count = 0;
    for (cell = trim(cell); !cell.empty(); cell = trim(cell)) {
        if (count == parts.size()) return {};
        std::size_t end = 0;
        while (end < cell.size() && cell[end] != ',' && cell[end] != ';' && !is_blank(cell[end]))
            ++end;
        std::string_view part = cell.substr(0, end);
        cell = trim(cell.substr(end));
        if (!cell.empty() && (cell[0] == ',' || cell[0] == ';')) cell.remove_prefix(1);
        std::size_t at = count++;
        if (const std::size_t equals = part.find('='); equals != std::string_view::npos) {
            const auto place = place_of(trim(part.substr(0, equals)));
            if (!place) return {};
            at = *place;
            part = trim(part.substr(equals + 1));
        }
        if (part.empty() || !parts[at].empty()) return {};
        parts[at] = part;
    }
    if (count < 3 || parts[0].empty() || parts[1].empty() || parts[2].empty()) return {};
    return std::array{parts[0], parts[1], parts[2]};
}

VectorColumns::VectorColumns(const std::vector<std::string_view>& names,
                             const std::vector<std::string_view>& first)
    : is_vector_(names.size()) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        is_vector_[i] =
            i < first.size() && is_vector_name(names[i]) && split_vector(first[i]).has_value();
        any_ = any_ || is_vector_[i];
        if (!is_vector_[i]) {
            names_.emplace_back(names[i]);
            column_.push_back(i);
            continue;
        }
        for (const char* const part : {".x", ".y", ".z"}) {
            names_.push_back(std::string(names[i]) + part);
            column_.push_back(i);
        }
    }
}

void VectorColumns::spread(const std::vector<std::string_view>& cells,
                           std::vector<std::string_view>& out) const {
    out.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i >= is_vector_.size() || !is_vector_[i]) {
            out.push_back(cells[i]);
            continue;
        }
        const auto parts = split_vector(cells[i]);
        for (std::size_t k = 0; k < 3; ++k) out.push_back(parts ? (*parts)[k] : cells[i]);
    }
}

}  // namespace awan
