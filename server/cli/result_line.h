// What came of a render, in a line: for people, or as JSON for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pipeline.h"

namespace awan {

struct PictureResult {
    std::string scene;
    // The files that hold it.
    std::vector<std::string> outputs;
    std::optional<std::uint64_t> frame;
    // They were there already, and nothing was rendered.
    bool skipped = false;
    double encode_ms = 0;
};

// {"scene","outputs","frame","skipped","digest","width","height","particles","rung","error","error_forecast",
// "times_ms":{...}} and a line feed; null for an error that is not known. rendered: null when it was skipped.
std::string result_json(const PictureResult& result, const Scene& scene, const Rendered* rendered);

// "a.png: transport-32, error 4.2% (expected 5%)"; EMPTY for a look, which has no error.
std::string result_text(const std::string& output, const Rendered& rendered);

}  // namespace awan
