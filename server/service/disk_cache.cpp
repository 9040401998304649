#include "server/service/disk_cache.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/temporary_file.h"
#include "core/base/thrown.h"
#include "server/service/kept_file.h"

namespace awan {
namespace {

constexpr std::string_view kKeptEnds = ".kept";
// Hex digits of an entity tag.
constexpr std::size_t kTagDigits = 32;
// What a file takes at least, and in steps of which it grows.
constexpr std::size_t kBlockBytes = 4096;

std::size_t on_disk(std::size_t bytes) {
    return (bytes + kBlockBytes - 1) / kBlockBytes * kBlockBytes;
}

bool is_lower_hex(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
}

// The file's name of an entity tag with its quotes; "" of one that make_etag() did not make.
std::string kept_name(const std::string& tag) {
    if (tag.size() != kTagDigits + 2) return {};
    const std::string digits = tag.substr(1, kTagDigits);
    if (!std::all_of(digits.begin(), digits.end(), is_lower_hex)) return {};
    return digits + std::string(kKeptEnds);
}
bool is_kept_name(std::string_view name) {
    return name.size() == kTagDigits + kKeptEnds.size() && name.ends_with(kKeptEnds) &&
           std::all_of(name.begin(), name.begin() + kTagDigits, is_lower_hex);
}

struct KeptFile {
    std::string name;
    std::size_t bytes = 0;
    timespec used{};
};

// Nothing: the folder cannot be read, and errno says why.
std::optional<std::vector<KeptFile>> files_of(const std::string& folder) {
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(opendir(folder.c_str()), closedir);
    if (!entries) return std::nullopt;
    std::vector<KeptFile> files;
    while (const dirent* const entry = readdir(entries.get())) {
        struct stat about {};
        if (!is_kept_name(entry->d_name)) continue;
        if (fstatat(dirfd(entries.get()), entry->d_name, &about, AT_SYMLINK_NOFOLLOW) != 0)
            continue;
        files.push_back(
            {entry->d_name, on_disk(static_cast<std::size_t>(about.st_size)), about.st_mtim});
    }
    return files;
}

std::size_t sum_of(const std::vector<KeptFile>& files) {
    std::size_t sum = 0;
    for (const KeptFile& file : files) sum += file.bytes;
    return sum;
}

// What a file holds, at most so much; nothing when it is longer, no file, or cannot be read.
std::optional<std::string> read_file(int fd, std::size_t most) {
    struct stat about {};
    if (fstat(fd, &about) != 0 || !S_ISREG(about.st_mode)) return std::nullopt;
    const auto size = static_cast<std::size_t>(about.st_size);
    if (size > most) return std::nullopt;
    std::string bytes(size, '\0');
    std::size_t have = 0;
    while (have < size) {
        const ssize_t n = ::read(fd, bytes.data() + have, size - have);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return std::nullopt;
        have += static_cast<std::size_t>(n);
    }
    return bytes;
}

Error disk_error(const std::string& path) {
    return {ErrorCode::kIo, "", path + ": " + std::strerror(errno)};
}

}  // namespace

Result<std::shared_ptr<DiskCache>> DiskCache::open(DiskCacheOptions options) {
    const std::string folder = options.folder;
    if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return disk_error(folder);
    remove_abandoned(folder);
    const auto files = files_of(folder);
    if (!files) return disk_error(folder);
    auto cache = std::make_shared<DiskCache>(std::move(options));
    cache->counts_.bytes = sum_of(*files);
    cache->counts_.entries = files->size();
    return cache;
}

DiskCache::DiskCache(DiskCacheOptions options)
    : options_(std::move(options)), writer_([this] { serve(); }) {}

DiskCache::~DiskCache() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        changed_.notify_all();
    }
    writer_.join();
}

std::size_t DiskCache::most_of_one() const {
    return std::min(options_.bytes, limits::kDiskCacheBytes) / 8;
}

