// Cells of tables that hold a whole vector: "(X=1.0,Y=0.2,Z=0.1)", "(1, 0.2, 0.1)", "[1 0.2 0.1]".
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace awan {

// The three numbers of a vector, as text, in the order x, y, z (or r, g, b); a fourth (w, alpha) is left out. Nothing
// for a cell that is none.
std::optional<std::array<std::string_view, 3>> split_vector(std::string_view cell);

// Makes three columns of each that holds vectors, so that whoever reads them knows of numbers alone.
class VectorColumns {
  public:
    // names: of the file's columns; first: the cells of its first row. Columns are vectors by their name and by what
    // stands there.
    VectorColumns(const std::vector<std::string_view>& names,
                  const std::vector<std::string_view>& first);

    bool any() const { return any_; }
    // "Location" as "Location.x", "Location.y", "Location.z".
    const std::vector<std::string>& names() const { return names_; }
    // The file's column of one of these.
    std::size_t column_of(std::size_t i) const { return column_[i]; }
    // The cells of a row, as many as names(). A cell that is no vector stands in place of each of its three numbers.
    void spread(const std::vector<std::string_view>& cells,
                std::vector<std::string_view>& out) const;

  private:
    bool any_ = false;
    std::vector<std::string> names_;
    std::vector<std::size_t> column_;
    // Of the file's columns.
    std::vector<bool> is_vector_;
};

}  // namespace awan
