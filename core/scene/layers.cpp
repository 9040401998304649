#include "core/scene/layers.h"

#include <algorithm>
#include <iterator>

namespace awan {

std::optional<Layers> read_layers(std::string_view text) {
    Layers layers;
    if (text == "none") return layers;
    if (text == "all") {
        for (int i = 0; i < kLayerCount; ++i) layers.add(static_cast<Layer>(i));
        return layers;
    }
    while (true) {
        const std::size_t comma = text.find(',');
        const std::string_view word = text.substr(0, comma);
        const auto found = std::find(std::begin(kLayerWords), std::end(kLayerWords), word);
        if (found == std::end(kLayerWords)) return std::nullopt;
        layers.add(static_cast<Layer>(found - std::begin(kLayerWords)));
        if (comma == std::string_view::npos) return layers;
        text.remove_prefix(comma + 1);
    }
}

}  // namespace awan
