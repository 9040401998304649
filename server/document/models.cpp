#include "server/document/models.h"

namespace awan {
namespace {

template <typename Model>
void write_one(const char* name, const Model& model, void (*write)(const Model&, ObjectText&),
               ObjectText& text) {
    text.text("model", name);
    std::string inner;
    ObjectText object(inner);
    write(model, object);
    object.end();
    text.name(name) += inner;
}

}  // namespace

void write_model(const Cloud& cloud, ObjectText& text) {
    if (cloud.automaton) write_one("automaton", *cloud.automaton, write_automaton, text);
    if (cloud.spheres) write_one("spheres", *cloud.spheres, write_spheres, text);
    if (cloud.implicit) write_one("implicit", *cloud.implicit, write_implicit, text);
    if (cloud.ellipsoids) write_one("ellipsoids", *cloud.ellipsoids, write_ellipsoids, text);
}

}  // namespace awan
