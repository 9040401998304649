// The flags of `awan serve`.
#include "server/cli/flags.h"

namespace awan {

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

}  // namespace awan
