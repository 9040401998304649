// Files of the command line: scenes in, results out. Output appears whole or not at all.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace awan {

// All bytes of a file, or of standard input for "-".
Result<std::string> read_input(const std::string& path);

// A scene from a file, read as its extension says, or from standard input, as its bytes say.
Result<SceneDraft> read_scene_file(const std::string& path);

// Where a command writes: a file, or standard output for "-". A file is written under another name
// in the same directory and takes its place when it is complete and on the disk; special files
// (/dev/null, pipes) are written directly.
class OutputFile {
  public:
    static Result<OutputFile> open(const std::string& path);
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    // Without commit(): leaves no trace.
    ~OutputFile();

    Status write(std::string_view bytes);
    Status commit();

  private:
    OutputFile() = default;
    int fd_ = -1;
    std::string path_;
    // "" when written directly.
    std::string temporary_;
};

// Whether write_output could begin: said before long work, not after it.
Status check_writable(const std::string& path);

// Writes all of `bytes` to a file, or to standard output for "-".
Status write_output(const std::string& path, std::string_view bytes);

}  // namespace awan
