// Where the cells of automata are in the picture, in their order from the eye, and the blending of them.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "core/draw/backdrop.h"
#include "core/generate/automaton/cells.h"
#include "core/generate/keyed_random.h"
#include "core/generate/motion.h"
#include "core/generate/own_textures.h"
#include "core/light/ground_light.h"
#include "core/looks/gardner.h"
#include "core/looks/looks.h"
#include "core/looks/upchurch.h"

namespace awan {
namespace upchurch {
namespace {

using automaton::Cell;

// The side of a tile, pixels.
constexpr int kTile = 32;
// A pixel is done where less than this share of the light from behind is left.
constexpr float kUnseen = 4e-3F;
// Textures that are made by rule, and their side.
constexpr std::size_t kGenerated = 4;
constexpr int kGeneratedSide = 64;
// Cells of a piece of work.
constexpr std::size_t kCells = 1 << 14;

// The picture's rays: of pixel (x, y) towards (left + x step, top - y step, 1) in the eye's frame.
struct Lens {
    Lens(const View& view, const Image& image)
        : step(2 * view.tan_half_fov / image.height),
          left(view.tan_half_fov * view.aspect * (1.0 / image.width - 1)),
          top(view.tan_half_fov * (1 - 1.0 / image.height)) {}
    double step, left, top;
};

// A cell as the picture sees it.
struct Square {
    // Of a billboard: its place, and its axes over its side.
    glm::vec3 q, right, up;
    float whiteness, opacity;
    // The pixels that it may reach: from..to, to excluded. Of a point exactly, in parts of pixels.
    float x0, y0, x1, y1;
    float depth;
    // Of a billboard: which texture, and which of its levels. -1: a point.
    std::int16_t texture, level;
};

// What all pieces of one cloud share.
struct Drawn {
    const AutomatonCloud& cloud;
    Motion motion;
    const View& view;
    Lens lens;
    std::size_t first_texture, textures;
    const std::vector<Painted>& painted;
    // Cells below are hidden by a ground.
    double lowest;
};

bool place_point(const Lens& lens, const glm::dvec3& q, double side, Square& square) {
    // No smaller than a pixel, as points are in any renderer.
    const double half = std::max(0.5 * side / (q.z * lens.step), 0.5);
    const double x = (q.x / q.z - lens.left) / lens.step + 0.5;
    const double y = (lens.top - q.y / q.z) / lens.step + 0.5;
    square.x0 = static_cast<float>(x - half), square.x1 = static_cast<float>(x + half);
    square.y0 = static_cast<float>(y - half), square.y1 = static_cast<float>(y + half);
    square.texture = -1;
    return true;
}

bool place_billboard(const Lens& lens, const glm::dvec3& q, double side, Square& square) {
    const Axes axes = axes_of(q);
    double x0 = 1e30, y0 = 1e30, x1 = -1e30, y1 = -1e30;
    for (const double a : {-0.5, 0.5})
        for (const double b : {-0.5, 0.5}) {
            const glm::dvec3 corner = q + side * (a * axes.right + b * axes.up);
            // One that reaches behind the eye is a veil over everything; as billboards go it is left out.
            if (!(corner.z > 1e-3 * side)) return false;
            const double x = (corner.x / corner.z - lens.left) / lens.step;
            const double y = (lens.top - corner.y / corner.z) / lens.step;
            x0 = std::min(x0, x), x1 = std::max(x1, x);
            y0 = std::min(y0, y), y1 = std::max(y1, y);
        }
    square.q = glm::vec3(q);
    square.right = glm::vec3(axes.right / side), square.up = glm::vec3(axes.up / side);
    square.x0 = static_cast<float>(std::floor(x0)),
    square.x1 = static_cast<float>(std::ceil(x1) + 1);
    square.y0 = static_cast<float>(std::floor(y0)),
    square.y1 = static_cast<float>(std::ceil(y1) + 1);
    return true;
}

// False where it does not show.
bool place(const Drawn& drawn, const Cell& cell, const Image& image, Square& square) {
    const AutomatonDrawing& drawing = drawn.cloud.drawing;
    if (drawing.mode == AutomatonMode::kPresence && !cell.cloud) return false;
    const CellStyle style = style_of(drawing, static_cast<double>(cell.density));
    if (!(style.opacity > 1e-3) || !(style.side > 0)) return false;
    const glm::dvec3 corner(drawn.cloud.cells.x / 2, 0, drawn.cloud.cells.z / 2);
    const glm::dvec3 at(cell.i + 0.5, cell.j + 0.5, cell.k + 0.5);
    const glm::dvec3 p = drawn.motion(drawn.cloud.cell * (at - corner));
    if (p.y < drawn.lowest) return false;
    const View& view = drawn.view;
    const glm::dvec3 d = p - view.eye;
    const glm::dvec3 q(glm::dot(d, view.right), glm::dot(d, view.up), glm::dot(d, view.forward));
    const double side = style.side * drawn.cloud.cell * drawn.motion.scale;
    if (!(q.z > 0)) return false;
    const bool point =
        drawing.mode == AutomatonMode::kDensity || drawing.mode == AutomatonMode::kPresence;
    if (!(point ? place_point : place_billboard)(drawn.lens, q, side, square)) return false;
    if (square.x1 <= 0 || square.y1 <= 0 || square.x0 >= static_cast<float>(image.width) ||
        square.y0 >= static_cast<float>(image.height))
        return false;
    square.whiteness = static_cast<float>(style.whiteness);
    square.opacity = static_cast<float>(style.opacity);
    square.depth = static_cast<float>(glm::length(q));
    if (!point) {
        const std::size_t texture =
            drawn.first_texture + texture_of_cell(cell.i, cell.j, cell.k, drawn.textures);
        const Painted& painted = drawn.painted[texture];
        const double pixels = side / (square.depth * drawn.lens.step);
        int level = 0;
        const auto last = static_cast<int>(painted.levels.size()) - 1;
        while (level < last && (painted.side >> (level + 1)) >= pixels) ++level;
        square.texture = static_cast<std::int16_t>(texture);
        square.level = static_cast<std::int16_t>(level);
    }
    return true;
}

// From the eye outward; of those as far, in the order of the cells. Sorted by digits of eleven bits: the bits of floats
// above 0 are in the order of their values.
std::vector<std::uint32_t> front_to_back(const std::vector<Square>& squares) {
    constexpr unsigned kDigit = 11;
    struct Entry {
        std::uint32_t bits, square;
    };
    std::vector<Entry> entries(squares.size()), sorted(squares.size());
    for (std::size_t i = 0; i < squares.size(); ++i)
        entries[i] = {std::bit_cast<std::uint32_t>(squares[i].depth),
                      static_cast<std::uint32_t>(i)};
    for (unsigned shift = 0; shift < 32; shift += kDigit) {
        std::array<std::size_t, (1u << kDigit) + 1> begin{};
        const auto digit = [&](const Entry& one) {
            return one.bits >> shift & ((1u << kDigit) - 1);
        };
        for (const Entry& one : entries) ++begin[digit(one) + 1];
        for (std::size_t d = 1; d < begin.size(); ++d) begin[d] += begin[d - 1];
        for (const Entry& one : entries) sorted[begin[digit(one)]++] = one;
        std::swap(entries, sorted);
    }
    std::vector<std::uint32_t> order;
    order.reserve(entries.size());
    for (const Entry& one : entries) order.push_back(one.square);
    return order;
}

// A tile's pixels, whose sums are scalars: everything is a shade of one white.
struct Tile {
    int x0, y0, x1, y1;
    std::array<float, kTile * kTile> white{}, through{};

