#include <malloc.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <thread>

#include "core/formats/image_file.h"
#include "core/light/machine_speed.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/support.h"
#include "server/http/connection.h"

namespace awan {
namespace {

// A request's large arrays go back to the system when it ends. Left to itself, glibc raises its threshold to what was
// freed last and keeps them: 340 MB stayed after renders of 200,000 particles, 228 MB do so.
void give_memory_back() {
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
}

// Characters of a token. What can be guessed is no secret.
constexpr std::size_t kShortestToken = 16;

// Blocked in every thread and read from a descriptor, so that no code runs inside a signal handler.
sigset_t block_stop_signals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGINT);
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    return set;
}

// The first SIGTERM or SIGINT stops the server, the second the process. Ends when `over` is written
// to.
void watch_signals(const Descriptor& signals, const Descriptor& over, HttpServer& server) {
    bool stopping = false;
    for (;;) {
        pollfd polled[] = {{signals.get(), POLLIN, 0}, {over.get(), POLLIN, 0}};
        if (poll(polled, 2, -1) < 0) continue;
        if (polled[1].revents) return;
        signalfd_siginfo info{};
        if (read(signals.get(), &info, sizeof info) != static_cast<ssize_t>(sizeof info)) continue;
        if (stopping) _exit(128 + static_cast<int>(info.ssi_signo));
        stopping = true;
        std::fputs("awan: stopping; what is in flight is finished, a second signal stops at once\n",
                   stderr);
        server.stop();
    }
}

// A descriptor a connection: the soft limit is often 1024, the hard one far more.
void raise_descriptor_limit(std::size_t connections) {
    rlimit descriptors{};
    if (getrlimit(RLIMIT_NOFILE, &descriptors) != 0) return;
    const rlim_t wanted = connections + 4 * limits::kSpareDescriptors;
    if (descriptors.rlim_cur >= wanted) return;
    descriptors.rlim_cur = std::min(wanted, descriptors.rlim_max);
    setrlimit(RLIMIT_NOFILE, &descriptors);
}

// In steps of a tenth, so that a server started again most often says the same of the same scene.
MachineSpeed rounded(MachineSpeed speed) {
    constexpr double kStep = 1.1;
    return {std::pow(kStep, std::round(std::log(speed.slowness) / std::log(kStep)))};
}

void say_renderer(const RenderThread& renderer) {
    renderer.wait_until_started();
    const RenderThread::Info info = renderer.info();
    if (info.state == RenderThread::Info::State::kReady) {
        std::fprintf(stderr, "awan: renders with %s\n", info.device.renderer.c_str());
    } else {
        std::fprintf(stderr,
                     "awan: no renderer, /v1/render answers 503 where a plan is of splats: %s\n",
                     info.reason.c_str());
    }
}

// What memory there is: the machine's, the container's (cgroup v2), or the process's own limit, whichever is least.
std::size_t memory_there_is() {
    double bytes =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    double container = 0;
    if (std::ifstream file("/sys/fs/cgroup/memory.max"); file >> container)
        bytes = std::min(bytes, container);
    rlimit space{};
    if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
        bytes = std::min(bytes, static_cast<double>(space.rlim_cur));
    return static_cast<std::size_t>(bytes);
}

// The token of a file: its first line.
Result<std::string> read_token(const std::string& path) {
    auto text = read_input(path);
    if (!text) return text.error();
    text->resize(std::min(text->find_first_of("\r\n"), text->size()));
    const bool plain =
        std::all_of(text->begin(), text->end(), [](char c) { return c > ' ' && c <= '~'; });
    if (text->size() < kShortestToken || !plain)
        return Error{ErrorCode::kIo, "",
                     "--token-file " + path + ": its first line must be a token of at least " +
                         std::to_string(kShortestToken) + " printable characters"};
    return text;
}

Result<std::shared_ptr<DiskCache>> open_disk_cache(const ServeCommand& command) {
    DiskCacheOptions options;
    options.folder = command.cache_dir;
    options.bytes = command.cache_disk_mib << 20;
    options.say = [](const std::string& what) { std::fprintf(stderr, "awan: %s\n", what.c_str()); };
    auto cache = DiskCache::open(std::move(options));
    if (cache) return cache;
    return Error{cache.error().code, "", "--cache-dir " + cache.error().message};
}

// Names and addresses that only programs of this machine can reach.
bool is_loopback(const std::string& host) {
    return host == "localhost" || host.starts_with("127.") || host == "[::1]" || host == "::1";
}

// How many threads may wait at once: those in lanes, those in the lines of the lanes and of the renderer, those that
// follow jobs, and some more, to be told that these are full.
std::size_t workers_for(const LanesOptions& lanes) {
    return lanes.lanes + 2 * lanes.line + 2 + limits::kEventStreams;
}

}  // namespace

