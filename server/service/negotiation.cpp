#include "server/service/negotiation.h"

#include <algorithm>
#include <cstdint>

#include "server/document/media_types.h"
#include "server/header_text.h"

namespace awan {
namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

// Cuts the text before the next `separator` off `rest`, trimmed. Quoted strings are kept whole.
std::string_view next_part(std::string_view& rest, char separator) {
    bool quoted = false;
    std::size_t i = 0;
    for (; i < rest.size(); ++i) {
        if (quoted && rest[i] == '\\') {
            ++i;
        } else if (rest[i] == '"') {
            quoted = !quoted;
        } else if (rest[i] == separator && !quoted) {
            break;
        }
    }
    i = std::min(i, rest.size());
    const std::string_view part = rest.substr(0, i);
    rest.remove_prefix(std::min(i + 1, rest.size()));
    return without_blanks(part);
}

// "0.75" -> 750; anything that is no quality counts as 0, so that a broken range selects nothing.
int quality_of(std::string_view text) {
    if (text.empty() || (text[0] != '0' && text[0] != '1')) return 0;
    int value = (text[0] - '0') * 1000;
    if (text.size() > 1 && text[1] != '.') return 0;
    int scale = 100;
    for (const char c : text.substr(std::min<std::size_t>(2, text.size()))) {
        if (c < '0' || c > '9' || scale == 0) return 0;
        value += (c - '0') * scale;
        scale /= 10;
    }
    return std::min(value, 1000);
}

// Quality of `offer`: that of the most specific range that covers it.
int quality(std::string_view accept, std::string_view offer) {
    const std::string_view type = offer.substr(0, offer.find('/'));
    int best_specificity = -1;
    int best_quality = 0;
    while (!accept.empty()) {
        std::string_view parameters = next_part(accept, ',');
        const std::string range = lower(next_part(parameters, ';'));
        int specificity = -1;
        if (usual_media_type(range) == offer) {
            specificity = 2;
        } else if (range == std::string(type) + "/*") {
            specificity = 1;
        } else if (range == "*/*" || range == "*") {
            specificity = 0;
        }
        if (specificity < 0) continue;
        int q = 1000;
        while (!parameters.empty()) {
            const std::string parameter = lower(next_part(parameters, ';'));
            if (parameter.starts_with("q=")) q = quality_of(parameter.substr(2));
        }
        if (specificity > best_specificity ||
            (specificity == best_specificity && q > best_quality)) {
            best_specificity = specificity;
            best_quality = q;
        }
    }
    return best_quality;
}

}  // namespace

std::string media_type(std::string_view content_type) {
    std::string_view rest = content_type;
    std::string type = lower(next_part(rest, ';'));
    while (!rest.empty()) {
        std::string parameter = lower(next_part(rest, ';'));
        std::erase(parameter, '"');
        if (parameter.starts_with("charset=") && parameter != "charset=utf-8" &&
            parameter != "charset=utf8" && parameter != "charset=us-ascii")
            return {};
    }
    return type;
}

std::optional<std::string_view> best_offer(std::string_view accept,
                                           std::span<const std::string_view> offers) {
    if (without_blanks(accept).empty())
        return offers.empty() ? std::nullopt : std::optional(offers.front());
    std::optional<std::string_view> best;
    int best_quality = 0;
    for (const std::string_view offer : offers) {
        const int q = quality(accept, offer);
        if (q > best_quality) {
            best_quality = q;
            best = offer;
        }
    }
    return best;
}

bool takes_gzip(std::string_view accept_encoding) {
    int of_gzip = -1, of_any = 0;
    while (!accept_encoding.empty()) {
        std::string_view parameters = next_part(accept_encoding, ',');
        const std::string coding = lower(next_part(parameters, ';'));
        int q = 1000;
        while (!parameters.empty()) {
            const std::string parameter = lower(next_part(parameters, ';'));
            if (parameter.starts_with("q=")) q = quality_of(parameter.substr(2));
        }
        if (coding == "gzip" || coding == "x-gzip") of_gzip = q;
        if (coding == "*") of_any = q;
    }
    return (of_gzip >= 0 ? of_gzip : of_any) > 0;
}

bool none_match_names(std::string_view if_none_match, std::string_view etag) {
    constexpr std::string_view kPacked = "-gzip\"";
    const std::string_view plain =
        etag.substr(0, etag.size() - std::min<std::size_t>(etag.size(), 1));
    while (!if_none_match.empty()) {
        std::string_view tag = next_part(if_none_match, ',');
        if (tag == "*") return true;
        if (tag.starts_with("W/")) tag.remove_prefix(2);
        if (tag == etag) return true;
        if (tag.ends_with(kPacked) && tag.substr(0, tag.size() - kPacked.size()) == plain)
            return true;
    }
    return false;
}

std::string make_etag(std::initializer_list<std::string_view> parts) {
    // FNV-1a, twice with different starts. The parts that matter come as fingerprints already; this
    // only folds them and a few short names into one tag.
    std::uint64_t hashes[2] = {0xcbf29ce484222325u, 0x9e3779b97f4a7c15u};
    for (std::uint64_t& hash : hashes) {
        for (const std::string_view part : parts) {
            for (const char c : part) {
                hash ^= static_cast<unsigned char>(c);
                hash *= 0x100000001b3u;
            }
            // Parts do not run into one another.
            hash ^= 0xff;
            hash *= 0x100000001b3u;
        }
    }
    std::string tag = "\"";
    for (const std::uint64_t hash : hashes)
        for (int shift = 60; shift >= 0; shift -= 4)
            tag += "0123456789abcdef"[(hash >> shift) & 15];
    return tag + '"';
}

}  // namespace awan
