#include "core/draw/display_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/base/exact_math.h"
#include "core/draw/billboards.h"
#include "core/generate/automaton/cells.h"
#include "core/generate/gaussian.h"
#include "core/generate/keyed_random.h"
#include "core/generate/motion.h"
#include "core/scene/automaton.h"

namespace awan {
namespace {

// No exposure is metered for them (formats/image_file.h); the tone curve takes a little off the paint.
const glm::dvec3 kEdge{0.02, 0.05, 0.12}, kFace{0.3, 0.36, 0.45}, kPaint{0.7, 0.7, 0.7};
const glm::dvec3 kEllipsoid{0.5, 0.6, 0.7}, kChosen{0.85, 0.03, 0.02};
// Opacity of the faces of a cube without a texture, and of what is painted.
constexpr double kBareFace = 0.25, kPaintedPart = 0.92;
// Edges are so many pixels wide in a picture of 600 rows, and at least one.
constexpr double kEdgeWidth = 1.6;
// Nearer to the eye by so much, so that an edge is seen before the faces that it bounds.
constexpr double kBefore = 0.998;
// The one that is chosen is seen through all others.
constexpr double kBeforeAll = 0.2;
// Nothing nearer to the eye than this share of the farthest corner is drawn.
constexpr double kNearest = 1e-4;

glm::dvec3 in_frame(const glm::dvec3& p, const View& view) {
    const glm::dvec3 d = p - view.eye;
    return {glm::dot(d, view.right), glm::dot(d, view.up), glm::dot(d, view.forward)};
}

// From the eye's frame to clip coordinates: depth is 1 - 2 near / z.
struct Lens {
    const View& view;
    double near;
    double height;  // pixels

    glm::dvec4 clip(const glm::dvec3& q) const {
        return {q.x / (view.tan_half_fov * view.aspect), q.y / view.tan_half_fov, q.z - 2 * near,
                q.z};
    }
};

glm::vec4 premultiplied(const glm::dvec3& color, double alpha) {
    return glm::vec4(glm::dvec4(alpha * color, alpha));
}

constexpr glm::vec4 kUnpainted{0, 0, -1, 0};

// p: four corners around, of which the first is the texture's lower left.
void add_quad(const std::array<glm::vec4, 4>& p, const glm::vec4& color, int layer,
              std::vector<DisplayVertex>& out) {
    constexpr glm::vec2 kAt[] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    for (const std::size_t i : {0, 1, 2, 0, 2, 3}) {
        const glm::vec4 texture(kAt[i], static_cast<float>(layer), 0);
        out.push_back({p[i], color, layer < 0 ? kUnpainted : texture});
    }
}

// A line of a width in pixels, of the part before the eye.
void add_line(const Lens& lens, glm::dvec3 a, glm::dvec3 b, std::vector<DisplayVertex>& out,
              const glm::dvec3& color = kEdge, double before = kBefore) {
    const double near = 1.01 * lens.near;
    if (a.z > b.z) std::swap(a, b);
    if (!(b.z > near)) return;
    if (a.z < near) a += (near - a.z) / (b.z - a.z) * (b - a);
    const auto flat = [&](const glm::dvec3& q) {
        const glm::dvec4 c = lens.clip(before * q);
        return glm::dvec3(c) / c.w;
    };
    const glm::dvec3 p = flat(a), q = flat(b);
    const glm::dvec2 square(lens.view.aspect, 1);
    glm::dvec2 way = glm::dvec2(q - p) * square;
    const double length = glm::length(way);
    way = length > 0 ? way / length : glm::dvec2(1, 0);
    const double width = std::max(1.0, kEdgeWidth * lens.height / 600) / lens.height;
    const glm::dvec2 aside = width * glm::dvec2(-way.y, way.x) / square;
    // Longer by half the width, so that the corners of boxes are whole.
    const glm::dvec2 past = width * way / square;
    const auto at = [&](const glm::dvec3& r, double side, double end) {
        const glm::dvec2 xy = glm::dvec2(r) + side * aside + end * past;
        return glm::vec4(glm::dvec4(xy, r.z, 1));
    };
    add_quad({at(p, -1, -1), at(q, -1, 1), at(q, 1, 1), at(p, 1, -1)}, premultiplied(color, 1), -1,
             out);
}

void add_edges(const DisplayBox& box, const Lens& lens, std::vector<DisplayVertex>& out) {
    for (std::size_t i = 0; i < 8; ++i)
        for (const std::size_t bit : {1, 2, 4})
            if ((i & bit) == 0)
                add_line(lens, in_frame(box.corner[i], lens.view),
                         in_frame(box.corner[i | bit], lens.view), out);
}

// The corners of a box's faces: -x, +x, -y, +y, -z, +z, each around, with y up and seen from without.
constexpr std::size_t kFaces[6][4] = {{0, 4, 6, 2}, {5, 1, 3, 7}, {0, 1, 5, 4},
                                      {6, 7, 3, 2}, {1, 0, 2, 3}, {4, 5, 7, 6}};

struct Face {
    const DisplayBox* box;
    const std::size_t* corners;
    double distance;
};

// Of all boxes, the farthest first.
std::vector<Face> faces_of(const std::vector<DisplayBox>& boxes, const View& view) {
    std::vector<Face> faces;
    for (const DisplayBox& box : boxes)
        for (const auto& corners : kFaces) {
            const glm::dvec3 middle = 0.5 * (box.corner[corners[0]] + box.corner[corners[2]]);
            faces.push_back({&box, corners, glm::length(middle - view.eye)});
        }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const Face& a, const Face& b) { return a.distance > b.distance; });
    return faces;
}

