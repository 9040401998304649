#include "server/cli/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/temporary_file.h"

namespace awan {
namespace {

Error io_error(const std::string& what, const std::string& path) {
    return Error{ErrorCode::kIo, "", "cannot " + what + " " + path + ": " + std::strerror(errno)};
}

std::string name_of(const std::string& path) {
    return path == "-" ? "standard output" : path;
}

// While a temporary file exists, an interrupt waits: it must not leave the file behind.
sigset_t interrupts() {
    sigset_t set;
    sigemptyset(&set);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, number);
    return set;
}
void hold_interrupts() {
    const sigset_t set = interrupts();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
}
void release_interrupts() {
    const sigset_t set = interrupts();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

std::string directory_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

// The name is on the disk only when its directory is.
void sync_directory(const std::string& directory) {
    const int fd = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return;
    fsync(fd);
    ::close(fd);
}

}  // namespace

Result<std::string> read_input(const std::string& path) {
    const bool standard = path == "-";
    const int fd = standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return io_error("read", path);
    std::string text;
    ssize_t n = 0;
    char buffer[64u << 10];
    while ((n = read(fd, buffer, sizeof buffer)) != 0) {
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) break;
        text.append(buffer, static_cast<std::size_t>(n));
    }
    const int failed = n < 0 ? errno : 0;
    if (!standard) ::close(fd);
    errno = failed;
    if (failed) return io_error("read", standard ? "standard input" : path);
    return text;
}

Result<OutputFile> OutputFile::open(const std::string& path) {
    OutputFile file;
    file.path_ = path;
    if (path == "-") {
        file.fd_ = STDOUT_FILENO;
        return file;
    }
    struct stat existing {};
    const bool exists = stat(path.c_str(), &existing) == 0;
    if (exists && !S_ISREG(existing.st_mode)) {
        file.fd_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (file.fd_ < 0) return io_error("write", path);
        return file;
    }
    // Write where a link leads, and leave the link.
    if (exists) {
        const std::unique_ptr<char, void (*)(void*)> real(realpath(path.c_str(), nullptr), free);
        if (real) file.path_ = real.get();
    }
    const std::string directory = directory_of(file.path_);
    remove_abandoned(directory);
    hold_interrupts();
    const mode_t mode = exists ? existing.st_mode & 0777 : 0666;
    file.fd_ = create_temporary(directory, mode, file.temporary_);
    if (file.fd_ < 0) {
        const Error error = io_error("write", path);
        file.temporary_.clear();
        release_interrupts();
        return error;
    }
    if (exists && fchmod(file.fd_, mode) != 0) return io_error("write", path);
    return file;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    std::swap(fd_, other.fd_);
    std::swap(path_, other.path_);
    std::swap(temporary_, other.temporary_);
    return *this;
}

OutputFile::~OutputFile() {
    if (fd_ >= 0 && fd_ != STDOUT_FILENO) ::close(fd_);
    if (temporary_.empty()) return;
    unlink(temporary_.c_str());
    release_interrupts();
}

Status OutputFile::write(std::string_view bytes) {
    if (!write_all(fd_, bytes)) return io_error("write", name_of(path_));
    return std::nullopt;
}

Status OutputFile::commit() {
    if (fd_ == STDOUT_FILENO) return std::nullopt;
    // Pipes and devices have nothing to sync and say EINVAL.
    if (fsync(fd_) != 0 && errno != EINVAL && errno != EROFS) return io_error("write", path_);
    const bool takes_place = !temporary_.empty();
    // Still locked: who clears a folder of what was left there would take an unlocked file for that.
    if (takes_place) {
        if (rename(temporary_.c_str(), path_.c_str()) != 0) return io_error("write", path_);
        temporary_.clear();
        release_interrupts();
    }
    if (::close(std::exchange(fd_, -1)) != 0) return io_error("write", path_);
    if (takes_place) sync_directory(directory_of(path_));
    return std::nullopt;
}

Status check_writable(const std::string& path) {
    if (path == "-") return std::nullopt;
    struct stat existing {};
    const bool special = stat(path.c_str(), &existing) == 0 && !S_ISREG(existing.st_mode);
    if (S_ISDIR(existing.st_mode)) {
        errno = EISDIR;
        return io_error("write", path);
    }
    const std::string place = special ? path : directory_of(path);
    if (access(place.c_str(), special ? W_OK : W_OK | X_OK) != 0) return io_error("write", path);
    return std::nullopt;
}

bool is_finished(const std::string& path) {
    struct stat existing {};
    return stat(path.c_str(), &existing) == 0 && S_ISREG(existing.st_mode) && existing.st_size > 0;
}

Status write_depfile(const std::string& path, const std::vector<std::string>& outputs,
                     const std::vector<std::string>& inputs) {
    std::string text;
    // As GCC writes them, which both programs read.
    const auto append = [&](const std::string& name) {
        if (name == "-") return;
        if (!text.empty()) text += ' ';
        for (const char c : name) {
            if (c == ' ' || c == '#' || c == '\\') text += '\\';
            if (c == '$') text += '$';
            text += c;
        }
    };
    for (const std::string& name : outputs) append(name);
    if (text.empty())
        return Error{ErrorCode::kIo, "", "--depfile " + path + ": needs an output that has a name"};
    text += ':';
    for (const std::string& name : inputs) append(name);
    return write_output(path, text + '\n');
}

Status write_output(const std::string& path, std::string_view bytes) {
    auto file = OutputFile::open(path);
    if (!file) return file.error();
    if (const Status failed = file->write(bytes)) return failed;
    return file->commit();
}

}  // namespace awan
