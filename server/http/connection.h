// One client's connection: its bytes, where it stands, how its answer leaves.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/result.h"
#include "server/http/codec.h"
#include "server/http/framing.h"

namespace awan {

// Reading -> Working -> Writing -> Reading again, or Lingering and the end.
enum class Stand {
    // A head is awaited, or half of it is here.
    kHead,
    // Half of a body is here.
    kBody,
    // Its request is being answered, here or by a worker.
    kWorking,
    // The rest of an answer waits for the client to take it.
    kWriting,
    // Answered for the last time; what still comes is thrown away.
    kLingering,
};

// While it is kWorking it belongs to the worker that has it, except `stand`, `until`, `socket` and
// `gone`; otherwise to the thread that polls.
struct Connection {
    using Clock = std::chrono::steady_clock;

    Descriptor socket;
    // The address of this end, as a Host header would have it, and that of the other.
    std::string local_address;
    std::string client;
    // It came when there was no room any more, and is told so; only whether the server lives is answered.
    bool in_reserve = false;
    Stand stand = Stand::kHead;
    // When it is cut (not while kWorking).
    Clock::time_point until;
    // When it began to wait for a head.
    Clock::time_point since;

    // Bytes received and not yet understood.
    std::string in;
    std::size_t scanned = 0;
    RequestHead head;
    std::string body;
    Clock::time_point body_since;
    // Bytes counted for it in the budget of all bodies.
    std::size_t body_charged = 0;
    // Becomes true when the client has gone.
    std::shared_ptr<std::atomic<bool>> gone;
    // The client has closed its side: it sends no more. It may have gone, or wait for its answer.
    bool half_closed = false;
    // Who writes: nobody, the thread that polls (a word to find out), or the one that answers.
    enum class Voice { kNone, kProbe, kAnswer };
    std::atomic<Voice> voice{Voice::kNone};
    // When its request was complete.
    Clock::time_point read_at;
    bool admitted = false;
    std::size_t served = 0;

    // Bytes of the answer that the client has not yet taken.
    std::string out;
    std::size_t sent = 0;
    // What follows `out`, kept for others too; none: null.
    std::shared_ptr<const std::string> shared;
    std::size_t shared_sent = 0;
    // Bytes counted for it among all parked bytes; shared ones are not its own.
    std::size_t parked = 0;
    bool close_after = false;
    // A worker has it, and hands it back.
    bool with_worker = false;
    // Of the worker that has answered it: whether all went well, and which one was answered before.
    bool alive = true;
    Connection* done_before = nullptr;

    bool unsent() const { return sent < out.size() || shared; }
};

// From now on only the one that answers writes.
void begin_answer(Connection& connection);

// What has closed its side has either gone or waits for its answer: only when something is sent to it does the
// difference show. An interim answer that clients must pass over (RFC 9110, section 15.2) finds it out, where none is
// begun; a client that has gone refuses it with a reset.
void find_out_whether_gone(Connection& connection);

enum class Received { kBytes, kNothing, kClosed };

// Appends what is there, at most `limit` bytes.
Received receive(const Connection& connection, std::size_t limit, std::string& to);

// Sends what the client takes now of `out` and `shared`, some MiB at once at most, and counts what stays in
// `parked_in_all`. False when the connection is of no more use.
bool send_unsent(Connection& connection, std::atomic<std::size_t>& parked_in_all);

// Brings the count of parked bytes up to date.
void count_parked(Connection& connection, std::atomic<std::size_t>& parked_in_all);

// Writes an answer: what the client takes at once goes out; the rest is parked in `out` as long as
// all parked bytes stay within a limit; past it the writer waits for the client, until `until`.
class ConnectionSink : public ByteSink {
  public:
    // never_wait: for the thread that polls; its answers are small and always parked.
    ConnectionSink(Connection& connection, std::atomic<std::size_t>& parked_in_all, bool never_wait,
                   Connection::Clock::time_point until)
        : connection_(connection), parked_(parked_in_all), never_wait_(never_wait), until_(until) {}

    bool write(std::string_view bytes) override;
    bool write_shared(const std::shared_ptr<const std::string>& bytes) override;
    // From now on every write goes out at once.
    void gather_nothing() { gathers_ = false; }
    // To be called once after the last write.
    bool flush();

  private:
    bool send_or_wait();

    Connection& connection_;
    std::atomic<std::size_t>& parked_;
    bool never_wait_;
    bool gathers_ = true;
    Connection::Clock::time_point until_;
};

// A listening socket that does not block, or why not.
Result<Descriptor> listen_on(const std::string& host, int port);
int port_of(const Descriptor& socket);

}  // namespace awan
