#include "server/cli/completion.h"

#include <CLI/CLI.hpp>

namespace awan {
namespace {

// "--width --height -o": every name of every flag of a command.
std::string flags_of(const CLI::App& command) {
    std::string flags;
    for (const CLI::Option* const option : command.get_options()) {
        for (const std::string& name : option->get_lnames())
            flags += (flags.empty() ? "--" : " --") + name;
        for (const std::string& name : option->get_snames())
            flags += (flags.empty() ? "-" : " -") + name;
    }
    return flags;
}

// One case of the script for each command.
std::string bash_script(const CLI::App& app) {
    std::string commands, cases;
    for (const CLI::App* const command : app.get_subcommands({})) {
        commands += (commands.empty() ? "" : " ") + command->get_name();
        cases += "        " + command->get_name() + ") flags=\"" + flags_of(*command) + "\" ;;\n";
    }
    return "_awan() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} flags=\"" +
           flags_of(app) +
           "\"\n"
           "    COMPREPLY=()\n"
           "    if [ \"$COMP_CWORD\" -eq 1 ] && [[ $word != -* ]]; then\n"
           "        COMPREPLY=($(compgen -W \"" +
           commands +
           "\" -- \"$word\"))\n"
           "        return\n"
           "    fi\n"
           "    case ${COMP_WORDS[1]} in\n" +
           cases +
           "    esac\n"
           "    if [[ $word == -* ]]; then COMPREPLY=($(compgen -W \"$flags\" -- \"$word\")); fi\n"
           "}\n"
           "complete -o default -F _awan awan\n";
}

// In single quotes, as fish reads them.
std::string fish_quoted(std::string text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out + "'";
}

std::string fish_script(const CLI::App& app) {
    std::string script;
    for (const CLI::App* const command : app.get_subcommands({})) {
        const std::string name = command->get_name();
        script += "complete -c awan -n __fish_use_subcommand -a " + name + " -d " +
                  fish_quoted(command->get_description()) + "\n";
        for (const CLI::Option* const option : command->get_options()) {
            if (option->get_positional()) continue;
            script += "complete -c awan -n '__fish_seen_subcommand_from " + name + "'";
            for (const std::string& word : option->get_lnames()) script += " -l " + word;
            for (const std::string& word : option->get_snames()) script += " -s " + word;
            // A value follows, which may be a file.
            if (option->get_expected_min() > 0) script += " -r";
            script += " -d " + fish_quoted(option->get_description()) + "\n";
        }
    }
    return script;
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
    if (shell == "fish") return fish_script(app);
    // zsh runs bash's completions once it is told to.
    const std::string before =
        shell == "zsh" ? "autoload -U +X compinit && compinit\nautoload -U +X bashcompinit && "
                         "bashcompinit\n"
                       : "";
    return before + bash_script(app);
}

}  // namespace awan
