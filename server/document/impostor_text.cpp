#include "server/document/impostor_text.h"

#include "server/document/json_text.h"

namespace awan {
namespace {

void append_vector(const char* name, const glm::dvec3& v, std::string& out) {
    json_text::name(name, out);
    append_json_vector(v, out);
}

}  // namespace

std::string impostor_to_json(const Impostor& impostor, std::string_view image, bool has_depth) {
    using json_text::member;
    const ImpostorWish& wish = impostor.wish;
    std::string out = "{";
    member("app", std::string_view("Awan"), out);
    member("version", std::string_view(AWAN_VERSION), out);
    member("image", image, out);
    member("mapping", std::string_view(kImpostorWords[static_cast<int>(wish.mapping)]), out);
    member("views", wish.views, out);
    member("size", wish.size, out);
    member("depth", has_depth, out);
    append_vector("center", impostor.center, out);
    member("radius", impostor.radius, out);
    member("distance", impostor.distance, out);
    member("fov", kImpostorFov, out);
    json_text::name("frames", out);
    out += '[';
    for (std::size_t i = 0; i < impostor.views.size(); ++i) {
        const ImpostorView& view = impostor.views[i];
        const auto place = static_cast<int>(i);
        out += i == 0 ? "\n{" : ",\n{";
        member("x", place % wish.views * wish.size, out);
        member("y", place / wish.views * wish.size, out);
        append_vector("direction", view.direction, out);
        append_vector("eye", view.scene->camera.eye, out);
        append_vector("up", view.scene->camera.up, out);
        out += '}';
    }
    return out + "\n]}\n";
}

}  // namespace awan
