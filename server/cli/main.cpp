// awan: the command line. Flags become plain values here; commands.cpp and serve.cpp do the work.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "core/base/thrown.h"
#include "core/pipeline.h"
#include "server/cli/cli.h"
#include "server/cli/completion.h"
#include "server/cli/flags.h"
#include "server/service/problem.h"

namespace {

using namespace awan;

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
                                                    {"bench", add_bench(app)},
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
