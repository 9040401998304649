// Parts of the program that are loaded when they are asked for, as they bring large libraries.
#pragma once

#include <string>

namespace awan {

// Loads a module and leaves it loaded: `file` beside the program, in ../lib/awan of it, or one folder above (where
// tests have it). The function of that name in it; null, and why in `reason`.
void* module_function(const char* file, const char* function, std::string& reason);

}  // namespace awan
