#include "server/document/problem_page.h"

#include <nlohmann/json.hpp>

namespace awan {
namespace {

using Json = nlohmann::json;

std::string as_text(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else
            out += c;
    }
    return out;
}

std::string row(std::string_view name, const std::string& value) {
    if (value.empty()) return {};
    return "<dt>" + std::string(name) + "</dt><dd>" + as_text(value) + "</dd>\n";
}

}  // namespace

std::string problem_page(std::string_view problem_json) {
    const Json problem = Json::parse(problem_json, nullptr, false);
    const auto word = [&](const char* name) {
        const auto found = problem.is_object() ? problem.find(name) : problem.end();
        return found != problem.end() && found->is_string() ? found->get<std::string>()
                                                            : std::string();
    };
    const std::string status =
        problem.is_object() && problem.contains("status") ? problem["status"].dump() : "";
    const std::string title = as_text(word("title"));
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
           title +
           " - Awan</title>\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<meta name=\"color-scheme\" content=\"light dark\">\n"
           "<link rel=\"icon\" href=\"/icon.svg\" type=\"image/svg+xml\">\n"
           "<link rel=\"stylesheet\" href=\"/plain.css\">\n</head>\n<body>\n<main>\n<h1>" +
           title + "</h1>\n<p>" + as_text(word("detail")) + "</p>\n<dl>\n" +
           row("Place in the document", word("pointer")) + row("Status", status) +
           row("Request", word("request_id")) +
           "</dl>\n<p>Your browser's Back returns to what you wrote; <a href=\"/\">the page</a> "
           "begins anew.</p>\n</main>\n</body>\n</html>\n";
}

}  // namespace awan
