#include "core/formats/vdb_file.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>

#include "core/formats/vdb_module.h"

namespace awan {
namespace {

// The folder of the running program, with a slash at its end.
std::string program_folder() {
    std::array<char, 4096> path{};
    const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
    const std::string whole(path.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    return whole.substr(0, whole.rfind('/') + 1);
}

// Loads the module and leaves it loaded. Null, and why in `reason`.
WriteVdb* load_writer(std::string& reason) {
    const std::string folder = program_folder();
    // Beside the program, as it is built; where it is installed; and above the tests.
    for (const char* const place : {"", "../lib/awan/", "../"}) {
        void* const module = dlopen((folder + place + kVdbModule).c_str(), RTLD_NOW | RTLD_LOCAL);
        if (module == nullptr) {
            reason = dlerror();
            continue;
        }
        if (void* const function = dlsym(module, kWriteVdb))
            return reinterpret_cast<WriteVdb*>(function);
        reason = "it lacks its function";
    }
    return nullptr;
}

}  // namespace

Result<std::string> encode_vdb(const DensityVolume& volume, const std::vector<float>& light) {
    if (volume.extinction.empty())
        return Error{ErrorCode::kInvalidScene, "", "there is no matter to make a volume of"};
    std::string reason;
    WriteVdb* const write = load_writer(reason);
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
