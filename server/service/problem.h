// Errors as answers: RFC 9457 problem documents, the same from every room of the server.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "server/service/service.h"

namespace awan {

// The HTTP status of an error; kCancelled has none of its own (nobody reads it) and gets 503.
int status_of(ErrorCode code);

// The exit code of an error on the command line: 3 the scene, 4 could not render, 5 reading or
// writing.
int exit_code_of(ErrorCode code);

// A short title of a status, e.g. "Not Found"; also of 413, 421, 431.
std::string_view status_title(int status);

// An error as a problem document. pointer: "" where none belongs to it.
Response problem(int status, std::string_view detail, std::string_view pointer,
                 std::string_view request_id);
Response problem(const Error& error, std::string_view request_id);

// A problem with the header Retry-After, for 429 and 503.
Response problem_retry(int status, std::string_view detail, int retry_after_seconds,
                       std::string_view request_id);

// Makes a problem document a page of HTML, for a client whose Accept says that it would rather see one: a browser that
// sent a form, or was led to a path that is not there. `accept`: the header, its fields joined.
void show_problem(std::string_view accept, Response& response);

// Milliseconds as Retry-After has them: whole seconds, 1 to 600.
int seconds_from_ms(double ms);

// The status in metrics and log of an answer whose client had gone before it, as nginx has it.
inline constexpr int kClientGone = 499;

// The client's id when it is 1..128 of [A-Za-z0-9._-], else a new one of 16 hex digits.
std::string request_id_from(std::string_view client_id);

}  // namespace awan
