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
#include <thread>

#include "core/light/machine_speed.h"
#include "server/cli/cli.h"
#include "server/http/connection.h"

namespace awan {
namespace {

// A request's large arrays go back to the system when it ends. Left to itself, glibc raises its threshold to what was
// freed last and keeps them: 340 MB stayed after renders of 200,000 particles, 228 MB do so.
void give_memory_back() {
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
}

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
void raise_descriptor_limit() {
    rlimit descriptors{};
    if (getrlimit(RLIMIT_NOFILE, &descriptors) != 0) return;
    const rlim_t wanted = limits::kMaxConnections + 4 * limits::kSpareDescriptors;
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
        std::fprintf(stderr, "awan: no renderer, /v1/render answers 503: %s\n",
                     info.reason.c_str());
    }
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
    const sigset_t stop_signals = block_stop_signals();
    std::signal(SIGPIPE, SIG_IGN);
    raise_descriptor_limit();

    Metrics metrics;
    RenderThread renderer(command.device, command.threads, command.queue);
    ServiceOptions service_options;
    service_options.threads = command.threads;
    service_options.speed = rounded(measure_speed());
    service_options.working = command.working;
    Service service(renderer, metrics, service_options);

    HttpOptions http = command.http;
    http.workers = command.working + command.queue + 1;
    HttpServer server(service, metrics, http);
    if (const Status failed = server.bind()) return report_error("", *failed);
    std::fprintf(stderr, "awan: listening on http://%s:%d/\n", http.host.c_str(), server.port());

    const Descriptor signals(signalfd(-1, &stop_signals, SFD_CLOEXEC));
    const Descriptor over(eventfd(0, EFD_CLOEXEC));
    std::thread herald([&] { say_renderer(renderer); });
    std::thread watcher([&] { watch_signals(signals, over, server); });
    server.run();
    herald.join();
    const std::uint64_t one = 1;
    if (write(over.get(), &one, sizeof one) < 0) std::fputs("awan: eventfd failed\n", stderr);
    watcher.join();
    return kExitFine;
}

}  // namespace awan
