// What the rooms of the service share (service.cpp, scene.cpp); nobody else includes it.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <span>

#include "core/generate/automaton/kept_states.h"
#include "core/light/light_cache.h"
#include "server/limits.h"
#include "server/service/jobs.h"
#include "server/service/pages.h"
#include "server/service/result_cache.h"
#include "server/service/service.h"
#include "server/service/texture_store.h"
#include "server/service/work_budget.h"

namespace awan {

struct Service::State {
    State(RenderThread& r, Metrics& m, ServiceOptions o)
        : renderer(r),
          metrics(m),
          options(std::move(o)),
          budget(options.work_bytes),
          results(options.cache_bytes, options.cache_bytes / 8),
          lanes(options.lanes),
          device_lane({1, 0, options.lanes.line, options.lanes.patience}) {}

    RenderThread& renderer;
    Metrics& metrics;
    const ServiceOptions options;
    std::atomic<bool> draining{false};
    std::atomic<std::size_t> in_progress{0};
    WorkBudget budget;
    ResultCache results;
    // Everything that computes has a lane; what the renderer draws has its line, in which the others' lanes are free.
    Lanes lanes;
    Lanes device_lane;
    // Held by the one measurement of accuracy that may run, beside the lanes: two at once would measure each other.
    std::mutex sweeping;
    // By when it is over, at most.
    std::atomic<Deadline::Clock::time_point> sweeps_until{Deadline::Clock::time_point::min()};
    TextureStore textures;
    DetailTiles tiles;
    // Of the frames by which the rungs of sequences are settled: for the frames that are asked for next.
    LightCache settling_lights{limits::kSettlingLightBytes};
    // Of automata, for their other frames.
    const std::shared_ptr<automaton::KeptStates> kept =
        std::make_shared<automaton::KeptStates>(limits::kKeptStatesBytes);
    // Held from looking for an Idempotency-Key to the job being there.
    std::mutex submitting;
    // Streams that tell how jobs go.
    std::atomic<std::size_t> streams{0};
    const std::vector<Page> pages = make_pages();
    const std::vector<Preset> presets = make_presets();
    std::string presets_json;
    std::string presets_etag;
    // Last: when it goes, what its jobs use is still there.
    std::unique_ptr<Jobs> jobs;
};

// All values of a header that may be repeated, as one list.
std::string joined_header(const Request& request, std::string_view name);

// 304 without a body, with what a cache keeps.
Response not_modified(std::string_view etag, bool varies);

// The POST routes. `check_scene_request` says what is wrong before the body is looked at.
std::optional<Response> check_scene_request(const Request& request);
Response answer_scene_request(Service::State& state, const Request& request);

// POST /v1/sky: its map as `type`, `width` pixels wide; none: limits::kSkyMapWidth.
inline constexpr std::string_view kSkyPath = "/v1/sky";
Response answer_sky(Service::State& state, const Request& request, const Scene& scene,
                    std::optional<int> width, std::string_view type, Lanes::Pass& pass);

// POST /v1/particles (particles.cpp): its answer as `type`.
inline constexpr std::string_view kParticlesPath = "/v1/particles";
inline constexpr std::array<std::string_view, 5> kParticleOffers = {
    "application/json", "text/csv", "application/x-ply", "text/x-awn", "text/x-awa"};
Response answer_particles(Service::State& state, const Request& request, const Scene& scene,
                          std::string_view type, Lanes::Pass& pass);

// POST /v1/accuracy: its query, and its answer as `type`.
inline constexpr std::string_view kAccuracyPath = "/v1/accuracy";
Status check_accuracy_query(const Request& request);
Response answer_accuracy(Service::State& state, const Request& request, const Scene& scene,
                         std::string_view type);

// /v1/textures and what is below it (texture_routes.cpp).
inline constexpr std::string_view kTexturesPath = "/v1/textures";
Response answer_texture_request(Service::State& state, const Request& request);

// The scene of a request's body, by its Content-Type; then whether it can be.
Result<Scene> read_request_scene(const Service::State& state, const Request& request);

// /v1/jobs and what is below it (job_routes.cpp). answer_job_work runs a job.
inline constexpr std::string_view kJobsPath = "/v1/jobs";
std::optional<Response> check_job_request(const Request& request);
Response submit_job(Service::State& state, const Request& request);
Response tell_job(Service::State& state, const Request& request);
Response answer_job_work(Service::State& state, const JobWork& work, const Request& request);

// The frames of a sequence, or of a flight, as an animation, "webp" or "apng", as pictures in an archive, "zip", or as
// a sheet and its layout in one, "flipbook"; of a flight also only its report, "json", which is in its archive too
// (sequence_job.cpp).
Response answer_sequence(Service::State& state, const Request& request, const JobWork& work);
// A lane for a piece of a job, which waits for it as long as the job may take.
Status enter_patiently(Lanes::Pass& pass, const Request& request);
// The scene of a job, read in a lane and within the budget as any request's is; both are waited for.
Result<Scene> read_job_scene(Service::State& state, const Request& request);

// A job of kind impostor (impostor_job.cpp).
Response answer_impostor(Service::State& state, const Request& request, const JobWork& work);

// A prediction may be this many times too long (tests/calibration/RESULTS.md). What would be too slow even then is
// refused before it costs more.
inline constexpr double kHopeless = 2.2;
// Until it is over, ms; infinite where there is none.
double left_ms(const Deadline& deadline);

// Draws what is planned: with the device, in whose line it waits while another computes in its lane, or in its lane.
// pass: in a lane, before and after. `refused`: what is to be said where it got no lane; then there is no picture.
struct Drawn {
    std::optional<Response> refused;
    Result<Rendered> rendered;
    double queue_ms = 0;
};
Drawn draw_in_lanes(Service::State& state, const Request& request, const Scene& scene,
                    Planned planned, double encode_ms, Lanes::Pass& pass);

// POST /v1/render (render.cpp). pass: in a lane, after so many ms.
inline constexpr std::string_view kRenderPath = "/v1/render";
Response answer_render(Service::State& state, const Request& request, const Scene& scene,
                       std::string_view type, Lanes::Pass& pass);

// A picture as `type`: "image/png" or "image/x-exr", the same bytes wherever it is asked for.
Result<std::string> encode_picture(const Rendered& rendered, const Scene& scene,
                                   std::string_view type, const Deadline& deadline);

// An error as an answer; nobody waits for that of a cancelled request.
Response fail(const Error& error, const Request& request);
// What is said when there is not the memory that this one needs beside the others.
Response no_memory(Service::State& state, const Request& request);
// What is said to a request that did not get a lane; nothing to one that did.
std::optional<Response> not_let_in(Lanes::Entry entry, const Lanes& lanes, Weight weight,
                                   const Request& request);
// The same, to one in a lane whose work turns out to take `expected_ms`, and may need another lane for it.
std::optional<Response> not_kept_in(Service::State& state, const Request& request,
                                    double expected_ms, Lanes::Pass& pass);
// Threads that a piece of work has: the machine's, shared among all that compute.
int threads_of_one(const Service::State& state);

// 200 with what all answers to scenes have.
Response ok_answer(std::string_view content_type, std::string_view etag);
// Predicted times are of this machine, and so is every rung that is chosen by them.
std::string speed_text(const Service::State& state);
// `queue;dur=0.100, draw;dur=12.500`, for Server-Timing.
std::string server_timing(std::span<const std::pair<const char*, double>> milliseconds);

}  // namespace awan
