// What billboards are painted with: pictures of matter, by name. Some are Awan's own (core/generate/own_textures.h),
// the others come beside the document: uploaded, or as files of the command line. A document names them, never a path.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace awan {

struct Cloud;
struct Cube;
struct SceneDraft;

// Points along a texture's side. A billboard is a few hundred pixels at most, and its edge is soft.
inline constexpr int kTextureSide = 128;

// A picture's luminance, whatever its alpha: 65535 white, row by row from the top left. `across` and `down` are at most
// kHeightMapSide, in the picture's proportions.
struct HeightMap {
    int across = 0, down = 0;
    std::vector<std::uint16_t> heights;
    // 32 hex digits of all that.
    std::string hash;
};
inline constexpr int kHeightMapSide = 512;

// 32 hex digits, of a height map's numbers.
std::string height_map_hash(const HeightMap& map);

// A picture of a puff of matter.
struct Texture {
    std::string name;
    // 32 hex digits of what it holds (XXH3-128 of `depth`, and of `color` behind it): another name for it, the same for
    // the same picture.
    std::string hash;
    // How deep the matter is behind each point of its square, 255 the deepest; kTextureSide^2, row by row from the top
    // left. Not 0 everywhere.
    std::vector<std::uint8_t> depth;
    // It has an up and a down: billboards turn it a little, others all round.
    bool upright = false;
    // The same picture as a height map; of pictures that came beside a document.
    HeightMap heights{};
    // The hue of the matter at each point, r, g, b as a picture file has them (sRGB), the largest of the three 255: how
    // bright the picture is counts as depth, or not at all. EMPTY: it is grey.
    std::vector<std::uint8_t> color{};
};
using GivenTextures = std::vector<std::shared_ptr<const Texture>>;

// 32 hex digits, of a texture's `depth` and `color`.
std::string texture_hash(const std::vector<std::uint8_t>& depth,
                         const std::vector<std::uint8_t>& color = {});

// The names of Awan's own, and what their hashes are.
struct OwnTexture {
    const char* name;
    const char* says;
    const char* hash;
    bool upright;
};
inline constexpr std::array kOwnTextures = {
    OwnTexture{"soft", "a round puff that thins out as a Gaussian does",
               "b08d694aa7de85b60bd51174cb15ba86", false},
    OwnTexture{"puff", "a round puff with a bumpy rim", "1a25bc2dc3f36ebe4b930e2441e1fa41", false},
    OwnTexture{"cauliflower", "lobes upon lobes, with clear edges",
               "7fd16bbbdcd5bb7f93206f3f5e8df107", false},
    OwnTexture{"torn", "ragged, with holes", "b10d7cbd99b508f0192b145340dd846c", false},
    OwnTexture{"wisp", "threads, drawn out sideways", "e57737d3f6fdcd63c19f8df7e8e9a29f", true},
    OwnTexture{"hard", "a puff with a hard edge", "3e9a94f8f295be3e4b185ff3cc862741", false},
};

// Stands for no texture, where a cube is to have none though its cloud has one.
inline constexpr std::string_view kNoTexture = "none";

// Whether a texture may be called so: 1 to 64 letters, digits, '-', '_' and '.', the first a letter or a digit; not
// "none", none of Awan's own names, and not 32 hex digits, which are a hash.
Status check_texture_name(std::string_view name);

// The hash of the texture that `name` (or hash) stands for in this scene; "" where there is none of that name.
std::string_view find_texture(const SceneDraft& scene, std::string_view name);

// The same of what a cube is painted with: its own texture, else the cloud's, else the scene's. "": with none. Null for
// clouds of other models, whose particles all have the cloud's.
std::string_view texture_of(const SceneDraft& scene, const Cloud& cloud, const Cube* cube);

// How many particles a cube has: where it is painted and says so (its `billboards`, else the cloud's, else the
// scene's), that many, else its `particles`.
std::uint64_t particles_of(const SceneDraft& scene, const Cloud& cloud, const Cube& cube);

// The hashes of all textures that the scene is painted with, each once, in the order of clouds and cubes.
std::vector<std::string_view> textures_of(const SceneDraft& scene);

// Whether anything of the scene is painted and is to be drawn so: effect `texture` is not switched off.
bool draws_textures(const SceneDraft& scene);

}  // namespace awan
