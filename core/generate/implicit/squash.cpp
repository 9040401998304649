#include "core/generate/implicit/squash.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "core/base/exact_math.h"
#include "core/generate/implicit/keys.h"

namespace awan::implicit {
namespace {

template <typename Use>
void each_corner(const Box& box, const Use& use) {
    for (int corner = 0; corner < 8; ++corner)
        use(glm::dvec3((corner & 1) != 0 ? box.max.x : box.min.x,
                       (corner & 2) != 0 ? box.max.y : box.min.y,
                       (corner & 4) != 0 ? box.max.z : box.min.z));
}

}  // namespace

double squash_amount(const ImplicitSquash& squash, bool smooth, double time) {
    return at_time(squash.keys, squash.amount, smooth, time,
                   [](const ImplicitSquashKey& key) { return std::optional<double>(key.amount); });
}

// s k k^T + (I - k k^T) / sqrt(s), k the unit vector along the axis, s the amount.
glm::dmat3 stretched_along(const glm::dvec3& axis, double amount) {
    const glm::dvec3 k = glm::normalize(axis);
    const double across = 1 / std::sqrt(amount);
    return across * glm::dmat3(1) + (amount - across) * glm::outerProduct(k, k);
}

Box mapped(const glm::dmat3& map, const glm::dvec3& at, const Box& box) {
    Box result;
    each_corner(box, [&](const glm::dvec3& corner) { result.add(at + map * (corner - at)); });
    return result;
}

// A component of what becomes of d is a s + b / sqrt(s), a of the part of d along the axis and b of the rest. It is
// farthest at one end of the amounts, or where its derivative is 0, s = (b / 2 a)^(2/3).
Box squashed_at_all_times(const ImplicitSquash& squash, const glm::dvec3& at, const Box& box) {
    double least = squash.amount, most = squash.amount;
    if (!squash.keys.empty()) least = most = squash.keys[0].amount;
    for (const ImplicitSquashKey& key : squash.keys)
        least = std::min(least, key.amount), most = std::max(most, key.amount);
    const glm::dvec3 k = glm::normalize(squash.axis);
    Box result;
    each_corner(box, [&](const glm::dvec3& corner) {
        const glm::dvec3 d = corner - at, along = glm::dot(d, k) * k, rest = d - along;
        const auto add = [&](double s) { result.add(at + s * along + rest / std::sqrt(s)); };
        add(least), add(most);
        for (int i = 0; i < 3; ++i) {
            const double ratio = along[i] != 0 ? rest[i] / (2 * along[i]) : 0;
            if (!(ratio > 0)) continue;
            const double root = exact::cbrt(ratio);
            if (root * root > least && root * root < most) add(root * root);
        }
    });
    return result;
}

}  // namespace awan::implicit
