#include "core/scene/ellipsoids.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/scene/checks.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// The first value that is out of its range; NaN is out of every range. Checks after it do nothing.
class Checks {
  public:
    explicit Checks(std::string at) : at_(std::move(at)) {}

    void number(const char* field, double value, double lowest, double highest) {
        if (!wrong_) wrong_ = in_range(value, lowest, highest, at_ + "/" + field);
    }
    void integer(const char* field, std::uint64_t value, std::uint64_t lowest,
                 std::uint64_t highest) {
        if (!wrong_) wrong_ = count_in_range(value, lowest, highest, at_ + "/" + field);
    }
    void vector(const char* field, const glm::dvec3& v, double lowest, double highest) {
        for (int i = 0; i < 3; ++i)
            number((field + ("/" + std::to_string(i))).c_str(), v[i], lowest, highest);
    }
    void also(const Status& other) {
        if (!wrong_) wrong_ = other;
    }
    const Status& result() const { return wrong_; }

  private:
    std::string at_;
    Status wrong_;
};

Status check_texture(const SineTexture& texture, const std::string& at) {
    Checks checks(at);
    checks.integer("terms", texture.terms, 1, limits::kMaxTextureTerms);
    checks.number("frequency_x", texture.frequency_x, limits::kMinTextureFrequency,
                  limits::kMaxTextureFrequency);
    checks.number("frequency_z", texture.frequency_z, limits::kMinTextureFrequency,
                  limits::kMaxTextureFrequency);
    checks.number("offset", texture.offset, 0, limits::kMaxTextureOffset);
    return checks.result();
}

void check_thresholds(Checks& checks, double threshold, double range) {
    checks.number("threshold", threshold, limits::kMinTextureThreshold,
                  limits::kMaxTextureThreshold);
    checks.number("range", range, limits::kMinTextureRange, limits::kMaxTextureRange);
}

Status check_plane(const SkyPlane& plane, const std::string& at) {
    Checks checks(at);
    checks.number("altitude", plane.altitude, -limits::kMaxEllipsoidCoordinate,
                  limits::kMaxEllipsoidCoordinate);
    checks.number("extent", plane.extent, limits::kMinPlaneExtent, limits::kMaxPlaneExtent);
    checks.number("thickness", plane.thickness, 0, plane.extent);
    check_thresholds(checks, plane.threshold, plane.range);
    checks.number("density", plane.density, 0, limits::kMaxDensity);
    checks.integer("resolution", plane.resolution, limits::kMinLatticeResolution,
                   limits::kMaxPlaneResolution);
    checks.also(check_texture(plane.texture, at + "/texture"));
    return checks.result();
}

Status check_formation(const Formation& formation, const std::string& at) {
    Checks checks(at);
    checks.integer("count", formation.count, 1, limits::kMaxEllipsoids);
    checks.vector("center", formation.center, -limits::kMaxEllipsoidCoordinate,
                  limits::kMaxEllipsoidCoordinate);
    checks.vector("radii", formation.radii, limits::kMinEllipsoidRadius,
                  limits::kMaxEllipsoidRadius);
    checks.number("variation", formation.variation, 0, limits::kMaxRadiusVariation);
    checks.number("link", formation.link, limits::kMinLink, limits::kMaxLink);
    checks.number("heading", formation.heading, -limits::kMaxAngle, limits::kMaxAngle);
    checks.number("spread", formation.spread, 0, 180);
    return checks.result();
}

Status check_ellipsoid(const Ellipsoid& one, const std::string& at) {
    Checks checks(at);
    checks.vector("center", one.center, -limits::kMaxEllipsoidCoordinate,
                  limits::kMaxEllipsoidCoordinate);
    checks.vector("radii", one.radii, limits::kMinEllipsoidRadius, limits::kMaxEllipsoidRadius);
    checks.number("rotate_y", one.rotate_y, -limits::kMaxAngle, limits::kMaxAngle);
    check_thresholds(checks, one.threshold.value_or(0), one.range.value_or(1));
    checks.number("threshold_edge", one.threshold_edge.value_or(0), limits::kMinTextureThreshold,
                  limits::kMaxTextureThreshold);
    return checks.result();
}

// All lists together, named at the one that goes over.
Status check_counts(const EllipsoidsCloud& cloud, const std::string& at) {
    const std::string most = "a cloud may have at most " + std::to_string(limits::kMaxEllipsoids) +
                             " ellipsoids in all, this makes it more";
    if (cloud.ellipsoids.size() > limits::kMaxEllipsoids) return invalid(at + "/ellipsoids", most);
    std::uint64_t count = cloud.ellipsoids.size();
    for (std::size_t i = 0; i < cloud.formations.size(); ++i) {
        if (cloud.formations[i].count > limits::kMaxEllipsoids - count)
            return invalid(at + "/formations/" + std::to_string(i) + "/count", most);
        count += cloud.formations[i].count;
    }
    if (most_particles(cloud) > limits::kMaxParticles)
        return invalid(at + "/plane/resolution", "the plane and the ellipsoids may have " +
                                                     std::to_string(limits::kMaxParticles) +
                                                     " cells together, not " +
                                                     std::to_string(most_particles(cloud)));
    return std::nullopt;
}

