// What a cloud of model "implicit" is: Ebert (document 004).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace awan {

struct ImplicitCloud {};

// Every value of it as numbers, lists with their lengths: two clouds are equal when these are.
std::vector<double> figures_of(const ImplicitCloud& cloud);

// What cannot be, with the pointer to it; `at` is the pointer to the cloud's "implicit".
Status check_implicit(const ImplicitCloud& cloud, const std::string& at);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const ImplicitCloud& cloud);

}  // namespace awan