// A face in light from above, in front and to the right of the scene.
double shade(const Face& face) {
    const auto& at = face.box->corner;
    const glm::dvec3 across = at[face.corners[1]] - at[face.corners[0]];
    const glm::dvec3 up = at[face.corners[3]] - at[face.corners[0]];
    const glm::dvec3 out = glm::cross(across, up);
    const double size = glm::length(out);
    if (!(size > 0)) return 1;
    return 0.72 + 0.4 * glm::dot(out / size, glm::normalize(glm::dvec3(0.4, 0.8, 0.45)));
}

std::array<glm::vec4, 4> seen(const Face& face, const Lens& lens) {
    std::array<glm::vec4, 4> p{};
    for (std::size_t i = 0; i < 4; ++i)
        p[i] = glm::vec4(lens.clip(in_frame(face.box->corner[face.corners[i]], lens.view)));
    return p;
}

std::array<glm::vec4, 4> square(const glm::dvec3& q, const BillboardAxes& axes, const Lens& lens) {
    return {glm::vec4(lens.clip(q - axes.across - axes.up)),
            glm::vec4(lens.clip(q + axes.across - axes.up)),
            glm::vec4(lens.clip(q + axes.across + axes.up)),
            glm::vec4(lens.clip(q - axes.across + axes.up))};
}