std::optional<ListenAddress> parse_listen(const std::string& text) {
    const auto port_from = [](const std::string& digits) -> std::optional<int> {
        if (digits.empty() || digits.size() > 5 ||
            !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
            return std::nullopt;
        const int port = std::stoi(digits);
        return port <= 65535 ? std::optional(port) : std::nullopt;
    };
    const HttpOptions defaults;
    if (const auto port = port_from(text)) return ListenAddress{defaults.host, *port};
    const std::size_t colon = text.rfind(':');
    const std::size_t bracket = text.rfind(']');
    const bool has_port =
        colon != std::string::npos && (bracket == std::string::npos || colon > bracket);
    std::string host = has_port ? text.substr(0, colon) : text;
    // Finds the colon that belongs to the port, if any.
    const bool bare_v6 = !host.starts_with('[') && host.find(':') != std::string::npos;
    if (host.empty() || bare_v6 || host.starts_with('[') != host.ends_with(']'))
        return std::nullopt;
    if (!has_port) return ListenAddress{host, defaults.port};
    const auto port = port_from(text.substr(colon + 1));
    if (!port) return std::nullopt;
    return ListenAddress{host, *port};
}

int run_serve(const ServeCommand& command) {
    give_memory_back();
    HttpOptions http = command.http;
    if (!command.token_file.empty()) {
        auto token = read_token(command.token_file);
        if (!token) return report_error("", token.error());
        http.token = *std::move(token);
    }
    if (http.token.empty() && !command.open_to_all && !is_loopback(http.host))
        return bad_usage("--listen " + http.host +
                         " is reached from other machines: name a token that they have to show, "
                         "--token-file FILE, or say --open where something else guards it");
    const sigset_t stop_signals = block_stop_signals();
    std::signal(SIGPIPE, SIG_IGN);
    raise_descriptor_limit(command.connections);
    set_exr_threads(command.threads);

    ServiceOptions service_options;
    service_options.threads = command.threads;
    service_options.speed = rounded(measure_speed());
    LanesOptions& lanes = service_options.lanes;
    lanes.lanes = command.lanes > 0
                      ? command.lanes
                      : std::max<std::size_t>(static_cast<std::size_t>(command.threads), 2);
    lanes.for_short = std::min(command.short_lanes, lanes.lanes - 1);
    lanes.line = command.queue;
    service_options.work_bytes = command.memory_mib > 0
                                     ? command.memory_mib << 20
                                     : std::min(limits::kWorkBytes, memory_there_is() / 2);
    service_options.jobs = lanes.lanes;
    service_options.cache_bytes = command.cache_mib << 20;
    if (!command.cache_dir.empty()) {
        auto opened = open_disk_cache(command);
        if (!opened) return report_error("", opened.error());
        service_options.disk = *std::move(opened);
    }
    const auto lights = std::make_shared<LightCache>(kLightCacheBytes);
    service_options.on_processor = processor_renderer(lights);

    http.workers = workers_for(lanes);
    http.max_connections = command.connections;
    http.max_body_bytes = command.body_mib << 20;
    http.max_body_bytes_in_all = std::max(limits::kMaxBodyBytesInAll, http.max_body_bytes);
    http.request_deadline =
        std::chrono::milliseconds(std::llround(1000 * command.deadline_seconds));
    AccessLog log(STDERR_FILENO, command.log);
    if (command.log != LogFormat::kNone)
        http.log = [&log](const AccessRecord& record) { log.add(record); };

    Metrics metrics;
    RenderThread renderer(device_renderer(command.device, command.threads, lights));
    Service service(renderer, metrics, service_options);
    HttpServer server(service, metrics, http);
    if (const Status failed = server.bind()) return report_error("", *failed);
    std::fprintf(stderr, "awan: listening on http://%s:%d/\n", http.host.c_str(), server.port());

    const Descriptor signals(signalfd(-1, &stop_signals, SFD_CLOEXEC));
    const Descriptor over(eventfd(0, EFD_CLOEXEC));
    std::thread herald([&] {
        try {
            say_renderer(renderer);
        } catch (const std::exception&) {
            // Without memory for its name, it goes unnamed.
        }
    });
    std::thread watcher([&] { watch_signals(signals, over, server); });
    std::exception_ptr thrown;
    try {
        server.run();
    } catch (...) {
        thrown = std::current_exception();
    }
    herald.join();
    const std::uint64_t one = 1;
    if (write(over.get(), &one, sizeof one) < 0) std::fputs("awan: eventfd failed\n", stderr);
    watcher.join();
    if (thrown) std::rethrow_exception(thrown);
    return kExitFine;
}

}  // namespace awan
