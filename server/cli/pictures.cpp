#include "server/cli/pictures.h"

#include <algorithm>
#include <cstdio>

#include "core/formats/animation.h"
#include "core/formats/image_file.h"
#include "core/formats/sheet.h"
#include "core/sequence.h"
#include "core/survey/in_view.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/document/sheet_text.h"
#include "server/service/render_thread.h"

namespace awan {
namespace {

// Pixels of an EXR that take one thread longer than others take to begin.
constexpr std::size_t kLargePicture = 1u << 18;

Result<std::string> encode(const Rendered& rendered, const Scene& scene, const std::string& format,
                           int bits, int threads) {
    if (format == "exr") {
        if (rendered.image.pixel_count() >= kLargePicture) set_exr_threads(threads);
        return encode_exr(rendered.image, scene->image.precision, notes_of(rendered), {},
                          channels_of(rendered.layers));
    }
    return encode_png(rendered.image, film_of(scene), bits);
}

Result<Rendered> render_of(const Settled& settled, std::uint64_t number, double time, Work& work,
                           Scene& scene, std::size_t& in_view) {
    Frame frame = frame_at(settled, time);
    auto planned = with_detail_made(frame.scene,
                                    plan_frame(frame, work.command.threads, work.deadline,
                                               work.speed, work.matter ? &*work.matter : nullptr),
                                    work.command.threads, &work.tiles);
    scene = std::move(frame.scene);
    if (planned && work.command.preview) planned = as_preview(scene, *std::move(planned));
    if (planned && work.flown)
        in_view = particles_in_view(planned->particles, planned->survey.view);
    if (planned && work.impostors) {
        planned->impostors = &*work.impostors;
        planned->flight_frame = number;
    }
    return render_picture(scene, std::move(planned), work);
}

// What holds every frame and is being made, and where it goes: an animation, or a sheet.
struct MovingPicture {
    const Target* target;
    std::optional<Animation> animation;
    SheetLayout layout;
    Image sheet;
    std::uint64_t frames = 0;

