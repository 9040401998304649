#include "tests/bench/baselines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <string>

#include "core/base/embedded.h"
#include "core/survey/projection.h"

namespace awan::bench {
namespace {

GLuint compile(GLenum kind, const std::string& text) {
    const GLuint shader = glCreateShader(kind);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good == GL_FALSE) {
        std::array<char, 2000> log{};
        glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
        std::fprintf(stderr, "%s\n", log.data());
        std::abort();
    }
    return shader;
}

GLuint link(const std::string& vertex, const std::string& fragment) {
    const GLuint program = glCreateProgram();
    glAttachShader(program, compile(GL_VERTEX_SHADER, "#version 450 core\n" + vertex));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, "#version 450 core\n" + fragment));
    glLinkProgram(program);
    return program;
}

GLuint make_frame(GLenum format, int width, int height, GLuint& texture) {
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    GLuint frame = 0;
    glCreateFramebuffers(1, &frame);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, texture, 0);
    return frame;
}

std::string shared_text(std::string_view name) {
    for (const EmbeddedFile& file : shader_files())
        if (file.name == name) return std::string(file.text);
    std::abort();
}

constexpr int kLightSide = 512;

}  // namespace

ReadbackLight::ReadbackLight(const ParticleSet& particles, glm::dvec3 to_sun, double gain)
    : gain_(static_cast<float>(gain)) {
    const SideAxes axes = side_axes(to_sun);
    std::vector<std::size_t> order(particles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return glm::dot(particles.center[a], to_sun) > glm::dot(particles.center[b], to_sun);
    });
    const Bounds bounds = bounds_of(particles);
    const glm::dvec3 middle = (bounds.min + bounds.max) / 2.0;
    const double half = glm::length(bounds.max - bounds.min) / 2 * 1.2;
    for (const std::size_t i : order) {
        const double s = static_cast<double>(particles.radius[i]) / 2;
        const glm::dvec3 p = particles.center[i] - middle;
        quads_.push_back({static_cast<float>(glm::dot(p, axes.u) / half),
                          static_cast<float>(glm::dot(p, axes.v) / half),
                          static_cast<float>(4 * s / half),
                          static_cast<float>(static_cast<double>(particles.density[i]) * s *
                                             std::sqrt(2 * std::numbers::pi))});
    }
    program_ = link(
        "layout(location = 0) uniform vec4 quad; out vec2 at;"
        "void main() { at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;"
        " gl_Position = vec4(quad.xy + at * quad.z, 0.0, 1.0); }",
        "layout(location = 0) uniform vec4 quad; layout(location = 1) uniform vec2 light; in vec2 "
        "at; out vec4 color;"
        "void main() { float T = exp(-quad.w * exp(-8.0 * dot(at, at)));"
        " color = vec4(light.y * (1.0 - T) * light.x, 0.0, 0.0, T); }");
    frame_ = make_frame(GL_R32F, kLightSide, kLightSide, texture_);
    glCreateVertexArrays(1, &array_);
}

ReadbackLight::~ReadbackLight() {
    glDeleteProgram(program_);
    glDeleteFramebuffers(1, &frame_);
    glDeleteTextures(1, &texture_);
    glDeleteVertexArrays(1, &array_);
}

std::vector<float> ReadbackLight::run() {
    std::vector<float> light(quads_.size());
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glViewport(0, 0, kLightSide, kLightSide);
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_SRC_ALPHA);
    glUseProgram(program_);
    glBindVertexArray(array_);
    for (std::size_t k = 0; k < quads_.size(); ++k) {
        const Quad& quad = quads_[k];
        const auto pixel = [](float x) {
            return std::clamp(static_cast<int>((x + 1) / 2 * kLightSide), 0, kLightSide - 1);
        };
        glReadPixels(pixel(quad.u), pixel(quad.v), 1, 1, GL_RED, GL_FLOAT, &light[k]);
        glUniform4f(0, quad.u, quad.v, quad.half, quad.tau);
        glUniform2f(1, light[k], gain_);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    glFinish();
    return light;
}

