// awan_write_vdb(): the module's only function, and the only user of OpenVDB.
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <ostream>
#include <streambuf>
#include <string>

#include "core/formats/vdb_module.h"

namespace {

// A stream that hands on what is written to it.
class Taker final : public std::streambuf {
  public:
    Taker(void (*take)(void*, const char*, std::size_t), void* to) : take_(take), to_(to) {}

  private:
    int_type overflow(int_type c) override {
        const char byte = traits_type::to_char_type(c);
        take_(to_, &byte, 1);
        return c;
    }
    std::streamsize xsputn(const char* bytes, std::streamsize size) override {
        take_(to_, bytes, static_cast<std::size_t>(size));
        return size;
    }

    void (*take_)(void*, const char*, std::size_t);
    void* to_;
};

openvdb::GridBase::Ptr made_of(const awan::VdbGrid& grid) {
    openvdb::FloatGrid::Ptr made = openvdb::FloatGrid::create(0.0f);
    made->setName(grid.name);
    made->setGridClass(openvdb::GRID_FOG_VOLUME);
    // A value stands in the middle of its cell.
    openvdb::math::Transform::Ptr place =
        openvdb::math::Transform::createLinearTransform(grid.cell);
    const double half = 0.5 * grid.cell;
    place->postTranslate({grid.origin[0] + half, grid.origin[1] + half, grid.origin[2] + half});
    made->setTransform(place);
    const openvdb::CoordBBox box({0, 0, 0},
                                 {grid.cells[0] - 1, grid.cells[1] - 1, grid.cells[2] - 1});
    openvdb::tools::Dense<const float, openvdb::tools::LayoutXYZ> dense(box, grid.values);
    openvdb::tools::copyFromDense(dense, *made, 0.0f, true);
    return made;
}

}  // namespace

extern "C" const char* awan_write_vdb(const awan::VdbGrid* grids, std::size_t count,
                                      void (*take)(void*, const char*, std::size_t), void* to) {
    static std::string message;
    try {
        openvdb::initialize();
        openvdb::GridPtrVec made;
        for (std::size_t i = 0; i < count; ++i) made.push_back(made_of(grids[i]));
        Taker taker(take, to);
        std::ostream out(&taker);
        openvdb::io::Stream stream(out);
        openvdb::MetaMap meta;
        meta.insertMeta("creator", openvdb::StringMetadata("Awan " AWAN_VERSION));
        stream.write(made, meta);
        if (!out) return "the file could not be written";
    } catch (const std::exception& e) {
        message = e.what();
        return message.c_str();
    }
    return nullptr;
}
