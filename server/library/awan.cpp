#include "server/library/awan.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "core/base/thrown.h"
#include "core/formats/image_file.h"
#include "core/formats/particle_files.h"
#include "core/generate/automaton/kept_states.h"
#include "core/generate/generate.h"
#include "core/gl/device.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "core/scene/fingerprint.h"
#include "core/scene/validate.h"
#include "server/document/json.h"
#include "server/document/overrides.h"
#include "server/document/scene_text.h"

namespace awan::library {

struct Scene::Inside {
    awan::Scene scene;
};
struct Particles::Inside {
    ParticleSet set;
};
struct Picture::Inside {
    awan::Scene scene;
    Rendered rendered;
};

namespace {

// Beyond that no machine is.
constexpr int kMostThreads = 256;
// Of the states that automata of one scene keep for its other times.
constexpr std::size_t kKeptStatesBytes = std::size_t{64} << 20;

ErrorKind kind_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::kMalformed:
            return ErrorKind::kMalformed;
        case ErrorCode::kInvalidScene:
            return ErrorKind::kInvalidScene;
        case ErrorCode::kUnsupported:
            return ErrorKind::kUnsupported;
        case ErrorCode::kTooLarge:
            return ErrorKind::kTooLarge;
        case ErrorCode::kNoRenderer:
            return ErrorKind::kNoRenderer;
        case ErrorCode::kOverDeadline:
            return ErrorKind::kOverDeadline;
        case ErrorCode::kOutOfMemory:
            return ErrorKind::kOutOfMemory;
        case ErrorCode::kCancelled:
            return ErrorKind::kCancelled;
        case ErrorCode::kIo:  // of files, which nothing here reads or writes
        case ErrorCode::kInternal:
            break;
    }
    return ErrorKind::kInternal;
}

[[noreturn]] void fail(const awan::Error& error) {
    throw Error(kind_of(error.code), error.pointer, error.message);
}

// What a stage gives, or the Error of what went wrong in it.
template <typename Stage>
auto given(const Stage& stage) {
    try {
        auto result = stage();
        if (!result.ok()) fail(result.error());
        return *std::move(result);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& thrown) {
        fail(error_of_thrown(thrown));
    }
}

int threads_of(const Options& options) {
    if (options.threads < 0 || options.threads > kMostThreads)
        fail({ErrorCode::kInvalidScene, "",
              "threads: must be 0 to " + std::to_string(kMostThreads)});
    if (options.threads > 0) return options.threads;
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
}

Deadline deadline_of(const Options& options) {
    // A year; what is longer could not be counted in the clock's own ticks.
    constexpr double kLongest_s = 3.2e7;
    if (!(options.deadline_s >= 0))
        fail({ErrorCode::kInvalidScene, "", "deadline_s: must be 0 or more"});
    Deadline deadline;
    deadline.cancelled = options.cancelled;
    if (options.deadline_s > 0 && options.deadline_s < kLongest_s)
        deadline.until =
            Deadline::Clock::now() + std::chrono::duration_cast<Deadline::Clock::duration>(
                                         std::chrono::duration<double>(options.deadline_s));
    return deadline;
}

SceneFormat format_of(SceneForm form, std::string_view bytes) {
    switch (form) {
        case SceneForm::kJson:
            return SceneFormat::kJson;
        case SceneForm::kAwn:
            return SceneFormat::kAwn;
        case SceneForm::kAwa:
            return SceneFormat::kAwa;
        case SceneForm::kPly:
            return SceneFormat::kPly;
        case SceneForm::kCsv:
            return SceneFormat::kCsv;
        case SceneForm::kAny:
            break;
    }
    return sniff_scene_format(bytes);
}

}  // namespace

Error::Error(ErrorKind kind, const std::string& place, const std::string& message)
    : std::runtime_error(place.empty() ? message : place + ": " + message),
      kind_(kind),
      place_(place) {}

const char* version() {
    return engine_version();
}

