// The rungs of accuracy, cheapest first.
#pragma once

#include <span>
#include <string_view>

namespace awan {

enum class Method {
    kSplats,  // the two passes of splats on the renderer (core/light/light.h, core/draw/draw.h)
    kMarch,  // transport on a grid and the march (core/light/transport.h, core/draw/march.h); no renderer
    kPaths,  // the path tracer (core/truth/path_tracer.h); no renderer
    kLook,   // the rules of a published system (core/looks/looks.h); no renderer, not on the ladder
};

struct Rung {
    const char* name;       // in documents
    const char* simulates;  // one phrase, for people
    Method method;
    int cells;  // of the transport grid along its longest side; 0: no transport
};

std::span<const Rung> ladder();
// What takes the place of a rung where a scene asks for a look.
const Rung& look_rung();

const Rung* find_rung(std::string_view name);  // null: there is none of that name

}  // namespace awan
