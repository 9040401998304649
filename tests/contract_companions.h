// What the contract says in prose, since JSON Schema has no words for it: which values need others beside them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace awan::contract {

using nlohmann::json;

// A value that is refused alone, or that shows in no fingerprint, with this beside it is taken, and shows. Tried only
// then: one that nothing needs is an error.
struct Companion {
    // Name of the schema of the object, or its end; and the property in it, "": with only what the object cannot do
    // without.
    const char* object;
    const char* property;
    const char* reason;
    void (*put_beside)(json& document, json& object);
};

// A ball beside one coefficient of a quadric, which that makes a little longer or moves.
template <char kWhich>
void round_beside(json&, json& quadric) {
    const double given = quadric.value(std::string("q") + kWhich, kWhich == '0' ? -1.0 : 1.0);
    const double size = kWhich >= '1' && kWhich <= '3' ? given : std::max(std::abs(given), 1.0);
    for (const char* const square : {"q1", "q2", "q3"}) quadric[square] = size;
    if (kWhich == '0')
        quadric["q7"] = 4 * size > 1e15 ? 1e15 : 4 * size;
    else
        quadric["q0"] = -size;
    if (kWhich == '0' && given > 0)
        for (const char* const square : {"q1", "q2", "q3"}) quadric[square] = size / 8;
}

inline bool belongs(const char* row_object, const char* row_property, const std::string& object,
                    const std::string& property) {
    return object.ends_with(row_object) && property == row_property;
}

// Whether a property decides another's default by being given at all: colours of a gradient make a sky one.
inline bool decides_by_being_there(const std::string& object, const std::string& property) {
    return belongs("Sky", "zenith", object, property) ||
           belongs("Sky", "horizon", object, property);
}

inline json ones_for(const json& list) {
    return json(list.size(), 1);
}

inline json one_cube() {
    return json::parse(
        R"([{"particles": 5, "size": [1, 1, 1], "center": [0, 0, 0], "radius": 1}])");
}

// The only primitive of a document whose keys are looked at.
inline json& keyed_primitive(json& document) {
    return document["clouds"][0]["implicit"]["primitives"][0];
}

