// awan: the command line. Flags become plain values here; commands.cpp and serve.cpp do the work.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <thread>

#include "core/base/thrown.h"
#include "core/pipeline.h"
#include "core/scene/limits.h"
#include "core/scene/rungs.h"
#include "server/cli/cli.h"
#include "server/cli/completion.h"
#include "server/cli/frames.h"
#include "server/service/problem.h"

namespace {

using namespace awan;

constexpr const char* kSceneHelp =
    "the scene: a .json, .awn, .awa, .ply or .csv file, or - for standard input";

int processors() {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Every flag has an environment variable: --allow-host is AWAN_ALLOW_HOST.
std::string environment_name(std::string flag) {
    for (char& c : flag) c = c == '-' ? '_' : static_cast<char>(std::toupper(c));
    return "AWAN_" + flag;
}

template <typename T>
CLI::Option* add(CLI::App& command, const std::string& names, T& value, const std::string& help) {
    CLI::Option* option = command.add_option(names, value, help)->capture_default_str();
    return option->envname(environment_name(option->get_lnames().front()));
}

void add_device(CLI::App& command, DeviceChoice& choice) {
    command
        .add_flag_callback(
            "--software", [&choice] { choice = DeviceChoice::kSoftware; },
            "render on the processor even where there is a GPU")
        ->envname("AWAN_SOFTWARE");
}

void add_threads(CLI::App& command, int& threads) {
    add(command, "--threads", threads, "threads that work on one scene")->check(CLI::Range(1, 256));
}

void add_textures(CLI::App& command, SceneInput& scene) {
    add(command, "--texture", scene.textures,
        "a picture that the scene may be painted with, as puff=my-puff.png; may be repeated")
        ->allow_extra_args(false);
}

// What takes the place of values in the scene, or in each of several.
void add_values(CLI::App& command, SceneInput& scene) {
    add(command, "--set", scene.sets,
        "a value of the document, as /sun/elevation=12 or /clouds/0/density=auto; may be repeated")
        ->allow_extra_args(false);
    add_textures(command, scene);
    add(command, "--seed", scene.seed, "instead of the document's");
    add(command, "--radius", scene.radius,
        "of ready particles (.ply, .csv), in place of what the file says of it")
        ->check(CLI::PositiveNumber);
}

void add_scene(CLI::App& command, SceneInput& scene, const std::string& name = "scene") {
    command.add_option(name, scene.path, kSceneHelp)->required();
    add_values(command, scene);
}

// A file that there is one of, whatever there are frames of.
void only_one(CLI::Option* option) {
    option->check([](const std::string& path) {
        // Whose flag it is, is said before it.
        const Status wrong = check_not_numbered(path, "");
        return wrong ? wrong->message : std::string();
    });
}

void add_state(CLI::App& command, SceneInput& scene) {
    add(command, "--state", scene.state,
        "a file of `awan state`: its automaton goes on from there instead of from the beginning");
}

void add_farm_flags(CLI::App& command, bool& skip_existing, std::string& depfile) {
    command
        .add_flag("--skip-existing", skip_existing,
                  "what is there already is not made again (files appear whole)")
        ->envname("AWAN_SKIP_EXISTING");
    only_one(add(command, "--depfile", depfile,
                 "a file that says to make and ninja what the outputs are made of"));
}

// A configuration file says for `serve` what its flags would: `queue = 4`, `allow-host = ["a"]`.
// Flags win over the environment, and both over the file.
class ServeConfig : public CLI::ConfigTOML {
  public:
    std::vector<CLI::ConfigItem> from_config(std::istream& in) const override {
        std::vector<CLI::ConfigItem> items = CLI::ConfigTOML::from_config(in);
        std::erase_if(items, [](const CLI::ConfigItem& item) {
            return std::getenv(environment_name(item.name).c_str()) != nullptr;
        });
        for (CLI::ConfigItem& item : items)
            if (item.parents.empty()) item.parents = {"serve"};
        return items;
    }
};

using Run = std::function<int()>;

std::vector<std::string> rung_names() {
    std::vector<std::string> names;
    for (const Rung& rung : ladder()) names.emplace_back(rung.name);
    return names;
}

Run add_serve(CLI::App& app) {
    auto command = std::make_shared<ServeCommand>();
    command->threads = processors();
    auto listen = std::make_shared<std::string>("127.0.0.1:8080");
    auto log = std::make_shared<std::string>("off");
    CLI::App* serve = app.add_subcommand("serve", "answer HTTP");
    // --config is the program's, and may stand after `serve`
    serve->fallthrough();
    add(*serve, "--listen", *listen, "host:port, [v6]:port, host or port; port 0 is any free one")
        ->check([](const std::string& text) {
            return parse_listen(text) ? std::string() : text + " is not host:port";
        });
    add(*serve, "--lanes", command->lanes,
        "requests that compute at once; 0: one a thread, at least 2")
        ->check(CLI::Range(0, 256));
    add(*serve, "--short-lanes", command->short_lanes,
        "of these, kept for what is expected to take at most a second; below the lanes")
        ->check(CLI::Range(0, 255));
    add(*serve, "--queue", command->queue,
        "requests that may wait for a lane, short and long ones each; more are answered 429")
        ->check(CLI::Range(0, 1024));
    add(*serve, "--deadline", command->deadline_seconds,
        "seconds from a whole request to its answer; what would take longer is answered 504")
        ->check(CLI::Range(0.1, 86400.0));
    add(*serve, "--max-body", command->body_mib, "MiB of a request's body; more is answered 413")
        ->check(CLI::Range(1, 4096));
    add(*serve, "--memory", command->memory_mib,
        "MiB for all scenes that are worked on, as estimated; 0: half of what there is, at most "
        "3072")
        ->check(CLI::Range(0, 1 << 20));
    add(*serve, "--cache", command->cache_mib, "MiB of answers to renders that are kept; 0: none")
        ->check(CLI::Range(0, 1 << 20));
    add(*serve, "--cache-dir", command->cache_dir,
        "a folder where answers are kept that outlive the server; several may share it");
    add(*serve, "--cache-disk", command->cache_disk_mib, "MiB of that folder")
        ->check(CLI::Range(1, 1 << 24));
    add(*serve, "--max-connections", command->connections, "connections at once")
        ->check(CLI::Range(1, 100'000));
    add_threads(*serve, command->threads);
    add(*serve, "--allow-host", command->http.allowed_hosts,
        "a further name of this server (Host header); may be repeated")
        ->delimiter(',');
    add(*serve, "--allow-origin", command->http.allowed_origins,
        "an origin, scheme://host:port, whose pages may post; may be repeated")
        ->delimiter(',');
    add(*serve, "--token-file", command->token_file,
        "a file whose first line clients have to show: Authorization: Bearer ...");
    serve
        ->add_flag("--open", command->open_to_all,
                   "listen beyond this machine without a token: something else guards it")
        ->envname("AWAN_OPEN");
    add(*serve, "--log", *log, "a line for every answer to standard error: off, text or json")
        ->check(CLI::IsMember({"off", "text", "json"}));
    add_device(*serve, command->device);
    serve->footer("A flag wins over its environment variable, and that over the file of --config.");
    return [command, listen, log] {
        const auto address = parse_listen(*listen);
        command->http.host = address->host;
        command->http.port = address->port;
        command->log = *log == "json"   ? LogFormat::kJson
                       : *log == "text" ? LogFormat::kText
                                        : LogFormat::kNone;
        return run_serve(*command);
    };
}

Run add_render(CLI::App& app) {
    auto command = std::make_shared<RenderCommand>();
    command->threads = processors();
    CLI::App* render = app.add_subcommand("render", "a scene to an image");
    add_scene(*render, command->scene);
    add(*render, "-o,--output", command->outputs,
        "a .png or .exr file, or - for standard output; of a sequence a name with %04d or #### in "
        "it "
        "for numbered files, or an animation, .webp or .apng; may be repeated")
        ->required()
        ->allow_extra_args(false);
    add(*render, "--time", command->time, "seconds, instead of the document's");
    add(*render, "--frames", command->frames,
        "of the scene's sequence: all, or numbers from 0 as 3, 0-11,20 or 0-99x10");
    render
        ->add_flag("--flipbook", command->flipbook,
                   "a sequence's frames side by side on one .png or .exr; a .json beside it says "
                   "what lies where")
        ->envname("AWAN_FLIPBOOK");
    add(*render, "--columns", command->columns, "of a flipbook; 0: about a square")
        ->check(CLI::Range(0, limits::kMaxImageSide));
    add(*render, "--bits", command->bits, "of a channel of PNG, 8 or 16, instead of the document's")
        ->check(CLI::IsMember({8, 16}));
    add_farm_flags(*render, command->skip_existing, command->depfile);
    render
        ->add_flag("--json", command->json,
                   "a line of JSON for every picture: digest, rung, error, times")
        ->envname("AWAN_JSON");
    add(*render, "--fps", command->frames_per_second, "frames a second that an animation shows")
        ->check(CLI::Range(0.1, 1000.0));
    add(*render, "--width", command->width, "pixels, instead of the document's")
        ->check(CLI::Range(1, limits::kMaxImageSide));
    add(*render, "--height", command->height, "pixels, instead of the document's")
        ->check(CLI::Range(1, limits::kMaxImageSide));
    add(*render, "--format", command->format,
        "png, png16 (16 bits a channel) or exr, instead of the document's; webp or apng for "
        "standard output")
        ->check(CLI::IsMember({"png", "png16", "exr", "webp", "apng"}));
    add(*render, "--background", command->background,
        "sky or transparent, instead of the document's")
        ->check(CLI::IsMember({"sky", "transparent"}));
    add(*render, "--layers", command->layers,
        "of an .exr, channels beside the colours, instead of the document's: all, none, or some of "
        "depth,transmittance,sun,sky,multiple,haze,background");
    CLI::Option* const rung = add(*render, "--rung", command->rung,
                                  "a rung of accuracy by name, instead of the document's accuracy");
    rung->check(CLI::IsMember(rung_names()));
    CLI::Option* const error =
        add(*render, "--error", command->error,
            "the cheapest rung of at most this relative error, instead of the document's accuracy");
    CLI::Option* const time_ms =
        add(*render, "--time-ms", command->time_ms,
            "the best rung within these milliseconds, instead of the document's accuracy");
    error->check(CLI::PositiveNumber)->excludes(rung)->excludes(time_ms);
    time_ms->check(CLI::PositiveNumber)->excludes(rung);
    add_state(*render, command->scene);
    add_threads(*render, command->threads);
    add_device(*render, command->device);
    render->footer(
        "Of a sequence:\n"
        "  awan render growth.json -o growth.webp                        to look at; .apng too\n"
        "  awan render growth.json --frames all -o growth.%04d.exr       numbered files\n"
        "  awan render growth.json --frames 30-59 -o growth.####.exr     a farm's share of them\n"
        "  awan render growth.json --flipbook -o growth.png              a sheet, and growth.json\n"
        "A frame depends on its time alone: rendered by itself, on another machine or on other\n"
        "threads, it has the same bytes.");
    return [command] { return run_render(*command); };
}

// "800x600".
std::string take_size(const std::string& text, FlyCommand& command) {
    int width = 0, height = 0, end = 0;
    const bool whole = std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end) == 2 &&
                       static_cast<std::size_t>(end) == text.size();
    if (!whole || width < 1 || height < 1 || std::max(width, height) > limits::kMaxImageSide)
        return text + " is not WIDTHxHEIGHT, each from 1 to " +
               std::to_string(limits::kMaxImageSide);
    command.width = width;
    command.height = height;
    return {};
}

Run add_fly(CLI::App& app) {
    auto command = std::make_shared<FlyCommand>();
    command->threads = processors();
    auto size = std::make_shared<std::string>();
    CLI::App* fly = app.add_subcommand(
        "fly", "a flight around clouds or through them: pictures, and a report of how it went");
    fly->add_option("scene", command->scenes,
                    std::string(kSceneHelp) + "; or several, whose clouds become one scene")
        ->required();
    add(*fly, "-o,--output", command->outputs,
        "a .webp or .apng, a name with %04d or #### in it for numbered .png or .exr, or a .json, "
        "the scene with the flight's camera keys; may be repeated; none: only the report")
        ->allow_extra_args(false);
    add(*fly, "--path", command->path,
        "orbit (around the clouds), through (in at one side, out at the other), keys (the "
        "document's own), or a .json file of camera keys; the document's own, else orbit");
    add(*fly, "--mode", command->mode,
        "thin, medium or thick: an optical depth of 1, 6 or 30; as the scenes stand")
        ->check(CLI::IsMember({"thin", "medium", "thick"}));
    add(*fly, "--frames", command->frames, "how many; those of the document's sequence, else 48")
        ->check(CLI::Range(std::uint64_t{1}, limits::kMaxCameraKeys));
    add(*fly, "--size", *size, "WIDTHxHEIGHT in pixels, instead of the document's")
        ->check([command](const std::string& text) { return take_size(text, *command); });
    add(*fly, "--fps", command->frames_per_second, "frames a second that an animation shows")
        ->check(CLI::Range(0.1, 1000.0));
    add(*fly, "--rung", command->rung,
        "a rung of accuracy by name, instead of transport-16, which is made for flights: its light "
        "is kept from frame to frame")
        ->check(CLI::IsMember(rung_names()));
    add(*fly, "--timeout", command->timeout_seconds,
        "seconds after which it stops with what is done; 0: at its end")
        ->check(CLI::Range(0.0, 1e6));
    only_one(add(*fly, "--report", command->report,
                 "a .json or .txt file: time, frames, particles, billboards, frames a second, "
                 "stages, memory; the text is printed too"));
    add(*fly, "--set", command->input.sets,
        "a value of the first document, as /sun/elevation=12; may be repeated")
        ->allow_extra_args(false);
    add_textures(*fly, command->input);
    add(*fly, "--seed", command->input.seed, "instead of the first document's");
    add(*fly, "--radius", command->input.radius,
        "of ready particles (.ply, .csv), in place of what the file says of it")
        ->check(CLI::PositiveNumber);
    add_threads(*fly, command->threads);
    add_device(*fly, command->device);
    fly->footer(
        "  awan fly cumulus.json -o flight.webp                            once around it\n"
        "  awan fly a.json b.json --path through --mode thick --frames 96 --size 640x360 \\\n"
        "      --timeout 60 --report report.json -o frames/%04d.png\n"
        "  awan fly cumulus.json --path keys.json -o flight.json           to render later\n"
        "Camera keys are a list of {\"time\", \"eye\", \"target\", \"fov\"}, as sequence.camera.");
    return [command, size] { return run_fly(*command); };
}

Run add_accuracy(CLI::App& app) {
    auto command = std::make_shared<AccuracyCommand>();
    command->threads = processors();
    CLI::App* accuracy = app.add_subcommand(
        "accuracy", "what accuracy costs a scene: every rung's time and its error to the truth");
    accuracy->add_option("scene", command->scenes, std::string(kSceneHelp) + "; or several")
        ->required();
    add_values(*accuracy, command->input);
    add(*accuracy, "-o,--output", command->outputs,
        "a .json, .csv or .png (plot) file, or - for standard output; may be repeated")
        ->required()
        ->allow_extra_args(false);
    add(*accuracy, "--format", command->format, "json, csv or png, for standard output")
        ->check(CLI::IsMember({"json", "csv", "png"}));
    add(*accuracy, "--theme", command->theme, "light or dark, of the plot")
        ->check(CLI::IsMember({"light", "dark"}));
    add(*accuracy, "--scale", command->scale, "size of the plot, times 1120 pixels")
        ->check(CLI::Range(1.0, 4.0));
    add(*accuracy, "--size", command->side, "pixels of the reference's longer side")
        ->check(CLI::Range(8, 2048));
    add(*accuracy, "--samples", command->samples, "paths a pixel of the reference")
        ->check(CLI::Range(2u, 1u << 24));
    add(*accuracy, "--rungs", command->rungs, "rungs by name, with commas; all but truth")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember(rung_names()));
    add(*accuracy, "--runs", command->runs, "timed renders of a rung; the first does not count")
        ->check(CLI::Range(1, 1000));
    add(*accuracy, "--within", command->within_seconds,
        "seconds that a scene may take: the reference is then as good as fits; 0 is no limit")
        ->check(CLI::Range(0.0, 1e6));
    add_threads(*accuracy, command->threads);
    add_device(*accuracy, command->device);
    accuracy->footer(
        "Traces each scene's truth, renders every rung, times it at the scene's own size, and\n"
        "draws error over time. The blue line is what nothing beats; hollow marks are what the\n"
        "plan predicted; a mark with \"\u2264\" has an error lost in the reference's noise. Below "
        "it:\n"
        "each rung's picture and its difference to the truth, blue too dark, orange too bright.");
    return [command] { return run_accuracy(*command); };
}

Run add_particles(CLI::App& app) {
    auto command = std::make_shared<ParticlesCommand>();
    command->threads = processors();
    CLI::App* particles = app.add_subcommand("particles", "a scene to its particles");
    add_scene(*particles, command->scene);
    add(*particles, "-o,--output", command->output,
        "a .json, .csv, .ply, .awn, .awa, .glb (points), .vdb (volume of extinction) or .xml "
        "(FlightGear's clouds) file, or - for standard output");
    add(*particles, "--format", command->format,
        "json, csv, ply, awn, awa, glb, vdb or xml, for standard output")
        ->check(CLI::IsMember({"json", "csv", "ply", "awn", "awa", "glb", "vdb", "xml"}));
    add(*particles, "--unit", command->unit,
        "metres that a unit of length is in an .xml, whose lengths are metres")
        ->check(CLI::Range(1e-3, 1e6));
    add(*particles, "--voxels", command->voxels,
        "cells along the longest side of a .vdb; fewer where it would take long")
        ->check(CLI::Range(8, 1024));
    particles
        ->add_flag(
            "--light", command->light,
            "of a .vdb: a grid `light` beside `density`, the mean radiance that matter sends "
            "out per optical depth")
        ->envname("AWAN_LIGHT");
    add(*particles, "--time", command->time, "seconds, instead of the document's");
    add(*particles, "--frames", command->frames,
        "of the scene's sequence, to numbered files: all, or numbers from 0 as 3, 0-11,20 or "
        "0-99x10");
    add_farm_flags(*particles, command->skip_existing, command->depfile);
    add_state(*particles, command->scene);
    add_threads(*particles, command->threads);
    return [command] { return run_particles(*command); };
}

Run add_sky(CLI::App& app) {
    auto command = std::make_shared<SkyCommand>();
    command->threads = processors();
    CLI::App* sky = app.add_subcommand(
        "sky", "a scene's sky all around, without sun and clouds, as an environment map");
    add_scene(*sky, command->scene);
    add(*sky, "-o,--output", command->output, "an .exr or a .png file, or - for standard output")
        ->required();
    add(*sky, "--format", command->format, "exr or png, for standard output")
        ->check(CLI::IsMember({"exr", "png"}));
    add(*sky, "--width", command->width, "pixels, an even number; the map is half as high")
        ->check(CLI::Range(2, limits::kMaxImageSide));
    add_farm_flags(*sky, command->skip_existing, command->depfile);
    add_threads(*sky, command->threads);
    sky->footer(
        "Equirectangular: +y is up, +z (azimuth 0) in the middle, +x (azimuth 90) a quarter from\n"
        "the left. The EXR's header has the sun's direction and irradiance (awan:sun_direction,\n"
        "awan:sun_irradiance), for a light of its own.");
    return [command] { return run_sky(*command); };
}

Run add_impostor(CLI::App& app) {
    auto command = std::make_shared<ImpostorCommand>();
    auto full = std::make_shared<bool>(false);
    command->threads = processors();
    CLI::App* impostor = app.add_subcommand(
        "impostor", "a scene from many sides on one atlas, for cards in a game engine");
    add_scene(*impostor, command->scene);
    add(*impostor, "-o,--output", command->output,
        "a .png or an .exr (with depth) file; its layout goes to the .json beside it")
        ->required();
    add(*impostor, "--format", command->format, "png or exr; must agree with the file's name")
        ->check(CLI::IsMember({"png", "exr"}));
    add(*impostor, "--views", command->wish.views, "along a side of the atlas")
        ->check(CLI::Range(2, kMostImpostorViews));
    add(*impostor, "--size", command->wish.size, "pixels of a view's side")
        ->check(CLI::Range(1, kMostImpostorSize));
    impostor
        ->add_flag("--full", *full,
                   "from below too: octahedral instead of hemi-octahedral, down to the horizon")
        ->envname("AWAN_FULL");
    add_farm_flags(*impostor, command->skip_existing, command->depfile);
    add_threads(*impostor, command->threads);
    add_device(*impostor, command->device);
    return [command, full] {
        if (*full) command->wish.mapping = ImpostorMapping::kSphere;
        return run_impostor(*command);
    };
}

Run add_plan(CLI::App& app) {
    auto command = std::make_shared<PlanCommand>();
    command->threads = processors();
    CLI::App* plan = app.add_subcommand("plan", "what would be simulated, and why, as JSON");
    add_scene(*plan, command->scene);
    add(*plan, "-o,--output", command->output, "a file, or - for standard output");
    add_farm_flags(*plan, command->skip_existing, command->depfile);
    add_state(*plan, command->scene);
    add_threads(*plan, command->threads);
    return [command] { return run_plan(*command); };
}

Run add_state_command(CLI::App& app) {
    auto command = std::make_shared<StateCommand>();
    command->threads = processors();
    CLI::App* state = app.add_subcommand(
        "state", "an automaton at the scene's time to a file, to go on from later (--state)");
    add_scene(*state, command->scene);
    add(*state, "-o,--output", command->output, "a file, or - for standard output")->required();
    add(*state, "--cloud", command->cloud,
        "which of the scene's clouds, from 0; needed when several are automata");
    add_farm_flags(*state, command->skip_existing, command->depfile);
    add_threads(*state, command->threads);
    return [command] { return run_state(*command); };
}

Run add_convert(CLI::App& app) {
    auto command = std::make_shared<ConvertCommand>();
    CLI::App* convert = app.add_subcommand("convert", "a layout or particles to a scene, and back");
    add_scene(*convert, command->input, "input");
    convert
        ->add_option("output", command->output,
                     "a .json, .awn or .awa file, or - for standard output")
        ->required();
    add(*convert, "--format", command->format, "json, awn or awa, for standard output")
        ->check(CLI::IsMember({"json", "awn", "awa"}));
    add_farm_flags(*convert, command->skip_existing, command->depfile);
    return [command] { return run_convert(*command); };
}

Run add_validate(CLI::App& app) {
    auto command = std::make_shared<ValidateCommand>();
    CLI::App* validate =
        app.add_subcommand("validate", "whether scenes can be, and what is wrong with them");
    validate->add_option("scene", command->scenes, std::string(kSceneHelp) + "; or several")
        ->required();
    add_values(*validate, command->input);
    return [command] { return run_validate(*command); };
}

Run add_presets(CLI::App& app) {
    auto command = std::make_shared<PresetsCommand>();
    CLI::App* presets = app.add_subcommand(
        "presets", "the scenes that ship with this program, or one as a document");
    presets->add_option("name", command->name,
                        "of one of them, or its genus, as \"cumulus congestus\"");
    return [command] { return run_presets(*command); };
}

Run add_digest(CLI::App& app) {
    auto command = std::make_shared<DigestCommand>();
    CLI::App* digest =
        app.add_subcommand("digest", "what equal scenes have in common: 32 hex digits");
    add_scene(*digest, command->scene);
    add_state(*digest, command->scene);
    return [command] { return run_digest(*command); };
}

// `app` has all of its commands when the script is asked for.
Run add_completion(CLI::App& app) {
    auto shell = std::make_shared<std::string>();
    CLI::App* completion =
        app.add_subcommand("completion", "a script that completes commands and flags in a shell");
    completion->add_option("shell", *shell, "bash, zsh or fish: source <(awan completion bash)")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    return [&app, shell] {
        const std::string script = completion_script(app, *shell);
        std::fwrite(script.data(), 1, script.size(), stdout);
        return kExitFine;
    };
}

// What was printed has to have arrived: a full disk is no success.
int once_printed(int code) {
    const bool arrived = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (arrived || code != kExitFine) return code;
    return report_error("", Error{ErrorCode::kIo, "", "cannot write standard output"});
}

}  // namespace

int main(int argc, char** argv) {
    // A heap for each thread takes 64 MiB of addresses, which are short under a limit, and keeps what it once took.
    mallopt(M_ARENA_MAX, 4);
    // Writing to a pipe that was closed then fails, with a message, instead of ending the process.
    std::signal(SIGPIPE, SIG_IGN);
    // So does writing more than a file may hold (ulimit -f).
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app("Awan renders clouds.", "awan");
    app.footer(
        "Every flag has an environment variable; awan COMMAND --help names it.\n"
        "Exit codes: 0 fine, 2 bad usage, 3 a scene that cannot be, 4 could not render,\n"
        "5 could not read or write.");
    app.set_version_flag("--version", std::string("awan ") + engine_version());
    app.require_subcommand(1);
    app.config_formatter(std::make_shared<ServeConfig>());
    // CLI11 reads the file before the environment, so this variable is looked up here. A file that
    // is named must be there.
    const char* const config = std::getenv("AWAN_CONFIG");
    const bool named = config != nullptr && *config != '\0';
    app.set_config("--config", named ? config : "",
                   "flags of serve, one a line: queue = 4 (Env:AWAN_CONFIG)", named);
    app.allow_config_extras(CLI::config_extras_mode::error);

    const std::pair<const char*, Run> commands[] = {{"serve", add_serve(app)},
                                                    {"render", add_render(app)},
                                                    {"fly", add_fly(app)},
                                                    {"accuracy", add_accuracy(app)},
                                                    {"particles", add_particles(app)},
                                                    {"sky", add_sky(app)},
                                                    {"impostor", add_impostor(app)},
                                                    {"plan", add_plan(app)},
                                                    {"convert", add_convert(app)},
                                                    {"state", add_state_command(app)},
                                                    {"validate", add_validate(app)},
                                                    {"presets", add_presets(app)},
                                                    {"digest", add_digest(app)},
                                                    {"completion", add_completion(app)}};
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const bool help = e.get_exit_code() == 0;
        app.exit(e);
        if (help && std::cout.flush()) return kExitFine;
        if (help)
            return report_error("", Error{ErrorCode::kIo, "", "cannot write standard output"});
        return dynamic_cast<const CLI::FileError*>(&e) ? exit_code_of(ErrorCode::kIo) : kExitUsage;
    }
    try {
        for (const auto& [name, run] : commands)
            if (app.got_subcommand(name)) return once_printed(run());
        // E.g. std::bad_alloc, or a thread that cannot be made.
    } catch (const std::exception& e) {
        return report_error("", error_of_thrown(e));
    }
    return kExitUsage;
}