std::shared_ptr<const KeptResult> DiskCache::find(const std::string& tag) {
    const std::string name = kept_name(tag);
    if (name.empty()) return nullptr;
    const std::string path = options_.folder + "/" + name;
    try {
        // A pipe by this name would wait for its writer.
        const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
        if (file.get() < 0 && errno != ELOOP) return nullptr;
        if (auto bytes = read_file(file.get(), most_of_one()))
            if (auto result = read_kept(*std::move(bytes), tag)) {
                // When it was used last. A folder that may only be read stays as it is.
                futimens(file.get(), nullptr);
                auto kept = std::make_shared<const KeptResult>(*std::move(result));
                const std::lock_guard lock(mutex_);
                ++counts_.hits;
                return kept;
            }
        unlink(path.c_str());
        const std::lock_guard lock(mutex_);
        ++counts_.damaged;
    } catch (const std::bad_alloc&) {
        // It is rendered anew, or there is not the memory for that either.
    }
    return nullptr;
}

void DiskCache::keep(const std::string& tag, std::shared_ptr<const KeptResult> result) {
    const std::size_t size = result->bytes();
    if (on_disk(size) > most_of_one()) return;
    const std::lock_guard lock(mutex_);
    if (waiting_bytes_ + size > options_.most_waiting && waiting_bytes_ > 0) {
        ++counts_.skipped;
        return;
    }
    waiting_.push_back({tag, std::move(result)});
    waiting_bytes_ += size;
    changed_.notify_all();
}

void DiskCache::flush() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_.empty() && !writing_; });
}

DiskCache::Counts DiskCache::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

void DiskCache::serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return stopping_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        waiting_bytes_ -= next.result->bytes();
        writing_ = true;
        lock.unlock();
        try {
            write(next);
        } catch (const std::exception&) {
            failed("no memory");
        }
        lock.lock();
        writing_ = false;
        changed_.notify_all();
    }
}

void DiskCache::write(const Waiting& next) {
    const std::string name = kept_name(next.tag);
    const std::string head = kept_head(next.tag, *next.result);
    if (name.empty() || head.empty()) return;
    const std::size_t size = on_disk(head.size() + next.result->body->size());
    const std::string path = options_.folder + "/" + name;
    make_room(size);
    struct stat before {};
    const bool is_there = lstat(path.c_str(), &before) == 0;
    if (const Status wrong = write_file(head, *next.result->body, path)) {
        failed(wrong->message);
        return;
    }
    if (is_there) return;
    const std::lock_guard lock(mutex_);
    counts_.bytes += size;
    ++counts_.entries;
}

Status DiskCache::write_file(const std::string& head, const std::string& body,
                             const std::string& path) {
    std::string temporary;
    Descriptor file(create_temporary(options_.folder, 0600, temporary));
    if (file.get() < 0) return disk_error(options_.folder);
    if (!write_all(file.get(), head) || !write_all(file.get(), body) ||
        rename(temporary.c_str(), path.c_str()) != 0) {
        const Error error = disk_error(options_.folder);
        unlink(temporary.c_str());
        return error;
    }
    if (!file.close()) {
        const Error error = disk_error(options_.folder);
        unlink(path.c_str());
        return error;
    }
    return std::nullopt;
}

// Counted anew when it seems full: others may write there, or clear it. Then a tenth is freed at once, so that it is
// counted seldom.
void DiskCache::make_room(std::size_t size) {
    {
        const std::lock_guard lock(mutex_);
        if (counts_.bytes + size <= options_.bytes) return;
    }
    remove_abandoned(options_.folder);
    auto files = files_of(options_.folder).value_or(std::vector<KeptFile>{});
    std::sort(files.begin(), files.end(), [](const KeptFile& a, const KeptFile& b) {
        return std::pair(a.used.tv_sec, a.used.tv_nsec) < std::pair(b.used.tv_sec, b.used.tv_nsec);
    });
    std::size_t sum = sum_of(files);
    std::size_t gone = 0;
    if (sum + size > options_.bytes)
        for (; gone < files.size() && sum + size > options_.bytes / 10 * 9; ++gone) {
            unlink((options_.folder + "/" + files[gone].name).c_str());
            sum -= files[gone].bytes;
        }
    const std::lock_guard lock(mutex_);
    counts_.evicted += gone;
    counts_.bytes = sum;
    counts_.entries = files.size() - gone;
}

void DiskCache::failed(const std::string& why) noexcept {
    bool first = false;
    {
        const std::lock_guard lock(mutex_);
        ++counts_.failed;
        first = !std::exchange(said_, true);
    }
    if (!first || !options_.say) return;
    try {
        options_.say("answers cannot be kept on disk: " + why + "; renders go on without");
    } catch (const std::exception&) {
        // It is counted.
    }
}

}  // namespace awan
