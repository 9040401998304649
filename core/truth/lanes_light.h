// How light turns, in lanes. Included once for each instruction set, after lanes.h, as that is.

struct Directions {
    Floats x, y, z;
};
AWAN_INLINE Floats dot(const Directions& a, const Directions& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
AWAN_INLINE Directions chosen(const Ints& first, const Directions& a, const Directions& b) {
    return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}
// Numbers out of a table, a place a lane.
template <typename Element>
AWAN_INLINE auto looked_up(const std::vector<Element>& table, const Ints& at) {
    std::conditional_t<std::is_same_v<Element, float>, Floats, Ints> values{};
    for (int lane = 0; lane < kLanes; ++lane) {
        const Element one = table[static_cast<std::size_t>(at[lane])];
        values[lane] =
            static_cast<std::conditional_t<std::is_same_v<Element, float>, float, std::int32_t>>(
                one);
    }
    return values;
}

// As value() of droplet_law.h.
AWAN_INLINE Floats droplet_values(const DropletLaw& law, const Directions& a, const Directions& b) {
    const Directions apart{a.x - b.x, a.y - b.y, a.z - b.z},
        together{a.x + b.x, a.y + b.y, a.z + b.z};
    const Floats less = 0.5f * dot(apart, apart), more = 0.5f * dot(together, together);
    const Ints behind = more < less;
    const Floats w = min(behind ? more : less, all(1.0f));
    const Bits steps = (bits(1.0f + w * law.stretch) - 0x3f800000u) >> law.shift;
    const auto half = static_cast<std::int32_t>(law.half);
    const Ints step = Ints(steps);
    const Ints at = (step < half ? step : Ints{} + (half - 1)) + (behind ? Ints{} + half : Ints{});
    const Floats part = (w - looked_up(law.from, at)) / looked_up(law.width, at);
    return looked_up(law.p_from, at) +
           min(max(part, all(0.0f)), all(1.0f)) * looked_up(law.p_rise, at);
}

// phase_value (phase_law.h) of the ways before and after, unit.
AWAN_INLINE Floats phase_values(const PhaseLaw& law, const Directions& a, const Directions& b) {
    if (law.droplets) return droplet_values(*law.droplets, a, b);
    const auto g = static_cast<float>(law.g), size = std::abs(g);
    const float sign = g >= 0 ? 1.0f : -1.0f;
    // 1 -+ cosine as half a squared distance, which loses no digits at the peak.
    const Directions apart{a.x - sign * b.x, a.y - sign * b.y, a.z - sign * b.z};
    const Floats base = (1 - size) * (1 - size) + size * dot(apart, apart);
    const Floats hg = ((1 - size) * (1 + size)) / (base * sqrt(base));
    if (!law.cornette_shanks) return hg;
    const Floats cosine = dot(a, b);
    return (1.5f / (2 + g * g)) * (1.0f + cosine * cosine) * hg;
}

// The cosine of a scattering by Henyey & Greenstein, inverted as henyey_greenstein_cosine; 1 - cosine and 1 + cosine
// each without cancellation, at any g:
//     v = 2 u - 1,   1 -+ cosine = (1 -+ g)^2 (1 -+ v) (2 +- g + g v) / (2 (1 + g v)^2).
struct Turn {
    Floats less, more;  // 1 - cosine, 1 + cosine
};
AWAN_INLINE Turn henyey_greenstein_turn(float g, const Floats& u) {
    const Floats v = 2.0f * u - 1.0f, below = 1.0f + g * v;
    const Floats per = 0.5f / (below * below), rise = g * v;
    return {((1 - g) * (1 - g)) * (2.0f - 2.0f * u) * ((2 + g) + rise) * per,
            ((1 + g) * (1 + g)) * (2.0f * u) * ((2 - g) + rise) * per};
}

// As droplet_cosine of phase_law.h.
AWAN_INLINE Turn droplet_turn(const DropletLaw& law, RandomLanes& random) {
    const auto count = static_cast<std::int32_t>(law.keep.size());
    const Ints drawn = __builtin_convertvector(unit(random) * static_cast<float>(count), Ints);
    const Ints first = drawn < count ? drawn : Ints{} + (count - 1);
    const Ints at = unit(random) > looked_up(law.keep, first) ? looked_up(law.other, first) : first;
    const Floats low = looked_up(law.p_from, at), high = low + looked_up(law.p_rise, at),
                 u = unit(random);
    const Floats part = u * (low + high) / (low + sqrt(low * low + u * (high * high - low * low)));
    const Floats w = looked_up(law.from, at) + min(part, all(1.0f)) * looked_up(law.width, at);
    const Ints ahead = at < static_cast<std::int32_t>(law.half);
    return {ahead ? w : 2.0f - w, ahead ? 2.0f - w : w};
}

// `d` turned so, evenly about itself. Basis: Duff et al. 2017.
AWAN_INLINE Directions turned(const Directions& d, const Turn& turn, RandomLanes& random) {
    const Bits word = next(random);
    // Within an eighth of a circle to both sides, then by quarters: two bits say how many.
    const Bits within = (word << 2) >> 8;
    const Floats a = (__builtin_convertvector(Ints(within), Floats) * 0x1p-24f - 0.5f) *
                     (std::numbers::pi_v<float> / 2);
    const Floats aa = a * a;
    const Floats s = a * (1.0f - aa * ((1.0f / 6) - aa * ((1.0f / 120) - aa * (1.0f / 5040))));
    const Floats c =
        1.0f - aa * (0.5f - aa * ((1.0f / 24) - aa * ((1.0f / 720) - aa * (1.0f / 40320))));
    const Ints quarter = Ints(word) < 0;
    const Bits half = (word << 1) & 0x80000000u;
    const Floats cosine = floats(bits(quarter ? -s : c) ^ half);
    const Floats sine = floats(bits(quarter ? c : s) ^ half);

    const Floats ahead = 1.0f - turn.less;
    const Floats aside = sqrt(max(turn.less * turn.more, all(0.0f)));
    const Floats x = aside * cosine, y = aside * sine;
    const Floats sign = d.z < 0.0f ? all(-1.0f) : all(1.0f);
    const Floats k = -1.0f / (sign + d.z), b = d.x * d.y * k;
    Directions out{x * (1.0f + sign * d.x * d.x * k) + y * b + ahead * d.x,
                   x * sign * b + y * (sign + d.y * d.y * k) + ahead * d.y,
                   -x * sign * d.x - y * d.y + ahead * d.z};
    // A step of Newton's towards unit length, so that rounding does not gather.
    const Floats scale = 1.5f - 0.5f * dot(out, out);
    out = {out.x * scale, out.y * scale, out.z * scale};
    return out;
}

// Where light that came along `d` goes on.
AWAN_INLINE Directions scattered(const PhaseLaw& law, const Directions& d, RandomLanes& random) {
    if (law.droplets) return turned(d, droplet_turn(*law.droplets, random), random);
    const auto g = static_cast<float>(law.g);
    Turn turn = henyey_greenstein_turn(g, unit(random));
    if (law.cornette_shanks) {
        Ints refused = ~Ints{};
        // A draw is refused with probability .5 at most: 128 never all are.
        for (int draw = 0; draw < 128; ++draw) {
            const Floats cosine = 1.0f - turn.less;
            RandomLanes drawn = random;
            const Ints still = refused & (2.0f * unit(drawn) > 1.0f + cosine * cosine);
            const Turn other = henyey_greenstein_turn(g, unit(drawn));
            random = chosen(refused, drawn, random);
            refused = still;
            if (!any(refused)) break;
            turn = {refused ? other.less : turn.less, refused ? other.more : turn.more};
        }
    }
    return turned(d, turn, random);
}
