// A client that sends exactly the bytes it is given, for tests of the transport.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <strings.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace awan::test {

using Clock = std::chrono::steady_clock;

struct Answer {
    int status = 0;  // 0: the connection ended before a whole answer
    std::vector<std::pair<std::string, std::string>> headers;
    std::string body;

    std::string header(std::string_view name) const {
        for (const auto& [key, value] : headers)
            if (key.size() == name.size() && strncasecmp(key.data(), name.data(), name.size()) == 0)
                return value;
        return {};
    }
};

class RawClient {
  public:
    // receive_buffer > 0: a client that takes little at a time.
    explicit RawClient(int port, int receive_buffer = 0)
        : fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        if (receive_buffer > 0)
            setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        connected_ = connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    ~RawClient() { close(); }
    RawClient(RawClient&& other) noexcept
        : fd_(std::exchange(other.fd_, -1)),
          connected_(other.connected_),
          received_(std::move(other.received_)) {}
    RawClient& operator=(RawClient&&) = delete;

    bool connected() const { return connected_; }
    void close() {
        if (fd_ >= 0) ::close(fd_);
        fd_ = -1;
    }

    // Sends no more, and goes on reading.
    void close_sending() { shutdown(fd_, SHUT_WR); }

    bool send(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t n = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (n <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(n));
        }
        return true;
    }

    // One answer, in whatever form its length is given. `head`: to a HEAD, which has no body.
    Answer read(bool head = false) {
        Answer answer;
        const std::size_t end = wait_for("\r\n\r\n");
        if (end == std::string::npos) return answer;
        parse_head(received_.substr(0, end), answer);
        received_.erase(0, end + 4);
        const int status = answer.status;
        answer.status = 0;
        if (head || status == 304 || status == 204 || status < 200) {
            answer.status = status;
        } else if (answer.header("Transfer-Encoding") == "chunked") {
            if (read_chunks(answer.body)) answer.status = status;
        } else if (!answer.header("Content-Length").empty()) {
            const std::size_t length = std::stoull(answer.header("Content-Length"));
            while (received_.size() < length && more()) {
            }
            if (received_.size() >= length) answer.status = status;
            answer.body = received_.substr(0, length);
            received_.erase(0, length);
        } else {
            answer.body = rest();
            answer.status = status;
        }
        return answer;
    }

    // Everything until the server closes.
    std::string rest() {
        while (more()) {
        }
        return std::exchange(received_, {});
    }

    // True when the server closes within that time, whatever it sends before.
    bool closes_within(std::chrono::milliseconds time) {
        const auto until = Clock::now() + time;
        while (Clock::now() < until) {
            pollfd readable{fd_, POLLIN, 0};
            if (poll(&readable, 1, 50) > 0 && !more()) return true;
        }
        return false;
    }

  private:
    bool more() {
        pollfd readable{fd_, POLLIN, 0};
        if (poll(&readable, 1, 20'000) <= 0) return false;
        char buffer[64u << 10];
        const ssize_t n = recv(fd_, buffer, sizeof buffer, 0);
        if (n <= 0) return false;
        received_.append(buffer, static_cast<std::size_t>(n));
        return true;
    }

    std::size_t wait_for(std::string_view text) {
        for (;;) {
            const std::size_t at = received_.find(text);
            if (at != std::string::npos || !more()) return at;
        }
    }

    bool read_chunks(std::string& body) {
        for (;;) {
            const std::size_t end = wait_for("\r\n");
            if (end == std::string::npos) return false;
            const std::size_t length = std::stoull(received_, nullptr, 16);
            while (received_.size() < end + length + 4)
                if (!more()) return false;
            body.append(received_, end + 2, length);
            received_.erase(0, end + length + 4);
            if (length == 0) return true;
        }
    }

    static void parse_head(const std::string& head, Answer& answer) {
        answer.status = std::stoi(head.substr(head.find(' ') + 1));
        std::size_t at = head.find("\r\n");
        while (at != std::string::npos) {
            const std::size_t next = head.find("\r\n", at + 2);
            const std::string line = head.substr(at + 2, next - at - 2);
            const std::size_t colon = line.find(": ");
            if (colon != std::string::npos)
                answer.headers.emplace_back(line.substr(0, colon), line.substr(colon + 2));
            at = next;
        }
    }

    int fd_ = -1;
    bool connected_ = false;
    std::string received_;
};

inline std::string get(std::string_view path, std::string_view headers = "") {
    return "GET " + std::string(path) + " HTTP/1.1\r\nHost: localhost\r\n" + std::string(headers) +
           "\r\n";
}

inline std::string post(std::string_view path, std::string_view body, std::string_view headers = "",
                        std::string_view type = "application/json") {
    return "POST " + std::string(path) +
           " HTTP/1.1\r\nHost: localhost\r\nContent-Type: " + std::string(type) +
           "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + std::string(headers) +
           "\r\n" + std::string(body);
}

}  // namespace awan::test
