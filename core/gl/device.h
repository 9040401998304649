// A place to draw: a headless OpenGL 4.5 core context and the programs of both passes, made once.
// Belongs to the thread that opened it.
#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"

namespace awan {

// What draws, for people.
struct DeviceInfo {
    // GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string renderer;
    // GL_VERSION, e.g. "4.5 (Core Profile) Mesa 22.3.6".
    std::string version;
    // "device" (a GPU) or "surfaceless" (Mesa, software).
    std::string platform;
    bool software = true;
};

// kAuto: a GPU if there is one, else Mesa's llvmpipe.
enum class DeviceChoice { kAuto, kSoftware };

// The context and its programs. Move-only.
class Device {
  public:
    // Fails with kNoRenderer and the EGL step and code that failed, or kOutOfMemory.
    static Result<Device> open(DeviceChoice choice);
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    const DeviceInfo& info() const;

    // The compiled shaders, see core/gl/programs.h.
    struct Programs;
    Programs& programs();

  private:
    struct State;
    explicit Device(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace awan
