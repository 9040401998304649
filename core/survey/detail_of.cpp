#include "core/survey/detail_of.h"

namespace awan {

std::shared_ptr<const DetailField> detail_of(const Scene& scene, const Survey& survey, int threads,
                                             DetailTiles* tiles) {
    const Detail asked = scene->detail.value_or(Detail{});
    if (!(asked.amount > 0) || !(survey.detail.extinction > 0) || !(survey.detail.radius > 0))
        return nullptr;
    DetailField field = make_detail(
        survey.detail, asked.amount, asked.size,
        tiles ? tiles->of(scene->seed, threads) : make_detail_tile(scene->seed, threads));
    // Of this realisation, not of their mean: a cloud of few bumps would have more or less than it was given.
    const DensityVolume& volume = survey.volume;
    double whole = 0, kept = 0;
    for (std::size_t i = 0; i < volume.extinction.size(); ++i) {
        const float extinction = volume.extinction[i];
        if (!(extinction > 0)) continue;
        const auto nx = static_cast<std::size_t>(volume.cells.x),
                   ny = static_cast<std::size_t>(volume.cells.y);
        const glm::dvec3 middle =
            volume.origin +
            volume.cell * (glm::dvec3(static_cast<double>(i % nx), static_cast<double>(i / nx % ny),
                                      static_cast<double>(i / nx / ny)) +
                           0.5);
        whole += static_cast<double>(extinction);
        kept += static_cast<double>(detailed(field, extinction, bumps_at(field, middle)));
    }
    if (kept > 0) field.keep = static_cast<float>(whole / kept);
    return std::make_shared<const DetailField>(std::move(field));
}

}  // namespace awan
