#include "server/http/server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "core/base/thrown.h"
#include "server/http/state.h"

namespace awan {
namespace {

using Clock = Connection::Clock;

// How long no connection is accepted after there were no descriptors for one.
constexpr std::chrono::milliseconds kAcceptPause{100};

// Connections beyond the table, kept just long enough to tell them so.
constexpr std::size_t kTurnedAway = 32;

// Connections accepted in one turn. What they have sent is read before more come: whoever makes room has then been
// heard. At most half of kTurnedAway, so that those turned away in one turn find room beside those of the turn before.
constexpr int kAcceptsATurn = 16;

// How long a head or a body may come before its connection may have to make room for another, if it is the slowest.
constexpr std::chrono::milliseconds kGrace{500};

// After memory ran out outside any connection.
constexpr std::chrono::milliseconds kMemoryPause{20};

// Of this end of a socket (getsockname) or the other (getpeername), without the port.
std::string address_of(int fd, int (*which)(int, sockaddr*, socklen_t*)) {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    char text[INET6_ADDRSTRLEN] = "";
    if (which(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return {};
    if (address.ss_family == AF_INET) {
        const auto* in = reinterpret_cast<const sockaddr_in*>(&address);
        inet_ntop(AF_INET, &in->sin_addr, text, sizeof text);
        return text;
    }
    const auto* in6 = reinterpret_cast<const sockaddr_in6*>(&address);
    if (IN6_IS_ADDR_V4MAPPED(&in6->sin6_addr)) {
        inet_ntop(AF_INET, &in6->sin6_addr.s6_addr[12], text, sizeof text);
        return text;
    }
    inet_ntop(AF_INET6, &in6->sin6_addr, text, sizeof text);
    return "[" + std::string(text) + "]";
}

void drain_counter(int fd) {
    std::uint64_t count = 0;
    while (read(fd, &count, sizeof count) > 0) {
    }
}

}  // namespace

HttpServer::State::State(Service& s, Metrics& m, HttpOptions o)
    : service(s), metrics(m), options(std::move(o)), wake(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

// --- The turn of the loop

// Memory may run out at any time. Then one connection ends, never the thread: if there is enough for it, with a word.
template <typename What>
void HttpServer::State::guarded(Connection& c, const What& what) {
    try {
        try {
            what();
        } catch (const std::exception&) {
            if (c.socket.get() < 0 || c.with_worker) return;
            const auto body = std::exchange(c.body, {});
            refuse(c, 503, kOutOfMemoryText, "memory");
        }
    } catch (const std::exception&) {
        end(c);
    }
}

void HttpServer::State::poll_once() {
    std::vector<pollfd> polled;
    std::vector<Connection*> whose;
    polled.push_back({wake.get(), POLLIN, 0});
    // poll passes over -1: no listener while it must wait.
    const bool accepting = Clock::now() >= accept_after;
    polled.push_back({accepting ? listener.get() : -1, POLLIN, 0});
    Clock::time_point soonest = draining ? drain_until : Clock::time_point::max();
    if (!accepting) soonest = std::min(soonest, accept_after);
    for (Connection& c : connections) {
        short events = POLLIN;
        if (c.stand == Stand::kWriting) events = POLLOUT;
        // Once the client has closed its side, poll would report it for ever; a reset it reports in any case.
        if (c.stand == Stand::kWorking) events = c.half_closed ? 0 : POLLRDHUP;
        const bool deaf = c.stand == Stand::kWorking && c.gone->load();
        if (c.stand != Stand::kWorking) soonest = std::min(soonest, c.until);
        polled.push_back({deaf ? -1 : c.socket.get(), events, 0});
        whose.push_back(&c);
    }
    int wait_ms = -1;
    if (soonest != Clock::time_point::max()) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(soonest - Clock::now()).count();
        wait_ms = static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
    }
    if (::poll(polled.data(), polled.size(), wait_ms) < 0) return;

    if (polled[0].revents) drain_counter(wake.get());
    take_back_done();
    const auto now = Clock::now();
    for (std::size_t i = 0; i < whose.size(); ++i) {
        Connection& c = *whose[i];
        guarded(c, [&] {
            if (polled[i + 2].revents && c.socket.get() == polled[i + 2].fd)
                on_event(c, polled[i + 2].revents);
            if (c.socket.get() >= 0 && c.stand != Stand::kWorking && now >= c.until) on_timeout(c);
        });
    }
    if (polled[1].revents) accept_all();
    forget_ended();
}

void HttpServer::State::on_event(Connection& c, short events) {
    switch (c.stand) {
        case Stand::kWorking:
            if (events & (POLLHUP | POLLERR)) {
                c.gone->store(true);
            } else if (!std::exchange(c.half_closed, true)) {
                find_out_whether_gone(c);
            }
            return;
        case Stand::kWriting:
            if (!send_unsent(c, parked)) return end(c);
            if (!c.unsent()) written(c);
            return advance(c);
        case Stand::kLingering: {
            std::string thrown_away;
            if (receive(c, kLongBody, thrown_away) == Received::kClosed) end(c);
            return;
        }
        case Stand::kHead: {
            const bool first = c.in.empty();
            const Received got = receive(c, limits::kMaxHeadBytes + 1 - c.in.size(), c.in);
            if (got == Received::kClosed) return end(c);
            if (first && c.served > 0) c.until = Clock::now() + options.head_deadline;
            return advance(c);
        }
        case Stand::kBody: {
            const std::size_t before = c.body.size();
            const Received got = receive(c, c.head.content_length - before, c.body);
            if (got == Received::kClosed) return end(c);
            charge_body(c, c.body.size() - before);
            if (c.stand == Stand::kBody && c.body.size() == c.head.content_length) dispatch(c);
            return advance(c);
        }
    }
}

void HttpServer::State::on_timeout(Connection& c) {
    if (c.stand == Stand::kHead && !c.in.empty())
        return refuse(c, 408, "the head did not arrive in time", "timeout");
    if (c.stand == Stand::kBody)
        return refuse(c, 408, "the body did not arrive in time", "timeout");
    if (c.stand == Stand::kWriting) metrics.connection_refused("timeout");
    end(c);
}

void HttpServer::State::take_back_done() {
    Connection* taken = nullptr;
    {
        const std::lock_guard lock(done_mutex);
        taken = std::exchange(done, nullptr);
    }
    while (taken) {
        Connection& c = *std::exchange(taken, taken->done_before);
        c.with_worker = false;
        guarded(c, [&] {
            taken_back(c, c.alive);
            advance(c);
        });
    }
}

// --- Connections come and go

void HttpServer::State::accept_all() {
    for (int i = 0; i < kAcceptsATurn; ++i) {
        Descriptor socket(accept4(listener.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
        if (socket.get() < 0) {
            // Out of descriptors or memory: the connection stays in the backlog, and poll would
            // report it at once, again and again.
            if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR && errno != ECONNABORTED)
                accept_after = Clock::now() + kAcceptPause;
            return;
        }
        const int on = 1;
        setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        const bool full = connections.size() >= options.max_connections && !make_room();
        if (full && connections.size() >= options.max_connections + kTurnedAway) end_turned_away();
        // Those that made room count no more.
        forget_ended();
        Connection& c = connections.emplace_back();
        c.local_address = address_of(socket.get(), getsockname);
        c.client = address_of(socket.get(), getpeername);
        c.socket = std::move(socket);
        c.since = Clock::now();
        c.until = c.since + options.head_deadline;
        c.in_reserve = full;
    }
}

// Closes the connection that has waited longest for a head, one that has sent nothing before one
// that has begun, and where there is none, the one whose body comes slowest: the newcomer is likelier to have
// something to say. Whoever has just come has time to say it while there are others. False when all are at work.
bool HttpServer::State::make_room() {
    const auto now = Clock::now();
    Connection* longest = nullptr;
    Connection* newcomer = nullptr;
    Connection* slowest = nullptr;
    const auto rank = [](const Connection& x) { return std::pair(!x.in.empty(), x.since); };
    const auto rate = [&](const Connection& x) {
        const std::chrono::duration<double> taken = now - x.body_since;
        return static_cast<double>(x.body.size()) / taken.count();
    };
    for (Connection& c : connections) {
        if (c.socket.get() < 0 || c.in_reserve) continue;
        Connection*& head = now - c.since > kGrace ? longest : newcomer;
        if (c.stand == Stand::kHead && (!head || rank(c) < rank(*head))) head = &c;
        if (c.stand == Stand::kBody && now - c.body_since > kGrace &&
            (!slowest || rate(c) < rate(*slowest)))
            slowest = &c;
    }
    if (!longest && !slowest) longest = newcomer;
    if (longest) {
        metrics.connection_refused("connections");
        end(*longest);
        return true;
    }
    if (!slowest) return false;
    refuse(*slowest, 503, "there are too many connections, and this body came slowest",
           "connections");
    end(*slowest);
    return true;
}

// Closes one that has had its answer, the one that has lingered longest; where there is none, the one beyond the table
// that has been silent longest.
void HttpServer::State::end_turned_away() {
    Connection* lingering = nullptr;
    Connection* silent = nullptr;
    for (Connection& c : connections) {
        if (c.socket.get() < 0) continue;
        if (c.stand == Stand::kLingering && (!lingering || c.until < lingering->until))
            lingering = &c;
        if (c.in_reserve && c.stand == Stand::kHead && (!silent || c.since < silent->since))
            silent = &c;
    }
    if (Connection* one = lingering ? lingering : silent) end(*one);
}

void HttpServer::State::end(Connection& c) {
    body_bytes -= std::exchange(c.body_charged, 0);
    c.out.clear();
    c.sent = 0;
    c.shared.reset();
    count_parked(c, parked);
    c.socket.close();
}

void HttpServer::State::forget_ended() {
    connections.remove_if([](const Connection& c) { return c.socket.get() < 0; });
}

// --- The end

void HttpServer::State::begin_drain() {
    draining = true;
    drain_until = Clock::now() + options.drain_deadline;
    service.drain();
}

bool HttpServer::State::drained() const {
    // Lingering ones have their answer; a client that keeps its side open must not hold up the
    // stop.
    return std::all_of(connections.begin(), connections.end(), [](const Connection& c) {
        return c.stand == Stand::kHead || c.stand == Stand::kLingering;
    });
}

HttpServer::HttpServer(Service& service, Metrics& metrics, HttpOptions options)
    : state_(std::make_unique<State>(service, metrics, std::move(options))) {}

HttpServer::~HttpServer() = default;

Status HttpServer::bind() {
    State& s = *state_;
    rlimit descriptors{};
    if (getrlimit(RLIMIT_NOFILE, &descriptors) == 0 && descriptors.rlim_cur != RLIM_INFINITY) {
        const std::size_t all = descriptors.rlim_cur;
        const std::size_t reserved = limits::kSpareDescriptors + kTurnedAway;
        s.options.max_connections =
            std::min(s.options.max_connections, all > 2 * reserved ? all - reserved : reserved);
    }
    auto listener = listen_on(s.options.host, s.options.port);
    if (!listener) return listener.error();
    s.listener = std::move(listener).value();
    s.port = port_of(s.listener);
    s.rules.hosts = {"localhost", "127.0.0.1", "[::1]", s.options.host};
    s.rules.hosts.insert(s.rules.hosts.end(), s.options.allowed_hosts.begin(),
                         s.options.allowed_hosts.end());
    s.rules.origins = s.options.allowed_origins;
    s.rules.token = s.options.token;
    s.rules.open_paths = s.service.page_paths();
    return std::nullopt;
}

int HttpServer::port() const {
    return state_->port;
}

void HttpServer::run() {
    State& s = *state_;
    {
        Workers<Connection*> workers(s.options.workers, s.options.waiting_requests,
                                     [&s]() -> std::function<void(Connection*)> {
                                         auto codec = std::make_shared<HttpCodec>();
                                         return [&s, codec](Connection* connection) {
                                             s.answer_on_worker(*connection, *codec);
                                         };
                                     });
        s.workers = &workers;
        for (;;) {
            if (s.stopping && !s.draining) s.begin_drain();
            if (s.draining && (s.drained() || Clock::now() >= s.drain_until)) break;
            try {
                s.poll_once();
            } catch (const std::exception&) {
                // No memory to look at connections with, or to accept one.
                std::this_thread::sleep_for(kMemoryPause);
            }
        }
        s.listener.close();
        // Whoever has not finished by now is told that nobody waits; the workers end with that.
        for (Connection& c : s.connections)
            if (c.stand == Stand::kWorking) c.gone->store(true);
    }
    s.workers = nullptr;
    s.connections.clear();
}

void HttpServer::stop() {
    state_->stopping = true;
    const std::uint64_t one = 1;
    // A failed write means that the pipe is full: the thread is awake already.
    if (write(state_->wake.get(), &one, sizeof one) < 0) return;
}

}  // namespace awan
