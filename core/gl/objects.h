// OpenGL objects as move-only values. Private to core/gl, core/light and core/draw: they live and
// die on the thread of the Device.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"

namespace awan::gl {

// A shader storage buffer. An empty one still has a byte, since GL refuses none.
class Buffer {
  public:
    explicit Buffer(std::size_t bytes, const void* data = nullptr);
    template <typename T>
    explicit Buffer(std::span<const T> values) : Buffer(values.size_bytes(), values.data()) {}
    Buffer(Buffer&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer();

    // Makes it the buffer of `layout(binding = ...) buffer` in the shader.
    void bind(GLuint binding) const;
    // Sets every byte to zero.
    void clear();
    GLuint name() const { return name_; }
    // Copies bytes from the start; waits for the shaders that write them.
    void read(void* to, std::size_t bytes) const;

  private:
    GLuint name_ = 0;
};

// Read-only vec4s that a shader fetches by index (samplerBuffer).
class TexelBuffer {
  public:
    template <typename T>
    explicit TexelBuffer(std::span<const T> values)
        : TexelBuffer(values.size_bytes(), values.data()) {}
    TexelBuffer(std::size_t bytes, const void* data);
    TexelBuffer(TexelBuffer&& other) noexcept
        : buffer_(std::move(other.buffer_)), texture_(std::exchange(other.texture_, 0)) {}
    TexelBuffer& operator=(TexelBuffer&&) = delete;
    TexelBuffer(const TexelBuffer&) = delete;
    TexelBuffer& operator=(const TexelBuffer&) = delete;
    ~TexelBuffer();

    // Makes it the sampler of `layout(binding = ...) uniform samplerBuffer` in the shader.
    void bind(GLuint binding) const;

  private:
    Buffer buffer_;
    GLuint texture_ = 0;
};

// Layers of a square picture of one channel or of three, half floats, each with its mip levels. Beyond its edge one
// channel is 0, and three are as at the edge.
class TextureArray {
  public:
    // side: a power of 2.
    TextureArray(int side, int layers, int channels = 1);
    TextureArray(TextureArray&& other) noexcept
        : name_(std::exchange(other.name_, 0)), channels_(other.channels_) {}
    TextureArray& operator=(TextureArray&&) = delete;
    TextureArray(const TextureArray&) = delete;
    TextureArray& operator=(const TextureArray&) = delete;
    ~TextureArray();

    // texels: (side >> level)^2 times the channels, the first row first.
    void put(int layer, int level, std::span<const float> texels);
    // Makes it the sampler of `layout(binding = ...) uniform sampler2DArray` in the shader.
    void bind(GLuint binding) const;

  private:
    GLuint name_ = 0;
    int channels_ = 1;
};

// What a volume is between the middles of its voxels: linear, or what the nearest one is, which llvmpipe looks up in a
// quarter of the time.
enum class BetweenVoxels { kLinear, kNearest };

// A volume of one channel. Beyond its sides it is 0, or begins again.
class VolumeTexture {
  public:
    // One value a voxel, x fastest, kept as half floats.
    VolumeTexture(int width, int height, int depth, std::span<const float> values,
                  BetweenVoxels between);
    // A byte a voxel, 255 is 1; begins again on all sides.
    VolumeTexture(int side, std::span<const std::uint8_t> bytes, BetweenVoxels between);
    VolumeTexture(VolumeTexture&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    VolumeTexture& operator=(VolumeTexture&&) = delete;
    VolumeTexture(const VolumeTexture&) = delete;
    VolumeTexture& operator=(const VolumeTexture&) = delete;
    ~VolumeTexture();

    // Makes it the sampler of `layout(binding = ...) uniform sampler3D` in the shader.
    void bind(GLuint binding) const;

  private:
    GLuint name_ = 0;
};

// A program of compute shaders, or of a vertex and a fragment shader.
class Program {
  public:
    // `name`: a file of core/shaders; `defines`: text put before it. Lines `#include "other.glsl"`
    // are replaced by that file. Fails with kInternal and the compiler's log.
    static Result<Program> compute(std::string_view name, std::string_view defines = "");
    // Both shaders from one file: VERTEX is defined for the one, FRAGMENT for the other.
    static Result<Program> drawing(std::string_view name);
    Program(Program&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Program& operator=(Program&& other) noexcept;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program();

    void use() const;
    // Location of a uniform; -1 when the compiler dropped it (setting -1 is allowed and does
    // nothing).
    GLint uniform(const char* name) const;

  private:
    explicit Program(GLuint name) : name_(name) {}
    GLuint name_ = 0;
};

// The first error flag of the context since the last call, as an Error that names `step`; kNoRenderer where the context
// is lost, and with it whatever was drawn.
Status gl_status(const char* step);

}  // namespace awan::gl
