#include "core/gl/device.h"

#include <utility>

#include "core/gl/egl_context.h"
#include "core/gl/programs.h"

namespace awan {

struct Device::State {
    // Declared first, so destroyed last: the programs need it.
    gl::EglContext context;
    DeviceInfo info;
    Device::Programs programs;
};

Device::Device(std::unique_ptr<State> state) : state_(std::move(state)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

const DeviceInfo& Device::info() const {
    return state_->info;
}
Device::Programs& Device::programs() {
    return state_->programs;
}

namespace {

std::string gl_text(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

Result<Device> Device::open(DeviceChoice choice) {
    auto context = gl::EglContext::open(choice);
    if (!context.ok()) return context.error();
    DeviceInfo info{gl_text(GL_RENDERER), gl_text(GL_VERSION), context->platform(), true};
    info.software = info.renderer.find("llvmpipe") != std::string::npos ||
                    info.renderer.find("softpipe") != std::string::npos;
    auto columns = gl::Program::compute("light_columns.glsl");
    if (!columns.ok()) return columns.error();
    auto sums = gl::Program::compute("light_sums.glsl");
    if (!sums.ok()) return sums.error();
    auto samples = gl::Program::compute("light_samples.glsl");
    if (!samples.ok()) return samples.error();
    auto splat = gl::Program::compute("splat.glsl");
    if (!splat.ok()) return splat.error();
    auto interior = gl::Program::compute("splat.glsl", "#define INTERIOR\n");
    if (!interior.ok()) return interior.error();
    return Device(std::unique_ptr<State>(
        new State{*std::move(context),
                  std::move(info),
                  {*std::move(columns), *std::move(sums), *std::move(samples), *std::move(splat),
                   *std::move(interior)}}));
}

}  // namespace awan
