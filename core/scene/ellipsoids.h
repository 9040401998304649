// What a cloud of model "ellipsoids" is: Gardner 1985 (document 002).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace awan {

struct EllipsoidsCloud {};

// Every value of it as numbers, lists with their lengths: two clouds are equal when these are.
std::vector<double> figures_of(const EllipsoidsCloud& cloud);

// What cannot be, with the pointer to it; `at` is the pointer to the cloud's "ellipsoids".
Status check_ellipsoids(const EllipsoidsCloud& cloud, const std::string& at);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const EllipsoidsCloud& cloud);

}  // namespace awan
