// Answers made smaller on the way, where the client asks for it.
#pragma once

#include "server/service/service.h"

namespace awan {

// Compresses the body (or the pieces of it that follow) with gzip when the request's Accept-Encoding takes that, and
// the answer is text or numbers of some length. The ETag says so: "abc" becomes "abc-gzip"; none_match_names() takes
// both for the same.
void compress(const Request& request, Response& response);

}  // namespace awan
