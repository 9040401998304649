// What the files of the transport share (server.cpp: connections and turns, requests.cpp:
// requests and answers); nobody else includes it.
#pragma once

#include <atomic>
#include <cstddef>
#include <list>
#include <mutex>
#include <string_view>
#include <vector>

#include "server/http/access.h"
#include "server/http/codec.h"
#include "server/http/connection.h"
#include "server/http/server.h"
#include "server/http/workers.h"

namespace awan {

// A body as long as this is worth a look at its head before it is sent.
inline constexpr std::size_t kLongBody = 1u << 20;

struct HttpServer::State {
    using Clock = Connection::Clock;

    State(Service& s, Metrics& m, HttpOptions o);

    Service& service;
    Metrics& metrics;
    HttpOptions options;
    AccessRules rules;
    Descriptor listener;
    // Written to when a worker has finished, and by stop(); it wakes the thread that polls.
    Descriptor wake;
    int port = 0;
    std::atomic<bool> stopping{false};

    // All of the following belongs to the thread in run(), except what is said otherwise.
    HttpCodec codec;
    std::list<Connection> connections;
    // Bytes of the bodies of all connections.
    std::size_t body_bytes = 0;
    // Bytes of all answers that wait for their clients. Workers count too, hence atomic.
    std::atomic<std::size_t> parked{0};
    bool draining = false;
    Clock::time_point drain_until;
    Clock::time_point accept_after;
    Workers<Connection*>* workers = nullptr;
    std::mutex done_mutex;
    // The one that was answered last, and so on by done_before; guarded by done_mutex. Needs no memory: a worker that
    // has answered must be able to say so.
    Connection* done = nullptr;

    // What a thread that has run out of memory does with the connection that it was busy with.
    template <typename What>
    void guarded(Connection& c, const What& what);
    void answer_on_worker(Connection& c, HttpCodec& with) noexcept;

    void accept_all();
    bool make_room();
    void end_turned_away();
    void poll_once();
    void on_event(Connection& c, short events);
    void on_timeout(Connection& c);
    void take_back_done();
    void begin_drain();
    bool drained() const;

    void advance(Connection& c);
    void begin_request(Connection& c);
    void begin_body(Connection& c);
    void charge_body(Connection& c, std::size_t bytes);
    void dispatch(Connection& c);
    bool answer(Connection& c, HttpCodec& with, bool here);
    void answer_here(Connection& c, const HttpCodec::Answer& what);
    void log(const Connection& c, const Response& response, std::string_view id,
             std::size_t bytes_in);
    void refuse(Connection& c, int status, std::string_view detail, std::string_view reason);
    void taken_back(Connection& c, bool alive);
    void written(Connection& c);
    // Closes it; it leaves the list with forget_ended().
    void end(Connection& c);
    void forget_ended();
};

}  // namespace awan
