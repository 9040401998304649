// The frames of a sequence as one animation, as pictures in one archive, or side by side on one sheet. What is settled
// for all frames is settled once; then each frame has a lane for itself, so that others compute between two of them.
#include <array>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>
#include <utility>

#include "core/flight_impostors.h"
#include "core/flight_path.h"
#include "core/formats/animation.h"
#include "core/formats/image_file.h"
#include "core/formats/sheet.h"
#include "core/formats/zip_archive.h"
#include "core/sequence.h"
#include "core/survey/in_view.h"
#include "server/document/flight_report.h"
#include "server/document/sheet_text.h"
#include "server/service/problem.h"
#include "server/service/state.h"

namespace awan {
namespace {

// That an animation shows.
constexpr double kFramesPerSecond = kFlightFramesPerSecond;

// Where the frames go, in their order.
class Reel {
  public:
    // format: "webp", "apng", "zip", "flipbook", or of a flight "json": its report alone.
    static Result<Reel> begin(const std::string& format, const Scene& scene) {
        Reel reel;
        if (wants_layers(scene) && format != "zip")
            return in_scene({ErrorCode::kInvalidScene, "/image/layers",
                             "only EXRs hold layers: ask for the format \"zip\", or for none"});
        if (format == "json") return reel;
        const std::uint64_t frames = scene->sequence->frames;
        if (format == "zip" || format == "flipbook") {
            auto archive = ZipArchive::begin();
            if (!archive) return archive.error();
            reel.archive_ = *std::move(archive);
            if (format == "zip") return reel;
            auto layout = sheet_layout(frames, scene->image.width, scene->image.height);
            if (!layout) return in_scene(layout.error());
            const std::size_t bytes = 4 * sizeof(float) *
                                      static_cast<std::size_t>(layout->sheet_width()) *
                                      static_cast<std::size_t>(layout->sheet_height());
            if (bytes > limits::kJobBytes)
                return in_scene({ErrorCode::kTooLarge, "/sequence/frames",
                                 "the sheet takes over " + std::to_string(limits::kJobBytes >> 20) +
                                     " MiB while it is made; ask for fewer or smaller frames"});
            reel.layout_ = *layout;
            return reel;
        }
        auto animation =
            Animation::begin(format == "apng" ? AnimationFormat::kApng : AnimationFormat::kWebp,
                             kFramesPerSecond, frames);
        if (!animation) return animation.error();
        reel.animation_ = *std::move(animation);
        return reel;
    }
    Status add(const Rendered& rendered, const Scene& scene, std::uint64_t frame,
               const Deadline& deadline) {
        if (animation_) return animation_->add(rendered.image, film_of(scene), deadline);
        if (layout_) {
            if (frame == 0) sheet_ = begin_sheet(*layout_, rendered.image.opaque);
            put_on_sheet(*layout_, frame, rendered.image, sheet_);
            return std::nullopt;
        }
        if (!archive_) return std::nullopt;
        const bool exr = scene->image.format == ImageFormat::kExr || wants_layers(scene);
        auto bytes = encode_picture(rendered, scene, exr ? "image/x-exr" : "image/png", deadline);
        if (!bytes) return bytes.error();
        return archive_->add(frame_name(frame, exr ? "exr" : "png"), *bytes);
    }
    // Of an archive so far. An animation is small beside its frames.
    std::size_t bytes() const {
        return (archive_ ? archive_->bytes() : 0) + sheet_.pixels.size() * sizeof(float);
    }
    // scene: any of the frames, since the light and so the exposure is the same for all. report: of a flight.
    Result<std::string> end(const Scene& scene, const FlightReport* report,
                            const Deadline& deadline) {
        if (animation_) return animation_->end();
        if (!archive_) return flight_to_json(*report);
        if (layout_)
            if (const Status failed = add_sheet(scene, deadline)) return *failed;
        if (report != nullptr) {
            if (Status failed = archive_->add("report.json", flight_to_json(*report)))
                return *failed;
            if (Status failed = archive_->add("report.txt", flight_to_text(*report)))
                return *failed;
        }
        return archive_->end();
    }

  private:
    // The scene of a job stands in its document.
    static Error in_scene(Error error) {
        error.pointer = "/scene" + error.pointer;
        return error;
    }

