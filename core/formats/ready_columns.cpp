#include "core/formats/ready_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/formats/numbers.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// What is out of float32's range becomes infinite, which validate() refuses.
float to_float(double value) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (std::isfinite(value) && std::abs(value) > kLargest)
        return static_cast<float>(std::copysign(std::numeric_limits<double>::infinity(), value));
    return static_cast<float>(value);
}

Error wrong(std::string message) {
    return {ErrorCode::kMalformed, "", std::move(message)};
}

// Names of a file, for a message or a header of HTTP: as many as a table that people look at has, and how many more
// there are.
std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 16;
    std::string out;
    for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
        out += (i == 0 ? "" : ", ") + short_quote(names[i]);
    if (names.size() > kMost) out += " and " + std::to_string(names.size() - kMost) + " more";
    return out;
}

constexpr Says kRadiusSays[] = {Says::kRadiusX, Says::kRadiusY, Says::kRadiusZ};
constexpr Says kLogScaleSays[] = {Says::kLogScale0, Says::kLogScale1, Says::kLogScale2};
constexpr Says kColorSays[] = {Says::kRed, Says::kGreen, Says::kBlue};
constexpr Says kHarmonicSays[] = {Says::kHarmonicRed, Says::kHarmonicGreen, Says::kHarmonicBlue};

// Alpha of 1 would be matter without end. Eight bits cannot tell it from half a step less, which is taken for it.
constexpr double kMostOpaque = 1.0 - 1.0 / 510.0;

// The peak extinction of a Gaussian of this radius (s = radius / 2) that takes the share `opacity` off a ray through
// its middle, where the optical depth is density * s * sqrt(2 pi).
double density_of(double opacity, double radius) {
    const double depth = -exact::log1p(-std::min(opacity, kMostOpaque));
    return depth / (0.5 * radius * std::sqrt(2 * std::numbers::pi));
}

}  // namespace

void ReadyColumns::note(std::string text) const {
    if (reading_.notes != nullptr) reading_.notes->push_back(std::move(text));
}

// Of several ways to give a radius the plainest counts.
Status ReadyColumns::choose_radius(const std::vector<std::string>& names,
                                   std::vector<std::optional<Says>>& used) {
    const auto leave_only = [&](bool radius, bool width, bool radii, bool scales) {
        for (std::optional<Says>& says : used) {
            if (!says) continue;
            const bool of_radii = std::find(std::begin(kRadiusSays), std::end(kRadiusSays),
                                            *says) != std::end(kRadiusSays);
            const bool of_scales = std::find(std::begin(kLogScaleSays), std::end(kLogScaleSays),
                                             *says) != std::end(kLogScaleSays);
            if ((*says == Says::kRadius && !radius) || (*says == Says::kWidth && !width) ||
                (of_radii && !radii) || (of_scales && !scales)) {
                drop(*says);
                says.reset();
            }
        }
        return std::nullopt;
    };
    if (reading_.radius) return leave_only(false, false, false, false);
    if (has(Says::kRadius)) return leave_only(true, false, false, false);
    if (has(Says::kWidth)) {
        note("radius: half of the column of widths");
        return leave_only(false, true, false, false);
    }
    if (has(Says::kRadiusX) || has(Says::kRadiusY) || has(Says::kRadiusZ)) {
        note("radius: the geometric mean of the radii along the axes");
        return leave_only(false, false, true, false);
    }
    if (has(Says::kLogScale0) && has(Says::kLogScale1) && has(Says::kLogScale2)) {
        note("3D Gaussian splats: radius is twice the geometric mean of exp(scale_0, 1, 2)");
        return std::nullopt;
    }
    return wrong(
        "x, y, z and a radius are required; there is no radius (or width, pscale, radius_x, ...) "
        "among " +
        some_of(names) + ", and no --radius or ?radius= for all");
}

// Lengths are taken as they stand, so all of them have to be in one unit.
Status ReadyColumns::check_units(const std::vector<std::string>& names,
                                 const std::vector<std::optional<Says>>& used) const {
    std::size_t first = names.size();
    std::string unit;
    for (std::size_t i = 0; i < names.size(); ++i) {
        // The radius along the last axis is the last of the lengths.
        if (!used[i] || *used[i] > Says::kRadiusZ) continue;
        const std::string other = known_name(names[i])->unit;
        if (other.empty()) continue;
        if (first == names.size()) {
            first = i;
            unit = other;
        } else if (other != unit) {
            return wrong("lengths are in different units: " + short_quote(names[first]) + " and " +
                         short_quote(names[i]) + "; give all in one");
        }
    }
    return std::nullopt;
}

