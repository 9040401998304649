// Every field of the scene document counts: whichever is changed alone, the scene has another fingerprint, and the
// light another key where light depends on it. Nothing here lists fields: the documents below set all that the parser
// knows (which the parser's own refusals tell), and each value in them is changed in turn. A field that is added to a
// scene fails the first test until a document below sets it, and the second until the fingerprint has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/scene/fingerprint.h"
#include "core/scene/scene.h"
#include "core/scene/validate.h"
#include "server/document/json.h"

namespace awan {
namespace {

using nlohmann::json;

// Together they set every field of every object.
const char* const kDocuments[] = {
    R"({
"clouds": [
  {"cubes": [{"particles": 40, "size": [3, 1, 2], "center": [1, 2, 3], "radius": 1.5, "density": 0.7},
             {"particles": 10, "size": [1, 1, 1], "center": [0, 5, 0], "radius": 1, "texture": "puff",
              "billboards": 20}],
   "translate": [1, 2, 3], "velocity": [0.5, 0.25, 1], "scale": 2, "rotate_y": 30},
  {"model": "cubes", "cubes": [{"particles": 5, "size": [1, 1, 1], "center": [0, 0, 9], "radius": 1}],
   "fill": "gardner", "density": 0.3, "seed": 17, "texture": "wisp", "billboards": 12},
  {"model": "particles", "positions": [[1, 2, 3], [4, 5, 6]], "radii": [1, 2], "densities": [0.5, 0.6],
   "colors": [[0.9, 0.8, 0.7], [0.6, 0.5, 0.4]]},
  {"model": "automaton", "automaton": {
     "cells": [40, 20, 30], "cell": 4,
     "ellipsoids": [{"center": [20, 8, 15], "radii": [8, 6, 7]}, {"center": [12, 8, 11], "radii": [5, 6, 4]}],
     "random": {"count": 3, "smallest": [4, 4, 4], "largest": [7, 6, 7], "level": 4},
     "overlap": "first", "base": 4, "humidity": 0.2, "activation": 0.01, "extinction": 0.1,
     "outside_extinction": 0.3, "fall_off": "table", "fall_off_table": [1, 0.5, 0.25],
     "wind": {"direction": 70, "layers": {"constant": 0.1, "linear": 0.02, "quadratic": 0.001, "direction": 20, "turn": 2},
              "layer_bands": [{"from": 2, "to": 9, "constant": 0.3, "linear": 0.01, "quadratic": 0.003, "direction": 10, "turn": 1}],
              "mutation": 0.2,
              "ellipsoids": [{"from": 1, "to": 15, "constant": 0.2, "linear": 0.03, "quadratic": 0.002, "direction": 200, "turn": -1}]},
     "smooth_weight": "table", "smooth_weight_table": [1, 0.5],
     "drawing": {"mode": "textures", "textures": "soft,hard", "billboard_scale": 5, "color_multiplier": 2.5, "opacity": 0.75,
                 "point_size": 2, "between_steps": "hold"}, "chosen": 2,
     "warm_up": 30, "steps_per_second": 2, "steps": 500, "smooth": [1, 2, 1], "smooth_steps": 3,
     "metaball_radius": 2.5, "threshold": 0.05, "most_particles": 9000}},
  {"model": "spheres", "spheres": {
     "kind": "cumulus", "levels": 4, "size": [12, 6, 9], "visual_range": 30, "ratio_min": 0.3,
     "ratio_max": 0.6, "shift_min": 0.7, "shift_max": 0.95, "scaling": "every", "growth": "down",
     "parts": 6, "places": "dome", "ratio_law": "falling", "shift_law": "ends", "turning": 7,
     "poses": [{"time": 1, "shift": [1, 2, 3], "turn": [4, 5, 6], "scale": [2, 3, 4]}],
     "bump": {"height": 0.2, "texture": "puff", "repeat": 3,
              "waves": [{"amplitude": 0.5, "around": 3, "down": 1.5, "phase": 0.25}]},
     "morph": {"seed": 9, "duration": 8, "steps": 6}}},
  {"model": "implicit", "implicit": {
     "preset": "cirrus", "interpolation": "linear", "base": -3, "amount": 0.8, "exponent": 1.2, "blend": 0.4,
     "displacement": 0.3, "displace": "diagonal", "noise_size": 1.5, "octaves": 4, "gain": 0.45, "stretch": 2,
     "jet": [0.5, 0.25, 0.125], "jet_turbulence": 0.6, "warp_from": -20, "warp_to": 40,
     "attractors": [{"at": [1, 2, 3], "strength": 0.5, "reach": 9,
                     "keys": [{"time": 2, "at": [2, 2, 3], "strength": 0.25, "reach": 8}]}],
     "vortices": [{"at": [3, 2, 1], "axis": [0.2, 1, 0.3], "angle": 40, "reach": 8,
                   "keys": [{"time": 3, "at": [3, 3, 1], "axis": [0.1, 1, 0.4], "angle": 50, "reach": 7}]}],
     "flow": {"min": [-9, -8, -7], "max": [9, 8, 7], "size": [2, 1, 1], "vectors": [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]},
     "ripple": [3, 4, 5], "ripple_depth": 0.7, "ripple_turbulence": 0.9, "swirl": 5, "swirl_path": "printed",
     "resolution": 40, "threshold": 0.01,
     "primitives": [
       {"shape": "sphere", "center": [1, 2, 3], "radius": 6, "core": 1, "weight": 0.9,
        "keys": [{"time": -2, "center": [1, 1, 1], "radius": 5, "weight": 0.5, "core": 0.5},
                 {"time": 8, "center": [3, 2, 2], "radius": 7, "weight": 0.75}]},
       {"shape": "ellipsoid", "center": [5, 0, 0], "radius": 4, "radii": [2, 1, 1.5], "rotate": [10, 20, 30],
        "keys": [{"time": 1, "radii": [1, 1.25, 1.5], "rotate": [5, 6, 7]}]},
       {"shape": "sphere", "radius": 2},
       {"shape": "segment", "radius": 3, "points": [[0, 0, 0], [4, 1, 0], [8, 0, 1]],
        "keys": [{"time": 3, "points": [[0, 1, 0], [4, 2, 0], [8, 3, 1]]}]}],
     "keys": [{"time": -1, "amount": 0.7, "exponent": 1.3, "blend": 0.45, "displacement": 0.2, "noise_size": 1.25,
               "gain": 0.55, "stretch": 2.5, "jet": [0.25, 0.5, 0.75], "jet_turbulence": 0.4, "warp": 0.5,
               "ripple_depth": 0.6, "ripple_turbulence": 0.8, "base": -4}],
     "squash": {"at": [1, 2, 3], "axis": [0.1, 1, 0.2], "amount": 1.5, "keys": [{"time": 2, "amount": 0.75}]},
     "formula": "density * height"}},
  {"model": "implicit", "implicit": {
     "growth": {"seeds": 5, "most": 20, "radius": 12, "shrink": 0.8, "weight": 0.9, "center": [1, 2, 3],
                "spread": [2, 1, 1.5], "velocity": [0.01, 0.03, 0.02], "force": [0.001, 0.006, 0.002],
                "turbulence": 0.04, "drag": 0.1, "lifetime": 20, "rate": 0.2, "duration": 50,
                "keys": [{"time": 4, "center": [2, 2, 3], "radius": 11, "weight": 0.8, "force": [0.002, 0.005, 0.001],
                          "turbulence": 0.05, "drag": 0.2, "rate": 0.3}]},
     "bubbles": {"most": 20, "knobs": 3, "radius": 11, "weight": 0.8, "center": [1, 2, 3], "spread": [3, 1, 2],
                 "rise": 0.3, "ceiling": 4, "entrainment": 0.2, "rate": 2, "began": -20},
     "billows": {"waves": 3, "wavelength": 90, "length": 100, "radius": 9, "weight": 0.7, "center": [3, 2, 1],
                 "shear": 7, "amplitude": 0.05, "smoothing": 0.25, "variation": 0.2, "began": -25},
     "cells": {"kind": "open", "rings": 2, "parcels": 8, "spacing": 80, "depth": 20, "radius": 14, "weight": 0.9,
               "center": [2, 1, 3], "irregular": 0.1, "turnover": 40},
     "particles": [{"time": 1, "id": 2, "center": [1, 2, 3], "radius": 4, "weight": 0.5},
                   {"time": 3, "id": 2, "center": [3, 2, 1], "radius": 5, "weight": 0.75}]}},
  {"model": "ellipsoids", "ellipsoids": {
     "texture": {"form": "printed", "terms": 5, "frequency_x": 0.3, "frequency_z": 0.4, "offset": 0.9,
                 "sines": [{"amplitude": 0.5, "frequency_x": 2, "frequency_z": 3, "phase_x": 4, "phase_z": 5}]},
     "join": 0.5, "translucence_min": 0.1, "translucence_max": 0.9,
     "quadrics": [{"q1": 1, "q2": 2, "q3": 3, "q4": 0.1, "q5": 0.2, "q6": 0.3, "q7": 0.4, "q8": 0.5, "q9": 0.6, "q0": -4}],
     "shading": {"specular": 0.2, "texture": 0.3, "ambient": 0.4, "shininess": 9},
     "threshold": 0.1, "threshold_edge": 0.6, "range": 0.4,
     "plane": {"altitude": 50, "extent": 300, "thickness": 3, "threshold": 0.2, "range": 0.5, "density": 0.8,
               "resolution": 60, "horizon": 200, "translucence_min": 0.1, "translucence_max": 0.9,
               "patterns": [{"x": 1, "z": 2, "radius_x": 30, "radius_z": 20, "edge": 0.6, "threshold": 0.1, "range": 0.2,
                             "texture": {"form": "clean", "terms": 6, "frequency_x": 0.5, "frequency_z": 0.7, "offset": 0.8,
                                         "sines": [{"amplitude": 0.5, "frequency_x": 2, "frequency_z": 3, "phase_x": 4, "phase_z": 5}]}}],
               "texture": {"form": "clean", "terms": 6, "frequency_x": 0.05, "frequency_z": 0.07, "offset": 0.8,
                           "sines": [{"amplitude": 0.5, "frequency_x": 2, "frequency_z": 3, "phase_x": 4, "phase_z": 5}]}},
     "formations": [{"kind": "combined", "count": 6, "center": [1, 2, 3], "radii": [5, 2, 4], "variation": 0.3,
                     "link": 0.4, "heading": 30, "spread": 50, "tilt": 5}],
     "ellipsoids": [{"center": [3, 2, 1], "radii": [6, 3, 5], "rotate_y": 20, "rotate_x": 5, "rotate_z": 6, "threshold": 0.15,
                     "threshold_edge": 0.7, "range": 0.3}],
     "drift": [0.4, 0.1, 0.2], "density": 0.9, "resolution": 30}}
],
"fill": "printed", "seed": 5, "display": "quads", "density": 0.25, "time": 1.5, "sequence": {
  "from": -4, "to": 12, "frames": 9, "interpolation": "linear", "clouds": "move",
  "camera": [{"time": -4, "eye": [1, 2, 90], "target": [0, 1, 2], "fov": 35},
             {"time": 12, "eye": [60, 2, 70], "target": [0, 1, 3], "fov": 25}]},
"medium": {"albedo": 0.95, "g": 0.7, "phase": "cornette-shanks"},
"sun": {"elevation": 30, "azimuth": 40, "color": [0.9, 0.8, 0.7], "intensity": 8},
"sky": {"model": "gradient", "zenith": [0.1, 0.2, 0.3], "horizon": [0.4, 0.5, 0.6], "intensity": 0.9},
"ground": {"height": -30, "albedo": [0.1, 0.2, 0.3], "terrain": {"height": 3, "extent": 90, "center": [1, 2, 3],
           "size": 12, "roughness": 0.3, "level": 0.2, "seed": 4, "rock": [0.2, 0.1, 0.1], "snow": 2}},
"haze": {"extinction": 0.001, "height": -20, "scale_height": 80, "albedo": [0.9, 0.8, 0.7], "g": 0.5},
"detail": {"amount": 0.6, "size": 1.25},
"camera": {"eye": [1, 2, 90], "target": [0, 1, 2], "up": [0.1, 1, 0.05], "fov": 35},
"image": {"width": 320, "height": 200, "format": "exr", "background": "transparent", "exposure": 0.5,
          "precision": "float", "tone": "reinhard"},
"effects": {"self_shadow": true, "multiple_scattering": false, "view_extinction": true, "sky_light": false,
            "ground_light": true, "ground_shadow": false, "sun_color": true, "aerial_perspective": false,
            "light_shafts": true, "detail": false, "interior": false, "texture": false, "terrain": true},
"accuracy": {"error": 0.05}
})",
    R"({
"cubes": [{"particles": 40, "size": [3, 1, 2], "center": [1, 2, 3], "radius": 1.5, "density": 2,
           "texture": "puff", "billboards": 20},
          {"particles": 3, "size": [1, 1, 1], "center": [4, 2, 3], "radius": 1}],
"texture": "torn", "billboards": 30,
"sun": {"direction": [0.3, 0.5, 0.4], "color": "auto", "disc": "off"},
"medium": {"phase": "mie", "droplet": 11},
"sky": {"model": "physical", "daylight": "preetham", "turbidity": 3, "intensity": 0.7},
"ground": {"albedo": 0.4, "terrain": {"height": 4, "map": "puff"}},
"haze": {"extinction": 0.01, "scale_height": 20, "albedo": 0.8},
"image": {"exposure": "auto", "layers": "depth,sun"}, "accuracy": {"time_ms": 200}
})",
    R"({