    float* at(std::array<float, kTile * kTile>& of, int y) const {
        return of.data() + static_cast<std::size_t>((y - y0) * kTile);
    }
};

void blend(float alpha, float whiteness, float& white, float& through) {
    white += through * alpha * whiteness;
    through *= 1 - alpha;
}

void draw_point(const Square& s, Tile& tile) {
    const int left = std::max(tile.x0, static_cast<int>(std::floor(s.x0)));
    const int right = std::min(tile.x1, static_cast<int>(std::ceil(s.x1)));
    const int top = std::max(tile.y0, static_cast<int>(std::floor(s.y0)));
    const int bottom = std::min(tile.y1, static_cast<int>(std::ceil(s.y1)));
    for (int y = top; y < bottom; ++y) {
        const auto row = static_cast<float>(y);
        const float high = std::min(s.y1, row + 1) - std::max(s.y0, row);
        for (int x = left; x < right; ++x) {
            const auto column = static_cast<float>(x);
            // The share of the pixel that it covers.
            const float cover = high * (std::min(s.x1, column + 1) - std::max(s.x0, column));
            const auto n = static_cast<std::size_t>(x - tile.x0);
            blend(s.opacity * cover, s.whiteness, tile.at(tile.white, y)[n],
                  tile.at(tile.through, y)[n]);
        }
    }
}

// Where a pixel's ray meets the billboard's plane, at t d with t = q.q / q.d, it is t (d.right), t (d.up) from its
// middle, as both axes are at right angles to q.
void draw_billboard(const Square& s, const Lens& lens, const Painted& texture, Tile& tile) {
    const int left = std::max(tile.x0, static_cast<int>(s.x0));
    const int right = std::min(tile.x1, static_cast<int>(s.x1));
    const int top = std::max(tile.y0, static_cast<int>(s.y0));
    const int bottom = std::min(tile.y1, static_cast<int>(s.y1));
    const float square = glm::dot(s.q, s.q);
    for (int y = top; y < bottom; ++y) {
        const auto v = static_cast<float>(lens.top - y * lens.step);
        float* const white = tile.at(tile.white, y);
        float* const through = tile.at(tile.through, y);
        for (int x = left; x < right; ++x) {
            const auto n = static_cast<std::size_t>(x - tile.x0);
            if (through[n] < kUnseen) continue;
            const auto u = static_cast<float>(lens.left + x * lens.step);
            const glm::vec3 d(u, v, 1);
            const float t = square / glm::dot(s.q, d);
            const float a = t * glm::dot(s.right, d), b = t * glm::dot(s.up, d);
            const float alpha = s.opacity * sample(texture, s.level, 0.5F + a, 0.5F - b);
            blend(alpha, s.whiteness, white[n], through[n]);
        }
    }
}

void draw_tile(const std::vector<Square>& squares, const std::vector<std::uint32_t>& order,
               const Lens& lens, const std::vector<Painted>& textures, Tile& tile) {
    tile.through.fill(1);
    std::size_t count = 0;
    for (const std::uint32_t n : order) {
        const Square& s = squares[n];
        if (s.texture < 0)
            draw_point(s, tile);
        else
            draw_billboard(s, lens, textures[static_cast<std::size_t>(s.texture)], tile);
        // Whether anything behind would show is asked now and then.
        constexpr std::size_t kBetween = 256;
        if (++count % kBetween == 0 && std::all_of(tile.through.begin(), tile.through.end(),
                                                   [](float through) { return through < kUnseen; }))
            return;
    }
}

// The textures of a cloud; made by rule, or named.
void add_textures(const Scene& scene, const AutomatonCloud& cloud, std::uint64_t key, int threads,
                  std::vector<Painted>& all) {
    const std::size_t first = all.size();
    const AutomatonDrawing& drawing = cloud.drawing;
    if (drawing.mode == AutomatonMode::kGenerated) {
        all.resize(first + kGenerated);
        parallel_for(threads, kGenerated, [&](std::size_t n) {
            all[first + n] = painted(generated_puff(keyed(key, n), kGeneratedSide));
        });
    }
    if (drawing.mode != AutomatonMode::kTextures) return;
    const auto names = names_in(drawing.textures);
    all.resize(first + names.size());
    parallel_for(threads, names.size(), [&](std::size_t n) {
        const auto texture = texture_of_hash(*scene, find_texture(*scene, names[n]));
        std::vector<float> texels;
        for (const std::uint8_t one : texture->depth)
            texels.push_back(static_cast<float>(one) / 255.0F);
        all[first + n] = painted(std::move(texels));
    });
}

// Squares of all automata of the scene.
Result<std::vector<Square>> squares_of(const Scene& scene, const View& view, const Image& image,
                                       int threads, const Deadline& deadline,
                                       std::vector<Painted>& textures) {
    std::vector<Square> all;
    for (std::size_t c = 0; c < scene->clouds.size(); ++c) {
        const Cloud& own = scene->clouds[c];
        const AutomatonCloud& cloud = *own.automaton;
        ModelRequest request;
        request.key = keyed(seed_of(*scene, own), c);
        request.time = clouds_time(*scene);
        request.threads = threads;
        const auto cells = automaton::cells_of(cloud, request, cloud.drawing.hold, deadline);
        if (!cells.ok()) return cells.error();
        const std::size_t first = textures.size();
        add_textures(scene, cloud, request.key, threads, textures);
        const bool ground = scene->ground && view.eye.y > scene->ground->height;
        const Drawn drawn{cloud,    motion_of(own, clouds_time(*scene)),
                          view,     Lens(view, image),
                          first,    textures.size() - first,
                          textures, ground ? scene->ground->height : -1e300};
        std::vector<std::vector<Square>> pieces((cells->size() + kCells - 1) / kCells);
        parallel_for(threads, pieces.size(), [&](std::size_t n) {
            const std::size_t last = std::min((n + 1) * kCells, cells->size());
            Square square{};
            for (std::size_t i = n * kCells; i < last; ++i)
                if (place(drawn, (*cells)[i], image, square)) pieces[n].push_back(square);
        });
        for (const auto& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
        if (auto late = deadline.over()) return *late;
    }
    return all;
}

// For each tile the squares that reach it, in their order.
std::vector<std::vector<std::uint32_t>> lists_of(const std::vector<Square>& squares,
                                                 const std::vector<std::uint32_t>& order,
                                                 int across, int down) {
    std::vector<std::vector<std::uint32_t>> lists(static_cast<std::size_t>(across) *
                                                  static_cast<std::size_t>(down));
    const auto tile_of = [](float pixel, int last) {
        return std::clamp(static_cast<int>(pixel) / kTile, 0, last);
    };
    for (const std::uint32_t n : order) {
        const Square& s = squares[n];
        for (int y = tile_of(std::max(s.y0, 0.0F), down - 1); y <= tile_of(s.y1, down - 1); ++y)
            for (int x = tile_of(std::max(s.x0, 0.0F), across - 1); x <= tile_of(s.x1, across - 1);
                 ++x)
                lists[static_cast<std::size_t>(y * across + x)].push_back(n);
    }
    return lists;
}

Result<Image> draw(const Scene& scene, const View& view, int threads, const Deadline& deadline) {
    Image image{scene->image.width, scene->image.height, false, {}};
    image.pixels.resize(4 * image.pixel_count());
    std::vector<Painted> textures;
    const auto squares = squares_of(scene, view, image, threads, deadline, textures);
    if (!squares.ok()) return squares.error();
    const Lens lens(view, image);
    const glm::vec3 white(gardner::whites_of(scene).sunlit);
    const int across = (image.width + kTile - 1) / kTile, down = (image.height + kTile - 1) / kTile;
    const auto lists = lists_of(*squares, front_to_back(*squares), across, down);
    std::atomic<bool> late = false;
    parallel_for(threads, lists.size(), [&](std::size_t n) {
        if (late || deadline.over()) {
            late = true;
            return;
        }
        const int x0 = static_cast<int>(n) % across * kTile,
                  y0 = static_cast<int>(n) / across * kTile;
        Tile tile{x0, y0, std::min(x0 + kTile, image.width), std::min(y0 + kTile, image.height)};
        draw_tile(*squares, lists[n], lens, textures, tile);
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) {
                const auto i = static_cast<std::size_t>(x - tile.x0);
                float* const pixel =
                    image.pixels.data() +
                    4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x));
                for (int c = 0; c < 3; ++c) pixel[c] = white[c] * tile.at(tile.white, y)[i];
                pixel[3] = 1 - tile.at(tile.through, y)[i];
            }
    });
    if (auto error = deadline.over()) return *error;
    if (scene->image.background == Background::kSky)
        lay_under(image, make_backdrop(scene, view, image.width, image.height, bare_ground(*scene),
                                       threads));
    return image;
}

}  // namespace
}  // namespace upchurch

Result<Image> upchurch_look(const Scene& scene, const View& view, int threads,
                            const Deadline& deadline) {
    return upchurch::draw(scene, view, threads, deadline);
}

double upchurch_look_ms(const Scene& scene, const View& view, int threads) {
    // Measured, in nanoseconds: a pixel and its background; a cell of the grid, a third of which has matter; a step of
    // it; a pixel of a billboard, most of which are hidden by nearer ones.
    constexpr double kPixel = 90, kCell = 60, kStep = 1.5, kShade = 2;
    double cells = 0, steps = 0;
    for (const Cloud& cloud : scene->clouds) {
        const double own =
            cloud.automaton->cells.x * cloud.automaton->cells.y * cloud.automaton->cells.z;
        cells += own;
        steps += own * automaton_steps_at(*cloud.automaton, clouds_time(*scene));
    }
    const double pixels =
        static_cast<double>(scene->image.width) * static_cast<double>(scene->image.height);
    (void)view;
    return (pixels * kPixel + cells * (kCell + 20 * kShade) + steps * kStep) * 1e-6 /
           std::max(threads, 1);
}

}  // namespace awan
