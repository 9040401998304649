#include "core/pipeline.h"

#include <chrono>
#include <utility>

#include "core/draw/draw.h"
#include "core/generate/generate.h"
#include "core/light/light.h"

namespace awan {
namespace {

// Runs a stage and notes its wall time.
template <typename Stage>
auto timed(double& milliseconds, const Stage& stage) {
    const auto start = std::chrono::steady_clock::now();
    auto result = stage();
    milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace

Result<Planned> plan_scene(const Scene& scene, int threads, const Deadline& deadline) {
    Planned planned;
    auto particles =
        timed(planned.times.generate_ms, [&] { return generate(scene, threads, deadline); });
    if (!particles.ok()) return particles.error();
    planned.particles = *std::move(particles);
    auto surveyed = timed(planned.times.survey_ms,
                          [&] { return survey(scene, planned.particles, threads, deadline); });
    if (!surveyed.ok()) return surveyed.error();
    planned.survey = *std::move(surveyed);
    planned.plan = plan(scene, planned.survey);
    return planned;
}

Result<Rendered> render_planned(const Scene& scene, Planned planned, Device& device,
                                const Deadline& deadline) {
    Rendered rendered{std::move(planned.survey), std::move(planned.plan), {}, planned.times};
    auto lighting = timed(rendered.times.light_ms, [&] {
        return light(scene, planned.particles, rendered.plan, device, deadline);
    });
    if (!lighting.ok()) return lighting.error();
    auto image = timed(rendered.times.draw_ms, [&] {
        return draw(scene, planned.particles, rendered.survey.view, rendered.plan, *lighting,
                    device, deadline);
    });
    if (!image.ok()) return image.error();
    rendered.image = *std::move(image);
    rendered.survey.volume.extinction = {};
    return rendered;
}

Result<Rendered> render_scene(const Scene& scene, Device& device, int threads,
                              const Deadline& deadline) {
    auto planned = plan_scene(scene, threads, deadline);
    if (!planned.ok()) return planned.error();
    return render_planned(scene, *std::move(planned), device, deadline);
}

const char* engine_version() {
    return AWAN_VERSION;
}

}  // namespace awan
