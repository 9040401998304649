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

// Where what belongs to the program may be, seen from its folder.
constexpr const char* kModulePlaces[] = {"", "../lib/awan/", "../"};

}  // namespace

std::string beside_program(const char* file) {
    const std::string folder = program_folder();
    for (const char* const place : kModulePlaces)
        if (std::string path = folder + place + file; access(path.c_str(), X_OK) == 0) return path;
    return {};
}

void* module_function(const char* file, const char* function, std::string& reason) {
    const std::string folder = program_folder();
    for (const char* const place : kModulePlaces) {
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
