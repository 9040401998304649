#include "core/light/legendre.h"

#include <cmath>

namespace awan {

std::vector<double> legendre_moments(const Medium& medium, int highest) {
    // cos P_l = ((l+1) P_l+1 + l P_l-1) / (2l+1): each factor cos costs one order.
    const auto size = static_cast<std::size_t>(highest) + 1;
    std::vector<double> chi(size + 2);
    for (std::size_t l = 0; l < chi.size(); ++l)
        chi[l] = std::pow(medium.g, static_cast<double>(l));
    if (medium.phase == PhaseFunction::kCornetteShanks) {
        const auto times_cosine = [](const std::vector<double>& c) {
            std::vector<double> product(c.size() - 1);
            for (std::size_t l = 0; l < product.size(); ++l) {
                const auto order = static_cast<double>(l);
                product[l] =
                    ((order + 1) * c[l + 1] + (l > 0 ? order * c[l - 1] : 0)) / (2 * order + 1);
            }
            return product;
        };
        const std::vector<double> squared = times_cosine(times_cosine(chi));
        const double scale = 1.5 / (2 + medium.g * medium.g);
        for (std::size_t l = 0; l < size; ++l) chi[l] = scale * (chi[l] + squared[l]);
    }
    chi.resize(size);
    return chi;
}

}  // namespace awan
