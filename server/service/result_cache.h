// Answers to renders that are kept for those who ask for the same again, by entity tag: that names the scene in its
// canonical form, the engine's version, the renderer and the format.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace awan {

struct KeptResult {
    std::vector<std::pair<std::string, std::string>> headers;
    std::shared_ptr<const std::string> body;
};

// The most recently used, as many as fit into `bytes`. Thread-safe.
class ResultCache {
  public:
    // 0: nothing is kept.
    explicit ResultCache(std::size_t bytes) : bytes_(bytes) {}

    bool keeps() const { return bytes_ > 0; }
    // Null: it is not here. What is found counts as the most recently used.
    std::shared_ptr<const KeptResult> find(const std::string& tag);
    // Drops the least recently used until this one fits; what alone is more than an eighth of all is not kept.
    void keep(const std::string& tag,
              const std::vector<std::pair<std::string, std::string>>& headers,
              const std::string& body);
    std::size_t bytes_in_use() const;
    std::size_t entries() const;

  private:
    struct Entry {
        std::string tag;
        std::shared_ptr<const KeptResult> result;
        std::size_t bytes;
    };
    std::list<Entry>::iterator at(const std::string& tag);

    mutable std::mutex mutex_;
    const std::size_t bytes_;
    std::size_t used_ = 0;
    // Most recently used first.
    std::list<Entry> entries_;
};

}  // namespace awan