void add(std::vector<double>& figures, std::initializer_list<double> values) {
    for (const double value : values) figures.push_back(value);
}

void add_texture(std::vector<double>& figures, const SineTexture& texture) {
    add(figures, {static_cast<double>(texture.form), static_cast<double>(texture.terms),
                  texture.frequency_x, texture.frequency_z, texture.offset});
}

void add_vector(std::vector<double>& figures, const glm::dvec3& v) {
    add(figures, {v.x, v.y, v.z});
}

void add_optional(std::vector<double>& figures, const std::optional<double>& value) {
    add(figures, {value ? 1.0 : 0.0, value.value_or(0)});
}

}  // namespace

std::vector<double> figures_of(const EllipsoidsCloud& cloud) {
    std::vector<double> figures;
    add_texture(figures, cloud.texture);
    const SineShading& shading = cloud.shading;
    const Translucence& t = cloud.translucence;
    add(figures, {shading.specular, shading.texture, shading.ambient, shading.shininess,
                  t.threshold, t.threshold_edge, t.range, cloud.plane ? 1.0 : 0.0});
    if (cloud.plane) {
        const SkyPlane& plane = *cloud.plane;
        add(figures, {plane.altitude, plane.extent, plane.thickness, plane.threshold, plane.range,
                      plane.density, static_cast<double>(plane.resolution)});
        add_texture(figures, plane.texture);
    }
    figures.push_back(static_cast<double>(cloud.formations.size()));
    for (const Formation& one : cloud.formations) {
        add(figures, {static_cast<double>(one.kind), static_cast<double>(one.count)});
        add_vector(figures, one.center);
        add_vector(figures, one.radii);
        add(figures, {one.variation, one.link, one.heading, one.spread});
    }
    figures.push_back(static_cast<double>(cloud.ellipsoids.size()));
    for (const Ellipsoid& one : cloud.ellipsoids) {
        add_vector(figures, one.center);
        add_vector(figures, one.radii);
        figures.push_back(one.rotate_y);
        add_optional(figures, one.threshold);
        add_optional(figures, one.threshold_edge);
        add_optional(figures, one.range);
    }
    add_vector(figures, cloud.drift);
    add(figures, {cloud.density, static_cast<double>(cloud.resolution)});
    for (double& figure : figures) figure += 0.0;  // -0 is 0
    return figures;
}

Status check_ellipsoids(const EllipsoidsCloud& cloud, const std::string& at) {
    Checks checks(at);
    checks.also(check_texture(cloud.texture, at + "/texture"));
    Checks shading(at + "/shading");
    shading.number("specular", cloud.shading.specular, 0, 1);
    shading.number("texture", cloud.shading.texture, 0, 1);
    shading.number("ambient", cloud.shading.ambient, 0, 1);
    shading.number("shininess", cloud.shading.shininess, 1, limits::kMaxShininess);
    checks.also(shading.result());
    check_thresholds(checks, cloud.translucence.threshold, cloud.translucence.range);
    checks.number("threshold_edge", cloud.translucence.threshold_edge, limits::kMinTextureThreshold,
                  limits::kMaxTextureThreshold);
    if (cloud.plane) checks.also(check_plane(*cloud.plane, at + "/plane"));
    for (std::size_t i = 0; i < cloud.formations.size() && !checks.result(); ++i)
        checks.also(check_formation(cloud.formations[i], at + "/formations/" + std::to_string(i)));
    for (std::size_t i = 0; i < cloud.ellipsoids.size() && !checks.result(); ++i)
        checks.also(check_ellipsoid(cloud.ellipsoids[i], at + "/ellipsoids/" + std::to_string(i)));
    checks.vector("drift", cloud.drift, -limits::kMaxVelocity, limits::kMaxVelocity);
    checks.number("density", cloud.density, 0, limits::kMaxDensity);
    checks.integer("resolution", cloud.resolution, limits::kMinLatticeResolution,
                   limits::kMaxLatticeResolution);
    if (!checks.result()) checks.also(check_counts(cloud, at));
    return checks.result();
}

std::uint64_t most_particles(const EllipsoidsCloud& cloud) {
    // A draft that cannot be asks for more than there may be.
    if (cloud.resolution > limits::kMaxLatticeResolution ||
        (cloud.plane && cloud.plane->resolution > limits::kMaxPlaneResolution))
        return limits::kMaxParticles + 1;
    const bool solid = !cloud.plane || !cloud.formations.empty() || !cloud.ellipsoids.empty();
    std::uint64_t most = solid ? cloud.resolution * cloud.resolution * cloud.resolution : 0;
    if (cloud.plane) {
        const SkyPlane& plane = *cloud.plane;
        const auto side = static_cast<double>(plane.resolution);
        const double layers = std::ceil(plane.thickness / plane.extent * side);
        most += plane.resolution * plane.resolution *
                static_cast<std::uint64_t>(std::min(std::max(1.0, layers), side));
    }
    return most;
}

}  // namespace awan