Result<std::vector<std::optional<Says>>> ReadyColumns::choose(
    const std::vector<std::string>& names) {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<std::optional<Says>> used(names.size());
    std::array<std::size_t, kSaysCount> column{};
    column.fill(kNone);
    std::array<int, kSaysCount> rank{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::optional<KnownName> known = known_name(names[i]);
        if (!known) continue;
        const auto k = static_cast<std::size_t>(known->says);
        if (column[k] != kNone && rank[k] == known->rank)
            return wrong(std::string("what says ") + name_of(known->says) + " stands twice: " +
                         short_quote(names[column[k]]) + " and " + short_quote(names[i]));
        if (column[k] != kNone && rank[k] < known->rank) continue;
        if (column[k] != kNone) used[column[k]].reset();
        column[k] = i;
        rank[k] = known->rank;
        used[i] = known->says;
        has_[k] = true;
    }
    const auto any = [&](const Says(&all)[3]) { return has(all[0]) || has(all[1]) || has(all[2]); };
    const auto every = [&](const Says(&all)[3]) {
        return has(all[0]) && has(all[1]) && has(all[2]);
    };
    const auto drop_all = [&](const Says(&all)[3]) {
        for (std::optional<Says>& says : used)
            if (says && std::find(std::begin(all), std::end(all), *says) != std::end(all)) {
                drop(*says);
                says.reset();
            }
    };
    for (const Says says : {Says::kX, Says::kY, Says::kZ})
        if (!has(says))
            return wrong(std::string("there is no ") + name_of(says) + " among " + some_of(names) +
                         "; needed are x, y, z and radius, then density and r, g, b");
    splats_ = every(kHarmonicSays) || every(kLogScaleSays);
    // x, y, z, r: a radius, where there is no other colour.
    if (has(Says::kRed) && !has(Says::kGreen) && !has(Says::kBlue) && !has(Says::kRadius) &&
        !has(Says::kWidth) && !any(kRadiusSays) &&
        known_name(names[column[static_cast<std::size_t>(Says::kRed)]])->rank == 1) {
        used[column[static_cast<std::size_t>(Says::kRed)]] = Says::kRadius;
        drop(Says::kRed);
        has_[static_cast<std::size_t>(Says::kRadius)] = true;
        note("radius: the column " +
             short_quote(names[column[static_cast<std::size_t>(Says::kRed)]]));
    }
    if (const Status missing = choose_radius(names, used)) return *missing;
    if (const Status mixed = check_units(names, used)) return *mixed;
    if (any(kColorSays) && !every(kColorSays))
        return wrong("a colour needs all of red, green and blue (or r, g, b)");
    if (every(kColorSays) || !every(kHarmonicSays)) drop_all(kHarmonicSays);
    if (has(Says::kDensity) && has(Says::kOpacity)) {
        for (std::optional<Says>& says : used)
            if (says == Says::kOpacity) says.reset();
        drop(Says::kOpacity);
    }
    if (has(Says::kOpacity))
        note(std::string("density: such that a ray through a particle's middle loses its ") +
             (splats_ ? "opacity, 1 / (1 + exp(-opacity))" : "opacity"));
    std::vector<std::string> left;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!used[i] && !names[i].empty()) left.push_back(names[i]);
    if (!left.empty()) note("not used: " + some_of(left));
    return used;
}

void ReadyColumns::reserve(std::size_t count) {
    ready_.positions.reserve(count);
    ready_.radii.reserve(count);
    if (has(Says::kDensity) || has(Says::kOpacity)) ready_.densities.reserve(count);
    if (has(Says::kRed) || has(Says::kHarmonicRed)) ready_.colors.reserve(count);
}

float ReadyColumns::radius_of(const ReadyRow& row) const {
    if (reading_.radius) return to_float(*reading_.radius);
    if (has(Says::kRadius)) return to_float(row[Says::kRadius]);
    if (has(Says::kWidth)) return to_float(row[Says::kWidth] / 2);
    if (has(Says::kLogScale0))
        return to_float(
            2 * exact::exp((row[Says::kLogScale0] + row[Says::kLogScale1] + row[Says::kLogScale2]) /
                           3));
    double product = 1;
    int given = 0;
    for (const Says says : kRadiusSays)
        if (has(says)) {
            product *= row[says];
            ++given;
        }
    // Negative ones stay so, for validate() to refuse.
    return to_float(std::copysign(exact::pow(std::abs(product), 1.0 / given), product));
}

