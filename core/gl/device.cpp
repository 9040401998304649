#include "core/gl/device.h"

#include <sys/mman.h>

#include <cstddef>
#include <utility>

#include "core/gl/egl_context.h"
#include "core/gl/programs.h"

namespace awan {

namespace {

template <typename Compile>
Result<const gl::Program*> compiled(std::optional<gl::Program>& kept, const Compile& compile) {
    if (!kept) {
        auto program = compile();
        if (!program.ok()) return program.error();
        kept.emplace(*std::move(program));
    }
    return &*kept;
}

}  // namespace

Result<const gl::Program*> Device::Programs::plain(bool interior) {
    return compiled(plain_splats[interior ? 1 : 0], [&] {
        return gl::Program::compute("splat.glsl", interior ? "#define INTERIOR\n" : "");
    });
}

Result<const gl::Program*> Device::Programs::painted(bool interior, bool tinted) {
    return compiled(painted_splats[interior ? 1 : 0][tinted ? 1 : 0], [&] {
        std::string defines = "#define PAINTED\n";
        if (interior) defines += "#define INTERIOR\n";
        if (tinted) defines += "#define TINTED\n";
        return gl::Program::compute("splat.glsl", defines);
    });
}

Result<const gl::Program*> Device::Programs::detailed(bool interior) {
    return compiled(detailed_splats[interior ? 1 : 0], [&] {
        return gl::Program::compute(
            "splat.glsl", interior ? "#define DETAIL\n#define INTERIOR\n" : "#define DETAIL\n");
    });
}

Result<const gl::Program*> Device::Programs::display() {
    return compiled(display_triangles, [] { return gl::Program::drawing("display.glsl"); });
}

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

// Address space that opening a device takes with Mesa's llvmpipe: threads, and the code that LLVM makes of the shaders.
constexpr std::size_t kOpeningBytes = std::size_t{384} << 20;

// Under a limit (ulimit -v), LLVM ends the whole process where it gets no memory. So it is asked for before.
bool has_room() {
    void* const room =
        mmap(nullptr, kOpeningBytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return room != MAP_FAILED && munmap(room, kOpeningBytes) == 0;
}

std::string gl_text(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

Result<Device> Device::open(DeviceChoice choice) {
    if (!has_room())
        return Error{ErrorCode::kOutOfMemory, "",
                     "there is not enough memory to open OpenGL: it takes 384 MiB of addresses"};
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
    return Device(std::unique_ptr<State>(
        new State{*std::move(context),
                  std::move(info),
                  {*std::move(columns), *std::move(sums), *std::move(samples)}}));
}

}  // namespace awan
