#include "core/formats/module.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>

namespace awan {
namespace {

// The folder of the running program, with a slash at its end.
std::string program_folder() {
    std::array<char, 4096> path{};
    const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
    const std::string whole(path.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    return whole.substr(0, whole.rfind('/') + 1);
}

}  // namespace

void* module_function(const char* file, const char* function, std::string& reason) {
    const std::string folder = program_folder();
    for (const char* const place : {"", "../lib/awan/", "../"}) {
        void* const module = dlopen((folder + place + file).c_str(), RTLD_NOW | RTLD_LOCAL);
        if (module == nullptr) {
            reason = dlerror();
            continue;
        }
        if (void* const found = dlsym(module, function)) return found;
        reason = "it lacks its function";
    }
    return nullptr;
}

}  // namespace awan
