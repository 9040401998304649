// Limits of the transport, in one place: value, unit, reason. Those of a scene:
// core/scene/limits.h.
#pragma once

#include <chrono>
#include <cstddef>

namespace awan::limits {

// --- one request
inline constexpr std::size_t kMaxBodyBytes =
    96u << 20;  // a million ready particles as JSON take about 60 MB
inline constexpr std::size_t kMaxHeadBytes =
    16u << 10;  // request line and all headers; browsers send about 1 KiB
inline constexpr std::size_t kMaxHeaders = 100;         // browsers send about 15
inline constexpr std::size_t kMaxTargetBytes = 2048;    // request target; the longest route is 40
inline constexpr std::size_t kMaxRequestIdBytes = 128;  // it is echoed; a UUID takes 36

// --- time
inline constexpr std::chrono::milliseconds kHeadDeadline{
    5'000};  // whole head, from accept or from its first byte on a kept connection
inline constexpr std::chrono::milliseconds kBodyDeadline{
    30'000};  // whole body, from the end of the head
inline constexpr std::chrono::milliseconds kWriteDeadline{60'000};  // whole answer
inline constexpr std::chrono::milliseconds kIdleDeadline{
    5'000};  // between requests on a kept connection
inline constexpr std::chrono::milliseconds kLingerDeadline{
    2'000};  // reading on after a final answer, so that it is not lost to a reset
inline constexpr std::chrono::milliseconds kRequestDeadline{
    30'000};  // from the end of the body to the answer's first byte
inline constexpr std::chrono::milliseconds kDrainDeadline{
    30'000};  // SIGTERM to exit, for what is in flight

// --- connections
inline constexpr int kListenBacklog = 1024;
inline constexpr std::size_t kMaxConnections =
    1000;  // open at once; about 20 KiB each while its head is read
inline constexpr std::size_t kRequestsPerConnection =
    1000;  // then the connection is closed, so that load balances
inline constexpr std::size_t kSpareDescriptors =
    64;  // of the process's limit, for everything that is not a client

// --- work
inline constexpr std::size_t kRenderQueue =
    16;  // renders waiting; at 50 ms each the last waits under a second
inline constexpr std::size_t kWaitingRequests =
    64;  // read, not yet with a worker; more are answered 429

// --- memory
inline constexpr std::size_t kFreeBodyBytes =
    64u << 10;  // a body up to this never waits for the budget below; no layout is longer
inline constexpr std::size_t kMaxBodyBytesInAll =
    384u << 20;  // bodies being received or waiting, in all: four of the largest
inline constexpr std::size_t kMaxParkedBytes =
    128u << 20;  // answers that clients are slow to take; past it their workers wait for them
inline constexpr std::size_t kWorkBytes =
    std::size_t{3} << 30;  // scenes being worked on, in all: two of the largest
inline constexpr std::size_t kBytesPerParticle =
    150;  // positions, radii, densities, light pass, sort keys; estimate
inline constexpr std::size_t kBytesPerPixel = 24;  // float RGBA and its encoding; estimate

// --- pieces
inline constexpr std::size_t kParticlesPerPiece =
    4096;  // of a streamed answer: about 400 KiB of JSON

}  // namespace awan::limits
