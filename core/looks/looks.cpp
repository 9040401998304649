#include "core/looks/looks.h"

namespace awan {

Result<Image> draw_look(const Scene& scene, const View& view, int threads,
                        const Deadline& deadline) {
    if (scene->look == Look::kUpchurch) return upchurch_look(scene, view, threads, deadline);
    if (scene->look == Look::kGardner) return gardner_look(scene, view, threads, deadline);
    return ostroushko_look(scene, view, threads, deadline);
}

double look_time_ms(const Scene& scene, const View& view, int threads) {
    if (scene->look == Look::kUpchurch) return upchurch_look_ms(scene, view, threads);
    if (scene->look == Look::kGardner) return gardner_look_ms(scene, view, threads);
    return ostroushko_look_ms(scene, view, threads);
}

}  // namespace awan
