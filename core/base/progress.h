// How far long work has come, for those who watch it.
#pragma once

#include <functional>

namespace awan {

// Called now and then with the share of the work that is done, 0..1, rising; from any thread, never
// from two at once. May be empty. Must not throw.
using Progress = std::function<void(double done)>;

}  // namespace awan
