// What a client sends and what it takes: media types, Accept, entity tags (RFC 9110, 8.3, 12.5.1,
// 13.1.2). Pure functions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace awan {

// The media type of a Content-Type, lower case, when its charset (if any) is UTF-8 or ASCII;
// "" otherwise.
std::string media_type(std::string_view content_type);

// The offer that `accept` likes best: by quality, then by the order of `offers`. An empty `accept`
// takes anything. Nothing when no offer is acceptable.
std::optional<std::string_view> best_offer(std::string_view accept,
                                           std::span<const std::string_view> offers);

// Whether an Accept-Encoding takes gzip.
bool takes_gzip(std::string_view accept_encoding);

// Does If-None-Match name this strong tag (with its quotes), or that of the same answer compressed (compression.h)?
// Weak comparison; lists and "*" too.
bool none_match_names(std::string_view if_none_match, std::string_view etag);

// A strong entity tag, with its quotes, over all parts.
std::string make_etag(std::initializer_list<std::string_view> parts);

}  // namespace awan
