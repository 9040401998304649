// Pictures by the rules of published systems instead of by light (scene field `look`): what a cloud looked like
// there. They have no rungs and no error against the truth. All clouds of the scene are of the model that the look
// belongs to (validate() sees to it), and stand where their transform and the scene's time put them.
#pragma once

#include "core/base/deadline.h"
#include "core/base/image.h"
#include "core/base/result.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Draws the scene's look. Threads do not show in the result. Errors: kOverDeadline, kCancelled.
Result<Image> draw_look(const Scene& scene, const View& view, int threads,
                        const Deadline& deadline);

// About how long it will take, wall clock.
double look_time_ms(const Scene& scene, const View& view, int threads);

// Each in its own files.
Result<Image> ostroushko_look(const Scene& scene, const View& view, int threads,
                              const Deadline& deadline);
Result<Image> gardner_look(const Scene& scene, const View& view, int threads,
                           const Deadline& deadline);
double ostroushko_look_ms(const Scene& scene, const View& view, int threads);
Result<Image> upchurch_look(const Scene& scene, const View& view, int threads,
                            const Deadline& deadline);
double upchurch_look_ms(const Scene& scene, const View& view, int threads);
double gardner_look_ms(const Scene& scene, const View& view, int threads);

}  // namespace awan
