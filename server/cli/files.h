// Files of the command line: scenes in, results out. Output appears whole or not at all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace awan {

// All bytes of a file, or of standard input for "-".
Result<std::string> read_input(const std::string& path);

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

// Whether a file with something in it is there. Ours appear whole, so it is finished.
bool is_finished(const std::string& path);

// Writes what make and ninja read to know what `outputs` are made of: "a.png b.exr: scene.json". Standard input and
// output have no names and do not stand in it.
Status write_depfile(const std::string& path, const std::vector<std::string>& outputs,
                     const std::vector<std::string>& inputs);

// Writes all of `bytes` to a file, or to standard output for "-".
Status write_output(const std::string& path, std::string_view bytes);

}  // namespace awan
