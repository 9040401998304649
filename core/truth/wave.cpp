// Next-event estimation of the sun, and, against the noise of a narrow phase function, directions drawn from the sun's
// side.
//
// The last of these is bidirectional path tracing (Veach 1997) in directions only: since the sun's rays are parallel
// and the phase function is the same everywhere, a path's directions d_0 (from the eye), ..., d_(n-1), sun can be
// drawn from either end, while its free flights are always drawn from the eye's. Technique m draws the last m
// directions backwards from the sun, e_1 about it, e_2 about e_1, ...; the one scattering whose two directions were
// drawn from different ends, number n - m, is weighted by its phase value p_(n-m). Its density is the product of all
// p_i but that one, so the balance heuristic gives a path that any of the techniques drew, each tried with
// probability q, the weight
//     transmittance / sum_m (q_m / p_(n-m)).
// Plain next-event estimation (m = 0) alone weights it by p_n, whose relative variance in diffuse light is
// 2 g^2 / (1 - g)^2 or so; a sum over a few m has that of a phase function of mean cosine g^(m+1).
#include "core/truth/wave.h"

#include "core/truth/lane_targets.h"

#define AWAN_LANES_FILE "core/truth/wave_steps.h"
#include "core/truth/for_each_target.h"

namespace awan::truth {

void scatter_waves(const WaveSetting& s, Wave& wave) {
    AWAN_ON_TARGET(scatter_waves(s, wave))
}

void follow_branches(const WaveSetting& s, int left, Wave& wave) {
    AWAN_ON_TARGET(follow_branches(s, left, wave))
}

void turn_waves(const WaveSetting& s, Wave& wave) {
    AWAN_ON_TARGET(turn_waves(s, wave))
}

}  // namespace awan::truth
