// Kept answers that outlive the server: a file each, named by its entity tag, in a folder of their own. Several servers
// may have the same folder.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "core/base/result.h"
#include "server/limits.h"
#include "server/service/result_cache.h"

namespace awan {

struct DiskCacheOptions {
    // Made if it is not there (its parent is).
    std::string folder;
    // Of all files, in blocks of 4 KiB.
    std::size_t bytes = limits::kDiskCacheBytes;
    // Of answers that wait to be written. What comes beside these is not kept.
    std::size_t most_waiting = limits::kDiskWaitingBytes;
    // Told the first time that an answer could not be written, and why. May be empty.
    std::function<void(const std::string& what)> say;
};

// Thread-safe. Nothing that the disk does fails a request: what cannot be read is not there, what cannot be written is
// not kept, and both are counted. Answers are written by a thread of its own, so a slow disk holds up nobody.
class DiskCache {
  public:
    // kIo: the folder cannot be made or read.
    static Result<std::shared_ptr<DiskCache>> open(DiskCacheOptions options);
    explicit DiskCache(DiskCacheOptions options);
    // Writes what waits.
    ~DiskCache();
    DiskCache(const DiskCache&) = delete;
    DiskCache& operator=(const DiskCache&) = delete;

    // Bytes of an answer over which it is not kept: an eighth of the folder's, at most of the usual folder's.
    std::size_t most_of_one() const;
    // The answer to an entity tag. Null: it is not here. A file that is not whole, or another's, is removed. What is
    // found counts as the most recently used, for the servers after this one too.
    std::shared_ptr<const KeptResult> find(const std::string& tag);
    // Drops the least recently used where there is no room. result is not null.
    void keep(const std::string& tag, std::shared_ptr<const KeptResult> result);
    // Waits until what was to be kept before has been written.
    void flush();

    struct Counts {
        std::uint64_t hits = 0;
        // Files that were damaged, cut short or another's; that gave way to others.
        std::uint64_t damaged = 0, evicted = 0;
        // Answers that could not be written; that were not, since too many waited.
        std::uint64_t failed = 0, skipped = 0;
        // What there is, as last counted, and what was written since.
        std::uint64_t bytes = 0, entries = 0;
    };
    Counts counts() const;

  private:
    struct Waiting {
        std::string tag;
        std::shared_ptr<const KeptResult> result;
    };
    void serve();
    void write(const Waiting& next);
    Status write_file(const std::string& head, const std::string& body, const std::string& path);
    void make_room(std::size_t size);
    void failed(const std::string& why) noexcept;

    const DiskCacheOptions options_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Waiting> waiting_;
    std::size_t waiting_bytes_ = 0;
    // The thread is busy with what it took from `waiting_`.
    bool writing_ = false;
    bool stopping_ = false;
    bool said_ = false;
    Counts counts_;
    std::thread writer_;
};

}  // namespace awan
