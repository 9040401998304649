// A job of kind impostor: the views of a scene from many sides on one atlas, and its layout, in an archive. Each view
// has a lane for itself, so that others compute between two of them.
#include <thread>

#include "core/formats/atlas.h"
#include "core/formats/zip_archive.h"
#include "core/impostor.h"
#include "core/pipeline.h"
#include "server/document/impostor_text.h"
#include "server/service/problem.h"
#include "server/service/state.h"

namespace awan {
namespace {

Drawn draw_view(Service::State& state, const Request& request, const Scene& scene) {
    Lanes::Pass pass(state.lanes);
    if (const Status over = enter_patiently(pass, request)) return {std::nullopt, *over};
    auto planned = plan_scene(scene, threads_of_one(state), request.deadline, state.options.speed,
                              &state.tiles);
    if (!planned) return {std::nullopt, planned.error()};
    planned->is_unmeasured = true;
    Request inner = request;
    // A view's own progress is not that of the whole.
    inner.progress = {};
    return draw_in_lanes(state, inner, scene, *std::move(planned), 0, pass);
}

Error in_job(Error error) {
    error.pointer = "/scene" + error.pointer;
    return error;
}

}  // namespace

Response answer_impostor(Service::State& state, const Request& request, const JobWork& work) {
    const auto scene = read_job_scene(state, request);
    if (!scene) return fail(scene.error(), request);
    const bool exr = (*scene)->image.format == ImageFormat::kExr;
    const auto pixels = static_cast<std::size_t>(work.impostor.views * work.impostor.size);
    const WorkBudget::Lease lease =
        state.budget.take(work_bytes(**scene, false) + pixels * pixels * limits::kBytesPerPixel);
    if (!lease) return no_memory(state, request);
    const auto impostor = [&]() -> Result<Impostor> {
        Lanes::Pass pass(state.lanes);
        if (const Status over = enter_patiently(pass, request)) return *over;
        return impostor_of(*scene, work.impostor, exr, threads_of_one(state), request.deadline);
    }();
    if (!impostor) return fail(in_job(impostor.error()), request);
    Atlas atlas = begin_atlas(work.impostor.views, work.impostor.size);
    for (std::size_t i = 0; i < impostor->views.size();) {
        Drawn drawn = draw_view(state, request, impostor->views[i].scene);
        if (drawn.refused && drawn.refused->status == 429 && !request.deadline.over()) {
            std::this_thread::sleep_for(kLinesAreFull);
            continue;
        }
        if (drawn.refused) return std::move(*drawn.refused);
        if (!drawn.rendered) return fail(drawn.rendered.error(), request);
        put_on_atlas(i, drawn.rendered->image, drawn.rendered->layers, atlas);
        ++i;
        if (request.progress)
            request.progress(static_cast<double>(i) / static_cast<double>(impostor->views.size()));
    }
    const auto bytes = encode_atlas(atlas, *scene, exr, request.deadline);
    if (!bytes) return fail(bytes.error(), request);
    auto archive = ZipArchive::begin();
    if (!archive) return fail(archive.error(), request);
    const std::string name = exr ? "impostor.exr" : "impostor.png";
    if (Status failed = archive->add(name, *bytes)) return fail(*failed, request);
    if (Status failed = archive->add(
            "impostor.json", impostor_to_json(*impostor, name, exr && !atlas.depth.empty())))
        return fail(*failed, request);
    auto packed = archive->end();
    if (!packed) return fail(packed.error(), request);
    Response response;
    response.headers = {{"Content-Type", "application/zip"}, {"Cache-Control", "no-store"}};
    response.body = *std::move(packed);
    return response;
}

}  // namespace awan