"clouds": [{"model": "automaton", "automaton": {"random": {"level": "any"}}},
           {"model": "ellipsoids", "ellipsoids": {"plane": "none", "formations": [{"kind": "vertical"}]}}],
"effects": "auto", "accuracy": {"rung": "transport-24"}
})",
    R"({"clouds": [{"model": "spheres", "spheres": {"kind": "cirrus"}}], "look": "ostroushko"})",
    R"({"clouds": [{"model": "implicit", "implicit": {"preset": "stratus"}}]})"};

// Values of words, each tried where a word stands until one is taken.
const char* const kWords[] = {"uniform",
                              "ball",
                              "soft",
                              "gardner",
                              "generated",
                              "blend",
                              "printed",
                              "henyey-greenstein",
                              "cornette-shanks",
                              "auto",
                              "none",
                              "png",
                              "exr",
                              "sky",
                              "transparent",
                              "half",
                              "float",
                              "first",
                              "deepest",
                              "any",
                              "cumulus",
                              "cirrus",
                              "every",
                              "up",
                              "down",
                              "stratus",
                              "smooth",
                              "linear",
                              "every_way",
                              "diagonal",
                              "steady",
                              "sphere",
                              "cylinder",
                              "segment",
                              "density",
                              "closed",
                              "open",
                              "horizontal",
                              "vertical",
                              "combined",
                              "move",
                              "stand",
                              "clean",
                              "physical",
                              "gradient",
                              "scattered",
                              "preetham",
                              "neutral",
                              "reinhard",
                              "ostroushko",
                              "lit",
                              "cubes",
                              "transport-32"};