QuadSplats::QuadSplats(const SplatList& list, int width, int height, double tan_x, double tan_y,
                       glm::dvec3 to_sun, double g)
    : width_(width), height_(height), count_(static_cast<GLsizei>(list.splats.size())) {
    std::vector<Splat> back_to_front(list.splats.rbegin(), list.splats.rend());
    std::vector<glm::vec4> boxes;  // slopes: left, right, bottom, top
    for (const Splat& splat : back_to_front) {
        const double reach = 4 / std::sqrt(2 * static_cast<double>(splat.place.w));
        const Interval x = disc_slopes(static_cast<double>(splat.place.x),
                                       static_cast<double>(splat.place.z), reach);
        const Interval y = disc_slopes(static_cast<double>(splat.place.y),
                                       static_cast<double>(splat.place.z), reach);
        boxes.push_back(glm::vec4(x.low / tan_x, x.high / tan_x, y.low / tan_y, y.high / tan_y));
        const auto share = [](double low, double high) {
            return std::max(0.0, std::min(high, 1.0) - std::max(low, -1.0)) / 2;
        };
        fragments_ += share(x.low / tan_x, x.high / tan_x) * width *
                      share(y.low / tan_y, y.high / tan_y) * height;
    }
    glCreateBuffers(1, &buffer_);
    glNamedBufferStorage(buffer_, static_cast<GLsizeiptr>(boxes.size() * sizeof(glm::vec4)),
                         boxes.data(), 0);
    GLuint data = 0;
    glCreateBuffers(1, &data);
    glNamedBufferStorage(data, static_cast<GLsizeiptr>(back_to_front.size() * sizeof(Splat)),
                         back_to_front.data(), 0);
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &texels_);
    glTextureBuffer(texels_, GL_RGBA32F, data);
    glDeleteBuffers(1, &data);  // the texture keeps it
    program_ = link(
        "layout(binding = 0) uniform samplerBuffer splats; layout(std430, binding = 0) readonly "
        "buffer B { vec4 boxes[]; };"
        "layout(location = 0) uniform vec2 tangent;"
        "out vec2 slope; flat out vec4 place, matter, direct, other, change;"
        "void main() { int at = gl_InstanceID * 5; place = texelFetch(splats, at); matter = "
        "texelFetch(splats, at + 1);"
        " direct = texelFetch(splats, at + 2); other = texelFetch(splats, at + 3); change = "
        "texelFetch(splats, at + 4);"
        " vec4 b = boxes[gl_InstanceID];"
        " vec2 p = vec2((gl_VertexID & 1) == 0 ? b.x : b.y, (gl_VertexID >> 1) == 0 ? b.z : b.w);"
        " slope = p * tangent; gl_Position = vec4(p, 0.0, 1.0); }",
        shared_text("optics.glsl") + shared_text("phase.glsl") +
            "layout(location = 1) uniform vec3 to_sun; layout(location = 2) uniform float g;"
            "in vec2 slope; flat in vec4 place, matter, direct, other, change; out vec4 color;"
            "float on_ray(vec4 f, vec3 p) { return f.w + dot(f.xyz, p); }"
            "void main() { vec3 d = vec3(slope, 1.0); float per = 1.0 / dot(d, d); float t = "
            "dot(place.xyz, d) * per;"
            " vec3 miss = cross(place.xyz, d); float tau = matter.w * exp(-dot(miss, miss) * "
            "place.w * per);"
            " float alpha = one_minus_exp(tau); vec3 p = d * t;"
            " float lit = clamp(on_ray(direct, p), 0.0, 1.0) * henyey_greenstein(to_sun, d * "
            "sqrt(per), g);"
            " vec3 all = other.rgb * clamp(on_ray(change, p), 0.0, other.w);"
            " color = vec4(alpha * (all + lit * matter.xyz), alpha); }");
    glUseProgram(program_);
    glUniform2f(0, static_cast<float>(tan_x), static_cast<float>(tan_y));
    const glm::vec3 sun(to_sun);
    glUniform3f(1, sun.x, sun.y, sun.z);
    glUniform1f(2, static_cast<float>(g));
    frame_ = make_frame(GL_RGBA32F, width, height, texture_);
    glCreateVertexArrays(1, &array_);
}

QuadSplats::~QuadSplats() {
    glDeleteProgram(program_);
    glDeleteFramebuffers(1, &frame_);
    glDeleteTextures(1, &texture_);
    glDeleteTextures(1, &texels_);
    glDeleteBuffers(1, &buffer_);
    glDeleteVertexArrays(1, &array_);
}

std::vector<float> QuadSplats::run() {
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glViewport(0, 0, width_, height_);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(program_);
    glBindVertexArray(array_);
    glBindTextureUnit(0, texels_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer_);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
    std::vector<float> pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                              4);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels.data());
    return pixels;
}

}  // namespace awan::bench
