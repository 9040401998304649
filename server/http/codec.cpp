#include "server/http/codec.h"

#include <httplib.h>

#include <ctime>

#include "server/service/problem.h"

namespace awan {
namespace {

// What httplib reads a request from and writes an answer to.
class CodecStream : public httplib::Stream {
  public:
    CodecStream(std::string head, ByteSink& sink) : head_(std::move(head)), sink_(sink) {}

    bool is_readable() const override { return true; }
    bool is_writable() const override { return !failed_; }
    ssize_t read(char* to, std::size_t size) override {
        const std::size_t n = head_.copy(to, size, read_);
        read_ += n;
        return static_cast<ssize_t>(n);
    }
    ssize_t write(const char* from, std::size_t size) override {
        // httplib only passes on what it is to write.
        const bool is_shared = shared_ && from == shared_->data() && size == shared_->size();
        failed_ = failed_ || !(is_shared ? sink_.write_shared(shared_) : sink_.write({from, size}));
        return failed_ ? -1 : static_cast<ssize_t>(size);
    }
    void get_remote_ip_and_port(std::string&, int&) const override {}
    void get_local_ip_and_port(std::string&, int&) const override {}
    socket_t socket() const override { return INVALID_SOCKET; }

    void drop() { failed_ = true; }
    void share(std::shared_ptr<const std::string> bytes) { shared_ = std::move(bytes); }
    bool failed() const { return failed_; }

  private:
    std::string head_;
    std::size_t read_ = 0;
    ByteSink& sink_;
    std::shared_ptr<const std::string> shared_;
    bool failed_ = false;
};

std::string date() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[40];
    const std::size_t n = std::strftime(text, sizeof text, "%a, %d %b %Y %H:%M:%S GMT", &utc);
    return {text, n};
}

}  // namespace

class HttpCodec::Impl : public httplib::Server {
  public:
    Impl() {
        // httplib ends streams when its listening socket is closed. It has none here.
        svr_sock_ = 0;
        set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& out) {
            // httplib would answer 500 and tell what was thrown.
            try {
                fill(answer_(request), out);
            } catch (const std::exception&) {
                say_no_memory(out);
            }
            return HandlerResponse::Handled;
        });
        // After httplib has added its own headers, before it writes them.
        set_post_routing_handler([](const httplib::Request&, httplib::Response& out) {
            out.headers.erase("Keep-Alive");
            out.headers.erase("Accept-Ranges");
            if (out.status == 304 || out.status == 204) out.headers.erase("Content-Length");
        });
    }

    bool run(std::string head, bool http10, std::function<Response(const httplib::Request&)> answer,
             ByteSink& sink) {
        CodecStream stream(std::move(head), sink);
        stream_ = &stream;
        http10_ = http10;
        answer_ = std::move(answer);
        bool closed = false;
        const bool written = process_request(stream, false, closed, nullptr);
        answer_ = nullptr;
        stream_ = nullptr;
        return written && !stream.failed();
    }

  private:
    // There is none even for the words of an error.
    void say_no_memory(httplib::Response& out) noexcept {
        try {
            out = {};
            out.status = 503;
            out.headers.emplace("Retry-After", "1");
        } catch (const std::exception&) {
            stream_->drop();
        }
    }

    void fill(Response response, httplib::Response& out) {
        if (response.abandoned) stream_->drop();
        out.status = response.status;
        std::string type;
        for (auto& [name, value] : response.headers) {
            if (name == "Content-Type") {
                type = std::move(value);
            } else {
                out.headers.emplace(name, std::move(value));
            }
        }
        out.headers.emplace("Date", date());
        if (response.shared) {
            stream_->share(response.shared);
            out.set_content_provider(
                response.shared->size(), type,
                [bytes = response.shared](std::size_t, std::size_t, httplib::DataSink& to) {
                    return to.write(bytes->data(), bytes->size());
                });
            return;
        }
        if (!response.stream) {
            out.body = std::move(response.body);
            if (!type.empty()) out.headers.emplace("Content-Type", type);
            return;
        }
        // A piece that cannot be made cuts the connection: the client must not take half an answer
        // for a whole one.
        auto provider = [stream = std::move(response.stream)](std::size_t, httplib::DataSink& to) {
            try {
                std::string piece;
                const bool more = stream(piece);
                if (!piece.empty() && !to.write(piece.data(), piece.size())) return false;
                if (!more) to.done();
                return true;
            } catch (const std::exception&) {
                return false;
            }
        };
        if (http10_) {
            // The body ends where the connection does.
            out.set_content_provider(type, provider);
        } else {
            out.set_chunked_content_provider(type, provider);
        }
    }

    std::function<Response(const httplib::Request&)> answer_;
    CodecStream* stream_ = nullptr;
    bool http10_ = false;
};

HttpCodec::HttpCodec() : impl_(std::make_unique<Impl>()) {}
HttpCodec::~HttpCodec() = default;

bool HttpCodec::exchange(const RequestHead& head, std::string body, Request request, bool close,
                         const Answer& answer, ByteSink& sink) {
    std::string line = head.method + " " + head.target + (head.http10 ? " HTTP/1.0" : " HTTP/1.1");
    line += close ? "\r\nConnection: close\r\n\r\n" : "\r\n\r\n";
    request.method = head.method;
    request.headers = head.headers;
    request.body = std::move(body);
    request.id = request_id_from(head.header("X-Request-Id"));
    const auto decoded = [&](const httplib::Request& in) {
        request.path = in.path;
        request.query.assign(in.params.begin(), in.params.end());
        return answer(request);
    };
    return impl_->run(std::move(line), head.http10, decoded, sink);
}

bool HttpCodec::refuse(const Response& response, ByteSink& sink) {
    // What came cannot be decoded, so the answer is written as if it were to this request.
    return impl_->run(
        "GET / HTTP/1.1\r\nConnection: close\r\n\r\n", false,
        [&](const httplib::Request&) { return response; }, sink);
}

}  // namespace awan