// Values that cannot be changed alone: why.
const std::map<std::string, std::string> kStandsWithOthers = {
    {"/clouds/model", "says which of its neighbours are allowed"},
    {"/sky/model", "says which of its neighbours are allowed"},
    {"/medium/phase", "droplets belong to one of them"},
    {"/clouds/ellipsoids/plane", "\"none\" is the only word"},
    {"/clouds/automaton/fall_off", "a table has values, which no other word has"},
    {"/clouds/automaton/smooth_weight", "a table has values, which no other word has"},
    {"/clouds/implicit/primitives/shape", "says which of its neighbours are allowed"},
    {"/effects", "\"auto\" is the only word"},
    {"/clouds/implicit/flow/size", "says how many vectors there are"}};

// Values, by their full pointers, that change no picture: why.
const std::map<std::string, std::string> kSaysNothing = {
    {"/sequence/frames", "a still depends on the sequence's two ends alone"},
    {"/cubes/0/particles", "its billboards stand for them"},
    {"/cubes/1/particles", "the scene's billboards stand for them"},
    {"/clouds/0/cubes/1/particles", "its billboards stand for them"},
    {"/clouds/1/cubes/0/particles", "the cloud's billboards stand for them"},
    {"/clouds/3/automaton/wind/direction", "all its parts have a direction of their own"},
    {"/clouds/4/spheres/kind", "only gives defaults, and all of them are given"}};

