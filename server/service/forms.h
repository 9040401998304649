// Bodies of forms, as HTML pages and `curl -F` send them.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace awan {

struct FormPart {
    std::string name;
    // Of a file; "" when none is given.
    std::string file_name, content_type;
    std::string value;
};

// Of at most kMostParts fields.
inline constexpr std::size_t kMostFormParts = 64;

// application/x-www-form-urlencoded.
Result<std::vector<FormPart>> read_urlencoded(std::string_view body);

// multipart/form-data (RFC 7578). content_type: the header, which names the boundary.
Result<std::vector<FormPart>> read_multipart(std::string_view content_type, std::string_view body);

// The query of a URL, "?width=64&rung=truth"; "" for none.
std::string query_text(const std::vector<std::pair<std::string, std::string>>& query);

}  // namespace awan
