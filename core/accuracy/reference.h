// The picture that all rungs are measured against: truth by rung truth's path tracer, as large and as free of noise
// as the time allows.
#pragma once

#include <cstdint>
#include <vector>

#include "core/accuracy/accuracy.h"
#include "core/accuracy/accuracy_pictures.h"
#include "core/accuracy/steps.h"
#include "core/light/ground_light.h"
#include "core/truth/path_tracer.h"

namespace awan {

// How large the reference is and how many paths a pixel it has.
struct ReferenceShape {
    PictureSize size;
    std::uint32_t samples = 2;
    double expected_ms = 0;  // 0: unknown
};

// As the options ask, or what fits into `allowed_ms` (infinite: no limit): fewer samples first, then fewer pixels.
// Errors: of trace_truth.
Result<ReferenceShape> reference_shape(const Scene& scene, const Planned& planned,
                                       const AccuracyOptions& options, double allowed_ms,
                                       const Deadline& deadline);

struct Reference {
    // Of the reference's size, over nothing; asks for no rung by itself.
    Scene scene;
    View view;
    TruthImage truth;
    // Of `truth`, and the samples of its PNG over sky and ground.
    Image mean;
    std::vector<std::uint8_t> shown;
    // Lies under every picture that is compared, the same: what differs is the cloud alone.
    GroundLight ground;
    std::uint32_t samples = 0;
    double time_ms = 0;
    // Of all threads of the process, whatever else it did meanwhile.
    double cpu_ms = 0;
};

// Traces it. planned: of `scene`; gets the detail that shows at its own size. film: for `shown`.
// Begins the step "tracing the reference". Errors: of trace_truth.
Result<Reference> trace_reference(const Scene& scene, Planned& planned, const ReferenceShape& shape,
                                  const AccuracyOptions& options, const FilmSettings& film,
                                  Steps& steps, const Deadline& deadline);

}  // namespace awan
