// SceneDraft -> a document for people to go on with: a cube a line, defaults left out.
#include "server/document/json.h"
#include "server/document/json_text.h"
#include "server/document/models.h"
#include "server/document/object_text.h"

namespace awan {
namespace {

const char* fill_name(Fill fill) {
    switch (fill) {
        case Fill::kUniform:
            return "uniform";
        case Fill::kGardner:
            return "gardner";
        case Fill::kPrinted:
            return "printed";
    }
    return "uniform";
}

void cube_list(const std::vector<Cube>& cubes, const char* indent, std::string& out) {
    out += '[';
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        out += i == 0 ? "\n" : ",\n";
        out += indent;
        const Cube& cube = cubes[i];
        ObjectText text(out);
        text.integer("particles", cube.particles);
        text.vector("size", cube.size);
        text.vector("center", cube.center);
        text.number("radius", cube.radius);
        text.number("density", cube.density, Cube{}.density);
        if (cube.texture) text.text("texture", *cube.texture);
        text.end();
    }
    out += cubes.empty() ? "]" : "\n" + std::string(indent).substr(2) + "]";
}

void ready_lists(ObjectText& text, const ReadyParticles& ready) {
    const auto number = [](float value, std::string& out) { append_json_number(value, out); };
    const auto vector = [](const auto& value, std::string& out) { append_json_vector(value, out); };
    write_list(text, "positions", ready.positions, vector);
    write_list(text, "radii", ready.radii, number);
    if (!ready.densities.empty()) write_list(text, "densities", ready.densities, number);
    if (!ready.colors.empty()) write_list(text, "colors", ready.colors, vector);
}

void cloud_object(const Cloud& cloud, std::string& out) {
    ObjectText text(out);
    if (is_procedural(cloud)) {
        write_model(cloud, text);
    } else if (cloud.model == CloudModel::kParticles) {
        text.text("model", "particles");
        ready_lists(text, cloud.ready);
    } else {
        cube_list(cloud.cubes, "      ", text.name("cubes"));
    }
    const Cloud standard;
    text.vector("translate", cloud.translate, standard.translate);
    text.number("scale", cloud.scale, standard.scale);
    text.number("rotate_y", cloud.rotate_y, standard.rotate_y);
    text.vector("velocity", cloud.velocity, standard.velocity);
    if (cloud.fill) text.text("fill", fill_name(*cloud.fill));
    if (cloud.density) text.number("density", *cloud.density);
    if (cloud.seed) text.integer("seed", *cloud.seed);
    text.end();
}

// Whether one cloud says no more than its cubes, so that they may stand at the top.
bool is_plain(const Cloud& cloud) {
    return cloud.model == CloudModel::kCubes && cloud.translate == glm::dvec3(0) &&
           cloud.scale == 1 && cloud.rotate_y == 0 && cloud.velocity == glm::dvec3(0) &&
           !cloud.fill && !cloud.density && !cloud.seed;
}

void clouds(ObjectText& text, const SceneDraft& scene) {
    if (scene.top_level_cubes && scene.clouds.size() == 1 && is_plain(scene.clouds[0])) {
        cube_list(scene.clouds[0].cubes, "    ", text.name("cubes"));
        return;
    }
    std::string& out = text.name("clouds");
    out += '[';
    for (std::size_t i = 0; i < scene.clouds.size(); ++i) {
        out += i == 0 ? "\n    " : ",\n    ";
        cloud_object(scene.clouds[i], out);
    }
    out += scene.clouds.empty() ? "]" : "\n  ]";
}

void lights(ObjectText& text, const SceneDraft& scene, const SceneDraft& standard) {
    write_object(text, "medium", [&](ObjectText& medium) {
        medium.number("albedo", scene.medium.albedo, standard.medium.albedo);
        medium.number("g", scene.medium.g, standard.medium.g);
        if (scene.medium.phase == PhaseFunction::kCornetteShanks)
            medium.text("phase", "cornette-shanks");
    });
    write_object(text, "sun", [&](ObjectText& sun) {
        if (scene.sun.direction) {
            sun.vector("direction", *scene.sun.direction);
        } else {
            sun.number("elevation", scene.sun.elevation, standard.sun.elevation);
            sun.number("azimuth", scene.sun.azimuth, standard.sun.azimuth);
        }
        if (scene.sun.auto_color)
            sun.text("color", "auto");
        else
            sun.vector("color", scene.sun.color, standard.sun.color);
        sun.number("intensity", scene.sun.intensity, standard.sun.intensity);
    });
    if (scene.sky.none) {
        text.text("sky", "none");
    } else {
        write_object(text, "sky", [&](ObjectText& sky) {
            if (scene.sky.physical) {
                sky.text("model", "physical");
                sky.number("intensity", scene.sky.intensity, kPhysicalSkyIntensity);
            } else {
                sky.vector("zenith", scene.sky.zenith, standard.sky.zenith);
                sky.vector("horizon", scene.sky.horizon, standard.sky.horizon);
                sky.number("intensity", scene.sky.intensity, standard.sky.intensity);
            }
            sky.number("turbidity", scene.sky.turbidity, standard.sky.turbidity);
        });
    }
    if (scene.ground)
        write_object(text, "ground", [&](ObjectText& ground) {
            ground.number("height", scene.ground->height);
            ground.vector("albedo", scene.ground->albedo);
        });
    if (scene.haze)
        write_object(text, "haze", [&](ObjectText& haze) {
            const Haze usual;
            haze.number("extinction", scene.haze->extinction);
            haze.number("height", scene.haze->height, usual.height);
            haze.number("scale_height", scene.haze->scale_height);
            haze.vector("albedo", scene.haze->albedo, usual.albedo);
            haze.number("g", scene.haze->g, usual.g);
        });
    if (scene.detail)
        write_object(text, "detail", [&](ObjectText& detail) {
            detail.number("amount", scene.detail->amount);
            detail.number("size", scene.detail->size);
        });
}

void picture(ObjectText& text, const SceneDraft& scene, const SceneDraft& standard) {
    if (!scene.camera.automatic)
        write_object(text, "camera", [&](ObjectText& camera) {
            camera.vector("eye", scene.camera.eye);
            camera.vector("target", scene.camera.target);
            camera.vector("up", scene.camera.up, standard.camera.up);
            camera.number("fov", scene.camera.fov, standard.camera.fov);
        });
    write_object(text, "image", [&](ObjectText& image) {
        image.number("width", scene.image.width, standard.image.width);
        image.number("height", scene.image.height, standard.image.height);
        if (scene.image.format == ImageFormat::kExr) image.text("format", "exr");
        if (scene.image.background == Background::kTransparent)
            image.text("background", "transparent");
        if (scene.image.exposure) image.number("exposure", *scene.image.exposure);
        if (scene.image.precision == Precision::kFloat) image.text("precision", "float");
    });
    write_object(text, "effects", [&](ObjectText& effects) {
        for (int i = 0; i < kEffectCount; ++i)
            if (scene.effects[i] != Switch::kAuto)
                effects.name(effect_name(static_cast<Effect>(i))) +=
                    scene.effects[i] == Switch::kOn ? "true" : "false";
    });
    write_object(text, "accuracy", [&](ObjectText& accuracy) {
        if (scene.accuracy.error) accuracy.number("error", *scene.accuracy.error);
        if (scene.accuracy.time_ms) accuracy.number("time_ms", *scene.accuracy.time_ms);
        if (scene.accuracy.rung) accuracy.text("rung", *scene.accuracy.rung);
    });
}

}  // namespace

std::string scene_to_json(const SceneDraft& scene) {
    const SceneDraft standard;
    std::string out;
    ObjectText text(out, "\n  ", "\n}\n");
    clouds(text, scene);
    if (scene.fill != standard.fill) text.text("fill", fill_name(scene.fill));
    if (scene.seed != standard.seed) text.integer("seed", scene.seed);
    if (scene.density) text.number("density", *scene.density);
    if (scene.look != Look::kPhysical)
        text.text("look", scene.look == Look::kGardner ? "gardner" : "ostroushko");
    text.number("time", scene.time, standard.time);
    if (scene.sequence)
        write_object(text, "sequence", [&](ObjectText& sequence) {
            sequence.number("from", scene.sequence->from);
            sequence.number("to", scene.sequence->to);
            sequence.integer("frames", scene.sequence->frames);
        });
    lights(text, scene, standard);
    picture(text, scene, standard);
    text.end();
    return out;
}

}  // namespace awan
