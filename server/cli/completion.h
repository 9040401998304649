// Completion of commands and flags in a shell.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace awan {

// A script for "bash", "zsh" or "fish", made of the program's own commands, flags and their help. Whatever is no flag
// is completed as a file.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace awan
