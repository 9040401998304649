#include "core/formats/particle_files.h"

#include <array>
#include <charconv>
#include <cstring>
#include <string>

namespace awan {
namespace {

template <typename T>
void append_shortest(T value, std::string& out) {
    // The longest double takes 24 characters.
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    out.append(buffer.data(), end);
}

glm::vec3 color_of(const ParticleSet& particles, std::size_t i) {
    return particles.color.empty() ? glm::vec3(1.0f) : particles.color[i];
}

template <typename T>
void append_bytes(T value, std::string& out) {
    // x86-64 is little-endian, as the header says.
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    out.append(bytes.data(), bytes.size());
}

}  // namespace

void append_number(double value, std::string& out) {
    append_shortest(value, out);
}
void append_number(float value, std::string& out) {
    append_shortest(value, out);
}

void append_csv_header(std::string& out) {
    out += "x,y,z,radius,density,r,g,b\n";
}

void append_csv(const ParticleSet& particles, std::size_t first, std::size_t last,
                std::string& out) {
    for (std::size_t i = first; i < last; ++i) {
        const glm::dvec3& center = particles.center[i];
        const glm::vec3 color = color_of(particles, i);
        for (const double value : {center.x, center.y, center.z}) {
            append_number(value, out);
            out += ',';
        }
        for (const float value :
             {particles.radius[i], particles.density[i], color.x, color.y, color.z}) {
            append_number(value, out);
            out += ',';
        }
        out.back() = '\n';
    }
}

void append_ply_header(const ParticleSet& particles, std::string& out,
                       std::span<const glm::vec3> light) {
    out +=
        "ply\n"
        "format binary_little_endian 1.0\n"
        "comment Gaussian particles: density * exp(-d^2 / (2 s^2)) per unit, s = radius / 2\n"
        "element vertex " +
        std::to_string(particles.size()) +
        "\n"
        "property double x\n"
        "property double y\n"
        "property double z\n"
        "property float radius\n"
        "property float density\n"
        "property float red\n"
        "property float green\n"
        "property float blue\n";
    if (!light.empty())
        out +=
            "property float light_red\n"
            "property float light_green\n"
            "property float light_blue\n";
    out += "end_header\n";
}

void append_ply(const ParticleSet& particles, std::size_t first, std::size_t last, std::string& out,
                std::span<const glm::vec3> light) {
    for (std::size_t i = first; i < last; ++i) {
        const glm::dvec3& center = particles.center[i];
        const glm::vec3 color = color_of(particles, i);
        for (const double value : {center.x, center.y, center.z}) append_bytes(value, out);
        for (const float value :
             {particles.radius[i], particles.density[i], color.x, color.y, color.z})
            append_bytes(value, out);
        if (light.empty()) continue;
        for (const float value : {light[i].x, light[i].y, light[i].z}) append_bytes(value, out);
    }
}

}  // namespace awan
