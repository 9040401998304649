#include "core/generate/relief.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/parallel.h"
#include "core/generate/keyed_random.h"
#include "core/generate/own_textures.h"

namespace awan {
namespace {

// Of the half side, over which the hills run out into the level ground.
constexpr double kMargin = 0.25;
constexpr int kMostOctaves = 10;
// Each octave is twice and a bit as fine as the one before, so that no place has lattice points of all of them.
constexpr double kLacunarity = 2.03;
// Snow lies on slopes whose normal's y is above the second, in full above the first.
constexpr double kSnowy = 0.80, kBare = 0.66;
// Between these of a normal's y rock takes over: 40 and 25 degrees.
constexpr double kSteep = 0.766, kGentle = 0.906;
constexpr double kSnowAlbedo = 0.8;
// By how much patches are lighter or darker than the mean.
constexpr double kMottled = 0.22;

double risen(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// Noise of gradients on a lattice of unit squares (Perlin 1985, with the smooth step of Perlin 2002), about -.7 to .7.
double noise_at(std::uint64_t key, double x, double z) {
    const double fx = std::floor(x), fz = std::floor(z);
    const auto ix = static_cast<std::int64_t>(fx), iz = static_cast<std::int64_t>(fz);
    const double u = x - fx, v = z - fz;
    const auto corner = [&](int i, int j) {
        // Eight directions are enough for what is summed over octaves.
        static constexpr double kWays[8][2] = {{1, 0},  {0.7071067811865476, 0.7071067811865476},
                                               {0, 1},  {-0.7071067811865476, 0.7071067811865476},
                                               {-1, 0}, {-0.7071067811865476, -0.7071067811865476},
                                               {0, -1}, {0.7071067811865476, -0.7071067811865476}};
        const auto place = static_cast<std::uint64_t>(ix + i) * 0x9e3779b97f4a7c15U ^
                           static_cast<std::uint64_t>(iz + j) * 0xc2b2ae3d27d4eb4fU;
        const double* const way = kWays[mix_bits(key ^ place) >> 61U];
        return way[0] * (u - i) + way[1] * (v - j);
    };
    const auto ease = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
    const double s = ease(u), t = ease(v);
    const double near = corner(0, 0) + s * (corner(1, 0) - corner(0, 0));
    const double far = corner(0, 1) + s * (corner(1, 1) - corner(0, 1));
    return near + t * (far - near);
}

// Hills of size 1 at x, z; 0 to somewhat above 1.
class Hills {
  public:
    Hills(std::uint64_t seed, double roughness, int octaves)
        : key_(keyed(seed, 0x7e11a1)), gain_(0.34 + 0.28 * roughness), octaves_(octaves) {}

    double at(double x, double z) const {
        // Bent a little, so that ridges do not run along the lattice.
        const double wx = x + 0.35 * noise_at(keyed(key_, 100), 0.9 * x + 3.1, 0.9 * z);
        const double wz = z + 0.35 * noise_at(keyed(key_, 101), 0.9 * x, 0.9 * z + 7.7);
        double sum = 0, weight = 1, amplitude = 1, scale = 1;
        for (int o = 0; o < octaves_; ++o) {
            const double n = noise_at(keyed(key_, static_cast<std::uint64_t>(o)),
                                      wx * scale + 0.37 * o, wz * scale + 0.71 * o);
            // The first octave's ridges are broad, those of others sharp.
            const double ridge = 1 - std::min(std::abs(n) * 1.9, 1.0);
            const double signal = ridge * ridge * weight;
            sum += amplitude * signal;
            weight = std::clamp(2 * signal, 0.0, 1.0);
            amplitude *= gain_;
            scale *= kLacunarity;
        }
        const double massif = risen(0.5 + 1.3 * noise_at(keyed(key_, 102), 0.43 * x, 0.43 * z));
        return sum * (0.25 + 0.75 * massif);
    }

  private:
    std::uint64_t key_;
    double gain_;
    int octaves_;
};

// Share of a height that is left so near to the sides; t from 0 to 1 across the relief.
double kept_near_sides(double t) {
    return risen(2 * std::min(t, 1 - t) / kMargin);
}

// Between the pixels of a height map, by cubic B-splines: smooth over the steps of few bits. 0..1.
double picture_at(const HeightMap& map, double x, double z) {
    const double u = x * map.across - 0.5, v = z * map.down - 0.5;
    const double fu = std::floor(u), fv = std::floor(v);
    const auto weights = [](double t, double(&w)[4]) {
        const double s = 1 - t;
        w[0] = s * s * s / 6;
        w[1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
        w[2] = (4 - 6 * s * s + 3 * s * s * s) / 6;
        w[3] = t * t * t / 6;
    };
    double wu[4], wv[4];
    weights(u - fu, wu);
    weights(v - fv, wv);
    double sum = 0;
    for (int j = 0; j < 4; ++j) {
        const int row = std::clamp(static_cast<int>(fv) - 1 + j, 0, map.down - 1);
        for (int i = 0; i < 4; ++i) {
            const int column = std::clamp(static_cast<int>(fu) - 1 + i, 0, map.across - 1);
            sum +=
                wv[j] * wu[i] *
                map.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.across) +
                            static_cast<std::size_t>(column)];
        }
    }
    return sum / 65535;
}

int cells_of(int pixels, int longer) {
    return std::max(1, static_cast<int>(std::int64_t{kReliefSide} * pixels / longer));
}

// Of hills by seed: as many octaves as its cells show.
int octaves_in(const Terrain& terrain, double cell) {
    double wavelength = terrain.size;
    int octaves = 1;
    while (octaves < kMostOctaves && wavelength > 4 * cell) {
        wavelength /= kLacunarity;
        ++octaves;
    }
    return octaves;
}

// Heights as they come, about 0 to 1.
void fill(const Terrain& terrain, const HeightMap* map, int threads, Relief& relief) {
    const Hills hills(terrain.seed, terrain.roughness, octaves_in(terrain, relief.cell.x));
    const glm::dvec2 middle(terrain.center.x, terrain.center.z);
    const auto row_nodes = static_cast<std::size_t>(relief.cells.x + 1);
    relief.height.resize(row_nodes * static_cast<std::size_t>(relief.cells.y + 1));
    parallel_for(threads, static_cast<std::size_t>(relief.cells.y + 1), [&](std::size_t row) {
        const double v = static_cast<double>(row) / relief.cells.y;
        for (std::size_t i = 0; i < row_nodes; ++i) {
            const double u = static_cast<double>(i) / relief.cells.x;
            const glm::dvec2 off =
                (relief.low + relief.cell * glm::dvec2(i, row) - middle) / terrain.size;
            relief.height[row * row_nodes + i] = static_cast<float>(
                map != nullptr ? picture_at(*map, u, v) : hills.at(off.x, off.y));
        }
    });
}

// From raw heights to those above the level ground.
void settle(const Terrain& terrain, bool by_seed, Relief& relief) {
    const auto row_nodes = static_cast<std::size_t>(relief.cells.x + 1);
    double most = 1;
    if (by_seed) {
        most = static_cast<double>(*std::max_element(relief.height.begin(), relief.height.end()));
        if (!(most > 0)) most = 1;
    }
    const auto settled = [&](std::size_t at) {
        const double kept = kept_near_sides(static_cast<double>(at % row_nodes) / relief.cells.x) *
                            kept_near_sides(static_cast<double>(at / row_nodes) / relief.cells.y);
        const double above =
            (static_cast<double>(relief.height[at]) / most - terrain.level) / (1 - terrain.level);
        return kept * std::max(above, 0.0);
    };
    double highest = 0;
    for (std::size_t at = 0; at < relief.height.size(); ++at) {
        const double share = settled(at);
        highest = std::max(highest, share);
        relief.height[at] = static_cast<float>(share);
    }
    // Margins take tops away: `height` is that of the highest that is left.
    const double scale = by_seed && highest > 0 ? terrain.height / highest : terrain.height;
    relief.highest = 0;
    for (float& one : relief.height) {
        one = static_cast<float>(scale * static_cast<double>(one));
        relief.highest = std::max(relief.highest, static_cast<double>(one));
    }
}

void make_levels(Relief& relief) {
    Relief::Level first{relief.cells, {}};
    first.highest.reserve(static_cast<std::size_t>(relief.cells.x) *
                          static_cast<std::size_t>(relief.cells.y));
    for (int z = 0; z < relief.cells.y; ++z)
        for (int x = 0; x < relief.cells.x; ++x)
            first.highest.push_back(std::max({relief.node(x, z), relief.node(x + 1, z),
                                              relief.node(x, z + 1), relief.node(x + 1, z + 1)}));
    relief.levels.push_back(std::move(first));
    while (relief.levels.back().highest.size() > 1) {
        const Relief::Level& fine = relief.levels.back();
        Relief::Level coarse{(fine.blocks + 1) / 2, {}};
        const auto across = static_cast<std::size_t>(fine.blocks.x);
        for (int z = 0; z < coarse.blocks.y; ++z)
            for (int x = 0; x < coarse.blocks.x; ++x) {
                float most = 0;
                for (int j = 2 * z; j < std::min(2 * z + 2, fine.blocks.y); ++j)
                    for (int i = 2 * x; i < std::min(2 * x + 2, fine.blocks.x); ++i)
                        most = std::max(most, fine.highest[static_cast<std::size_t>(j) * across +
                                                           static_cast<std::size_t>(i)]);
                coarse.highest.push_back(most);
            }
        relief.levels.push_back(std::move(coarse));
    }
}

glm::dvec3 mean_albedo(const Relief& relief) {
    constexpr int kSide = 48;
    glm::dvec3 sum(0);
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const glm::dvec2 at = relief.low + (relief.high() - relief.low) *
                                                   (glm::dvec2(i, j) + 0.5) /
                                                   static_cast<double>(kSide);
            sum += albedo_at(relief, at.x, at.y, normal_at(relief, at.x, at.y));
        }
    return sum / (1.0 * kSide * kSide);
}

// Deep as high.
HeightMap heights_of(const Texture& texture) {
    HeightMap map{kTextureSide, kTextureSide, {}, {}};
    for (const std::uint8_t depth : texture.depth)
        map.heights.push_back(static_cast<std::uint16_t>(257 * depth));
    return map;
}

std::shared_ptr<const Relief> made(const SceneDraft& scene, int threads) {
    const Ground& ground = *scene.ground;
    const Terrain& terrain = *ground.terrain;
    const std::shared_ptr<const Texture> texture = map_of(scene);
    HeightMap own;
    const HeightMap* map = texture ? &texture->heights : nullptr;
    if (!texture && terrain.map) {
        own = heights_of(*texture_of_hash(scene, map_hash(scene)));
        map = &own;
    }
    auto relief = std::make_shared<Relief>();
    relief->cells = glm::ivec2(kReliefSide);
    glm::dvec2 size(terrain.extent);
    if (map != nullptr) {
        const int longer = std::max(map->across, map->down);
        relief->cells = {cells_of(map->across, longer), cells_of(map->down, longer)};
        size *= glm::dvec2(map->across, map->down) / static_cast<double>(longer);
    }
    relief->cell = size / glm::dvec2(relief->cells);
    relief->low = glm::dvec2(terrain.center.x, terrain.center.z) - 0.5 * size;
    relief->base = ground.height;
    fill(terrain, map, threads, *relief);
    settle(terrain, map == nullptr, *relief);
    make_levels(*relief);
    relief->albedo = ground.albedo;
    relief->rock = terrain.rock.value_or(ground.albedo);
    relief->snow = terrain.snow.value_or(std::numeric_limits<double>::infinity());
    relief->mottle =
        map != nullptr ? terrain.extent / 40 : std::max(terrain.size / 5, 1e-6 * terrain.extent);
    relief->key = keyed(terrain.seed, 0x9a7c4);
    relief->mean_albedo = mean_albedo(*relief);
    return relief;
}

// A cell and where in it, of x and z.
struct InCell {
    int x, z;
    double u, v;
};
InCell in_cell(const Relief& relief, double x, double z) {
    const glm::dvec2 at = glm::clamp((glm::dvec2(x, z) - relief.low) / relief.cell, glm::dvec2(0),
                                     glm::dvec2(relief.cells));
    const glm::ivec2 cell = glm::min(glm::ivec2(at), relief.cells - 1);
    return {cell.x, cell.y, at.x - cell.x, at.y - cell.y};
}

bool is_beside(const Relief& relief, double x, double z) {
    const glm::dvec2 high = relief.high();
    return !(x >= relief.low.x && z >= relief.low.y && x <= high.x && z <= high.y);
}

// Heights over lengths at a node; 0 at the sides, where the level ground begins.
glm::dvec2 slope_at(const Relief& relief, int x, int z) {
    if (x == 0 || z == 0 || x == relief.cells.x || z == relief.cells.y) return glm::dvec2(0);
    return glm::dvec2(static_cast<double>(relief.node(x + 1, z)) -
                          static_cast<double>(relief.node(x - 1, z)),
                      static_cast<double>(relief.node(x, z + 1)) -
                          static_cast<double>(relief.node(x, z - 1))) /
           (2.0 * relief.cell);
}

}  // namespace

