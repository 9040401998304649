// What is kept for whoever asks for it again, bounded by its bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace awan {

// The most recently used values, as many as fit into so many bytes; Value says its own as bytes(). Thread-safe.
template <typename Value>
class ByteCache {
  public:
    // A value of over `most_of_one` bytes is not kept, so that it does not push out all others. 0: nothing is kept.
    explicit ByteCache(std::size_t bytes) : ByteCache(bytes, bytes) {}
    ByteCache(std::size_t bytes, std::size_t most_of_one)
        : bytes_(bytes), most_of_one_(std::min(most_of_one, bytes)) {}

    bool keeps() const { return bytes_ > 0; }
    std::size_t most_of_one() const { return most_of_one_; }

    // Null: it is not here. What is found counts as the most recently used.
    std::shared_ptr<const Value> find(const std::string& key) {
        const std::lock_guard lock(mutex_);
        const auto found = at(key);
        if (found == entries_.end()) return nullptr;
        entries_.splice(entries_.begin(), entries_, found);
        return found->value;
    }

    // Drops the least recently used until this one fits. A value of the same key is replaced. One that is too large is
    // not kept, and nothing else changes. value is not null.
    void keep(const std::string& key, std::shared_ptr<const Value> value) {
        const std::size_t size = value->bytes();
        if (size > most_of_one_) return;
        const std::lock_guard lock(mutex_);
        // It is here already where two who asked for the same at once made it.
        if (const auto same = at(key); same != entries_.end()) drop(same);
        while (used_ + size > bytes_) drop(std::prev(entries_.end()));
        entries_.push_front({key, std::move(value), size});
        used_ += size;
    }

    std::size_t bytes_in_use() const {
        const std::lock_guard lock(mutex_);
        return used_;
    }
    std::size_t entries() const {
        const std::lock_guard lock(mutex_);
        return entries_.size();
    }

  private:
    struct Entry {
        std::string key;
        std::shared_ptr<const Value> value;
        // As it was when it came.
        std::size_t bytes;
    };
    using Place = typename std::list<Entry>::iterator;

    Place at(const std::string& key) {
        return std::find_if(entries_.begin(), entries_.end(),
                            [&](const Entry& entry) { return entry.key == key; });
    }
    void drop(Place place) {
        used_ -= place->bytes;
        entries_.erase(place);
    }

    mutable std::mutex mutex_;
    const std::size_t bytes_, most_of_one_;
    std::size_t used_ = 0;
    // Most recently used first.
    std::list<Entry> entries_;
};

}  // namespace awan