// The texture of each box on one square that faces the eye, as large as the middle one of the box's sides.
void add_textures(const std::vector<DisplayBox>& boxes, const Lens& lens,
                  std::vector<DisplayVertex>& out) {
    std::vector<const DisplayBox*> painted;
    for (const DisplayBox& box : boxes)
        if (box.texture >= 0) painted.push_back(&box);
    const auto distance = [&](const DisplayBox* box) {
        return glm::length(box->middle() - lens.view.eye);
    };
    std::stable_sort(painted.begin(), painted.end(), [&](const DisplayBox* a, const DisplayBox* b) {
        return distance(a) > distance(b);
    });
    for (const DisplayBox* const box : painted) {
        std::array<double, 3> sides{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            sides[axis] = glm::length(box->corner[std::size_t{1} << axis] - box->corner[0]);
        std::sort(sides.begin(), sides.end());
        const glm::dvec3 q = in_frame(box->middle(), lens.view);
        const BillboardAxes axes = billboard_axes(q, sides[1] / 2, {}, vertical_in(lens.view));
        add_quad(square(q, axes, lens), premultiplied(kPaint, 1), box->texture, out);
    }
}

// A ring of the ellipsoid where its first axis is `level` radii from the middle, about that axis.
void add_ring(const DisplayEllipsoid& one, std::size_t about, double level, int segments,
              const Lens& lens, std::vector<DisplayVertex>& out) {
    const double wide = std::sqrt(1 - level * level);
    const glm::dvec3 middle = one.center + level * one.axis[about];
    const glm::dvec3 &a = one.axis[(about + 1) % 3], &b = one.axis[(about + 2) % 3];
    const auto at = [&](int n) {
        const exact::SinCos turn = exact::sincos_degrees(360.0 * n / segments);
        return in_frame(middle + wide * (turn.cos * a + turn.sin * b), lens.view);
    };
    for (int n = 0; n < segments; ++n)
        add_line(lens, at(n), at(n + 1), out, one.chosen ? kChosen : kEllipsoid,
                 one.chosen ? kBeforeAll : kBefore);
}

Lens lens_of(const Scene& scene, const View& view, double farthest) {
    return {view, std::max(kNearest * farthest, 1e-12), static_cast<double>(scene->image.height)};
}

DisplayBox box_around(const ParticleSet& particles, std::size_t first, std::size_t last) {
    glm::dvec3 low(0), high(0);
    for (std::size_t i = first; i < last; ++i) {
        const glm::dvec3 r(static_cast<double>(particles.radius[i]));
        low = i == first ? particles.center[i] - r : glm::min(low, particles.center[i] - r);
        high = i == first ? particles.center[i] + r : glm::max(high, particles.center[i] + r);
    }
    DisplayBox box;
    for (std::size_t i = 0; i < 8; ++i)
        box.corner[i] = {(i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y,
                         (i & 4) ? high.z : low.z};
    return box;
}

// Of an automaton: what its cells may fill.
DisplayBox box_of_grid(const Cloud& cloud, double time) {
    const Motion motion = motion_of(cloud, time);
    const AutomatonCloud& automaton = *cloud.automaton;
    DisplayBox box;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3 share((i & 1) ? 0.5 : -0.5, (i & 2) ? 1 : 0, (i & 4) ? 0.5 : -0.5);
        box.corner[i] = motion(automaton.cell * (share * automaton.cells));
    }
    return box;
}

double farthest_of(const std::vector<DisplayBox>& boxes, const View& view) {
    double farthest = 0;
    for (const DisplayBox& box : boxes)
        for (const glm::dvec3& corner : box.corner)
            farthest = std::max(farthest, glm::length(corner - view.eye));
    return farthest;
}

int place_of(std::string_view hash, const std::vector<std::string_view>& textures) {
    if (hash.empty()) return -1;
    return static_cast<int>(std::find(textures.begin(), textures.end(), hash) - textures.begin());
}

}  // namespace

std::vector<DisplayBox> display_boxes(const Scene& scene, const ParticleSet& particles) {
    const std::vector<std::string_view> textures = textures_of(*scene);
    std::vector<DisplayBox> boxes;
    for (std::size_t k = 0; k < scene->clouds.size(); ++k) {
        const Cloud& cloud = scene->clouds[k];
        if (cloud.model != CloudModel::kCubes) {
            if (scene->display == Display::kEllipsoids && cloud.automaton) {
                boxes.push_back(box_of_grid(cloud, clouds_time(*scene)));
                continue;
            }
            if (particles.cloud_begin[k] == particles.cloud_begin[k + 1]) continue;
            boxes.push_back(
                box_around(particles, particles.cloud_begin[k], particles.cloud_begin[k + 1]));
            boxes.back().texture = place_of(texture_of(*scene, cloud, nullptr), textures);
            continue;
        }
        const Motion motion = motion_of(cloud, clouds_time(*scene));
        for (const Cube& cube : cloud.cubes) {
            DisplayBox box;
            for (std::size_t i = 0; i < 8; ++i) {
                const glm::dvec3 way((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5,
                                     (i & 4) ? 0.5 : -0.5);
                box.corner[i] = motion(cube.center + way * cube.size);
            }
            box.texture = place_of(texture_of(*scene, cloud, &cube), textures);
            boxes.push_back(box);
        }
    }
    return boxes;
}

Result<std::vector<DisplayEllipsoid>> display_ellipsoids(const Scene& scene,
                                                         const Deadline& deadline) {
    std::vector<DisplayEllipsoid> all;
    if (scene->display != Display::kEllipsoids) return all;
    const double time = clouds_time(*scene);
    for (std::size_t k = 0; k < scene->clouds.size(); ++k) {
        const Cloud& cloud = scene->clouds[k];
        if (!cloud.automaton) continue;
        const AutomatonCloud& automaton = *cloud.automaton;
        const auto now =
            automaton::ellipsoids_at(automaton, keyed(seed_of(*scene, cloud), k), time, deadline);
        if (!now.ok()) return now.error();
        const Motion motion = motion_of(cloud, time);
        const glm::dvec3 corner(automaton.cells.x / 2, 0, automaton.cells.z / 2);
        for (std::size_t n = 0; n < now->size(); ++n) {
            const AutomatonEllipsoid& one = (*now)[n];
            const glm::dvec3 middle = motion(automaton.cell * (one.center - corner));
            DisplayEllipsoid shown{middle, {}, automaton.chosen == n};
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 tip = one.center - corner;
                tip[axis] += one.radii[axis];
                shown.axis[static_cast<std::size_t>(axis)] = motion(automaton.cell * tip) - middle;
            }
            all.push_back(shown);
        }
    }
    return all;
}

