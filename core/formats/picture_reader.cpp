#include "core/formats/picture_reader.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "core/base/descriptor.h"
#include "core/base/thrown.h"
#include "core/formats/module.h"
#include "core/formats/picture_program.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// How often it is looked whether somebody still waits.
constexpr int kLookMs = 20;

// What the shell and the loader say of a program that cannot be started.
constexpr int kNotStarted = 127;

// A process that is ended, and waited for, at the latest with this.
class Child {
  public:
    explicit Child(pid_t pid) : pid_(pid) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        (void)end();
    }
    // Its exit code, once it has ended; -1: by a signal, or nobody knows.
    int end() {
        int status = 0;
        pid_t done = -1;
        do {
            done = waitpid(pid_, &status, 0);
        } while (done < 0 && errno == EINTR);
        pid_ = 0;
        return done > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t pid_;
};

// What is to be done with the descriptors of a process before it begins.
class FileActions {
  public:
    FileActions() { posix_spawn_file_actions_init(&actions_); }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    posix_spawn_file_actions_t* get() { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_;
};

// Its number, or minus an error's.
pid_t start(const std::string& program, int in, int out) {
    FileActions actions;
    posix_spawn_file_actions_adddup2(actions.get(), in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(actions.get(), out, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(actions.get(), STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::string name = kPictureProgram;
    char* const arguments[] = {name.data(), nullptr};
    pid_t pid = 0;
    const int failed =
        posix_spawn(&pid, program.c_str(), actions.get(), nullptr, arguments, environ);
    return failed != 0 ? -failed : pid;
}

// Everything that comes, until its end or so many bytes.
Status read_all(int fd, std::size_t most, const Deadline& deadline, std::string& to) {
    char buffer[64u << 10];
    while (to.size() < most) {
        if (Status over = deadline.over()) return over;
        pollfd polled{fd, POLLIN, 0};
        if (poll(&polled, 1, kLookMs) <= 0) continue;
        const ssize_t n = read(fd, buffer, std::min(sizeof buffer, most - to.size()));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        to.append(buffer, static_cast<std::size_t>(n));
    }
    return std::nullopt;
}

// Whether this process, and so the other, may have so much memory only (ulimit -v): then it may be that which ended it.
bool is_limited() {
    rlimit space{};
    return getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY;
}

Error refused(const std::string& why) {
    return {ErrorCode::kInvalidScene, "", why};
}

}  // namespace

Result<GreyPicture> read_picture(std::string_view bytes, const Deadline& deadline) {
    const std::string program = beside_program(kPictureProgram);
    if (program.empty())
        return Error{
            ErrorCode::kUnsupported, "",
            std::string("pictures need the program ") + kPictureProgram + ", which is not there"};
    const Descriptor file(memfd_create("picture", MFD_CLOEXEC));
    if (file.get() < 0 || !write_all(file.get(), bytes)) return out_of_memory();
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return out_of_memory();
    const Descriptor from(ends[0]);
    Descriptor into(ends[1]);
    const pid_t pid = start(program, file.get(), into.get());
    if (pid < 0) return out_of_memory();
    Child child(pid);
    into.close();

    std::string said;
    constexpr std::size_t kHueBytes = 3 * kPictureHues * kPictureHues;
    constexpr std::size_t kMost = sizeof(PictureHead) + limits::kMaxTexturePixels +
                                  2 * kPictureHeights * kPictureHeights + kHueBytes;
    if (const Status over = read_all(from.get(), kMost, deadline, said)) return *over;
    PictureHead head;
    if (said.size() >= sizeof head) std::memcpy(&head, said.data(), sizeof head);
    const std::string_view rest = std::string_view(said).substr(std::min(sizeof head, said.size()));
    const auto area = [](std::int32_t across, std::int32_t down, std::int32_t most) {
        const bool possible = across > 0 && down > 0 && across <= most && down <= most;
        return possible ? static_cast<std::size_t>(across) * static_cast<std::size_t>(down) : 0;
    };
    constexpr auto kSide = static_cast<std::int32_t>(limits::kMaxTexturePictureSide);
    const std::size_t pixels = area(head.width, head.height, kSide),
                      heights = area(head.across, head.down, kPictureHeights);
    if (head.outcome == PictureOutcome::kRead && pixels > 0 && heights > 0 &&
        rest.size() == pixels + 2 * heights + (head.colored == 1 ? kHueBytes : 0)) {
        GreyPicture picture{head.width, head.height, {}, head.across, head.down, {}, {}};
        picture.values.assign(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(pixels));
        picture.luminance.resize(heights);
        std::memcpy(picture.luminance.data(), rest.data() + pixels, 2 * heights);
        const std::string_view hues = rest.substr(pixels + 2 * heights);
        picture.hues.assign(hues.begin(), hues.end());
        return picture;
    }
    if (head.outcome == PictureOutcome::kTooLarge)
        return Error{ErrorCode::kTooLarge, "", std::string(rest)};
    if (head.outcome == PictureOutcome::kNoMemory && is_limited()) return out_of_memory();
    if (head.outcome != PictureOutcome::kRead && !rest.empty()) return refused(std::string(rest));
    if (child.end() == kNotStarted || is_limited()) return out_of_memory();
    return refused("it is broken, or takes more to read than it may");
}

}  // namespace awan
