#include "core/gl/objects.h"

#include <EGL/egl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/vec3.hpp>
#include <utility>

#include "core/base/embedded.h"

namespace awan::gl {
namespace {

Result<std::string> shader_text(std::string_view name, int depth) {
    const auto files = shader_files();
    const auto file = std::find_if(files.begin(), files.end(),
                                   [&](const EmbeddedFile& f) { return f.name == name; });
    if (file == files.end() || depth > 4)
        return Error{ErrorCode::kInternal, "", "no shader file " + std::string(name)};
    std::string out;
    std::string_view rest = file->text;
    constexpr std::string_view kInclude = "#include \"";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
        const std::string_view line = rest.substr(0, end + 1);
        rest.remove_prefix(end + 1);
        if (!line.starts_with(kInclude)) {
            out += line;
            continue;
        }
        const std::string_view included =
            line.substr(kInclude.size(), line.rfind('"') - kInclude.size());
        auto text = shader_text(included, depth + 1);
        if (!text.ok()) return text;
        out += *text;
    }
    return out;
}

Error compile_error(std::string_view name, const char* log) {
    return {ErrorCode::kInternal, "", "shader " + std::string(name) + ": " + log};
}

// A compiled shader of that file, attached to the program.
Status attach(GLuint program, GLenum kind, std::string_view name, std::string_view defines) {
    auto text = shader_text(name, 0);
    if (!text.ok()) return text.error();
    const std::string whole = "#version 450 core\n" + std::string(defines) + *text;
    const char* source = whole.c_str();
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    std::array<char, 2048> log{};
    GLint good = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good == GL_TRUE)
        glAttachShader(program, shader);
    else
        glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    // It lives as long as it is attached.
    glDeleteShader(shader);
    if (good == GL_TRUE) return std::nullopt;
    return compile_error(name, log.data());
}

Status link(GLuint program, std::string_view name) {
    glLinkProgram(program);
    GLint good = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good == GL_TRUE) return std::nullopt;
    std::array<char, 2048> log{};
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    return compile_error(name, log.data());
}

}  // namespace

Buffer::Buffer(std::size_t bytes, const void* data) {
    glCreateBuffers(1, &name_);
    glNamedBufferStorage(name_, static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 1)),
                         bytes > 0 ? data : nullptr, 0);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

Buffer::~Buffer() {
    if (name_ != 0) glDeleteBuffers(1, &name_);
}

void Buffer::bind(GLuint binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
}

void Buffer::clear() {
    glClearNamedBufferData(name_, GL_R32F, GL_RED, GL_FLOAT, nullptr);
}

void Buffer::read(void* to, std::size_t bytes) const {
    if (bytes == 0) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(bytes), to);
}

TexelBuffer::TexelBuffer(std::size_t bytes, const void* data)
    : buffer_(std::max<std::size_t>(bytes, 16), bytes > 0 ? data : nullptr) {
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &texture_);
    glTextureBuffer(texture_, GL_RGBA32F, buffer_.name());
}

TexelBuffer::~TexelBuffer() {
    if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void TexelBuffer::bind(GLuint binding) const {
    glBindTextureUnit(binding, texture_);
}

TextureArray::TextureArray(int side, int layers, int channels) : channels_(channels) {
    int levels = 1;
    while (side >> levels > 0) ++levels;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name_);
    glTextureStorage3D(name_, levels, channels == 1 ? GL_R16F : GL_RGB16F, side, side, layers);
    glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    const GLint beyond = channels == 1 ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE;
    glTextureParameteri(name_, GL_TEXTURE_WRAP_S, beyond);
    glTextureParameteri(name_, GL_TEXTURE_WRAP_T, beyond);
}

TextureArray::~TextureArray() {
    if (name_ != 0) glDeleteTextures(1, &name_);
}

void TextureArray::put(int layer, int level, std::span<const float> texels) {
    const auto side = static_cast<GLsizei>(
        std::lround(std::sqrt(texels.size() / static_cast<std::size_t>(channels_))));
    glTextureSubImage3D(name_, level, 0, 0, layer, side, side, 1, channels_ == 1 ? GL_RED : GL_RGB,
                        GL_FLOAT, texels.data());
}

void TextureArray::bind(GLuint binding) const {
    glBindTextureUnit(binding, name_);
}

namespace {

GLuint make_volume(GLenum format, glm::ivec3 size, GLint beyond, BetweenVoxels between) {
    const GLint filter = between == BetweenVoxels::kLinear ? GL_LINEAR : GL_NEAREST;
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_3D, 1, &name);
    glTextureStorage3D(name, 1, format, size.x, size.y, size.z);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(name, axis, beyond);
    return name;
}

}  // namespace

VolumeTexture::VolumeTexture(int width, int height, int depth, std::span<const float> values,
                             BetweenVoxels between)
    : name_(make_volume(GL_R16F, {width, height, depth}, GL_CLAMP_TO_BORDER, between)) {
    glTextureSubImage3D(name_, 0, 0, 0, 0, width, height, depth, GL_RED, GL_FLOAT, values.data());
}

VolumeTexture::VolumeTexture(int side, std::span<const std::uint8_t> bytes, BetweenVoxels between)
    : name_(make_volume(GL_R8, glm::ivec3(side), GL_REPEAT, between)) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(name_, 0, 0, 0, 0, side, side, side, GL_RED, GL_UNSIGNED_BYTE,
                        bytes.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

VolumeTexture::~VolumeTexture() {
    if (name_ != 0) glDeleteTextures(1, &name_);
}

void VolumeTexture::bind(GLuint binding) const {
    glBindTextureUnit(binding, name_);
}

Result<Program> Program::compute(std::string_view name, std::string_view defines) {
    Program program(glCreateProgram());
    if (Status wrong = attach(program.name_, GL_COMPUTE_SHADER, name, defines)) return *wrong;
    if (Status wrong = link(program.name_, name)) return *wrong;
    return program;
}

Result<Program> Program::drawing(std::string_view name) {
    Program program(glCreateProgram());
    for (const auto& [kind, defines] : {std::pair{GL_VERTEX_SHADER, "#define VERTEX\n"},
                                        std::pair{GL_FRAGMENT_SHADER, "#define FRAGMENT\n"}})
        if (Status wrong = attach(program.name_, static_cast<GLenum>(kind), name, defines))
            return *wrong;
    if (Status wrong = link(program.name_, name)) return *wrong;
    return program;
}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

Program::~Program() {
    if (name_ != 0) glDeleteProgram(name_);
}

void Program::use() const {
    glUseProgram(name_);
}

GLint Program::uniform(const char* name) const {
    return glGetUniformLocation(name_, name);
}

Status gl_status(const char* step) {
    // Without a context, calls do nothing and nothing says so. After a reset, they may give anything.
    if (eglGetCurrentContext() == EGL_NO_CONTEXT || glGetGraphicsResetStatus() != GL_NO_ERROR)
        return Error{ErrorCode::kNoRenderer, "",
                     std::string("the OpenGL context was lost in ") + step};
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return std::nullopt;
    while (glGetError() != GL_NO_ERROR) {
    }
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(), "OpenGL error 0x%04x in %s", error, step);
    return Error{error == GL_OUT_OF_MEMORY ? ErrorCode::kOutOfMemory : ErrorCode::kInternal, "",
                 text.data()};
}

}  // namespace awan::gl
