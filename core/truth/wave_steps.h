// What the paths of a wave do alike (wave.h). Included once for each instruction set, after lanes.h, as that is.

// Weight below which paths are absorbed at random.
constexpr float kLight = 0.3f;

AWAN_INLINE Directions directions(const OfWave<float> (&from)[3], std::size_t at) {
    return {loaded(from[0].data() + at), loaded(from[1].data() + at), loaded(from[2].data() + at)};
}
AWAN_INLINE void set(OfWave<float> (&to)[3], std::size_t at, const Directions& d) {
    store(to[0].data() + at, d.x);
    store(to[1].data() + at, d.y);
    store(to[2].data() + at, d.z);
}
AWAN_INLINE Ints ints(const OfWave<std::int32_t>& from, std::size_t at) {
    return load<Ints>(from.data() + at);
}
AWAN_INLINE RandomLanes random_of(const Wave& wave, std::size_t at) {
    RandomLanes random;
    for (int word = 0; word < 4; ++word)
        random.state[word] = load<Bits>(wave.random[word].data() + at);
    return random;
}
AWAN_INLINE void keep_random(Wave& wave, std::size_t at, const Ints& where,
                             const RandomLanes& random) {
    const RandomLanes now = chosen(where, random, random_of(wave, at));
    for (int word = 0; word < 4; ++word) store(wave.random[word].data() + at, now.state[word]);
}

AWAN_INLINE Directions sun_of(const WaveSetting& s) {
    return {all(s.to_sun[0]), all(s.to_sun[1]), all(s.to_sun[2])};
}

// Chance of drawing directions from the sun at a place of that depth: there is little use of them where it does not
// shine, and less of them where the phase function is wide. Measured: more cost more time than they save noise.
AWAN_INLINE Floats worth(const WaveSetting& s, const Floats& depth) {
    const float most = std::min(static_cast<float>(s.from_sun) / 8, 1.0f);
    const Floats less = exp_below(min(0.2f * (6.0f - depth), all(0.0f)));
    return depth > 40.0f ? all(0.0f) : most * less;
}

// What comes through of the sunlight to flights' ends; all with detail, where it is to be found out.
AWAN_INLINE Floats sun_at(const WaveSetting& s, const WaveFlights& flights, std::size_t at) {
    const Floats through = s.detail ? all(1.0f) : exp_below(-loaded(flights.depth.data() + at));
    if (!s.sun_is_below) return through;
    Floats height = all(-s.ground);
    for (int a = 0; a < 3; ++a)
        height += s.up[a] * (static_cast<float>(kBrick) *
                                 __builtin_convertvector(ints(flights.brick[a], at), Floats) +
                             loaded(flights.local[a].data() + at));
    return height > 0.0f ? all(0.0f) : through;
}

// With detail sunlight costs a flight: where hardly any is to be expected, from the depth that is about right, one in
// ten does at least, with ten times the light.
AWAN_INLINE Floats sparing(const Floats& lit, const Floats& depth, RandomLanes& random) {
    const Floats chance = max(exp_below(min(0.5f * (3.0f - depth), all(0.0f))), all(0.1f));
    return unit(random) <= chance ? lit / chance : all(0.0f);
}

AWAN_INLINE Floats largest(const Directions& w) {
    return max(max(w.x, w.y), w.z);
}
AWAN_INLINE Floats mean(const Directions& w) {
    return (w.x + w.y + w.z) * (1.0f / 3);
}

// Absorption: first by weight, which costs no noise. From kLight on at random, with the chance that matter takes, so
// that weights stay where they are: a rarer and heavier path would bring noise in single bright pixels.
AWAN_INLINE void absorb(Wave& wave, std::size_t at, const Ints& here, const Directions& before,
                        Directions weight, RandomLanes& random) {
    const Floats most = largest(weight), least = largest(before);
    const Ints changed =
        here & ((weight.x != before.x) | (weight.y != before.y) | (weight.z != before.z));
    if (!any(changed)) return;
    const Ints light = changed & (most < kLight);
    const Floats chance = min(most / least, all(1.0f));
    Ints dies{};
    if (any(light)) {
        RandomLanes drawn = random;
        dies = light & ~((unit(drawn) <= chance) & (chance > 0.0f));
        random = chosen(light, drawn, random);
    }
    const Floats heavier = light ? 1.0f / chance : all(1.0f);
    weight = {weight.x * heavier, weight.y * heavier, weight.z * heavier};
    const Floats lost = dies ? mean(before) : mean(before) - mean(weight);
    const Floats absorbed = loaded(wave.absorbed.data() + at);
    store(wave.absorbed.data() + at, changed ? absorbed + lost : absorbed);
    store(wave.gone.data() + at, dies);
    set(wave.weight, at, chosen(changed & ~dies, weight, directions(wave.weight, at)));
}

