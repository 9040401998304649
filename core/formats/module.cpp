#include "core/formats/module.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <string_view>
#include <vector>

namespace awan {
namespace {

std::string folder_of(std::string_view path) {
    return std::string(path.substr(0, path.rfind('/') + 1));
}

// The folder of the running program, with a slash at its end.
std::string program_folder() {
    std::array<char, 4096> path{};
    const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
    return folder_of({path.data(), length > 0 ? static_cast<std::size_t>(length) : 0});
}

// The folder of the shared library that this code is part of; "" where the program itself holds it.
std::string library_folder() {
    Dl_info info{};
    static const char here = 0;
    if (dladdr(&here, &info) == 0 || info.dli_fname == nullptr) return {};
    const std::string_view path = info.dli_fname;
    return path.find(".so") == std::string_view::npos ? std::string() : folder_of(path);
}

// Where what belongs to the program, or to the library, may be: a path to be followed by its name.
std::vector<std::string> places_of_modules() {
    const std::string program = program_folder();
    std::vector<std::string> places = {program, program + "../lib/awan/", program + "../"};
    if (const std::string library = library_folder(); !library.empty()) {
        places.push_back(library + "awan/");
        places.push_back(library);
    }
    return places;
}

}  // namespace

std::string beside_program(const char* file) {
    for (const std::string& place : places_of_modules())
        if (std::string path = place + file; access(path.c_str(), X_OK) == 0) return path;
    return {};
}

void* module_function(const char* file, const char* function, std::string& reason) {
    for (const std::string& place : places_of_modules()) {
        void* const module = dlopen((place + file).c_str(), RTLD_NOW | RTLD_LOCAL);
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
