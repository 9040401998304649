// A context that is lost while the program runs: no picture comes of it, and the next one is right.
#include <EGL/egl.h>
#include <gtest/gtest.h>

#include <atomic>

#include "server/service/service.h"
#include "tests/scenes.h"
#include "tests/service_fixture.h"

namespace awan::test {
namespace {

// What a driver does that loses it: calls go nowhere from now on.
void lose_context() {
    const EGLDisplay display = eglGetCurrentDisplay();
    ASSERT_NE(display, EGL_NO_DISPLAY);
    ASSERT_EQ(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT),
              static_cast<EGLBoolean>(EGL_TRUE));
}

TEST(GlLost, IsNoPicture) {
    auto device = Device::open(DeviceChoice::kSoftware);
    ASSERT_TRUE(device.ok()) << device.error().message;
    SceneDraft draft = balls({{}});
    draft.accuracy.rung = "harris";
    const Scene scene = valid(draft);
    const Tools tools{&*device, 1, nullptr, {}, {}};
    ASSERT_TRUE(render_scene(scene, tools, {}).ok());
    lose_context();
    const auto lost = render_scene(scene, tools, {});
    ASSERT_FALSE(lost.ok());
    EXPECT_EQ(lost.error().code, ErrorCode::kNoRenderer);
    EXPECT_NE(lost.error().message.find("lost"), std::string::npos);
}

TEST(GlLost, Is503OnceAndThenTheSamePicture) {
    std::atomic<bool> lose{false};
    const OpenRenderer open = device_renderer(DeviceChoice::kSoftware, 1);
    RenderThread thread([&]() -> Result<Renderer> {
        auto renderer = open();
        if (!renderer) return renderer;
        renderer->render = [&, draw = std::move(renderer->render)](
                               const Scene& scene, Planned planned, const Deadline& deadline) {
            if (lose.exchange(false)) lose_context();
            return draw(scene, std::move(planned), deadline);
        };
        return renderer;
    });
    Metrics metrics;
    Service service(thread, metrics, {});
    const Request request = make_request("POST", "/v1/render", kScene);
    const Response before = service.answer(request);
    ASSERT_EQ(before.status, 200) << before.body;
    lose = true;
    const Response lost = service.answer(request);
    expect_problem(lost, 503);
    EXPECT_FALSE(lost.header("Retry-After").empty());
    const Response after = service.answer(request);
    EXPECT_EQ(after.status, 200);
    EXPECT_EQ(after.body, before.body);
    EXPECT_EQ(thread.reopened(), 1u);
}

}  // namespace
}  // namespace awan::test
