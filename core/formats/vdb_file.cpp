#include "core/formats/vdb_file.h"

#include "core/formats/module.h"
#include "core/formats/vdb_module.h"

namespace awan {

Result<std::string> encode_vdb(const DensityVolume& volume, const std::vector<float>& light) {
    if (volume.extinction.empty())
        return Error{ErrorCode::kInvalidScene, "", "there is no matter to make a volume of"};
    std::string reason;
    auto* const write = reinterpret_cast<WriteVdb*>(module_function(kVdbModule, kWriteVdb, reason));
    if (write == nullptr)
        return Error{ErrorCode::kUnsupported, "",
                     std::string("OpenVDB files need the module ") + kVdbModule +
                         ", which cannot be loaded: " + reason};
    VdbGrid grid{"density",
                 volume.extinction.data(),
                 {volume.cells.x, volume.cells.y, volume.cells.z},
                 {volume.origin.x, volume.origin.y, volume.origin.z},
                 volume.cell};
    std::vector<VdbGrid> grids{grid};
    if (!light.empty()) {
        grid.name = "light";
        grid.values = light.data();
        grids.push_back(grid);
    }
    std::string bytes;
    const auto take = [](void* to, const char* from, std::size_t size) {
        static_cast<std::string*>(to)->append(from, size);
    };
    if (const char* const failed = write(grids.data(), grids.size(), take, &bytes))
        return Error{ErrorCode::kInternal, "",
                     std::string("the volume could not be written: ") + failed};
    return bytes;
}

}  // namespace awan
