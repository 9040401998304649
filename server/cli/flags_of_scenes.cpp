// The flags of the commands that read and write scenes and particles.
#include "server/cli/flags.h"

namespace awan {

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
    add(*state, "--every", command->every,
        "states after every so many steps, to the scene's time or the last frame of its sequence, "
        "a file each; their names need a place for the step, %06d")
        ->check(CLI::Range(std::uint64_t{1}, limits::kMaxAutomatonSteps));
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

}  // namespace awan