Status ReadyColumns::add_density(const ReadyRow& row, float radius) {
    const Says from = has(Says::kDensity) ? Says::kDensity : Says::kOpacity;
    if (!has(from)) return std::nullopt;
    if (row.lacks(from)) {
        without_density_.push_back(ready_.densities.size());
        ready_.densities.push_back(0);
        return std::nullopt;
    }
    double value = row[from];
    if (from == Says::kOpacity) {
        if (splats_) value = 1 / (1 + exact::exp(-value));
        if (!(value >= 0 && value <= 1)) return wrong("opacity must be from 0 to 1");
        value = density_of(value, static_cast<double>(radius));
    }
    ready_.densities.push_back(to_float(value));
    return std::nullopt;
}

Status ReadyColumns::add_color(const ReadyRow& row) {
    glm::vec3 color(1.0f);
    if (has(Says::kRed)) {
        const int lacking =
            row.lacks(Says::kRed) + row.lacks(Says::kGreen) + row.lacks(Says::kBlue);
        if (lacking != 0 && lacking != 3)
            return wrong("a colour needs all of red, green and blue, or none");
        if (lacking == 3) {
            without_color_.push_back(ready_.colors.size());
            ready_.colors.emplace_back(1.0f);
            return std::nullopt;
        }
        color = {to_float(row[Says::kRed]), to_float(row[Says::kGreen]),
                 to_float(row[Says::kBlue])};
    } else if (has(Says::kHarmonicRed)) {
        // 1 / (2 sqrt(pi)), the first of the harmonics; splats are white where their sum is 1.
        constexpr double kFirst = 0.28209479177387814;
        const auto shade = [&](Says says) {
            return to_float(std::clamp(0.5 + kFirst * row[says], 0.0, 1.0));
        };
        color = {shade(Says::kHarmonicRed), shade(Says::kHarmonicGreen),
                 shade(Says::kHarmonicBlue)};
    } else {
        return std::nullopt;
    }
    all_white_ = all_white_ && color == glm::vec3(1.0f);
    all_whole_ = all_whole_ && glm::floor(color) == color;
    largest_color_ = std::max({largest_color_, color.x, color.y, color.z});
    ready_.colors.push_back(color);
    return std::nullopt;
}

Status ReadyColumns::add(const ReadyRow& row) {
    const float radius = radius_of(row);
    if (Status failed = add_density(row, radius)) return failed;
    if (Status failed = add_color(row)) return failed;
    ready_.positions.emplace_back(row[Says::kX], row[Says::kY], row[Says::kZ]);
    ready_.radii.push_back(radius);
    return std::nullopt;
}

// Where no density is given: the mean of those that are.
void ReadyColumns::fill_densities() {
    if (without_density_.empty()) return;
    const std::size_t given = ready_.densities.size() - without_density_.size();
    if (given == 0) {
        ready_.densities.clear();
        drop(Says::kDensity);
        drop(Says::kOpacity);
        return note("not used: the column of densities, which is empty");
    }
    double sum = 0;
    for (const float density : ready_.densities) sum += static_cast<double>(density);
    const float mean = to_float(sum / static_cast<double>(given));
    for (const std::size_t i : without_density_) ready_.densities[i] = mean;
    note("density is empty for " + std::to_string(without_density_.size()) + " of " +
         std::to_string(ready_.densities.size()) + " particles, which have the mean of the others");
}

// Colours are 0..1. Where all are whole numbers and some are above that, they were written for 8 bits, or 16.
void ReadyColumns::scale_colors() {
    float white = 1;
    if (all_whole_ && largest_color_ > 1 && largest_color_ <= 65535) {
        white = largest_color_ <= 255 ? 255.0f : 65535.0f;
        note("colours: whole numbers, of which " + std::to_string(static_cast<int>(white)) +
             " is white");
    }
    if (white == 1) return;
    for (glm::vec3& color : ready_.colors) color /= white;
    for (const std::size_t i : without_color_) ready_.colors[i] = glm::vec3(1.0f);
}

SceneDraft ReadyColumns::take() {
    // White is the default, though our own answers write it out.
    if (all_white_) ready_.colors.clear();
    scale_colors();
    fill_densities();
    SceneDraft draft;
    draft.top_level_cubes = false;
    Cloud& cloud = draft.clouds.emplace_back();
    cloud.model = CloudModel::kParticles;
    // The column holds extinction itself.
    if (has(Says::kDensity) || has(Says::kOpacity)) cloud.density = 1.0;
    cloud.ready = std::move(ready_);
    return draft;
}

Error too_many_particles(std::string pointer) {
    return {
        ErrorCode::kTooLarge, std::move(pointer),
        "a scene may have at most " + std::to_string(limits::kMaxParticles) + " particles in all"};
}

}  // namespace awan
