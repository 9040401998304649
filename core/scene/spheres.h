// What a cloud of model "spheres" is: Ostroushko et al. (document 003).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace awan {

struct SpheresCloud {};

// Every value of it as numbers, lists with their lengths: two clouds are equal when these are.
std::vector<double> figures_of(const SpheresCloud& cloud);

// What cannot be, with the pointer to it; `at` is the pointer to the cloud's "spheres".
Status check_spheres(const SpheresCloud& cloud, const std::string& at);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const SpheresCloud& cloud);

}  // namespace awan
