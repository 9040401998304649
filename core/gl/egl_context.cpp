#include "core/gl/egl_context.h"

#include <EGL/eglext.h>

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

namespace awan::gl {
namespace {

Error egl_error(const char* step) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "no renderer: %s failed (EGL error 0x%04x)", step,
                  static_cast<unsigned>(eglGetError()));
    return {ErrorCode::kNoRenderer, "", text.data()};
}

template <typename Function>
Function egl_function(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

bool has_extension(const char* list, std::string_view name) {
    return list != nullptr &&
           (" " + std::string(list) + " ").find(" " + std::string(name) + " ") != std::string::npos;
}

// The display of a real GPU, if EGL knows one: software devices have no DRM node.
EGLDisplay hardware_display() {
    const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto query_string =
        egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    const auto get_display =
        egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (query_devices == nullptr || query_string == nullptr || get_display == nullptr)
        return EGL_NO_DISPLAY;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE)
        return EGL_NO_DISPLAY;
    for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
        const char* extensions = query_string(device, EGL_EXTENSIONS);
        if (has_extension(extensions, "EGL_MESA_device_software")) continue;
        if (!has_extension(extensions, "EGL_EXT_device_drm") &&
            !has_extension(extensions, "EGL_NV_device_cuda"))
            continue;
        const EGLDisplay display = get_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        if (display != EGL_NO_DISPLAY) return display;
    }
    return EGL_NO_DISPLAY;
}

}  // namespace

Result<EglContext> EglContext::open(DeviceChoice choice) {
    if (choice == DeviceChoice::kAuto) {
        const EGLDisplay display = hardware_display();
        if (display != EGL_NO_DISPLAY) {
            auto context = open_display(display, "device");
            if (context.ok()) return context;
        }
    }
    const auto get_display =
        egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (get_display == nullptr) return egl_error("finding eglGetPlatformDisplayEXT");
    const EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display == EGL_NO_DISPLAY) return egl_error("eglGetPlatformDisplayEXT(surfaceless)");
    return open_display(display, "surfaceless");
}

Result<EglContext> EglContext::open_display(EGLDisplay display, std::string platform) {
    EglContext result;
    result.platform_ = std::move(platform);
    if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return egl_error("eglInitialize");
    result.display_ = display;
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return egl_error("eglBindAPI(OpenGL)");
    // Told when the device is reset (glGetGraphicsResetStatus), where the driver can tell.
    std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                        EGL_LOSE_CONTEXT_ON_RESET,
                                        EGL_NONE};
    result.context_ =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (result.context_ == EGL_NO_CONTEXT) {
        attributes[6] = EGL_NONE;
        result.context_ =
            eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    }
    if (result.context_ == EGL_NO_CONTEXT) return egl_error("eglCreateContext(OpenGL 4.5 core)");
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, result.context_) != EGL_TRUE)
        return egl_error("eglMakeCurrent");
    return result;
}

EglContext::EglContext(EglContext&& other) noexcept
    : display_(std::exchange(other.display_, EGL_NO_DISPLAY)),
      context_(std::exchange(other.context_, EGL_NO_CONTEXT)),
      platform_(std::move(other.platform_)) {}

EglContext& EglContext::operator=(EglContext&& other) noexcept {
    if (this != &other) {
        close();
        display_ = std::exchange(other.display_, EGL_NO_DISPLAY);
        context_ = std::exchange(other.context_, EGL_NO_CONTEXT);
        platform_ = std::move(other.platform_);
    }
    return *this;
}

EglContext::~EglContext() {
    close();
}

// The display is shared by everyone who asked for the same platform (EGL 1.5, 3.2), so it is not
// terminated.
void EglContext::close() {
    if (context_ == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    context_ = EGL_NO_CONTEXT;
}

}  // namespace awan::gl
