// write_glb(): glTF 2.0 in one binary file, which three.js, Blender, Houdini and Unreal open.
#include <bit>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>

#include "core/formats/particle_files.h"

namespace awan {
namespace {

void append_word(std::uint32_t value, std::string& out) {
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFF);
}

void append_float(float value, std::string& out) {
    append_word(std::bit_cast<std::uint32_t>(value), out);
}

template <typename V>
std::string vector_text(const V& v) {
    std::string out = "[";
    for (int i = 0; i < 3; ++i) {
        if (i > 0) out += ',';
        append_number(v[i], out);
    }
    return out + "]";
}

// One list of floats of the file: where it stands and what it is.
struct Attribute {
    const char* name;
    const char* type;
    std::size_t floats;
    std::string more;
};

void append_chunk(std::string_view type, std::string_view bytes, char filler, std::string& out) {
    const std::size_t padding = (4 - bytes.size() % 4) % 4;
    append_word(static_cast<std::uint32_t>(bytes.size() + padding), out);
    out += type;
    out += bytes;
    out.append(padding, filler);
}

}  // namespace

Result<std::string> write_glb(const ParticleSet& particles) {
    const std::size_t count = particles.size();
    if (count == 0)
        return Error{ErrorCode::kInvalidScene, "",
                     "there are no particles, and glTF has no list without elements"};
    glm::dvec3 lowest(std::numeric_limits<double>::max()),
        highest(-std::numeric_limits<double>::max());
    for (const glm::dvec3& center : particles.center) {
        lowest = glm::min(lowest, center);
        highest = glm::max(highest, center);
    }
    // Places are written as floats from the middle, which the node says: so they are exact far from the origin too.
    const glm::dvec3 middle = 0.5 * (lowest + highest);
    std::string data;
    data.reserve(count * 32);
    glm::vec3 least(std::numeric_limits<float>::max()), most(-std::numeric_limits<float>::max());
    for (const glm::dvec3& center : particles.center) {
        const glm::vec3 place(center - middle);
        least = glm::min(least, place);
        most = glm::max(most, place);
        for (int i = 0; i < 3; ++i) append_float(place[i], data);
    }
    for (const float radius : particles.radius) append_float(radius, data);
    for (const float density : particles.density) append_float(density, data);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 color = particles.color.empty() ? glm::vec3(1.0f) : particles.color[i];
        for (int k = 0; k < 3; ++k) append_float(color[k], data);
    }

    const Attribute attributes[] = {
        {"POSITION", "VEC3", 3, ",\"min\":" + vector_text(least) + ",\"max\":" + vector_text(most)},
        {"_RADIUS", "SCALAR", 1, ""},
        {"_DENSITY", "SCALAR", 1, ""},
        {"COLOR_0", "VEC3", 3, ""}};
    std::string views, accessors, names;
    std::size_t offset = 0, index = 0;
    for (const Attribute& a : attributes) {
        const char* const comma = index == 0 ? "" : ",";
        const std::size_t bytes = 4 * a.floats * count;
        views += comma + std::string("{\"buffer\":0,\"byteOffset\":") + std::to_string(offset) +
                 ",\"byteLength\":" + std::to_string(bytes) + "}";
        accessors += comma + std::string("{\"bufferView\":") + std::to_string(index) +
                     ",\"componentType\":5126,\"count\":" + std::to_string(count) + ",\"type\":\"" +
                     a.type + "\"" + a.more + "}";
        names += comma + std::string("\"") + a.name + "\":" + std::to_string(index);
        offset += bytes;
        ++index;
    }
    const std::string json =
        "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Awan " AWAN_VERSION
        "\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}]," +
        std::string("\"nodes\":[{\"name\":\"cloud\",\"mesh\":0,\"translation\":") +
        vector_text(middle) + "}],\"meshes\":[{\"primitives\":[{\"mode\":0,\"attributes\":{" +
        names + "}}]}],\"accessors\":[" + accessors + "],\"bufferViews\":[" + views +
        "],\"buffers\":[{\"byteLength\":" + std::to_string(data.size()) + "}]}";

    std::string out = "glTF";
    append_word(2, out);
    append_word(static_cast<std::uint32_t>(12 + 8 + (json.size() + 3) / 4 * 4 + 8 + data.size()),
                out);
    append_chunk("JSON", json, ' ', out);
    append_chunk(std::string_view("BIN\0", 4), data, '\0', out);
    return out;
}

}  // namespace awan
