// Between bytes and values: a vetted head -> Request, Response -> bytes. codec.cpp is the only
// user of cpp-httplib.
//
// cpp-httplib 0.11.4 is used as a codec and not as a server. As a server it gives a thread to every
// connection before a byte of it is read, limits silence but not time, and takes messages that two
// parsers read differently. Here the sockets are server.cpp's and the framing framing.cpp's.
// What httplib gets is a request line that has passed, without the headers that would switch on
// what is not wanted (ranges, compression, multipart); what it does is decode the target and write
// answers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/http/framing.h"
#include "server/service/service.h"

namespace awan {

// Where the bytes of an answer go.
class ByteSink {
  public:
    virtual ~ByteSink() = default;
    // False: the connection is of no more use.
    virtual bool write(std::string_view bytes) = 0;
    // The last of an answer. It may be held instead of copied.
    virtual bool write_shared(const std::shared_ptr<const std::string>& bytes) {
        return write(*bytes);
    }
};

// One a thread: it holds the request being answered.
class HttpCodec {
  public:
    HttpCodec();
    ~HttpCodec();
    HttpCodec(const HttpCodec&) = delete;
    HttpCodec& operator=(const HttpCodec&) = delete;

    using Answer = std::function<Response(const Request&)>;

    // Asks `answer` and writes what it says, with Date, and Connection: close when `close`. Fills
    // in the request's method, path, query, headers, body and id; `request` brings the rest. False when
    // the answer did not go out whole.
    bool exchange(const RequestHead& head, std::string body, Request request, bool close,
                  const Answer& answer, ByteSink& sink);

    // An answer to something that is no request.
    bool refuse(const Response& response, ByteSink& sink);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace awan
