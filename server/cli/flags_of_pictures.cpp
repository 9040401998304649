// The flags of the commands that make pictures.
#include <algorithm>

#include "core/pipeline.h"
#include "core/scene/limits.h"
#include "core/scene/rungs.h"
#include "server/cli/flags.h"
#include "server/cli/frames.h"
#include "server/cli/source_figures.h"

namespace awan {
namespace {

std::vector<std::string> rung_names() {
    std::vector<std::string> names;
    for (const Rung& rung : ladder()) names.emplace_back(rung.name);
    return names;
}

constexpr const char* kSaysWhatCame = "a line of JSON that says what came of it: digest, times";
void add_json(CLI::App& command, bool& json, const char* says) {
    command.add_flag("--json", json, says)->envname("AWAN_JSON");
}

// "800x600".
std::string take_size(const std::string& text, std::optional<int>& to_width,
                      std::optional<int>& to_height) {
    int width = 0, height = 0, end = 0;
    const bool whole = std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end) == 2 &&
                       static_cast<std::size_t>(end) == text.size();
    if (!whole || width < 1 || height < 1 || std::max(width, height) > limits::kMaxImageSide)
        return text + " is not WIDTHxHEIGHT, each from 1 to " +
               std::to_string(limits::kMaxImageSide);
    to_width = width;
    to_height = height;
    return {};
}

// Of a command with a picture's `width` and `height`. The check keeps the text that it is read to.
template <typename Command>
CLI::Option* add_size(CLI::App& app, const std::shared_ptr<Command>& command) {
    auto text = std::make_shared<std::string>();
    return add(app, "--size", *text, "WIDTHxHEIGHT in pixels, instead of the document's")
        ->check([command, text](const std::string& given) {
            return take_size(given, command->width, command->height);
        });
}

}  // namespace

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
    add_json(*render, command->json,
             "a line of JSON for every picture: digest, rung, error, times");
    render
        ->add_flag("--preview", command->preview,
                   "to look at in passing: one ray a pixel, edges are jagged, no error is measured")
        ->envname("AWAN_PREVIEW");
    add(*render, "--fps", command->frames_per_second, "frames a second that an animation shows")
        ->check(CLI::Range(0.1, 1000.0));
    CLI::Option* const size = add_size(*render, command);
    for (const auto& [name, side] :
         {std::pair{"--width", &command->width}, std::pair{"--height", &command->height}})
        add(*render, name, *side, "pixels, instead of the document's")
            ->check(CLI::Range(1, limits::kMaxImageSide))
            ->excludes(size);
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

Run add_fly(CLI::App& app) {
    auto command = std::make_shared<FlyCommand>();
    command->threads = processors();
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
    add_size(*fly, command);
    add(*fly, "--fps", command->frames_per_second, "frames a second that an animation shows")
        ->check(CLI::Range(0.1, 1000.0));
    add(*fly, "--rung", command->rung,
        "a rung of accuracy by name, instead of transport-16, which is made for flights: its light "
        "is kept from frame to frame")
        ->check(CLI::IsMember(rung_names()));
    add(*fly, "--impostors", command->impostors,
        "a cloud's picture, kept while its bound holds and shown in its place: auto (where that "
        "pays), on or off")
        ->check(CLI::IsMember({"auto", "on", "off"}));
    add(*fly, "--impostor-pixels", command->impostor_pixels,
        "that bound: by how many pixels at most a kept picture may show matter beside its place")
        ->check(CLI::Range(kLeastImpostorPixels, kMostImpostorPixels));
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
    return [command] { return run_fly(*command); };
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

Run add_bench(CLI::App& app) {
    auto command = std::make_shared<BenchCommand>();
    command->threads = processors();
    CLI::App* bench = app.add_subcommand(
        "bench", "the figures of time that the source documents print, and this machine's");
    std::vector<std::string> words(std::begin(kBenchSourceWords), std::end(kBenchSourceWords));
    add(*bench, "--sources", command->sources,
        "cubes, automaton, spheres, implicit, with commas; all")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember(words));
    add(*bench, "-o,--output", command->outputs,
        "a .json or .png (plot) file, or - for standard output; may be repeated")
        ->allow_extra_args(false);
    add(*bench, "--format", command->format, "json or png, for standard output")
        ->check(CLI::IsMember({"json", "png"}));
    add(*bench, "--theme", command->theme, "light or dark, of the plot")
        ->check(CLI::IsMember({"light", "dark"}));
    add_threads(*bench, command->threads);
    add_device(*bench, command->device);
    bench->footer(
        "Takes about a minute, without a GPU three; frames a second are of drawing alone, by light "
        "that is there.");
    return [command] { return run_bench(*command); };
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
    add_json(*sky, command->json, kSaysWhatCame);
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
    add_json(*impostor, command->json, kSaysWhatCame);
    add_threads(*impostor, command->threads);
    add_device(*impostor, command->device);
    return [command, full] {
        if (*full) command->wish.mapping = ImpostorMapping::kSphere;
        return run_impostor(*command);
    };
}

}  // namespace awan
