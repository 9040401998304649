// Parts of the program that are loaded, or run, when they are asked for, as they bring large libraries.
#pragma once

#include <string>

namespace awan {

// The path of a program that belongs to this one, in the folders that are named below; "": it is in none of them.
std::string beside_program(const char* file);

// Loads a module and leaves it loaded: `file` beside the program, in ../lib/awan of it, or one folder above (where
// tests have it); for those who link the shared library (server/library), in the folder `awan` beside that, or beside
// it. The function of that name in it; null, and why in `reason`.
void* module_function(const char* file, const char* function, std::string& reason);

}  // namespace awan