// The start of branches from those paths, which came along d and have that weight.
AWAN_INLINE void branch_off(const WaveSetting& s, Wave& wave, std::size_t at, const Ints& here,
                            const Directions& d, const Directions& weight, RandomLanes& random) {
    const auto most = static_cast<float>(s.from_sun);
    const Floats chance = worth(s, loaded(wave.path.depth.data() + at));
    store(wave.tried.data() + at, chance);
    const Ints begins = here & (unit(random) <= chance) & (chance > 0.0f);
    // 1..from_sun: unit() is never 0, and may be 1.
    Ints many = __builtin_convertvector(unit(random) * most, Ints) + 1;
    many = many > s.from_sun ? Ints{} + s.from_sun : many;
    const auto orders = load<Bits>(wave.orders.data() + at);
    const Ints allowed = orders + Bits(many) <= Bits{} + s.max_orders;
    many = begins & allowed & many;
    store(wave.branch_left.data() + at, many);
    if (!any(many)) return;
    // The phase functions are even in the angle: drawn backwards, a direction has the same density.
    Directions e = sun_of(s), last = e;
    set(wave.from_sun[0], at, e);
    Floats older{};
    for (int i = 1; i <= s.from_sun; ++i) {
        if (!any(many >= i)) break;
        RandomLanes drawn = random;
        e = scattered(s.phase, e, drawn);
        random = chosen(many >= i, drawn, random);
        set(wave.from_sun[i], at, e);
        last = chosen(many == i, e, last);
    }
    // Of the techniques that draw more directions than this branch did, those that the path's length allows.
    for (int i = 0; i < s.from_sun - 1; ++i)
        older += many < s.from_sun - i ? loaded(wave.shares[i].data() + at) : all(0.0f);
    store(wave.branch_sum.data() + at, older + chance / (most * phase_values(s.phase, d, last)));
    set(wave.branch_weight, at, weight);
    for (int a = 0; a < 3; ++a) {
        store(wave.branch.local[a].data() + at, loaded(wave.path.local[a].data() + at));
        store(wave.branch.brick[a].data() + at, ints(wave.path.brick[a], at));
    }
}

inline void scatter_waves(const WaveSetting& s, Wave& wave) {
    for (std::size_t at = 0; at < wave.count; at += kLanes) {
        const Ints here = ints(wave.in_matter, at);
        store(wave.gone.data() + at, Ints{});
        store(wave.branch_left.data() + at, Ints{});
        if (!any(here)) continue;
        RandomLanes random = random_of(wave, at);
        const auto orders = load<Bits>(wave.orders.data() + at);
        store(wave.orders.data() + at, orders - Bits(here));
        const Directions before = directions(wave.weight, at),
                         d = directions(wave.path.direction, at);
        Directions weight{before.x * s.albedo, before.y * s.albedo, before.z * s.albedo};
        if (s.colored) {
            const Directions tint = directions(wave.tint, at);
            weight = {weight.x * tint.x, weight.y * tint.y, weight.z * tint.z};
        }
        set(wave.weight, at, chosen(here, weight, before));
        if (s.sun_shines) {
            Floats sum = 1.0f / phase_values(s.phase, d, sun_of(s));
            for (int i = 0; i < s.from_sun; ++i) sum += loaded(wave.shares[i].data() + at);
            Floats lit = here ? sun_at(s, wave.path, at) / sum : all(0.0f);
            if (s.detail) lit = sparing(lit, loaded(wave.path.depth.data() + at), random);
            const Directions light{weight.x * lit, weight.y * lit, weight.z * lit};
            const Directions all_light = directions(wave.sunlight, at);
            if (s.detail)
                set(wave.lit, at, light);
            else
                set(wave.sunlight, at,
                    {all_light.x + light.x, all_light.y + light.y, all_light.z + light.z});
            if (s.from_sun > 0) branch_off(s, wave, at, here, d, weight, random);
        }
        absorb(wave, at, here, before, weight, random);
        keep_random(wave, at, here, random);
    }
}

inline void follow_branches(const WaveSetting& s, int left, Wave& wave) {
    for (std::size_t at = 0; at < wave.count; at += kLanes) {
        const Ints left_now = ints(wave.branch_left, at), flew = left_now >= left;
        if (!any(flew)) continue;
        const Ints met = flew & (ints(wave.branch.met, at) != 0);
        store(wave.branch_left.data() + at, flew & ~met ? Ints{} : left_now);
        const Directions before = directions(wave.branch_weight, at);
        Directions weight{before.x * s.albedo, before.y * s.albedo, before.z * s.albedo};
        if (s.colored) {
            const Directions tint = directions(wave.tint, at);
            weight = {weight.x * tint.x, weight.y * tint.y, weight.z * tint.z};
        }
        const Floats phase = phase_values(s.phase, directions(wave.from_sun[left], at),
                                          directions(wave.from_sun[left - 1], at));
        const Floats sum = loaded(wave.branch_sum.data() + at);
        if (left > 1) {
            const Floats share = worth(s, loaded(wave.branch.depth.data() + at)) /
                                 (static_cast<float>(s.from_sun) * phase);
            store(wave.branch_sum.data() + at, met ? sum + share : sum);
            set(wave.branch_weight, at, chosen(met, weight, before));
            continue;
        }
        const Floats lit = met ? sun_at(s, wave.branch, at) / (1.0f / phase + sum) : all(0.0f);
        weight = {weight.x * lit, weight.y * lit, weight.z * lit};
        if (s.detail) {
            set(wave.branch_weight, at, weight);
            continue;
        }
        const Directions light = directions(wave.sunlight, at);
        set(wave.sunlight, at,
            chosen(met, {light.x + weight.x, light.y + weight.y, light.z + weight.z}, light));
    }
}

inline void turn_waves(const WaveSetting& s, Wave& wave) {
    for (std::size_t at = 0; at < wave.count; at += kLanes) {
        const Ints here = ints(wave.in_matter, at);
        if (!any(here)) continue;
        RandomLanes random = random_of(wave, at);
        const Directions d = directions(wave.path.direction, at);
        const Directions on = scattered(s.phase, d, random);
        set(wave.path.direction, at, chosen(here, on, d));
        keep_random(wave, at, here, random);
        if (s.from_sun == 0 || !s.sun_shines) continue;
        for (int i = s.from_sun - 1; i > 0; --i)
            store(wave.shares[i].data() + at, loaded(wave.shares[i - 1].data() + at));
        const Floats share = loaded(wave.tried.data() + at) /
                             (static_cast<float>(s.from_sun) * phase_values(s.phase, d, on));
        store(wave.shares[0].data() + at, here ? share : all(0.0f));
    }
}
