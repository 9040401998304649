#include "core/survey/detail_of.h"

namespace awan {

std::shared_ptr<const DetailField> detail_of(const Scene& scene, const Survey& survey,
                                             int threads) {
    const Detail asked = scene->detail.value_or(Detail{});
    if (!(asked.amount > 0) || !(survey.detail.extinction > 0) || !(survey.detail.radius > 0))
        return nullptr;
    DetailField field =
        make_detail(survey.detail, asked.amount, asked.size, scene->seed, threads);
    double whole = 0, kept = 0;
    for (const float cell : survey.volume.extinction) {
        const auto extinction = static_cast<double>(cell);
        whole += extinction;
        kept += extinction * kept_by_detail(field, extinction);
    }
    if (kept > 0) field.keep = static_cast<float>(whole / kept);
    return std::make_shared<const DetailField>(std::move(field));
}

}  // namespace awan