DisplayShapes display_shapes(const Scene& scene, const std::vector<DisplayBox>& boxes,
                             const std::vector<DisplayEllipsoid>& ellipsoids, const View& view) {
    const Lens lens = lens_of(scene, view, farthest_of(boxes, view));
    DisplayShapes shapes;
    if (scene->display == Display::kShowTexture) {
        add_textures(boxes, lens, shapes.sheer);
        return shapes;
    }
    for (const DisplayBox& box : boxes) add_edges(box, lens, shapes.solid);
    // Many are drawn with fewer lines each.
    constexpr std::size_t kFew = 40;
    const bool few = ellipsoids.size() <= kFew;
    for (const DisplayEllipsoid& one : ellipsoids)
        for (const std::size_t about : {0, 1, 2}) {
            add_ring(one, about, 0, few ? 64 : 24, lens, shapes.solid);
            for (const double level : {-0.6, 0.6})
                if (few) add_ring(one, about, level, 48, lens, shapes.solid);
        }
    if (scene->display != Display::kCubes && scene->display != Display::kQuads) return shapes;
    const bool solid = scene->display == Display::kCubes;
    for (const Face& face : faces_of(boxes, view)) {
        const int texture = face.box->texture;
        const bool painted = !solid && texture >= 0;
        const glm::dvec3 color = shade(face) * (painted ? kPaint : kFace);
        const double alpha = solid ? 1 : painted ? kPaintedPart : kBareFace;
        add_quad(seen(face, lens), premultiplied(color, alpha), painted ? texture : -1,
                 solid ? shapes.solid : shapes.sheer);
    }
    return shapes;
}

std::vector<std::uint32_t> display_order(const ParticleSet& particles, const View& view) {
    std::vector<float> distance(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i)
        distance[i] = static_cast<float>(glm::length(particles.center[i] - view.eye));
    std::vector<std::uint32_t> order(particles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::erase_if(order, [&](std::uint32_t i) {
        return !(glm::dot(particles.center[i] - view.eye, view.forward) > 0);
    });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return distance[a] < distance[b]; });
    return order;
}

std::vector<DisplayVertex> display_billboards(const Scene& scene, const ParticleSet& particles,
                                              const std::vector<DisplayBox>& boxes,
                                              const View& view,
                                              const std::vector<std::uint32_t>& order,
                                              std::size_t first, std::size_t last, int plain) {
    const double farthest = farthest_of(boxes, view);
    const Lens lens = lens_of(scene, view, farthest);
    const double nearest = glm::length(particles.center[order.front()] - view.eye);
    const glm::dvec3 vertical = vertical_in(view);
    std::vector<DisplayVertex> out;
    out.reserve(6 * (last - first));
    for (std::size_t n = last; n-- > first;) {
        const std::size_t i = order[n];
        const Paint paint = particles.paint.empty() ? Paint{} : particles.paint[i];
        const glm::dvec3 q = in_frame(particles.center[i], view);
        const double half = kBillboardReach * gaussian_s(particles, i);
        // Flat white squares would run into one: what is farther is darker, and each a little by chance.
        const double far = (glm::length(q) - nearest) / std::max(farthest - nearest, 1e-12);
        const double own = unit_open(static_cast<std::uint32_t>(mix_bits(i + 1)));
        const glm::dvec3 color = kPaint * (1.1 - 0.6 * std::clamp(far, 0.0, 1.0) - 0.3 * own);
        add_quad(square(q, billboard_axes(q, half, paint, vertical), lens),
                 premultiplied(color, kPaintedPart), paint.texture > 0 ? paint.texture - 1 : plain,
                 out);
    }
    return out;
}

}  // namespace awan
