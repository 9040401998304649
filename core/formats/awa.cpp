#include "core/formats/awa.h"

#include <algorithm>
#include <vector>

#include "core/formats/awn.h"
#include "core/formats/numbers.h"
#include "core/formats/quote.h"

namespace awan {
namespace {

constexpr std::string_view kMagic = "awa";
constexpr std::string_view kVersion = "1";

bool is_separator(char c) {
    return c == ',' || is_blank(c);
}

// The words of a line, whatever is between them.
std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t i = 0; i < line.size();) {
        std::size_t end = i;
        while (end < line.size() && !is_separator(line[end])) ++end;
        if (end > i) words.push_back(line.substr(i, end - i));
        i = end + (end < line.size() ? 1 : 0);
    }
    return words;
}

bool could_be_texture(std::string_view word) {
    return word.size() <= limits::kMaxTextureName &&
           std::all_of(word.begin(), word.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '-' || c == '_' || c == '.';
           });
}

Status check_first(std::string_view line, std::size_t number) {
    const auto words = words_of(line);
    if (words.size() != 2 || words[0] != kMagic)
        return at_line(number,
                       "must be \"awa 1\", the format and its version, not " + short_quote(line));
    if (words[1] == kVersion) return std::nullopt;
    return at_line(number,
                   "says version " + short_quote(words[1]) + " of the format; only 1 is read");
}

}  // namespace

bool is_awa(std::string_view text) {
    text = trim(without_byte_order_mark(text));
    return text.size() > kMagic.size() && text.starts_with(kMagic) && is_blank(text[kMagic.size()]);
}

// What is left of it without the first line and the textures is an .awn layout, line by line.
Result<SceneDraft> read_awa(std::string_view text) {
    text = without_byte_order_mark(text);
    std::string layout;
    std::vector<std::string> textures;
    std::size_t number = 0, filled = 0;
    while (!text.empty()) {
        std::string_view line = trim(take_line(text));
        ++number;
        if (!line.empty()) ++filled;
        if (!line.empty() && filled == 1) {
            if (Status wrong = check_first(line, number)) return *wrong;
            line = {};
        } else if (filled > 3 && !line.empty()) {
            const auto words = words_of(line);
            if (words.size() != 9)
                return at_line(number,
                               "must hold 8 numbers (billboards, 3 lengths, 3 of the centre, max "
                               "radius) and the name of a texture, not " +
                                   std::to_string(words.size()) + " words");
            if (!could_be_texture(words.back()))
                return at_line(number, "texture must be a name, a hash or none, not " +
                                           short_quote(words.back()));
            textures.emplace_back(words.back());
            line = line.substr(0, static_cast<std::size_t>(words.back().data() - line.data()));
            // With its separator, which may be a comma.
            line = trim(line);
            if (line.ends_with(',')) line.remove_suffix(1);
        }
        layout.append(line) += '\n';
    }
    if (filled == 0) return at_line(1, "must be \"awa 1\"; the layout is empty");
    if (filled == 1) return at_line(number + 1, "must be the total of billboards; the layout ends");
    auto draft = read_awn(layout);
    if (!draft) return draft;
    std::vector<Cube>& cubes = draft->clouds.front().cubes;
    for (std::size_t i = 0; i < cubes.size(); ++i)
        if (textures[i] != kNoTexture) cubes[i].texture = std::move(textures[i]);
    return draft;
}

Result<std::string> write_awa(const SceneDraft& scene) {
    SceneDraft plain = scene;
    plain.texture.reset();
    plain.billboards.reset();
    std::vector<std::string> textures;
    for (std::size_t k = 0; k < plain.clouds.size(); ++k) {
        const Cloud& cloud = scene.clouds[k];
        plain.clouds[k].texture.reset();
        plain.clouds[k].billboards.reset();
        for (std::size_t i = 0; i < cloud.cubes.size(); ++i) {
            const Cube& cube = cloud.cubes[i];
            Cube& own = plain.clouds[k].cubes[i];
            own.particles = particles_of(scene, cloud, cube);
            own.texture.reset();
            own.billboards.reset();
            const auto& name = cube.texture    ? cube.texture
                               : cloud.texture ? cloud.texture
                                               : scene.texture;
            textures.push_back(name.value_or(std::string(kNoTexture)));
        }
    }
    const auto layout = write_awn(plain);
    if (!layout) return layout;
    std::string out = std::string(kMagic) + ' ' + std::string(kVersion) + '\n';
    std::string_view rest = *layout;
    for (std::size_t number = 0; !rest.empty(); ++number) {
        out += take_line(rest);
        if (number >= 2) out += ", " + textures[number - 2];
        out += '\n';
    }
    return out;
}

}  // namespace awan
