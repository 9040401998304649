// POST /v1/sky: from a scene to a map of its sky.
#include "core/draw/sky_map.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/formats/image_file.h"
#include "core/scene/fingerprint.h"
#include "server/service/negotiation.h"
#include "server/service/problem.h"
#include "server/service/state.h"

namespace awan {

namespace {

// What a pixel of a map takes to be made and encoded, on the machine of the calibration: 205 ns of one processor were
// measured (2048 x 1024); that, and half as much again.
constexpr double kPixel_ns = 310;
// What is offered takes this share of the time there is.
constexpr double kOffered = 0.7;

double expected_ms(int width, const MachineSpeed& speed) {
    return kPixel_ns * 1e-6 * speed.slowness * static_cast<double>(width) * width / 2;
}

// The widest map that is expected within so many ms, even.
int width_within(double ms, const MachineSpeed& speed) {
    const double widest = std::sqrt(ms / expected_ms(1, speed));
    return std::max(2 * static_cast<int>(std::min(widest, 1.0 * limits::kMaxImageSide) / 2), 2);
}

}  // namespace

Response answer_sky(Service::State& state, const Request& request, const Scene& scene,
                    std::optional<int> wanted, std::string_view type, Lanes::Pass& pass) {
    const int width = wanted.value_or(limits::kSkyMapWidth);
    if (width % 2 != 0)
        return problem(400,
                       "query parameter `width` must be even: a map is twice as wide as it is high",
                       "", request.id);
    const std::string etag =
        make_etag({"sky", fingerprint(scene), engine_version(), type, std::to_string(width)});
    if (none_match_names(joined_header(request, "If-None-Match"), etag))
        return not_modified(etag, true);
    const auto side = static_cast<std::size_t>(width);
    const double expected = expected_ms(width, state.options.speed);
    if (auto refused = not_kept_in(state, request, expected, pass)) return std::move(*refused);
    const double left = left_ms(request.deadline);
    if (expected > kHopeless * left) {
        Response response =
            problem(504,
                    "a map of that width would take longer than there is; ask for one of " +
                        std::to_string(width_within(kOffered * left, state.options.speed)) + " pixels",
                    "", request.id);
        response.reason = "hopeless";
        return response;
    }
    const WorkBudget::Lease lease =
        state.budget.take(work_bytes(*scene, false) + side * side / 2 * limits::kBytesPerPixel);
    if (!lease) return no_memory(state, request);
    const auto start = Deadline::Clock::now();
    const auto map = sky_map(scene, width, threads_of_one(state), request.deadline);
    if (!map) return fail(map.error(), request);
    const double draw_ms = ms_since(start);
    const auto encoding = Deadline::Clock::now();
    auto bytes = type == "image/png" ? encode_png(*map, film_of(scene), 8, request.deadline)
                                     : encode_exr(*map, scene->image.precision, sky_notes_of(scene),
                                                  request.deadline);
    if (!bytes) return fail(bytes.error(), request);
    const double encode_ms = ms_since(encoding);
    state.metrics.stage_done("draw", draw_ms);
    state.metrics.stage_done("encode", encode_ms);
    Response response = ok_answer(type, etag);
    response.body = *std::move(bytes);
    response.stages = {{"queue", pass.waited_ms()}, {"draw", draw_ms}, {"encode", encode_ms}};
    return response;
}

}  // namespace awan