    Status add_sheet(const Scene& scene, const Deadline& deadline) {
        const bool exr = scene->image.format == ImageFormat::kExr;
        auto bytes =
            exr ? encode_exr(sheet_, scene->image.precision, {}, deadline)
                : encode_png(sheet_, film_of(scene),
                             scene->image.format == ImageFormat::kPng16 ? 16 : 8, deadline);
        if (!bytes) return bytes.error();
        const std::string name = exr ? "flipbook.exr" : "flipbook.png";
        if (Status failed = archive_->add(name, *bytes)) return failed;
        std::vector<std::uint64_t> numbers;
        std::vector<double> times;
        for (std::uint64_t i = 0; i < layout_->frames; ++i) {
            numbers.push_back(i);
            times.push_back(frame_time(*scene->sequence, i));
        }
        return archive_->add("flipbook.json",
                             sheet_to_json(*layout_, name, numbers, times, kFramesPerSecond));
    }

    // As of `awan render SCENE --frames all -o frame.%04d.png`.
    static std::string frame_name(std::uint64_t frame, const char* ending) {
        std::array<char, 40> name{};
        std::snprintf(name.data(), name.size(), "frame.%04llu.%s",
                      static_cast<unsigned long long>(frame), ending);
        return name.data();
    }

    std::optional<Animation> animation_;
    std::optional<ZipArchive> archive_;
    // Of a flipbook.
    std::optional<SheetLayout> layout_;
    Image sheet_;
};

const char* type_of_reel(const std::string& format) {
    if (format == "zip" || format == "flipbook") return "application/zip";
    if (format == "json") return "application/json";
    return format == "apng" ? "image/apng" : "image/webp";
}

// Memory for what the reel has become. Whoever has much of it gives it back in time.
Status grow_lease(WorkBudget::Lease& lease, std::size_t bytes, const Deadline& deadline) {
    while (!lease.grow(bytes)) {
        if (auto over = deadline.over()) return over;
        std::this_thread::sleep_for(kLinesAreFull);
    }
    return std::nullopt;
}

// One frame, drawn; or what is to be said instead. impostors: of a flight, else null. in_view: its particles in the
// picture. pass: in a lane after it, in which it is encoded.
Drawn frame_of(Service::State& state, const Request& request, const Settled& settled,
               std::uint64_t number, FlightImpostors* impostors, Scene& scene, std::size_t& in_view,
               Lanes::Pass& pass) {
    const LaneWork work{Weight::kLong, 2 * kShort_ms, request.client};
    if (auto refused =
            not_let_in(pass.enter(work, request.deadline), state.lanes, Weight::kLong, request))
        return {std::move(refused), Error{}};
    Frame frame = frame_at(settled, frame_time(settled.sequence, number));
    auto planned = with_detail_made(
        frame.scene,
        plan_frame(frame, threads_of_one(state), request.deadline, state.options.speed),
        threads_of_one(state), &state.tiles);
    if (!planned) return {std::nullopt, planned.error()};
    in_view = particles_in_view(planned->particles, planned->survey.view);
    planned->impostors = impostors;
    planned->flight_frame = number;
    scene = std::move(frame.scene);
    Request inner = request;
    // A frame's own progress is not that of the whole.
    inner.progress = {};
    return draw_in_lanes(state, inner, scene, *std::move(planned), 0, pass);
}

// What is settled before the first frame; of a flight, whose scene this makes, its path too.
Result<Settled> settle_job(Service::State& state, const Request& request, const JobWork& work,
                           Result<Scene>& scene) {
    Lanes::Pass pass(state.lanes);
    if (const Status over = enter_patiently(pass, request)) return *over;
    const int threads = threads_of_one(state);
    if (work.kind == "fly") {
        auto flight = flight_of(**scene, work.flight, threads, request.deadline);
        if (!flight) {
            Error error = flight.error();
            error.pointer = "/scene" + error.pointer;
            return error;
        }
        scene = std::move(flight);
    }
    return settle(*scene, Settling::kMeasured, {&state.settling_lights, threads}, request.deadline);
}

// What is known before it begins.
FlightReport flight_report_of(const JobWork& work, const SceneDraft& scene,
                              const Service::State& state) {
    const bool has_keys = scene.sequence && !scene.sequence->camera.empty();
    FlightReport report;
    report.scenes = {"scene"};
    report.path = kFlightPathWords[static_cast<int>(
        work.flight.path.value_or(has_keys ? FlightPath::kKeys : FlightPath::kOrbit))];
    if (work.flight.thickness)
        report.mode = kThicknessWords[static_cast<int>(*work.flight.thickness)];
    report.width = scene.image.width;
    report.height = scene.image.height;
    report.threads = threads_of_one(state);
    report.renderer = "processor";
    return report;
}

}  // namespace

Response answer_sequence(Service::State& state, const Request& request, const JobWork& work) {
    const auto start = Deadline::Clock::now();
    auto scene = read_job_scene(state, request);
    if (!scene) return fail(scene.error(), request);
    WorkBudget::Lease lease = state.budget.take(work_bytes(**scene, true));
    if (!lease) return no_memory(state, request);
    const bool flies = work.kind == "fly";
    FlightReport report = flight_report_of(work, **scene, state);
    auto settled = settle_job(state, request, work, scene);
    if (!settled) return fail(settled.error(), request);
    settled->is_unmeasured = flies;
    report.settle_seconds = ms_since(start) / 1000;
    const Sequence& sequence = *(*scene)->sequence;
    report.frames_asked = sequence.frames;
    std::optional<FlightImpostors> impostors;
    if (flies) {
        impostors.emplace(work.flight_impostors, *scene, *settled);
        if (work.flight_impostors.mode != Impostors::kOff)
            if (const Status over = grow_lease(lease, impostor_bytes(*scene), request.deadline))
                return fail(*over, request);
    }
    auto reel = Reel::begin(work.format, *scene);
    if (!reel) return fail(reel.error(), request);
    for (std::uint64_t i = 0; i < sequence.frames;) {
        const auto frame_start = Deadline::Clock::now();
        Scene still = *scene;
        std::size_t in_view = 0;
        const double time = frame_time(sequence, i);
        Lanes::Pass pass(state.lanes);
        Drawn drawn = frame_of(state, request, *settled, i, impostors ? &*impostors : nullptr,
                               still, in_view, pass);
        // The lines are full at the moment. What has been drawn is not lost for that.
        if (drawn.refused && drawn.refused->status == 429 && !request.deadline.over()) {
            pass.leave();
            std::this_thread::sleep_for(kLinesAreFull);
            continue;
        }
        if (drawn.refused) return std::move(*drawn.refused);
        if (!drawn.rendered) return fail(drawn.rendered.error(), request);
        const std::size_t before = reel->bytes();
        const auto encoding = Deadline::Clock::now();
        if (const Status failed = reel->add(*drawn.rendered, still, i, request.deadline))
            return fail(*failed, request);
        pass.leave();
        if (reel->bytes() > limits::kJobBytes)
            return fail(
                {ErrorCode::kTooLarge, "/scene/sequence/frames",
                 "the first " + std::to_string(i + 1) + " of " + std::to_string(sequence.frames) +
                     " frames take over " + std::to_string(limits::kJobBytes >> 20) +
                     " MiB, which is what a result may have; ask for fewer or smaller ones"},
                request);
        if (const Status over = grow_lease(lease, reel->bytes() - before, request.deadline))
            return fail(*over, request);
        if (flies) {
            FlownFrame flown =
                flown_frame(i, time, drawn.rendered->survey.particles, in_view, *drawn.rendered);
            flown.encode_ms = ms_since(encoding);
            flown.ms = ms_since(frame_start);
            report.frames.push_back(flown);
            report.rung = drawn.rendered->plan.rung;
            if (needs_device(drawn.rendered->plan))
                report.renderer = state.renderer.info().device.renderer;
        }
        ++i;
        if (request.progress)
            request.progress(static_cast<double>(i) / static_cast<double>(sequence.frames));
    }
    report.seconds = ms_since(start) / 1000;
    if (impostors) report.impostors = impostors->report();
    auto bytes = reel->end(*scene, flies ? &report : nullptr, request.deadline);
    if (!bytes) return fail(bytes.error(), request);
    Response response;
    response.headers = {{"Content-Type", type_of_reel(work.format)}, {"Cache-Control", "no-store"}};
    response.body = *std::move(bytes);
    return response;
}

}  // namespace awan