Scene::Scene(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

int Scene::width() const {
    return inside_->scene->image.width;
}

int Scene::height() const {
    return inside_->scene->image.height;
}

std::string Scene::json() const {
    return scene_to_json(*inside_->scene);
}

std::string Scene::digest() const {
    return fingerprint(inside_->scene);
}

Scene Scene::with(std::string_view place, std::string_view value) const {
    return Scene(given([&]() -> Result<std::shared_ptr<const Inside>> {
        SceneDraft draft = *inside_->scene;
        if (const Status wrong = set_in_scene(place, value, draft)) return *wrong;
        auto scene = validate(std::move(draft));
        if (!scene.ok()) return scene.error();
        return std::make_shared<const Inside>(*std::move(scene));
    }));
}

Scene read_scene(std::string_view bytes, const Reading& reading) {
    return Scene(given([&]() -> Result<std::shared_ptr<const Scene::Inside>> {
        auto draft =
            awan::read_scene(format_of(reading.form, bytes), bytes, {reading.radius, nullptr});
        if (!draft.ok()) return draft.error();
        automaton::keep_states(*draft, std::make_shared<automaton::KeptStates>(kKeptStatesBytes));
        auto scene = validate(*std::move(draft));
        if (!scene.ok()) return scene.error();
        return std::make_shared<const Scene::Inside>(*std::move(scene));
    }));
}

std::string plan(const Scene& scene, const Options& options) {
    const int threads = threads_of(options);
    const Deadline deadline = deadline_of(options);
    return given([&]() -> Result<std::string> {
        auto planned = plan_only(scene.inside().scene, threads, deadline, measure_speed());
        if (!planned.ok()) return planned.error();
        return plan_to_json(planned->survey, planned->plan);
    });
}

Particles::Particles(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {
    const ParticleSet& set = inside_->set;
    list_.reserve(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) {
        const glm::vec3 color = set.color.empty() ? glm::vec3(1) : set.color[i];
        list_.push_back({set.center[i].x, set.center[i].y, set.center[i].z, set.radius[i],
                         set.density[i], color.x, color.y, color.z});
    }
}

std::string Particles::csv() const {
    std::string text;
    append_csv_header(text);
    append_csv(inside_->set, 0, inside_->set.size(), text);
    return text;
}

std::string Particles::ply() const {
    std::string text;
    append_ply_header(inside_->set, text);
    append_ply(inside_->set, 0, inside_->set.size(), text);
    return text;
}

std::string Particles::glb() const {
    return given([&] { return write_glb(inside_->set); });
}

Particles particles(const Scene& scene, const Options& options) {
    const int threads = threads_of(options);
    const Deadline deadline = deadline_of(options);
    return given([&]() -> Result<Particles> {
        auto set = generate(scene.inside().scene, threads, deadline);
        if (!set.ok()) return set.error();
        return Particles(std::make_shared<const Particles::Inside>(*std::move(set)));
    });
}

Picture::Picture(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

int Picture::width() const {
    return inside_->rendered.image.width;
}

int Picture::height() const {
    return inside_->rendered.image.height;
}

std::span<const float> Picture::pixels() const {
    return inside_->rendered.image.pixels;
}

std::string Picture::rung() const {
    return inside_->rendered.rung != nullptr ? inside_->rendered.rung->name
                                             : inside_->rendered.plan.rung;
}

double Picture::error() const {
    return inside_->rendered.stated_error;
}

std::string Picture::png(int bits) const {
    if (bits != 0 && bits != 8 && bits != 16)
        fail({ErrorCode::kInvalidScene, "", "bits of a PNG: must be 8, 16 or 0"});
    if (bits == 0) bits = inside_->scene->image.format == ImageFormat::kPng16 ? 16 : 8;
    return given(
        [&] { return encode_png(inside_->rendered.image, film_of(inside_->scene), bits); });
}

std::string Picture::exr() const {
    const Rendered& rendered = inside_->rendered;
    return given([&] {
        return encode_exr(rendered.image, inside_->scene->image.precision, notes_of(rendered), {},
                          channels_of(rendered.layers));
    });
}

Picture render(const Scene& asked, const Options& options) {
    const int threads = threads_of(options);
    const Deadline deadline = deadline_of(options);
    return given([&]() -> Result<Picture> {
        const awan::Scene& scene = asked.inside().scene;
        const MachineSpeed speed = measure_speed();
        auto planned = plan_scene(scene, threads, deadline, speed);
        if (!planned.ok()) return planned.error();
        std::optional<Device> device;
        if (needs_renderer(planned->plan.predicted.rung->method)) {
            auto opened = Device::open(DeviceChoice::kAuto);
            if (!opened.ok()) return opened.error();
            device.emplace(*std::move(opened));
        }
        auto rendered = render_planned(
            scene, *std::move(planned),
            {device ? &*device : nullptr, threads, nullptr, options.progress, speed}, deadline);
        if (!rendered.ok()) return rendered.error();
        return Picture(
            std::make_shared<const Picture::Inside>(Picture::Inside{scene, *std::move(rendered)}));
    });
}

}  // namespace awan::library
