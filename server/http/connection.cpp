#include "server/http/connection.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "server/limits.h"

namespace awan {
namespace {

// Small writes are gathered, so that a head and a short body leave in one packet.
constexpr std::size_t kGather = 64u << 10;

// A large answer is copied and sent in slices, so that it stands in memory once and not twice.
constexpr std::size_t kSlice = 1u << 20;

// What one client takes at once, so that a fast one does not keep the thread that polls from the others.
constexpr std::size_t kMostAtOnce = 1u << 20;

// How often a writer that waits for its client looks whether it is still there.
constexpr int kLookMs = 100;

}  // namespace

void begin_answer(Connection& c) {
    auto nobody = Connection::Voice::kNone;
    // A probe is one call that does not wait.
    while (!c.voice.compare_exchange_weak(nobody, Connection::Voice::kAnswer) &&
           nobody != Connection::Voice::kAnswer)
        nobody = Connection::Voice::kNone;
}

void find_out_whether_gone(Connection& c) {
    // HTTP/1.0 knows no interim answers.
    if (c.head.http10) return;
    auto nobody = Connection::Voice::kNone;
    if (!c.voice.compare_exchange_strong(nobody, Connection::Voice::kProbe)) return;
    constexpr std::string_view kProbe = "HTTP/1.1 100 Continue\r\n\r\n";
    const ssize_t n =
        send(c.socket.get(), kProbe.data(), kProbe.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n != static_cast<ssize_t>(kProbe.size())) c.gone->store(true);
    c.voice = Connection::Voice::kNone;
}

Received receive(const Connection& connection, std::size_t limit, std::string& to) {
    char buffer[64u << 10];
    const ssize_t n =
        recv(connection.socket.get(), buffer, std::min(limit, sizeof buffer), MSG_DONTWAIT);
    if (n > 0) {
        to.append(buffer, static_cast<std::size_t>(n));
        return Received::kBytes;
    }
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR))
        return Received::kNothing;
    return Received::kClosed;
}

namespace {

// Whether all went out. False also where the client takes no more now; `alive`: it may take more later.
bool send_some(int socket, std::string_view bytes, std::size_t& sent, std::size_t& left,
               bool& alive) {
    while (sent < bytes.size() && left > 0) {
        const ssize_t n = send(socket, bytes.data() + sent, std::min(bytes.size() - sent, left),
                               MSG_DONTWAIT | MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            alive = errno == EAGAIN || errno == EWOULDBLOCK;
            return false;
        }
        sent += static_cast<std::size_t>(n);
        left -= static_cast<std::size_t>(n);
    }
    return sent == bytes.size();
}

}  // namespace

bool send_unsent(Connection& c, std::atomic<std::size_t>& parked_in_all) {
    bool alive = true;
    std::size_t left = kMostAtOnce;
    if (send_some(c.socket.get(), c.out, c.sent, left, alive)) {
        // Not clear(): a kept connection must not keep the memory of a large answer.
        c.out = {};
        c.sent = 0;
        if (c.shared && send_some(c.socket.get(), *c.shared, c.shared_sent, left, alive)) {
            c.shared.reset();
            c.shared_sent = 0;
        }
    }
    count_parked(c, parked_in_all);
    return alive;
}

void count_parked(Connection& c, std::atomic<std::size_t>& parked_in_all) {
    const std::size_t rest = c.out.size() - c.sent;
    // Wraps when it shrinks, as unsigned numbers may.
    parked_in_all += rest - c.parked;
    c.parked = rest;
}

bool ConnectionSink::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::size_t n = std::min(bytes.size(), kSlice);
        connection_.out.append(bytes.substr(0, n));
        bytes.remove_prefix(n);
        if ((!gathers_ || connection_.out.size() >= kGather) && !send_or_wait()) return false;
    }
    return true;
}

bool ConnectionSink::write_shared(const std::shared_ptr<const std::string>& bytes) {
    // A small one goes out with its head, whole: a proxy asks another server instead of one that ended between them.
    if (bytes->size() <= kGather) return write(*bytes);
    connection_.shared = bytes;
    connection_.shared_sent = 0;
    return true;
}

bool ConnectionSink::flush() {
    return send_or_wait();
}

bool ConnectionSink::send_or_wait() {
    for (;;) {
        if (!send_unsent(connection_, parked_)) return false;
        if (!connection_.unsent() || never_wait_ || parked_ <= limits::kMaxParkedBytes) return true;
        if (Connection::Clock::now() >= until_ || connection_.gone->load()) return false;
        pollfd ready{connection_.socket.get(), POLLOUT, 0};
        poll(&ready, 1, kLookMs);
    }
}

Result<Descriptor> listen_on(const std::string& host, int port) {
    const auto failed = [&](const std::string& why) {
        return Error{ErrorCode::kIo, "",
                     "cannot listen on " + host + ":" + std::to_string(port) + ": " + why};
    };
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const std::string bare =
        host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
    const std::string service = std::to_string(port);
    if (const int code = getaddrinfo(bare.c_str(), service.c_str(), &hints, &found))
        return failed(gai_strerror(code));
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, freeaddrinfo);

    std::string why = "no address";
    for (const addrinfo* a = found; a; a = a->ai_next) {
        Descriptor socket(
            ::socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol));
        const int on = 1;
        // SO_REUSEADDR: a restart need not wait for TIME_WAIT. Not SO_REUSEPORT, with which a
        // second server could bind the same port and take half of the connections.
        if (socket.get() >= 0 &&
            setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
            ::bind(socket.get(), a->ai_addr, a->ai_addrlen) == 0 &&
            ::listen(socket.get(), limits::kListenBacklog) == 0)
            return socket;
        why = errno == EADDRINUSE ? "the port is taken by another program" : std::strerror(errno);
    }
    return failed(why);
}

int port_of(const Descriptor& socket) {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    if (getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
    if (address.ss_family == AF_INET6)
        return ntohs(reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port);
    return ntohs(reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

}  // namespace awan
