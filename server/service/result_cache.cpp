#include "server/service/result_cache.h"

#include <algorithm>

namespace awan {

std::list<ResultCache::Entry>::iterator ResultCache::at(const std::string& tag) {
    return std::find_if(entries_.begin(), entries_.end(),
                        [&](const Entry& entry) { return entry.tag == tag; });
}

std::shared_ptr<const KeptResult> ResultCache::find(const std::string& tag) {
    const std::lock_guard lock(mutex_);
    const auto found = at(tag);
    if (found == entries_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found);
    return found->result;
}

void ResultCache::keep(const std::string& tag,
                       const std::vector<std::pair<std::string, std::string>>& headers,
                       const std::string& body) {
    std::size_t size = sizeof(Entry) + tag.size() + body.size();
    for (const auto& [name, value] : headers) size += name.size() + value.size();
    if (size > bytes_ / 8) return;
    // Copied before anybody has to wait for it.
    auto kept = std::make_shared<const KeptResult>(
        KeptResult{headers, std::make_shared<const std::string>(body)});
    const std::lock_guard lock(mutex_);
    // It is here already where two asked for the same at once.
    if (const auto same = at(tag); same != entries_.end()) {
        used_ -= same->bytes;
        entries_.erase(same);
    }
    while (used_ + size > bytes_) {
        used_ -= entries_.back().bytes;
        entries_.pop_back();
    }
    entries_.push_front({tag, std::move(kept), size});
    used_ += size;
}

std::size_t ResultCache::bytes_in_use() const {
    const std::lock_guard lock(mutex_);
    return used_;
}

std::size_t ResultCache::entries() const {
    const std::lock_guard lock(mutex_);
    return entries_.size();
}

}  // namespace awan
