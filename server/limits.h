// Limits of the transport, in one place: value, unit, reason. Those of a scene:
// core/scene/limits.h.
#pragma once

#include <chrono>
#include <cstddef>

namespace awan::limits {

inline constexpr std::size_t kMaxBodyBytes =
    96u << 20;  // a million ready particles as JSON take about 60 MB
inline constexpr std::size_t kMaxHeadBytes =
    16u << 10;  // request line and all headers; browsers send about 1 KiB
inline constexpr std::size_t kMaxTargetBytes = 2048;  // request target; the longest route is 40
inline constexpr std::chrono::milliseconds kHeadDeadline{
    5'000};  // whole head, from accept or the last answer
inline constexpr std::chrono::milliseconds kBodyDeadline{
    30'000};  // whole body, from the end of the head
inline constexpr std::chrono::milliseconds kWriteDeadline{60'000};  // whole answer
inline constexpr std::chrono::milliseconds kIdleDeadline{
    5'000};  // between requests on a kept connection
inline constexpr std::size_t kRequestsPerConnection =
    1000;  // then the connection is closed, so that load balances
inline constexpr int kListenBacklog = 1024;
inline constexpr std::size_t kWaitingConnections =
    256;  // accepted, not yet with a worker; more get 503 at once

inline constexpr std::size_t kRenderQueue =
    16;  // renders waiting; at 50 ms each the last waits under a second
inline constexpr std::chrono::milliseconds kRequestDeadline{
    30'000};  // from the end of the body to the answer's first byte
inline constexpr std::chrono::milliseconds kDrainDeadline{
    30'000};  // SIGTERM to exit, for what is in flight

}  // namespace awan::limits
