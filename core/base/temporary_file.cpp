#include "core/base/temporary_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <string_view>

namespace awan {
namespace {

// Names of files that are not whole yet.
constexpr std::string_view kTemporaryBegins = ".awan-";
constexpr std::string_view kTemporaryEnds = ".tmp";

// That one process writes at once in one folder, and leftovers with its number, are far fewer.
constexpr int kMostNames = 10'000;

}  // namespace

int create_temporary(const std::string& directory, mode_t mode, std::string& name) {
    const std::string begins =
        directory + "/" + std::string(kTemporaryBegins) + std::to_string(getpid()) + "-";
    for (int i = 0; i < kMostNames; ++i) {
        name = begins + std::to_string(i) + std::string(kTemporaryEnds);
        const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (fd < 0 && errno == EEXIST) continue;
        if (fd < 0) return fd;
        // Before it was locked, another may have taken it for one that was left, and is about to remove it.
        struct stat created {};
        flock(fd, LOCK_EX);
        if (fstat(fd, &created) != 0 || created.st_nlink > 0) return fd;
        ::close(fd);
    }
    errno = EEXIST;
    return -1;
}

void remove_abandoned(const std::string& directory) {
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(opendir(directory.c_str()), closedir);
    if (!entries) return;
    while (const dirent* const entry = readdir(entries.get())) {
        const std::string_view name = entry->d_name;
        if (!name.starts_with(kTemporaryBegins) || !name.ends_with(kTemporaryEnds)) continue;
        const int fd = openat(dirfd(entries.get()), entry->d_name,
                              O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (fd < 0) continue;
        // Since it was opened it may have taken its place, and another file its name.
        struct stat locked {
        }, named{};
        if (flock(fd, LOCK_EX | LOCK_NB) == 0 && fstat(fd, &locked) == 0 &&
            fstatat(dirfd(entries.get()), entry->d_name, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
            locked.st_dev == named.st_dev && locked.st_ino == named.st_ino)
            unlinkat(dirfd(entries.get()), entry->d_name, 0);
        ::close(fd);
    }
}

}  // namespace awan
