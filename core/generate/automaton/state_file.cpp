#include "core/generate/automaton/state_file.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "core/generate/keyed_random.h"
#include "core/scene/limits.h"

namespace awan::automaton {
namespace {

static_assert(std::endian::native == std::endian::little);

// The bytes "AWANSTA1".
constexpr std::uint64_t kMagic = 0x314154534e415741u;
constexpr std::uint64_t kVersion = 1;
// The words before the ellipsoids.
constexpr std::size_t kHead = 10;

class Writer {
  public:
    void word(std::uint64_t value) {
        sum_ = keyed(sum_, value);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void number(double value) { word(std::bit_cast<std::uint64_t>(value)); }
    void vector(const glm::dvec3& v) {
        for (int axis = 0; axis < 3; ++axis) number(v[axis]);
    }
    void words(const std::vector<std::uint64_t>& values) {
        for (const std::uint64_t value : values) word(value);
    }
    std::string end() {
        word(sum_);
        return std::move(bytes_);
    }

  private:
    std::string bytes_;
    std::uint64_t sum_ = kMagic;
};

// Reads words one after the other. Precondition of every call: that many words are left.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}
    std::uint64_t word() {
        std::uint64_t value;
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    glm::dvec3 vector() {
        glm::dvec3 v;
        for (int axis = 0; axis < 3; ++axis) v[axis] = std::bit_cast<double>(word());
        return v;
    }
    std::vector<std::uint64_t> words(std::size_t count) {
        std::vector<std::uint64_t> values(count);
        std::memcpy(values.data(), bytes_.data() + at_, count * sizeof values[0]);
        at_ += count * sizeof values[0];
        return values;
    }

  private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

Error malformed(const std::string& what) {
    return {ErrorCode::kMalformed, "", "not a state of an automaton: " + what};
}

bool sum_is_right(std::string_view bytes) {
    Reader reader(bytes);
    std::uint64_t sum = kMagic;
    for (std::size_t n = 1; n < bytes.size() / 8; ++n) sum = keyed(sum, reader.word());
    return reader.word() == sum;
}

bool is_side(std::uint64_t cells) {
    return cells >= 1 && cells <= static_cast<std::uint64_t>(limits::kMaxAutomatonSide);
}

bool possible(const AutomatonEllipsoid& ellipsoid) {
    // Farther than winds can carry anything in all steps.
    constexpr double kFar = 1e15;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(ellipsoid.center[axis]) <= kFar)) return false;
        if (!(ellipsoid.radii[axis] > 0 &&
              ellipsoid.radii[axis] <= 2 * limits::kMaxAutomatonRadius))
            return false;
    }
    return true;
}

bool has_bits_beyond(const AutomatonGrid& grid, const std::vector<std::uint64_t>& bits) {
    for (std::size_t w = grid.words - 1; w < bits.size(); w += grid.words)
        if ((bits[w] & ~grid.last_mask()) != 0) return true;
    return false;
}

}  // namespace

std::string write_state(const AutomatonState& state) {
    Writer writer;
    for (const std::uint64_t word :
         {kMagic, kVersion, state.nx, state.ny, state.nz, state.key, state.rules, state.step,
          std::uint64_t{state.earlier.size()}, std::uint64_t{state.ellipsoids.size()}})
        writer.word(word);
    for (const AutomatonEllipsoid& ellipsoid : state.ellipsoids) {
        writer.vector(ellipsoid.center);
        writer.vector(ellipsoid.radii);
    }
    for (const auto* bits : {&state.hum, &state.act, &state.cld}) writer.words(*bits);
    for (const auto& sky : state.earlier) writer.words(sky);
    return writer.end();
}

Result<AutomatonState> read_state(std::string_view bytes) {
    Reader reader(bytes);
    if (bytes.size() < 8 || reader.word() != kMagic) return malformed("it begins otherwise");
    if (bytes.size() % 8 != 0 || bytes.size() < (kHead + 1) * 8)
        return malformed("it ends too early");
    const std::uint64_t version = reader.word();
    if (version != kVersion)
        return malformed("its version is " + std::to_string(version) + ", this program reads " +
                         std::to_string(kVersion));
    const std::uint64_t nx = reader.word(), ny = reader.word(), nz = reader.word();
    if (!is_side(nx) || !is_side(ny) || !is_side(nz) ||
        static_cast<double>(nx * ny * nz) > limits::kMaxAutomatonCells)
        return malformed("it has more cells than there may be, or none");
    const AutomatonGrid grid(
        glm::dvec3(static_cast<double>(nx), static_cast<double>(ny), static_cast<double>(nz)));
    AutomatonState state;
    state.nx = nx, state.ny = ny, state.nz = nz;
    state.key = reader.word();
    state.rules = reader.word();
    state.step = reader.word();
    const std::uint64_t earlier = reader.word(), ellipsoids = reader.word();
    if (state.step > limits::kMaxAutomatonSteps || earlier >= limits::kMaxAutomatonHistory ||
        ellipsoids > limits::kMaxAutomatonEllipsoids)
        return malformed("it has more steps, skies or ellipsoids than there may be");
    const std::size_t words = kHead + 6 * ellipsoids + (3 + earlier) * grid.all_words() + 1;
    if (bytes.size() != words * 8)
        return malformed("it has " + std::to_string(bytes.size()) + " bytes, its sizes ask for " +
                         std::to_string(words * 8));
    if (!sum_is_right(bytes)) return malformed("it is damaged, its sum is another");
    for (std::uint64_t n = 0; n < ellipsoids; ++n) {
        const glm::dvec3 center = reader.vector(), radii = reader.vector();
        state.ellipsoids.push_back({center, radii});
        if (!possible(state.ellipsoids.back())) return malformed("an ellipsoid cannot be");
    }
    for (auto* bits : {&state.hum, &state.act, &state.cld}) *bits = reader.words(grid.all_words());
    for (std::uint64_t n = 0; n < earlier; ++n)
        state.earlier.push_back(reader.words(grid.all_words()));
    bool beyond = false;
    for (const auto* bits : {&state.hum, &state.act, &state.cld})
        beyond |= has_bits_beyond(grid, *bits);
    for (const auto& sky : state.earlier) beyond |= has_bits_beyond(grid, sky);
    if (beyond) return malformed("it has bits where there are no cells");
    return state;
}

}  // namespace awan::automaton