inline const Companion kCompanions[] = {
    // --- the scene
    {"Scene", "time", "moves clouds that change",
     [](json& document, json&) {
         document.erase("cubes");
         document["clouds"] = json::parse(R"([{"model": "spheres", "spheres": {}}])");
     }},
    {"Scene", "look", "ostroushko belongs to spheres",
     [](json& document, json&) {
         document.erase("cubes");
         document["clouds"] = json::parse(R"([{"model": "spheres", "spheres": {}}])");
     }},
    {"Scene", "look", "gardner belongs to ellipsoids",
     [](json& document, json&) {
         document.erase("cubes");
         document["clouds"] = json::parse(R"([{"model": "ellipsoids", "ellipsoids": {}}])");
     }},
    {"Scene", "look", "upchurch belongs to automata",
     [](json& document, json&) {
         document.erase("cubes");
         document["clouds"] = json::parse(R"([{"model": "automaton", "automaton": {}}])");
     }},
    {"Scene", "texture", "there is something to paint",
     [](json& document, json&) { document["cubes"] = one_cube(); }},
    {"Scene", "billboards", "cubes without a texture have none",
     [](json& document, json&) {
         document["cubes"] = one_cube();
         document["texture"] = "soft";
     }},
    {"Cube", "billboards", "cubes without a texture have none",
     [](json& document, json&) { document["texture"] = "soft"; }},
    {"CubesCloud", "billboards", "cubes without a texture have none",
     [](json& document, json& cloud) {
         document["texture"] = "soft";
         cloud["cubes"] = one_cube();
     }},
    {"CubesCloud", "texture", "there is something to paint",
     [](json&, json& cloud) { cloud["cubes"] = one_cube(); }},
    {"Medium", "droplet", "droplets belong to phase mie",
     [](json&, json& medium) { medium["phase"] = "mie"; }},
    {"Camera", "", "the target differs from the eye",
     [](json&, json& camera) {
         camera["target"] = {2, 1, 1};
     }},
    {"Camera", "eye", "`up` is not along the view",
     [](json&, json& camera) {
         camera["up"] = {0, 0, 1};
     }},
    {"Camera", "target", "`up` is not along the view",
     [](json&, json& camera) {
         camera["up"] = {0, 0, 1};
     }},
    {"Camera", "up", "`up` is not along the view",
     [](json&, json& camera) {
         camera["target"] = {1, 1, 2};
     }},
    {"Sequence", "camera", "times rise, and a target is not its eye",
     [](json&, json& sequence) {
         int time = 0;
         for (json& key : sequence["camera"]) key.update({{"time", ++time}, {"target", {2, 1, 1}}});
     }},
    {"Sequence", "interpolation", "there are keys to go between",
     [](json&, json& sequence) {
         sequence["camera"] = json::parse(R"([{"time": 0, "eye": [0, 0, 9], "target": [0, 0, 0]},
                                              {"time": 1, "eye": [9, 0, 0], "target": [0, 0, 0]}])");
     }},
    {"CameraKey", "", "the target differs from the eye",
     [](json&, json& key) {
         key["target"] = {2, 1, 1};
     }},
    // --- clouds
    {"Cloud", "velocity", "where it stands at the scene's time is what counts",
     [](json& document, json&) { document["time"] = 1; }},
    {"ParticlesCloud", "positions", "lists are as long as `positions`",
     [](json&, json& cloud) { cloud["radii"] = ones_for(cloud["positions"]); }},
    {"ParticlesCloud", "radii", "lists are as long as `positions`",
     [](json&, json& cloud) {
         cloud["positions"] = {{0, 0, 0}};
     }},
    {"ParticlesCloud", "densities", "lists are as long as `positions`",
     [](json&, json& cloud) {
         cloud["positions"] = {{0, 0, 0}};
         cloud["radii"] = {1};
     }},
    {"ParticlesCloud", "colors", "lists are as long as `positions`",
     [](json&, json& cloud) {
         cloud["positions"] = {{0, 0, 0}};
         cloud["radii"] = {1};
     }},
    // --- automaton
    {"AutomatonRandom", "smallest", "smallest <= largest",
     [](json&, json& random) {
         random["largest"] = {4096, 4096, 4096};
     }},
    {"AutomatonRandom", "largest", "smallest <= largest",
     [](json&, json& random) {
         random["smallest"] = {0.5, 0.5, 0.5};
     }},
    {"Automaton", "chosen", "below the number of ellipsoids",
     [](json&, json& automaton) {
         automaton["random"] = {{"count", 1000}};
     }},
    {"Automaton", "fall_off", "a table has values",
     [](json&, json& automaton) {
         if (automaton["fall_off"] == "table") automaton["fall_off_table"] = {1, 0};
     }},
    {"Automaton", "smooth_weight", "a table has values",
     [](json&, json& automaton) {
         if (automaton["smooth_weight"] == "table") automaton["smooth_weight_table"] = {1, 0};
     }},
    {"Automaton", "fall_off_table", "of fall_off table, two values at least",
     [](json&, json& automaton) {
         automaton["fall_off"] = "table";
         while (automaton["fall_off_table"].size() < 2) automaton["fall_off_table"].push_back(0.5);
     }},
    {"Automaton", "smooth_weight_table", "of smooth_weight table, the first of its values above 0",
     [](json&, json& automaton) {
         automaton["smooth_weight"] = "table";
         json& table = automaton["smooth_weight_table"];
         while (table.size() < 2) table.push_back(0.5);
         if (table[0] == 0) table[0] = 0.25;
     }},
    {"AutomatonWindBand", "from", "from <= to", [](json&, json& band) { band["to"] = 1e5; }},
    {"AutomatonWindBand", "to", "from <= to", [](json&, json& band) { band["from"] = -1e5; }},
    {"Automaton", "steps", "warm_up <= steps",
     [](json&, json& automaton) { automaton["warm_up"] = 0; }},
    {"Automaton", "warm_up", "warm_up <= steps",
     [](json&, json& automaton) { automaton["steps"] = 100'000; }},
    // --- spheres
    {"Spheres", "ratio_min", "ratio_min <= ratio_max",
     [](json&, json& spheres) { spheres["ratio_max"] = 1; }},
    {"Spheres", "ratio_max", "ratio_min <= ratio_max",
     [](json&, json& spheres) { spheres["ratio_min"] = 0; }},
    {"Spheres", "shift_max", "shift_min <= shift_max",
     [](json&, json& spheres) { spheres["shift_min"] = 0; }},
    {"Spheres", "poses", "poses are in rising order of time",
     [](json&, json& spheres) {
         int time = 0;
         for (json& pose : spheres["poses"]) pose["time"] = ++time;
     }},
    // --- ellipsoids: the other coefficients so large that it is one
    {"EllipsoidsQuadric", "q1", "is an ellipsoid", round_beside<'1'>},
    {"EllipsoidsQuadric", "q2", "is an ellipsoid", round_beside<'2'>},
    {"EllipsoidsQuadric", "q3", "is an ellipsoid", round_beside<'3'>},
    {"EllipsoidsQuadric", "q4", "is an ellipsoid", round_beside<'4'>},
    {"EllipsoidsQuadric", "q5", "is an ellipsoid", round_beside<'5'>},
    {"EllipsoidsQuadric", "q6", "is an ellipsoid", round_beside<'6'>},
    {"EllipsoidsQuadric", "q7", "is an ellipsoid", round_beside<'7'>},
    {"EllipsoidsQuadric", "q8", "is an ellipsoid", round_beside<'8'>},
    {"EllipsoidsQuadric", "q9", "is an ellipsoid", round_beside<'9'>},
    {"EllipsoidsQuadric", "q0", "is an ellipsoid", round_beside<'0'>},
    // --- implicit
    {"ImplicitPrimitive", "shape", "cylinders and segments have points",
     [](json&, json& primitive) {
         primitive["points"] = {{0, 0, 0}, {0, 1, 0}};
     }},
    {"ImplicitPrimitive", "radii", "belong to an ellipsoid",
     [](json&, json& primitive) { primitive["shape"] = "ellipsoid"; }},
    {"ImplicitPrimitive", "points", "belong to cylinders and segments",
     [](json&, json& primitive) { primitive["shape"] = "segment"; }},
    {"ImplicitPrimitive", "points", "a segment has two points at least",
     [](json&, json& primitive) {
         primitive["shape"] = "segment";
         primitive["points"].push_back({0, 0, 0});
     }},
    {"ImplicitPrimitive", "keys", "keys are in rising order of time",
     [](json&, json& primitive) {
         int time = 0;
         for (json& key : primitive["keys"]) key["time"] = ++time;
     }},
    {"ImplicitKey", "radii", "belong to an ellipsoid",
     [](json& document, json&) { keyed_primitive(document)["shape"] = "ellipsoid"; }},
    {"ImplicitKey", "points", "as many as those of the skeleton",
     [](json& document, json& key) {
         while (key["points"].size() < 2) key["points"].push_back({0, 0, 0});
         json& primitive = keyed_primitive(document);
         primitive["shape"] = "segment";
         primitive["points"] = json(key["points"].size(), {0, 0, 0});
     }},
    {"Implicit", "keys", "keys are in rising order of time",
     [](json&, json& object) {
         int time = 0;
         for (json& key : object["keys"]) key["time"] = ++time;
     }},
    {"ImplicitSquash", "keys", "keys are in rising order of time",
     [](json&, json& object) {
         int time = 0;
         for (json& key : object["keys"]) key["time"] = ++time;
     }},
    {"ImplicitAttractor", "keys", "keys are in rising order of time",
     [](json&, json& object) {
         int time = 0;
         for (json& key : object["keys"]) key["time"] = ++time;
     }},
    {"ImplicitVortex", "keys", "keys are in rising order of time",
     [](json&, json& object) {
         int time = 0;
         for (json& key : object["keys"]) key["time"] = ++time;
     }},
    {"ImplicitGrowth", "keys", "keys are in rising order of time",
     [](json&, json& object) {
         int time = 0;
         for (json& key : object["keys"]) key["time"] = ++time;
     }},
    {"ImplicitGrowth", "seeds", "seeds <= most", [](json&, json& growth) { growth["most"] = 500; }},
    {"ImplicitGrowth", "most", "seeds <= most", [](json&, json& growth) { growth["seeds"] = 1; }},
    {"ImplicitFlow", "", "min < max",
     [](json&, json& flow) {
         flow["max"] = {2, 2, 2};
     }},
    {"ImplicitFlow", "min", "min < max",
     [](json&, json& flow) {
         flow["max"] = {1e6, 1e6, 1e6};
     }},
    {"ImplicitFlow", "max", "min < max",
     [](json&, json& flow) {
         flow["min"] = {-1e6, -1e6, -1e6};
     }},
    {"ImplicitFlow", "size", "as many vectors as `size` says",
     [](json&, json& flow) {
         std::size_t count = 1;
         for (const json& side : flow["size"]) count *= side.get<std::size_t>();
         flow["vectors"] = json(count, {0, 0, 0});
     }},
    {"ImplicitFlow", "vectors", "as many vectors as `size` says",
     [](json&, json& flow) {
         flow["size"] = {flow["vectors"].size(), 1, 1};
     }},
    // --- ellipsoids
    {"EllipsoidsPlane", "extent", "thickness <= extent",
     [](json&, json& plane) { plane["thickness"] = 0; }},
    {"EllipsoidsPlane", "thickness", "thickness <= extent",
     [](json&, json& plane) { plane["extent"] = 1e6; }},
    {"EllipsoidsPlane", "resolution", "so fine a plane has room for one layer",
     [](json&, json& plane) { plane["thickness"] = 0; }},
    {"Ellipsoids", "formations", "1000 ellipsoids in all",
     [](json&, json& ellipsoids) {
         for (json& formation : ellipsoids["formations"]) formation["count"] = 1;
     }},
};

// Ends that nothing can stand beside.
struct OutOfReach {
    const char* object;
    const char* property;
    double end;
    const char* reason;
};
inline constexpr OutOfReach kOutOfReach[] = {
    {"ImplicitFlow", "min", 1e6, "`max` is greater, and cannot be"},
    {"ImplicitFlow", "max", -1e6, "`min` is less, and cannot be"},
};

// Properties that tell no two pictures apart, and so show in no fingerprint.
struct Silent {
    const char* object;
    const char* property;
    const char* reason;
};
inline constexpr Silent kSilent[] = {
    {"Sequence", "frames", "a picture is of one time, whatever their number"},
};

}  // namespace awan::contract
