// Limits of the transport, in one place: value, unit, reason. Those of a scene:
// core/scene/limits.h.
#pragma once

#include <chrono>
#include <cstddef>

namespace awan::limits {

// --- one request
// A million ready particles as JSON take about 60 MB.
inline constexpr std::size_t kMaxBodyBytes = 96u << 20;
// Request line and all headers; browsers send about 1 KiB.
inline constexpr std::size_t kMaxHeadBytes = 16u << 10;
// Browsers send about 15.
inline constexpr std::size_t kMaxHeaders = 100;
// Request target; the longest route is 40.
inline constexpr std::size_t kMaxTargetBytes = 2048;
// It is echoed; a UUID takes 36.
inline constexpr std::size_t kMaxRequestIdBytes = 128;

// --- time
inline constexpr std::chrono::milliseconds kHeadDeadline{
    // Whole head, from accept or from its first byte on a kept connection.
    5'000};
inline constexpr std::chrono::milliseconds kBodyDeadline{// Whole body, from the end of the head.
                                                         30'000};
// Whole answer.
inline constexpr std::chrono::milliseconds kWriteDeadline{60'000};
inline constexpr std::chrono::milliseconds kIdleDeadline{// Between requests on a kept connection.
                                                         5'000};
inline constexpr std::chrono::milliseconds kLingerDeadline{
    // Reading on after a final answer, so that it is not lost to a reset.
    2'000};
inline constexpr std::chrono::milliseconds kRequestDeadline{
    // From the end of the body to the answer's first byte.
    30'000};
inline constexpr std::chrono::milliseconds kDrainDeadline{// SIGTERM to exit, for what is in flight.
                                                          30'000};

// --- connections
inline constexpr int kListenBacklog = 1024;
// Open at once; about 20 KiB each while its head is read.
inline constexpr std::size_t kMaxConnections = 1000;
// Then the connection is closed, so that load balances.
inline constexpr std::size_t kRequestsPerConnection = 1000;
// Of the process's limit, for everything that is not a client.
inline constexpr std::size_t kSpareDescriptors = 64;

// --- work
// Renders waiting; at 50 ms each the last waits under a second.
inline constexpr std::size_t kRenderQueue = 16;
// Read, not yet with a worker; more are answered 429.
inline constexpr std::size_t kWaitingRequests = 64;

// --- memory
// A body up to this never waits for the budget below; no layout is longer.
inline constexpr std::size_t kFreeBodyBytes = 64u << 10;
// Bodies being received or waiting, in all: four of the largest.
inline constexpr std::size_t kMaxBodyBytesInAll = 384u << 20;
// Answers that clients are slow to take; past it their workers wait for them.
inline constexpr std::size_t kMaxParkedBytes = 128u << 20;
// Scenes being worked on, in all: two of the largest.
inline constexpr std::size_t kWorkBytes = std::size_t{3} << 30;
// Positions, radii, densities, light pass, sort keys; estimate.
inline constexpr std::size_t kBytesPerParticle = 150;
// Float RGBA and its encoding; estimate.
inline constexpr std::size_t kBytesPerPixel = 24;

// --- pieces
// Of a streamed answer: about 400 KiB of JSON.
inline constexpr std::size_t kParticlesPerPiece = 4096;

}  // namespace awan::limits
