// What a cloud of model "automaton" is: Nagel & Raschke 1992, Dobashi et al. 2000, Upchurch 2009 (documents 000 and 001).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace awan {

struct AutomatonCloud {};

// Every value of it as numbers, lists with their lengths: two clouds are equal when these are.
std::vector<double> figures_of(const AutomatonCloud& cloud);

// What cannot be, with the pointer to it; `at` is the pointer to the cloud's "automaton".
Status check_automaton(const AutomatonCloud& cloud, const std::string& at);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const AutomatonCloud& cloud);

}  // namespace awan
