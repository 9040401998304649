// Lumps of detail (core/generate/detail.h) at the places of flights, a flight a lane. Included once for each
// instruction set, after lanes.h, as that is.

// What a matter's detail is along any flight, in cells of the lattice.
struct DetailLanes {
    explicit DetailLanes(const Matter& m) {
        if (!m.detail) return;
        const DetailField& field = *m.detail;
        words = field.tile->data();
        to_tile = field.to_tile * (m.cell * glm::transpose(m.axes));
        start = field.to_tile * (m.origin - field.origin) - to_tile * m.shift;
        const auto edge = static_cast<float>(static_cast<double>(field.edge) * m.cell);
        per_edge = 1 / edge;
        keep = field.keep;
        whole = keep * edge;
    }

    // Null: there is none.
    const std::uint32_t* words = nullptr;
    // From q to voxels: to_tile * q + start.
    glm::dmat3 to_tile{1};
    glm::dvec3 start{0};
    // Extinctions a cell: 1 / edge, and that of a lump of extinction `edge`.
    float per_edge = 1, whole = 1, keep = 1;

    // The voxel of q along an axis, in the tile.
    static float within(double voxel) {
        constexpr double kSide = kDetailSide;
        // Far out no digits are left, and any place is as good.
        return static_cast<float>(voxel - kSide * std::floor(voxel * (1 / kSide)));
    }
};

// n at voxels of the tile, trilinear as bumps_at; those lanes alone are looked up, others have anything.
AWAN_INLINE Floats bumps_in(const DetailLanes& detail, const Ints& lanes,
                            const Floats (&voxel)[3]) {
    constexpr auto kSide = static_cast<float>(kDetailSide);
    Ints low[3];
    Floats part[3];
    for (int a = 0; a < 3; ++a) {
        const Floats turns = voxel[a] * (1 / kSide);
        Ints whole = __builtin_convertvector(turns, Ints);
        whole += __builtin_convertvector(whole, Floats) > turns;
        const Floats in = voxel[a] - __builtin_convertvector(whole, Floats) * kSide;
        const Floats kept = min(max(in, all(0.0f)), all(kSide * 0.9999999f));
        low[a] = __builtin_convertvector(kept, Ints);
        part[a] = kept - __builtin_convertvector(low[a], Floats);
    }
    alignas(64) std::int32_t index[kLanes];
    alignas(64) std::int32_t near[kLanes]{}, far[kLanes]{};
    store(index, (low[2] * kDetailSide + low[1]) * kDetailSide + low[0]);
    each_lane(lanes, [&](std::size_t lane) {
        const std::uint32_t* const word = detail.words + index[lane];
        near[lane] = static_cast<std::int32_t>(word[0]);
        far[lane] = static_cast<std::int32_t>(word[kDetailSide * kDetailSide]);
    });
    const auto layer = [&](const std::int32_t* from) __attribute__((always_inline)) {
        const Ints w = load<Ints>(from);
        const Floats a = __builtin_convertvector(w & 255, Floats);
        const Floats b = __builtin_convertvector(w >> 8 & 255, Floats);
        const Floats c = __builtin_convertvector(w >> 16 & 255, Floats);
        const Floats d = __builtin_convertvector(w >> 24 & 255, Floats);
        const Floats low_y = a + part[0] * (b - a), high_y = c + part[0] * (d - c);
        return low_y + part[1] * (high_y - low_y);
    };
    const Floats a = layer(near), b = layer(far);
    return (a + part[2] * (b - a) + 0.5f) * (1.0f / 256);
}

// The extinction with detail at those lanes' places, from the smooth one, as detailed(); but 0 where it is not above
// `least`: most of these need no bumps. place(): the voxels.
template <typename Place>
AWAN_INLINE Floats with_detail(const DetailLanes& detail, const Ints& lanes, const Floats& smooth,
                               const Floats& least, const Place& place) {
    constexpr float w = kSoftness;
    const Floats u = smooth * detail.per_edge, v = 2.0f * u / (1.0f + u);
    const Ints thin = u < 1.0f;
    // gathered_share(v).
    const Floats begins = 1.0f - v * (1 + w), ends = begins + w, rest = 1.0f - begins;
    const Floats share = begins >= 1 - w    ? rest * rest * (1 / (2 * w))
                         : (begins >= 0.0f) ? rest - 0.5f * w
                                            : 1.0f - ends * ends * (1 / (2 * w));
    const Floats lump = detail.whole * min(u / max(share, all(1e-20f)), all(kMostGathered));
    const Ints wanted = lanes & thin & (lump > least) & (smooth > 0.0f);
    Floats gathered{};
    if (any(wanted)) {
        Floats voxel[3];
        place(voxel);
        const Floats n = bumps_in(detail, wanted, voxel);
        const Floats ramp = min(max((n - begins) * (1 / w), all(0.0f)), all(1.0f));
        gathered = wanted ? lump * ramp : all(0.0f);
    }
    return thin ? gathered : detail.keep * smooth;
}
