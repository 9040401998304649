// Answers to renders that are kept for those who ask for the same again, by entity tag: that names the scene in its
// canonical form, the engine's version, the renderer and the format.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/byte_cache.h"

namespace awan {

struct KeptResult {
    std::vector<std::pair<std::string, std::string>> headers;
    // Not null.
    std::shared_ptr<const std::string> body;

    // What it takes beside its key.
    std::size_t bytes() const {
        std::size_t sum = sizeof(KeptResult) + body->size();
        for (const auto& [name, value] : headers)
            sum += sizeof headers[0] + name.size() + value.size();
        return sum;
    }
};

using ResultCache = ByteCache<KeptResult>;

}  // namespace awan
