#include "core/plan/transport_settings.h"

#include <algorithm>

namespace awan {

TransportSettings transport_settings(const Rung& rung) {
    TransportSettings settings;
    settings.cells = rung.cells;
    settings.sun_cells = std::clamp(3 * rung.cells, 64, 128);
    return settings;
}

}  // namespace awan