// Beginnings of what light does not depend on: the light of a cloud is the same for every picture of it.
const char* const kPictureOnly[] = {
    "/sun/disc",     "/camera",  "/image",   "/haze",    "/accuracy",       "/look",
    "/sequence",     "/effects", "/display", "/texture", "/clouds/texture", "/clouds/cubes/texture",
    "/cubes/texture"};
const char* const kLightToo[] = {"/effects/sun_color", "/effects/terrain", "/sequence/clouds"};

bool begins(const std::string& path, const char* with) {
    const std::string beginning = with;
    return path == beginning || path.rfind(beginning + "/", 0) == 0;
}

bool is_for_pictures_only(const std::string& path) {
    const auto here = [&](const char* beginning) { return begins(path, beginning); };
    return std::any_of(std::begin(kPictureOnly), std::end(kPictureOnly), here) &&
           std::none_of(std::begin(kLightToo), std::end(kLightToo), here);
}

// Both are empty for what is no scene.
struct Prints {
    std::string scene, light;
};
Prints prints_of(const json& document) {
    auto draft = parse_scene(document.dump());
    if (!draft.ok()) return {};
    const auto scene = validate(*std::move(draft));
    if (!scene.ok()) return {};
    return {fingerprint(*scene), light_fingerprint(*scene)};
}