std::size_t Relief::bytes() const {
    std::size_t all = sizeof *this + height.size() * sizeof(float);
    for (const Level& level : levels) all += level.highest.size() * sizeof(float);
    return all;
}

std::shared_ptr<const Relief> relief_of(const SceneDraft& scene, int threads) {
    if (!has_terrain(scene) || !scene.relief) return nullptr;
    ReliefSlot& slot = *scene.relief;
    std::call_once(slot.made, [&] { slot.relief = made(scene, threads); });
    return slot.relief;
}

double height_at(const Relief& relief, double x, double z) {
    if (is_beside(relief, x, z)) return 0;
    const InCell in = in_cell(relief, x, z);
    const double a = static_cast<double>(relief.node(in.x, in.z)),
                 b = static_cast<double>(relief.node(in.x + 1, in.z)),
                 c = static_cast<double>(relief.node(in.x, in.z + 1)),
                 d = static_cast<double>(relief.node(in.x + 1, in.z + 1));
    const double near = a + in.u * (b - a), far = c + in.u * (d - c);
    return near + in.v * (far - near);
}

glm::dvec3 normal_at(const Relief& relief, double x, double z) {
    if (is_beside(relief, x, z)) return {0, 1, 0};
    const InCell in = in_cell(relief, x, z);
    const glm::dvec2 near =
        glm::mix(slope_at(relief, in.x, in.z), slope_at(relief, in.x + 1, in.z), in.u);
    const glm::dvec2 far =
        glm::mix(slope_at(relief, in.x, in.z + 1), slope_at(relief, in.x + 1, in.z + 1), in.u);
    const glm::dvec2 slope = glm::mix(near, far, in.v);
    return glm::normalize(glm::dvec3(-slope.x, 1, -slope.y));
}

