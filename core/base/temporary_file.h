// Files that appear whole: written under another name in the same folder, then renamed.
#pragma once

#include <sys/types.h>

#include <string>

namespace awan {

// A new file of that mode (less the umask) in `directory`, open for writing and locked for as long as it is; its path
// in `name`. -1, with errno.
int create_temporary(const std::string& directory, mode_t mode, std::string& name);

// Removes what a program left in `directory` that was killed while it wrote. Who still writes holds a lock.
void remove_abandoned(const std::string& directory);

}  // namespace awan
