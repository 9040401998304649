// A headless EGL context, current on the thread that opened it. Private to core/gl.
#pragma once

#include <EGL/egl.h>

#include <string>

#include "core/base/result.h"
#include "core/gl/device.h"

namespace awan::gl {

// The context; move-only, closed when it is destroyed.
class EglContext {
  public:
    // kAuto: first a hardware EGL device (EGL_EXT_platform_device, one with a DRM node), then
    // Mesa's surfaceless platform; kSoftware: only the latter. OpenGL 4.5 core, no config, no
    // surface.
    static Result<EglContext> open(DeviceChoice choice);
    EglContext(EglContext&& other) noexcept;
    EglContext& operator=(EglContext&& other) noexcept;
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext();

    const std::string& platform() const { return platform_; }

  private:
    EglContext() = default;
    static Result<EglContext> open_display(EGLDisplay display, std::string platform);
    void close();

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    std::string platform_;
};

}  // namespace awan::gl
