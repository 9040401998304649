// Lanes of floats, a path in each: random numbers and elementary functions.
//
// No header like others: it is included once for each instruction set, inside a namespace and a region that chooses the
// set (for_each_target.h). For where a processor has no instruction for an operator of vectors, GCC takes it apart
// before anything is inlined: code that was written outside of the region would be for the plainest processor in all of
// them. The operations are the same IEEE ones in every set, however many lanes go at a time, and so are the bytes.
//
// Expected in the namespace: kLanes, Floats, Ints, Bits, sqrt, lanes_of (for_each_target.h).

// Vectors in memory, of any alignment.
template <typename Vector, typename Element>
AWAN_INLINE Vector load(const Element* from) {
    Vector v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
template <typename Vector, typename Element>
AWAN_INLINE void store(Element* to, const Vector& v) {
    std::memcpy(to, &v, sizeof v);
}
AWAN_INLINE Floats loaded(const float* from) {
    return load<Floats>(from);
}

AWAN_INLINE Floats all(float x) {
    return Floats{} + x;
}
AWAN_INLINE Floats min(const Floats& a, const Floats& b) {
    return a < b ? a : b;
}
AWAN_INLINE Floats max(const Floats& a, const Floats& b) {
    return a > b ? a : b;
}
AWAN_INLINE Bits bits(const Floats& x) {
    return Bits(x);
}
AWAN_INLINE Floats floats(const Bits& x) {
    return Floats(x);
}
AWAN_INLINE Floats abs(const Floats& x) {
    return floats(bits(x) & 0x7fffffffu);
}
AWAN_INLINE bool any(const Ints& mask) {
    return lanes_of(mask) != 0;
}
// visit(lane) for each lane of a mask, from the first on.
template <typename Visit>
AWAN_INLINE void each_lane(const Ints& mask, const Visit& visit) {
    for (std::uint32_t left = lanes_of(mask); left != 0; left &= left - 1)
        visit(static_cast<std::size_t>(__builtin_ctz(left)));
}

// The state of xoshiro128+ (Blackman & Vigna 2021) of each lane's path: 128 bits, seeded by its key. Its lowest bits
// are weak and not used.
struct RandomLanes {
    Bits state[4];
};

AWAN_INLINE Bits next(RandomLanes& random) {
    Bits* s = random.state;
    const Bits result = s[0] + s[3], shifted = s[1] << 9;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= shifted;
    s[3] = (s[3] << 11) | (s[3] >> 21);
    return result;
}

AWAN_INLINE RandomLanes chosen(const Ints& first, const RandomLanes& a, const RandomLanes& b) {
    const Bits mask = Bits(first);
    RandomLanes random;
    for (int word = 0; word < 4; ++word)
        random.state[word] = (mask & a.state[word]) | (~mask & b.state[word]);
    return random;
}

// Uniform in (0, 1], 24 bits.
AWAN_INLINE Floats unit(RandomLanes& random) {
    const Bits whole = next(random) >> 8;
    return (__builtin_convertvector(Ints(whole), Floats) + 1.0f) * 0x1p-24f;
}

// exp(x) for x <= 0, constant below -86; relative error < 4e-7. x = n ln 2 + r, |r| <= ln 2 / 2, ln 2 in two parts
// (Cody & Waite 1980): 2^n is made from the exponent's bits, exp(r) by its series.
AWAN_INLINE Floats exp_below(const Floats& at) {
    // 1.5 * 2^23: a sum with it is rounded to an integer.
    constexpr float kShift = 12582912.0f;
    const Floats x = max(at, all(-86.0f));
    const Floats shifted = x * std::numbers::log2e_v<float> + kShift;
    const Floats n = shifted - kShift;
    const Floats r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
    Floats p = all(1.0f / 720);
    for (const float c : {1.0f / 120, 1.0f / 24, 1.0f / 6, 0.5f, 1.0f, 1.0f}) p = p * r + c;
    return floats(bits(p) + (bits(shifted) << 23));
}

// -ln(u), u in (0, 1] and normal; relative error < 2e-6. u = 2^n m, 1 / sqrt 2 <= m < sqrt 2, ln m = 2 artanh((m - 1) /
// (m + 1)) by its series.
AWAN_INLINE Floats minus_log(const Floats& u) {
    const Bits b = bits(u) - 0x3f3504f3u;
    const Floats n = __builtin_convertvector(Ints(b) >> 23, Floats);
    const Floats m = floats((b & 0x007fffffu) + 0x3f3504f3u);
    const Floats f = (m - 1.0f) / (m + 1.0f), ff = f * f;
    const Floats series =
        1.0f + ff * ((1.0f / 3) + ff * ((1.0f / 5) + ff * ((1.0f / 7) + ff * (1.0f / 9))));
    return -(n * std::numbers::ln2_v<float> + 2.0f * f * series);
}
