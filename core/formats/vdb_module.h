// What the module that writes OpenVDB files gives to the program. OpenVDB brings libraries that take longer to load
// than a small picture takes to render, so it is loaded when it is asked for.
#pragma once

#include <cstddef>

namespace awan {

// One grid of floats on cubic cells, x fastest, then y, then z.
struct VdbGrid {
    const char* name;
    const float* values;
    int cells[3];
    // Corner of cell 0 and side of a cell, scene units.
    double origin[3];
    double cell;
};

// Gives the bytes of a file with these grids to take(to, ...), one after the other. Null, or what went wrong (for ever
// valid).
using WriteVdb = const char*(const VdbGrid* grids, std::size_t count,
                             void (*take)(void* to, const char* bytes, std::size_t size), void* to);
inline constexpr const char* kWriteVdb = "awan_write_vdb";
inline constexpr const char* kVdbModule = "awan_openvdb.so";

}  // namespace awan