glm::dvec3 albedo_at(const Relief& relief, double x, double z, const glm::dvec3& normal) {
    if (is_beside(relief, x, z)) return relief.albedo;
    const double u = (x - relief.low.x) / relief.mottle, v = (z - relief.low.y) / relief.mottle;
    const double patches = noise_at(relief.key, u, v) +
                           0.6 * noise_at(relief.key + 1, 3.1 * u, 3.1 * v) +
                           0.5 * noise_at(relief.key + 2, 9.7 * u, 9.7 * v);
    const double steep = 1 - risen((normal.y - kSteep) / (kGentle - kSteep));
    glm::dvec3 albedo = glm::mix(relief.albedo, relief.rock, steep) *
                        (1 + kMottled * std::clamp(1.5 * patches, -1.0, 1.0));
    const double height = height_at(relief, x, z);
    if (height > relief.snow - 0.2 * std::abs(relief.snow)) {
        // Its lower edge is uneven.
        const double over = relief.snow > 0 ? height / relief.snow - 1 : 1;
        const double lies =
            risen(0.5 + 4 * over + 0.9 * patches) * risen((normal.y - kBare) / (kSnowy - kBare));
        albedo = glm::mix(albedo, glm::dvec3(kSnowAlbedo), lies);
    }
    // Where the level ground begins there are no patches.
    const double margin = kept_near_sides((x - relief.low.x) / (relief.high().x - relief.low.x)) *
                          kept_near_sides((z - relief.low.y) / (relief.high().y - relief.low.y));
    return glm::clamp(glm::mix(relief.albedo, albedo, margin), 0.0, 1.0);
}

}  // namespace awan