// A pointer without its indices: "/clouds/3/implicit/base" is "/clouds/implicit/base".
std::string names_in(const json::json_pointer& at) {
    std::string names, rest = at.to_string();
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('/', 1), rest.size());
        if (!std::isdigit(static_cast<unsigned char>(rest[1]))) names += rest.substr(0, end);
        rest = rest.substr(end);
    }
    return names;
}

// What stands between quotes in the refusal of an unknown field, but the field itself.
std::vector<std::string> fields_at(json document, const json::json_pointer& object) {
    document[object]["?"] = 0;
    const auto draft = parse_scene(document.dump());
    if (draft.ok()) return {};
    std::string text = draft.error().message;
    const std::size_t allowed = text.find("allowed are ");
    if (allowed == std::string::npos) return {};
    std::vector<std::string> fields;
    text = text.substr(allowed);
    for (std::size_t open = text.find('"'); open != std::string::npos;) {
        const std::size_t close = text.find('"', open + 1);
        fields.push_back(text.substr(open + 1, close - open - 1));
        open = text.find('"', close + 1);
    }
    return fields;
}

template <typename Visit>
void each_value(const json& value, const json::json_pointer& at, const Visit& visit) {
    visit(value, at);
    if (value.is_object())
        for (const auto& [name, inner] : value.items()) each_value(inner, at / name, visit);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) each_value(value[i], at / i, visit);
}

