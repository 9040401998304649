// Trilinear values within a brick of matter.h, four floats at a time by GCC's vector extensions: the same IEEE
// operations on every machine.
#pragma once

#include <algorithm>
#include <cstring>
#include <glm/vec3.hpp>

#include "core/truth/matter.h"

namespace awan::truth {

using Four = float __attribute__((vector_size(16)));

// Where in a brick: its cell's first node, and the place within the cell, 0..1.
struct InCell {
    std::size_t node;
    float x, y, z;
};

// u, v, w: cells from the brick's first node, cut to the brick.
inline InCell in_cell(std::uint32_t nodes, float u, float v, float w) {
    const auto cut = [](float at) { return std::clamp(at, 0.0f, static_cast<float>(kBrick)); };
    u = cut(u);
    v = cut(v);
    w = cut(w);
    const int i = std::min(static_cast<int>(u), kBrick - 1);
    const int j = std::min(static_cast<int>(v), kBrick - 1);
    const int k = std::min(static_cast<int>(w), kBrick - 1);
    return {
        kBrickStride * nodes + static_cast<std::size_t>((i * kBrickNodes + j) * kBrickNodes + k),
        u - static_cast<float>(i), v - static_cast<float>(j), w - static_cast<float>(k)};
}

struct Sampled {
    float extinction, depth;
};

// The smooth field and its depth (matter.h).
inline Sampled sampled(const Matter& m, const InCell& at) {
    const Node* first = m.nodes.data() + at.node;
    // Two nodes in a row: extinction, depth, extinction, depth.
    const auto row = [&](int along_x, int along_y) {
        Four v;
        std::memcpy(&v, first + (along_x * kBrickNodes + along_y) * kBrickNodes, sizeof v);
        return v;
    };
    const Four a = row(0, 0) + at.y * (row(0, 1) - row(0, 0));
    const Four b = row(1, 0) + at.y * (row(1, 1) - row(1, 0));
    const Four v = a + at.x * (b - a);
    const float rise = v[2] - v[0];
    return {v[0] + at.z * rise, v[1] + at.z * (v[0] + 0.5f * at.z * rise)};
}

}  // namespace awan::truth
