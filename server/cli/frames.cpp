#include "server/cli/frames.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace awan {
namespace {

Error bad(std::string message) {
    return {ErrorCode::kInvalidScene, "", std::move(message)};
}

std::optional<std::uint64_t> number(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

// Where in the name the number goes: at %d, at %0Nd with one digit N, or at a run of two or more #, a digit each.
struct Place {
    std::size_t at, length, digits;
};
std::optional<Place> place_in(std::string_view name) {
    const std::size_t marks = name.find("##");
    if (marks != std::string_view::npos) {
        const std::size_t end = std::min(name.find_first_not_of('#', marks), name.size());
        return Place{marks, end - marks, end - marks};
    }
    for (std::size_t at = name.find('%'); at != std::string_view::npos;
         at = name.find('%', at + 1)) {
        const std::string_view rest = name.substr(at + 1);
        if (rest.starts_with('d')) return Place{at, 2, 1};
        if (rest.size() >= 3 && rest[0] == '0' && rest[1] >= '1' && rest[1] <= '9' &&
            rest[2] == 'd')
            return Place{at, 4, static_cast<std::size_t>(rest[1] - '0')};
    }
    return {};
}

// A place as printf and other renderers write it that is none here: "%4d", "%i", "$F4", "@@@@". EMPTY: there is none.
std::string other_place_in(std::string_view name) {
    const auto character = [&](std::size_t at) { return at < name.size() ? name[at] : '\0'; };
    const auto is_letter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
    for (std::size_t at = name.find_first_of("%$@"); at != std::string_view::npos;
         at = name.find_first_of("%$@", at + 1)) {
        std::size_t end = at + 1;
        if (name[at] == '@') {
            while (character(end) == '@') ++end;
            if (end == at + 1) continue;
        } else {
            const auto skip_digits = [&] {
                while (character(end) >= '0' && character(end) <= '9') ++end;
            };
            if (name[at] == '%') skip_digits();
            const char letter = character(end++);
            if (name[at] == '%' ? letter != 'd' && letter != 'i' && letter != 'u' : letter != 'F')
                continue;
            if (name[at] == '$') skip_digits();
            // "100%dry.png" is a word.
            if (is_letter(character(end))) continue;
        }
        return std::string(name.substr(at, end - at));
    }
    return {};
}

Status check_place(const std::string& output) {
    if (place_in(output)) return std::nullopt;
    const std::string other = other_place_in(output);
    if (other.empty()) return std::nullopt;
    return bad("-o " + output + ": " + other +
               " is no place for a frame's number here; write %04d or ####");
}

}  // namespace

Result<std::vector<std::uint64_t>> parse_frames(const std::string& text, std::uint64_t count) {
    std::vector<std::uint64_t> frames;
    if (text.empty() || text == "all") {
        for (std::uint64_t i = 0; i < count; ++i) frames.push_back(i);
        return frames;
    }
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const std::string_view part = rest.substr(0, comma);
        const std::size_t dash = part.find('-');
        const std::size_t cross =
            std::min(part.find('x', std::min(dash, part.size())), part.size());
        const auto first = number(part.substr(0, dash));
        const auto last = dash == std::string_view::npos
                              ? first
                              : number(part.substr(dash + 1, cross - dash - 1));
        const auto step =
            cross == part.size() ? std::optional<std::uint64_t>(1) : number(part.substr(cross + 1));
        if (!first || !last || *first > *last || !step || *step == 0)
            return bad(
                "--frames " + text +
                ": must be all, or numbers and ranges with commas, such as 3, 0-11,20 or 0-99x10");
        if (*last >= count)
            return bad("--frames " + text + ": the sequence has frames 0 to " +
                       std::to_string(count - 1));
        for (std::uint64_t i = *first; i <= *last; i += std::min(*step, *last - i + 1)) {
            if (frames.size() >= count) return bad("--frames " + text + ": some stand there twice");
            frames.push_back(i);
        }
        if (comma == std::string_view::npos) return frames;
        rest = rest.substr(comma + 1);
    }
}

Status check_numbered(const std::string& output, std::size_t frames) {
    if (Status wrong = check_place(output)) return wrong;
    if (frames <= 1 || place_in(output)) return std::nullopt;
    return bad("-o " + output + ": " + std::to_string(frames) +
               " frames need a place for their number, such as cloud.%04d.png or cloud.####.png, "
               "or an animation, "
               ".webp or .apng");
}

Status check_not_numbered(const std::string& output, const std::string& flag) {
    if (!place_in(output) && other_place_in(output).empty()) return std::nullopt;
    return bad(flag + output +
               ": has a place for a frame's number, and there are no frames; render and particles "
               "take --frames");
}

std::string numbered_name(const std::string& output, std::uint64_t frame) {
    const auto place = place_in(output);
    if (!place) return output;
    std::string digits = std::to_string(frame);
    if (digits.size() < place->digits) digits.insert(0, place->digits - digits.size(), '0');
    return output.substr(0, place->at) + digits + output.substr(place->at + place->length);
}

}  // namespace awan
