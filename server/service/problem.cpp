#include "server/service/problem.h"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "server/document/json.h"
#include "server/document/problem_page.h"
#include "server/limits.h"
#include "server/service/negotiation.h"

namespace awan {
namespace {

constexpr std::string_view kProblemType = "application/problem+json";

// A page that says what is wrong: no scripts, nothing to send.
constexpr std::string_view kProblemPolicy =
    "default-src 'none'; style-src 'self'; img-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

}  // namespace

int status_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::kMalformed:
            return 400;
        case ErrorCode::kInvalidScene:
        case ErrorCode::kUnsupported:
            return 422;
        case ErrorCode::kTooLarge:
            return 413;
        case ErrorCode::kNoRenderer:
        case ErrorCode::kOutOfMemory:
        case ErrorCode::kCancelled:
            return 503;
        case ErrorCode::kOverDeadline:
            return 504;
        case ErrorCode::kIo:
        case ErrorCode::kInternal:
            return 500;
    }
    return 500;
}

int exit_code_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::kMalformed:
        case ErrorCode::kInvalidScene:
        case ErrorCode::kUnsupported:
        case ErrorCode::kTooLarge:
            return 3;
        case ErrorCode::kNoRenderer:
        case ErrorCode::kOutOfMemory:
        case ErrorCode::kCancelled:
        case ErrorCode::kOverDeadline:
        case ErrorCode::kInternal:
            return 4;
        case ErrorCode::kIo:
            return 5;
    }
    return 4;
}

std::string_view status_title(int status) {
    switch (status) {
        case 308:
            return "Permanent Redirect";
        case 400:
            return "Bad Request";
        case 401:
            return "Unauthorized";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 406:
            return "Not Acceptable";
        case 408:
            return "Request Timeout";
        case 409:
            return "Conflict";
        case 410:
            return "Gone";
        case 411:
            return "Length Required";
        case 413:
            return "Content Too Large";
        case 414:
            return "URI Too Long";
        case 415:
            return "Unsupported Media Type";
        case 417:
            return "Expectation Failed";
        case 421:
            return "Misdirected Request";
        case 422:
            return "Unprocessable Content";
        case 429:
            return "Too Many Requests";
        case 431:
            return "Request Header Fields Too Large";
        case 500:
            return "Internal Server Error";
        case 501:
            return "Not Implemented";
        case 503:
            return "Service Unavailable";
        case 504:
            return "Gateway Timeout";
        default:
            return "Error";
    }
}

Response problem(int status, std::string_view detail, std::string_view pointer,
                 std::string_view request_id) {
    Response response;
    response.status = status;
    response.headers = {{"Content-Type", std::string(kProblemType)},
                        {"Cache-Control", "no-store"},
                        {"X-Content-Type-Options", "nosniff"},
                        {"X-Request-Id", std::string(request_id)}};
    response.body = problem_to_json(status, status_title(status), detail, pointer, request_id);
    return response;
}

Response problem(const Error& error, std::string_view request_id) {
    // What went wrong inside is for the log of whoever runs the server, not for its clients.
    if (error.code == ErrorCode::kInternal || error.code == ErrorCode::kIo)
        return problem(500, "something went wrong inside the server", "", request_id);
    return problem(status_of(error.code), error.message, error.pointer, request_id);
}

Response problem_retry(int status, std::string_view detail, int retry_after_seconds,
                       std::string_view request_id) {
    Response response = problem(status, detail, "", request_id);
    response.headers.emplace_back("Retry-After", std::to_string(std::max(1, retry_after_seconds)));
    return response;
}

void show_problem(std::string_view accept, Response& response) {
    constexpr std::array<std::string_view, 3> kOffers = {kProblemType, "application/json",
                                                         "text/html"};
    if (response.header("Content-Type") != kProblemType) return;
    if (best_offer(accept, kOffers) != "text/html") return;
    response.body = problem_page(response.body);
    for (auto& [name, value] : response.headers)
        if (name == "Content-Type") value = "text/html; charset=utf-8";
    response.headers.emplace_back("Content-Security-Policy", kProblemPolicy);
    response.headers.emplace_back("Referrer-Policy", "no-referrer");
    response.headers.emplace_back("Vary", "Accept");
}

int seconds_from_ms(double ms) {
    return static_cast<int>(std::clamp(std::ceil(ms / 1000), 1.0, 600.0));
}

std::string request_id_from(std::string_view client_id) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '.' || c == '_' || c == '-';
    };
    if (!client_id.empty() && client_id.size() <= limits::kMaxRequestIdBytes &&
        std::all_of(client_id.begin(), client_id.end(), allowed))
        return std::string(client_id);

    unsigned char bytes[8];
    if (getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes)) {
        const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
        for (std::size_t i = 0; i < sizeof bytes; ++i)
            bytes[i] = static_cast<unsigned char>(now >> (8 * i));
    }
    std::string id;
    for (const unsigned char byte : bytes) {
        id += "0123456789abcdef"[byte >> 4];
        id += "0123456789abcdef"[byte & 15];
    }
    return id;
}

}  // namespace awan
