// The rungs of the ladder of accuracy: the words that `accuracy.rung` may have, and how each makes a picture.
#pragma once

#include <span>
#include <string_view>

namespace awan {

enum class Method {
    // Two passes of splats on the renderer (core/light/light.h, core/draw/draw.h).
    kSplats,
    // Transport on a grid, then rays from the eye (core/light/transport.h, core/draw/march.h); no renderer.
    kMarch,
    // The path tracer (core/truth/path_tracer.h); no renderer.
    kPaths,
    // The rules of a published system (core/looks/looks.h); no renderer, not on the ladder.
    kLook,
    // What the clouds are made of, on the renderer (core/draw/display.h); not on the ladder.
    kDisplay,
};

// Whether that needs a renderer.
constexpr bool needs_renderer(Method method) {
    return method == Method::kSplats || method == Method::kDisplay;
}

// Which rung it is: in the order of the ladder, the crudest first.
enum class RungId {
    kAdditive,
    kHarris,
    kSingle,
    kTransport16,
    kTransport24,
    kTransport32,
    kTransport48,
    kTransport64,
    kTruth,
    // What takes the place of a rung where a scene asks for a look, or to be displayed; not on the ladder.
    kLook,
    kDisplay,
};

struct Rung {
    RungId id;
    const char* name;       // in documents
    const char* simulates;  // one phrase, for people
    Method method;
    // Of the transport grid along its longest side; 0: no transport.
    int cells;

    // A rung is known by its id, wherever a copy of it stands in memory.
    friend bool operator==(const Rung& a, const Rung& b) { return a.id == b.id; }
};

// All rungs that a document can name, in the order of RungId.
std::span<const Rung> ladder();

// Any id, kLook and kDisplay too.
const Rung& rung_of(RungId id);

// Null: there is none of that name on the ladder.
const Rung* find_rung(std::string_view name);

}  // namespace awan
