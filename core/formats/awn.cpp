#include "core/formats/awn.h"

#include <cstdint>

#include "core/formats/numbers.h"
#include "core/formats/particle_files.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// Splits a line into its numbers. A comma with no number on either side is a number that got lost,
// not a separator.
class Tokens {
  public:
    explicit Tokens(std::string_view line) : rest_(trim(line)) {}

    bool done() const { return rest_.empty(); }

    // The next token; empty where a comma stands without a number before or after it.
    std::string_view next() {
        std::size_t length = 0;
        while (length < rest_.size() && rest_[length] != ',' && !is_blank(rest_[length])) ++length;
        const std::string_view token = rest_.substr(0, length);
        rest_ = trim(rest_.substr(length));
        if (!rest_.empty() && rest_.front() == ',') {
            rest_ = trim(rest_.substr(1));
            // A comma with nothing behind it: the next token is empty.
            if (rest_.empty()) rest_ = ",";
        }
        return token;
    }

  private:
    std::string_view rest_;
};

Result<std::uint64_t> read_header(std::string_view line, std::size_t number, const char* what) {
    Tokens tokens(line);
    const std::string_view token = tokens.next();
    const std::optional<std::uint64_t> value = read_number<std::uint64_t>(token);
    if (!value)
        return at_line(number, std::string("must be the ") + what + ", an integer >= 0, not " +
                                   short_quote(token));
    if (!tokens.done()) return at_line(number, std::string("must hold one number, the ") + what);
    return *value;
}

Result<Cube> read_cube(std::string_view line, std::size_t number) {
    static constexpr const char* kColumns[] = {"particles", "x-length", "y-length", "z-length",
                                               "cx",        "cy",       "cz",       "max radius"};
    Cube cube;
    double* const values[] = {nullptr,        &cube.size.x,   &cube.size.y,   &cube.size.z,
                              &cube.center.x, &cube.center.y, &cube.center.z, &cube.radius};
    Tokens tokens(line);
    for (std::size_t i = 0; i < std::size(kColumns); ++i) {
        if (tokens.done())
            return at_line(number,
                           "must hold 8 numbers (particles, 3 lengths, 3 of the centre, "
                           "max radius), not " +
                               std::to_string(i));
        const std::string_view token = tokens.next();
        if (i == 0) {
            const std::optional<std::uint64_t> count = read_number<std::uint64_t>(token);
            if (!count)
                return at_line(number,
                               "particles must be an integer >= 0, not " + short_quote(token));
            cube.particles = *count;
        } else {
            const std::optional<double> value = read_number<double>(token);
            if (!value)
                return at_line(number, std::string(kColumns[i]) + " must be a finite number, not " +
                                           short_quote(token));
            *values[i] = *value;
        }
    }
    if (!tokens.done())
        return at_line(number,
                       "must hold 8 numbers (particles, 3 lengths, 3 of the centre, max "
                       "radius); there are more");
    return cube;
}

}  // namespace

Result<SceneDraft> read_awn(std::string_view text) {
    text = without_byte_order_mark(text);
    std::uint64_t total = 0, count = 0;
    std::size_t total_line = 0, count_line = 0, number = 0;
    SceneDraft draft;
    std::vector<Cube>& cubes = draft.clouds.emplace_back().cubes;

    // Nothing is reserved from the header: it may claim anything.
    while (!text.empty()) {
        const std::string_view line = trim(take_line(text));
        ++number;
        if (line.empty()) continue;
        if (total_line == 0) {
            const Result<std::uint64_t> value = read_header(line, number, "total of particles");
            if (!value) return value.error();
            total = *value;
            total_line = number;
        } else if (count_line == 0) {
            const Result<std::uint64_t> value = read_header(line, number, "number of cubes");
            if (!value) return value.error();
            count = *value;
            count_line = number;
        } else {
            if (cubes.size() == limits::kMaxCubes)
                return Error{
                    ErrorCode::kInvalidScene, "line " + std::to_string(number),
                    "a scene may have at most " + std::to_string(limits::kMaxCubes) + " cubes"};
            const Result<Cube> cube = read_cube(line, number);
            if (!cube) return cube.error();
            cubes.push_back(*cube);
        }
    }
    if (total_line == 0) return at_line(1, "must be the total of particles; the layout is empty");
    if (count_line == 0) return at_line(number + 1, "must be the number of cubes; the layout ends");
    if (count != cubes.size())
        return at_line(count_line, "the header says " + std::to_string(count) +
                                       " cubes, but there are lines for " +
                                       std::to_string(cubes.size()));
    if (const std::uint64_t sum = particle_count(draft); total != sum)
        return at_line(total_line, "the header says " + std::to_string(total) +
                                       " particles in all, but the cubes have " +
                                       std::to_string(sum));
    return draft;
}

Result<std::string> write_awn(const SceneDraft& scene) {
    const auto too_rich = [](std::string pointer, const char* message) {
        return Error{ErrorCode::kInvalidScene, std::move(pointer), message};
    };
    if (scene.clouds.size() != 1)
        return too_rich(scene.top_level_cubes ? "" : "/clouds",
                        "an .awn layout holds exactly one cloud");
    const Cloud& cloud = scene.clouds.front();
    const std::string at = scene.top_level_cubes ? "" : "/clouds/0";
    if (cloud.model != CloudModel::kCubes)
        return too_rich(at + "/model", "an .awn layout holds cubes only");
    if (cloud.translate != glm::dvec3(0))
        return too_rich(at + "/translate", "an .awn layout cannot move its cloud");
    if (cloud.scale != 1) return too_rich(at + "/scale", "an .awn layout cannot scale its cloud");
    if (cloud.rotate_y != 0)
        return too_rich(at + "/rotate_y", "an .awn layout cannot turn its cloud");

    std::string out =
        std::to_string(particle_count(scene)) + "\n" + std::to_string(cloud.cubes.size()) + "\n";
    for (std::size_t i = 0; i < cloud.cubes.size(); ++i) {
        const Cube& cube = cloud.cubes[i];
        if (cube.density != 1)
            return too_rich(at + "/cubes/" + std::to_string(i) + "/density",
                            "a cube of an .awn layout has no density of its own");
        if (!texture_of(scene, cloud, &cube).empty())
            return too_rich(at + "/cubes/" + std::to_string(i) + "/texture",
                            "a cube of an .awn layout has no texture; an .awa layout has");
        out += std::to_string(cube.particles);
        for (const double value : {cube.size.x, cube.size.y, cube.size.z, cube.center.x,
                                   cube.center.y, cube.center.z, cube.radius}) {
            out += ", ";
            append_number(value, out);
        }
        out += '\n';
    }
    return out;
}

}  // namespace awan
