// Heads and forms from bytes.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "server/http/access.h"
#include "server/http/framing.h"
#include "server/service/forms.h"
#include "tests/fuzz/targets.h"

namespace awan::fuzz {

void fuzz_form(std::string_view bytes) {
    const std::size_t line = std::min(bytes.find('\n'), bytes.size());
    const std::string_view body = bytes.substr(std::min(line + 1, bytes.size()));
    const auto parts = read_multipart(bytes.substr(0, line), body);
    if (parts) {
        require(parts->size() <= kMostFormParts, "a form has as many parts as are allowed");
        std::size_t all = 0;
        for (const FormPart& part : *parts) all += part.value.size();
        require(all <= body.size(), "a form's parts are not more than its body");
    }
    const auto fields = read_urlencoded(body);
    if (!fields) return;
    std::vector<std::pair<std::string, std::string>> query;
    for (const FormPart& field : *fields) query.emplace_back(field.name, field.value);
    const auto again = read_urlencoded(std::string_view(query_text(query)).substr(!query.empty()));
    require(again.ok() && again->size() == query.size(), "a query that was written can be read");
    for (std::size_t i = 0; i < query.size(); ++i)
        require((*again)[i].name == query[i].first && (*again)[i].value == query[i].second,
                "a query that was written is the same");
}

void fuzz_head(std::string_view bytes) {
    std::size_t scanned = 0;
    const HeadEnd whole = find_head_end(bytes, scanned);
    // Byte by byte, as a slow client sends it: the same end, or the same refusal.
    std::size_t slowly = 0;
    HeadEnd pieces;
    for (std::size_t n = 1; n <= bytes.size() && !pieces.bytes && !pieces.error; ++n)
        pieces = find_head_end(bytes.substr(0, n), slowly);
    require(pieces.bytes == whole.bytes, "a head ends where it ends, in pieces or not");
    require(pieces.error.has_value() == whole.error.has_value() &&
                (!whole.error || whole.error->status == pieces.error->status),
            "a head is refused in pieces or not");
    if (!whole.bytes) return;
    const ParsedHead parsed = parse_head(bytes.substr(0, *whole.bytes));
    if (parsed.error) {
        require(parsed.error->status >= 400 && parsed.error->status < 600, "a refusal is one");
        return;
    }
    const RequestHead& head = parsed.head;
    require(head.target == "*" || head.target.front() == '/', "a target is a path");
    std::string text = head.method + " " + head.target + " HTTP/1." + (head.http10 ? "0" : "1");
    for (const auto& [name, value] : head.headers) text += "\r\n" + name + ": " + value;
    text += "\r\n\r\n";
    std::size_t again = 0;
    const HeadEnd end = find_head_end(text, again);
    require(end.bytes == text.size(), "what was read of a head is a head");
    const ParsedHead twice = parse_head(text);
    require(!twice.error && twice.head.content_length == head.content_length &&
                twice.head.keep_alive == head.keep_alive && twice.head.target == head.target,
            "what was read of a head is read the same again");
    static_cast<void>(check_access(head, {}));
}

}  // namespace awan::fuzz
