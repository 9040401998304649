// Limits of the transport, in one place: value, unit, reason. Those of a scene: core/scene/limits.h.
#pragma once

#include <chrono>
#include <cstddef>

#include "core/formats/picture_program.h"
#include "core/scene/limits.h"

namespace awan::limits {

// --- One request

// Bytes of a body. A million ready particles as JSON take about 60 MB.
inline constexpr std::size_t kMaxBodyBytes = 96u << 20;
// Bytes of the request line and all headers. Browsers send about 1 KiB.
inline constexpr std::size_t kMaxHeadBytes = 16u << 10;
// Headers of a request. Browsers send about 15.
inline constexpr std::size_t kMaxHeaders = 100;
// Bytes of the request target. The longest route is 40.
inline constexpr std::size_t kMaxTargetBytes = 2048;
// Bytes of a client's request id, which is echoed. A UUID takes 36.
inline constexpr std::size_t kMaxRequestIdBytes = 128;

// --- Time

// For a whole head, from accept or from its first byte on a kept connection.
inline constexpr std::chrono::milliseconds kHeadDeadline{5'000};
// For a whole body, from the end of the head.
inline constexpr std::chrono::milliseconds kBodyDeadline{30'000};
// For the client to take a whole answer.
inline constexpr std::chrono::milliseconds kWriteDeadline{60'000};
// Between requests on a kept connection.
inline constexpr std::chrono::milliseconds kIdleDeadline{5'000};
// How long is read on after a final answer, so that the answer is not lost to a reset.
inline constexpr std::chrono::milliseconds kLingerDeadline{2'000};
// From the end of the body to the answer's first byte.
inline constexpr std::chrono::milliseconds kRequestDeadline{30'000};
// From SIGTERM to the exit, for what is in flight.
inline constexpr std::chrono::milliseconds kDrainDeadline{30'000};

// --- Connections

// Connections that the kernel holds until they are accepted.
inline constexpr int kListenBacklog = 1024;
// Connections open at once, beside a few in which only health is answered. Each takes about 20 KiB while its head is
// read.
inline constexpr std::size_t kMaxConnections = 1000;
// Requests after which a connection is closed, so that a balancer in front can spread the load anew.
inline constexpr std::size_t kRequestsPerConnection = 1000;
// File descriptors of the process that are kept for everything that is not a client.
inline constexpr std::size_t kSpareDescriptors = 64;

// --- Work

// Requests that wait for a lane, of each weight (server/service/lanes.h). At 50 ms each, the last waits under a second.
inline constexpr std::size_t kRenderQueue = 16;
// Requests that are read and not yet with a worker. More are answered 429.
inline constexpr std::size_t kWaitingRequests = 64;

// Jobs that have not finished; more are answered 429. Jobs that are kept in all, the oldest finished ones are dropped.
inline constexpr std::size_t kWaitingJobs = 64;
inline constexpr std::size_t kMostJobs = 256;
// Bytes of the results of jobs that are kept: some sequences, or a thousand pictures.
inline constexpr std::size_t kJobBytes = 256u << 20;
// Of one job, from when it begins: what takes longer is for the command line.
inline constexpr std::chrono::minutes kJobDeadline{60};
// Clients that follow jobs at once: each holds a thread. More are answered 429, and ask now and then instead.
inline constexpr std::size_t kEventStreams = 16;
// After so long the stream ends, and whoever still follows connects anew.
inline constexpr std::chrono::minutes kEventsDeadline{10};
// Bytes of an Idempotency-Key. A UUID takes 36.
inline constexpr std::size_t kMaxKeyBytes = 128;

// --- Memory

// Bytes of a body that never waits for the budget below. No layout is longer.
inline constexpr std::size_t kFreeBodyBytes = 64u << 10;
// Bytes of all bodies that are being received or waiting: four of the largest.
inline constexpr std::size_t kMaxBodyBytesInAll = 384u << 20;
// Bytes of all answers that clients are slow to take. Past it their workers wait for them.
inline constexpr std::size_t kMaxParkedBytes = 128u << 20;
// Bytes of all scenes that are being worked on: two of the largest.
inline constexpr std::size_t kWorkBytes = std::size_t{3} << 30;
// What a byte of a document takes of it while it is read, an estimate: lists of lists of short numbers take most.
inline constexpr std::size_t kBytesPerBodyByte = 8;
// What one particle takes of it, an estimate: positions, radii, densities, light pass, sort keys.
inline constexpr std::size_t kBytesPerParticle = 150;
// What one pixel takes of it, an estimate: float RGBA and its encoding.
inline constexpr std::size_t kBytesPerPixel = 24;
// Bytes of answers to renders that are kept: a few hundred pictures of the usual size.
inline constexpr std::size_t kCacheBytes = 64u << 20;
// Bytes of a folder of kept answers, where there is one, and of those that wait to be written there.
inline constexpr std::size_t kDiskCacheBytes = 1024u << 20;
inline constexpr std::size_t kDiskWaitingBytes = 64u << 20;
// Bytes of lights that are kept to settle the rungs of sequences: a few dozen coarse grids, or one of the finest.
inline constexpr std::size_t kSettlingLightBytes = 64u << 20;
// Bytes of states of automata that are kept for their other frames: 130 of the source's size, two of the largest grid.
inline constexpr std::size_t kKeptStatesBytes = 64u << 20;

// --- Maps

// Pixels across a map of the sky, where nobody says.
inline constexpr int kSkyMapWidth = 1024;

// --- Pieces

// Particles in one piece of a streamed answer: about 400 KiB of JSON.
inline constexpr std::size_t kParticlesPerPiece = 4096;

// --- Textures of clients

// Kept at once, each of 16 KiB.
inline constexpr std::size_t kMaxKeptTextures = 256;
// What reading one takes at its peak: its file, and the program that reads it.
inline constexpr std::size_t kTextureWorkBytes = kMaxTextureBytes + kPictureMemory;

}  // namespace awan::limits
