// Answers made smaller on the way, where the client asks for it.
#pragma once

#include <string>
#include <string_view>

#include "server/service/service.h"

namespace awan {

// Compresses the body (or the pieces of it that follow) with gzip when the request's Accept-Encoding takes that, and
// the answer is text or numbers of some length. The ETag says so: "abc" becomes "abc-gzip"; none_match_names() takes
// both for the same.
void compress(const Request& request, Response& response);

// What is packed once and sent often: as small as gzip can. "" where that is no smaller, or memory is short.
std::string packed_whole(std::string_view text);
// The same as compress(), with the body as packed_whole() made it.
void send_packed(const Request& request, std::string_view packed, Response& response);

}  // namespace awan