    Status add(const Image& picture, const FilmSettings& film) {
        if (animation) return animation->add(picture, film);
        if (frames == 0) sheet = begin_sheet(layout, picture.opaque);
        put_on_sheet(layout, frames++, picture, sheet);
        return std::nullopt;
    }
};

Status write_sheet(const MovingPicture& moving, const std::vector<std::uint64_t>& frames,
                   const Scene& scene, const Work& work) {
    const std::string& path = moving.target->path;
    auto bytes = moving.target->format == "exr"
                     ? encode_exr(moving.sheet, scene->image.precision)
                     : encode_png(moving.sheet, film_of(scene), work.png_bits);
    if (!bytes) return bytes.error();
    if (Status failed = write_output(path, *bytes)) return failed;
    std::vector<double> times;
    for (const std::uint64_t frame : frames) times.push_back(frame_time(*scene->sequence, frame));
    return write_output(layout_path(path),
                        sheet_to_json(moving.layout, path.substr(path.rfind('/') + 1), frames,
                                      times, work.command.frames_per_second));
}

Result<std::vector<MovingPicture>> begin_moving(const Scene& scene, const Work& work,
                                                std::size_t frames) {
    std::vector<MovingPicture> all;
    for (const Target& target : work.targets) {
        if (!target.animated()) continue;
        if (target.sheet) {
            const auto layout =
                sheet_layout(frames, scene->image.width, scene->image.height, work.command.columns);
            if (!layout) return layout.error();
            all.push_back({&target, std::nullopt, *layout, {}});
            continue;
        }
        auto begun = Animation::begin(
            target.format == "webp" ? AnimationFormat::kWebp : AnimationFormat::kApng,
            work.command.frames_per_second, frames);
        if (!begun) return begun.error();
        all.push_back({&target, *std::move(begun), {}, {}});
    }
    return all;
}

// The frames that are to be made: all, or those of which a file is missing.
std::vector<std::uint64_t> missing_frames(const Scene& scene,
                                          const std::vector<std::uint64_t>& frames, Work& work) {
    std::vector<std::uint64_t> missing;
    for (const std::uint64_t frame : frames) {
        PictureResult result{work.command.scene.path, files_of_frame(work.targets, &frame), frame,
                             true, 0};
        if (all_finished(result.outputs))
            say_result(result, scene, nullptr, work);
        else
            missing.push_back(frame);
    }
    return missing;
}

// One frame, drawn and written to its files and into what moves.
Status make_frame(const Settled& settled, const Sequence& sequence, std::uint64_t frame,
                  std::vector<MovingPicture>& all, Work& work) {
    const auto start = Deadline::Clock::now();
    const double time = frame_time(sequence, frame);
    Scene still = frame_at(settled, time).scene;
    std::size_t in_view = 0;
    auto rendered = render_of(settled, frame, time, work, still, in_view);
    if (!rendered) return rendered.error();
    PictureResult result{work.command.scene.path, files_of_frame(work.targets, &frame), frame,
                         false, 0};
    if (Status failed = write_picture(*rendered, still, &frame, work, result.encode_ms))
        return failed;
    const auto filming = Deadline::Clock::now();
    for (MovingPicture& moving : all)
        if (Status failed = moving.add(rendered->image, film_of(still))) return failed;
    result.encode_ms += ms_since(filming);
    if (!work.flown) {
        say_result(result, still, &*rendered, work);
        return std::nullopt;
    }
    FlownFrame flown = flown_frame(frame, time, rendered->survey.particles, in_view, *rendered);
    flown.encode_ms = result.encode_ms;
    flown.ms = ms_since(start);
    work.flown(flown);
    return std::nullopt;
}

Status end_moving(std::vector<MovingPicture>& all, const std::vector<std::uint64_t>& frames,
                  const Scene& scene, Work& work) {
    work.progress.say("encoding");
    for (MovingPicture& moving : all) {
        if (!moving.animation) {
            if (Status failed = write_sheet(moving, frames, scene, work)) return failed;
            continue;
        }
        auto bytes = moving.animation->end();
        if (!bytes) return bytes.error();
        if (Status failed = write_output(moving.target->path, *bytes)) return failed;
    }
    return std::nullopt;
}

}  // namespace

Result<Rendered> render_picture(const Scene& scene, Result<Planned> planned, Work& work) {
    if (!planned) return planned.error();
    if (const Status failed = open_for(planned->plan, work.command.device, work.device))
        return *failed;
    work.progress.say(work.prefix + "rendering, rung " + planned->plan.rung);
    const Tools tools{work.device ? &*work.device : nullptr, work.command.threads,
                      work.lights ? &*work.lights : nullptr,
                      [&](double share) { work.progress.done(share); }, work.speed};
    return render_planned(scene, *std::move(planned), tools, work.deadline);
}

Status write_picture(const Rendered& rendered, const Scene& scene, const std::uint64_t* frame,
                     Work& work, double& encode_ms) {
    const auto start = Deadline::Clock::now();
    for (const Target& target : work.targets) {
        if (target.animated()) continue;
        const auto bytes =
            encode(rendered, scene, target.format, work.png_bits, work.command.threads);
        if (!bytes) return bytes.error();
        const std::string path =
            frame == nullptr ? target.path : numbered_name(target.path, *frame);
        if (Status failed = write_output(path, *bytes)) return failed;
    }
    encode_ms = ms_since(start);
    return std::nullopt;
}

void say_result(const PictureResult& result, const Scene& scene, const Rendered* rendered,
                Work& work) {
    const bool taken = std::any_of(work.targets.begin(), work.targets.end(),
                                   [](const Target& target) { return target.path == "-"; });
    if (taken) return;
    work.progress.clear();
    std::string text;
    if (work.command.json) {
        text = result_json(result, scene, rendered);
    } else if (result.skipped) {
        for (const std::string& file : result.outputs) text += file + ": is there already\n";
    } else if (rendered != nullptr && !result.frame) {
        for (const std::string& file : result.outputs) text += result_text(file, *rendered);
    }
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

bool all_finished(const std::vector<std::string>& files) {
    return std::all_of(files.begin(), files.end(), is_finished);
}

std::string layout_path(const std::string& sheet) {
    return sheet.substr(0, sheet.rfind('.')) + ".json";
}

Result<FramesMade> render_frames(const Scene& scene, std::vector<std::uint64_t> frames,
                                 Work& work) {
    auto all = begin_moving(scene, work, frames.size());
    if (!all) return all.error();
    FramesMade made;
    if (work.command.skip_existing) {
        // An animation holds every frame.
        if (all->empty()) frames = missing_frames(scene, frames, work);
        if (frames.empty()) return made;
    }
    work.matter.reset();
    if (clouds_stand(*scene)) {
        work.lights.emplace(kLightCacheBytes);
        work.matter.emplace();
    }
    work.progress.say("settling the sequence");
    const auto start = Deadline::Clock::now();
    auto settled =
        settle(scene, Settling::kMeasured,
               {work.lights ? &*work.lights : nullptr, work.command.threads}, work.deadline);
    if (!settled) return settled.error();
    // A flight's report says how fast it was.
    settled->is_unmeasured = work.flown != nullptr;
    if (work.flown) work.impostors.emplace(work.impostor_wish, scene, *settled);
    made.settle_ms = ms_since(start);
    for (const std::uint64_t frame : frames) {
        work.prefix = "frame " + std::to_string(made.count + 1) + " of " +
                      std::to_string(frames.size()) + ", ";
        work.progress.say(work.prefix + "planning");
        const Status failed = make_frame(*settled, *scene->sequence, frame, *all, work);
        made.timed_out = failed && failed->code == ErrorCode::kOverDeadline && made.count > 0;
        if (made.timed_out) break;
        if (failed) return *failed;
        ++made.count;
    }
    if (Status failed = end_moving(*all, frames, scene, work)) return *failed;
    return made;
}

}  // namespace awan