// Other values, the likeliest to be allowed first. Beside a word a number or a vector may be allowed.
std::vector<json> others(const json& value) {
    std::vector<json> list;
    if (value.is_boolean()) list.insert(list.end(), {json(!value.get<bool>()), json("auto")});
    if (value.is_string())
        for (const char* word : kWords)
            if (value != word) list.push_back(word);
    if (value.is_string()) list.insert(list.end(), {json(0.25), json({0.5, 0.25, 0.125})});
    if (value.is_number_integer()) {
        list.push_back(value.get<std::int64_t>() + 1);
        list.push_back(value.get<std::int64_t>() - 1);
    }
    if (value.is_number())
        for (const double step : {1.01, 0.99}) list.push_back(value.get<double>() * step + 0.001);
    return list;
}

std::vector<json> documents() {
    std::vector<json> list;
    for (const char* text : kDocuments) list.push_back(json::parse(text));
    return list;
}

TEST(SceneFields, TheDocumentsHereSetThemAll) {
    std::set<std::string> allowed, given;
    for (const json& document : documents()) {
        const auto draft = parse_scene(document.dump());
        ASSERT_TRUE(draft.ok()) << draft.error().pointer << ": " << draft.error().message;
        const auto scene = validate(*draft);
        ASSERT_TRUE(scene.ok()) << scene.error().pointer << ": " << scene.error().message;
        each_value(document, json::json_pointer(), [&](const json& value, const auto& at) {
            given.insert(names_in(at));
            if (!value.is_object()) return;
            const std::vector<std::string> fields = fields_at(document, at);
            EXPECT_FALSE(fields.empty()) << at;
            for (const std::string& field : fields) allowed.insert(names_in(at) + "/" + field);
        });
    }
    EXPECT_GT(allowed.size(), 150U);
    for (const std::string& field : allowed) EXPECT_TRUE(given.contains(field)) << field;
}

TEST(SceneFields, WhicheverIsChangedTheFingerprintChanges) {
    std::set<std::string> unchangeable, nothing;
    for (const json& document : documents()) {
        const Prints before = prints_of(document);
        ASSERT_FALSE(before.scene.empty());
        each_value(document, json::json_pointer(), [&](const json& value, const auto& at) {
            if (value.is_structured()) return;
            const std::string names = names_in(at);
            Prints after;
            json changed = document;
            for (const json& other : others(value)) {
                changed[at] = other;
                after = prints_of(changed);
                if (!after.scene.empty()) break;
            }
            if (after.scene.empty()) {
                EXPECT_TRUE(kStandsWithOthers.contains(names)) << at << " takes no other value";
                unchangeable.insert(names);
                return;
            }
            if (after.scene == before.scene) {
                EXPECT_TRUE(kSaysNothing.contains(at.to_string()))
                    << at << ": " << value << " or " << changed[at] << " are one fingerprint";
                nothing.insert(at.to_string());
                return;
            }
            if (is_for_pictures_only(names))
                EXPECT_EQ(after.light, before.light) << at << " makes light anew";
            else
                EXPECT_NE(after.light, before.light) << at << " would be lit by other light";
        });
    }
    for (const auto& [names, why] : kStandsWithOthers)
        EXPECT_TRUE(unchangeable.contains(names)) << names << " is no exception: " << why;
    for (const auto& [at, why] : kSaysNothing)
        EXPECT_TRUE(nothing.contains(at)) << at << " is no exception: " << why;
}

// What is left out is not the same as what is given, unless it is the default.
TEST(SceneFields, WhicheverIsLeftOutTheFingerprintIsThatOfItsDefault) {
    for (const json& document : documents())
        each_value(document, json::json_pointer(), [&](const json& value, const auto& at) {
            if (!value.is_object()) return;
            for (const auto& [name, inner] : value.items()) {
                json without = document;
                without[at].erase(name);
                const Prints prints = prints_of(without);
                if (prints.scene.empty()) continue;  // it is needed
                const auto draft = parse_scene(without.dump());
                const Prints again = prints_of(json::parse(scene_to_json(*draft)));
                EXPECT_EQ(prints.scene, again.scene) << at << '/' << name;
            }
        });
}

}  // namespace
}  // namespace awan
