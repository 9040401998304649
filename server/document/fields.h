// What a scene document may hold, as tables: one an object, one row a field. parse.cpp walks
// the text; these say what each value may be and where it goes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace awan {

// Which table holds for an object of the document.
enum class ObjectKind : std::uint8_t {
    kNone,
    kScene,
    kCube,
    kCloud,
    kMedium,
    kSun,
    kSky,
    kGround,
    kHaze,
    kDetail,
    kCamera,
    kImage,
    kEffects,
    kAccuracy,
    kSequence,
    kAutomaton,
    kSpheres,
    kSpheresMorph,
    kImplicit,
    kEllipsoids,
    kAutomatonEllipsoid,
    kAutomatonRandom,
    kAutomatonWind,
    kAutomatonLayers,
    kAutomatonWindBand,
    kImplicitPrimitive,
    kImplicitKey,
    kImplicitGrowth,
    kImplicitAttractor,
    kImplicitVortex,
    kImplicitFlow,
    kEllipsoidsTexture,
    kEllipsoidsShading,
    kSkyPlane,
    kPlaneTexture,
    kFormation,
    kEllipsoid,
};

// Lists whose length is not fixed.
enum class ListKind : std::uint8_t {
    kNone,
    kCubes,
    kClouds,
    kPositions,
    kRadii,
    kDensities,
    kColors,
    kAutomatonEllipsoids,
    kAutomatonWindBands,
    kImplicitPrimitives,
    kImplicitPoints,
    kImplicitKeys,
    kImplicitAttractors,
    kImplicitVortices,
    kImplicitVectors,
    kFormations,
    kEllipsoids,
};

enum class WordOutcome { kTaken, kUnknown };

// The draft being filled in, and the elements of its lists that are being read.
struct DraftInProgress {
    SceneDraft draft;
    Cloud* cloud = nullptr;
    Cube* cube = nullptr;
    Effect effect = Effect::kSelfShadow;
    // Of the cloud that is being read, made new when its object begins and given to it when it ends.
    std::shared_ptr<AutomatonCloud> automaton;
    std::shared_ptr<SpheresCloud> spheres;
    std::shared_ptr<ImplicitCloud> implicit;
    std::shared_ptr<EllipsoidsCloud> ellipsoids;

    // An element for the object of that kind that begins here; an object that is not an element
    // leaves a mark that it was given.
    void begin(ObjectKind kind);
};

// A type is allowed where its member is set.
struct Field {
    std::string_view name;
    const char* wanted;  // completes "must be ..."
    bool required = false;
    void (*number)(DraftInProgress&, double) = nullptr;
    void (*integer)(DraftInProgress&, std::uint64_t) = nullptr;
    std::uint64_t largest_integer = UINT64_MAX;
    void (*flag)(DraftInProgress&, bool) = nullptr;
    WordOutcome (*word)(DraftInProgress&, std::string_view) = nullptr;
    glm::dvec3* (*vector)(DraftInProgress&) = nullptr;  // three numbers
    ObjectKind object = ObjectKind::kNone;
    ListKind list = ListKind::kNone;
};

// What the elements of a list may be: one of the three.
struct List {
    const char* wanted;  // completes "must be ..."
    std::uint64_t most;  // elements
    ObjectKind object = ObjectKind::kNone;
    void (*number)(DraftInProgress&, double) = nullptr;
    void (*row)(DraftInProgress&, const glm::dvec3&) = nullptr;  // [x, y, z]
};
const List& list_at(ListKind kind);

// At most 32 fields an object: those seen are bits of a word.
std::span<const Field> fields_of(ObjectKind kind);

// Index in fields_of(kind), or of an effect; -1 for a name that is not there.
int find_field(ObjectKind kind, std::string_view name);

// The row of a field; every effect shares one.
const Field& field_at(ObjectKind kind, int index);
std::string_view field_name(ObjectKind kind, int index);

// `"a", "b", ...`: what find_field would find.
std::string allowed_names(ObjectKind kind);

// Defaults that depend on other fields of the object, once it has ended.
void complete(ObjectKind kind, std::uint32_t seen, DraftInProgress& state);

// Rules between the fields of one object, once it has ended. `seen` has bit i for field i. An error
// has a pointer relative to the object.
Status check_together(ObjectKind kind, std::uint32_t seen, const DraftInProgress& state);

}  // namespace awan
