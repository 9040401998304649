// What was asked for, as plain values. A SceneDraft is as read (types right, ranges unchecked); a Scene is a draft that
// validate() (validate.h) has found possible. Nothing else can make a Scene.
//
// Axes: right-handed, y up; the unit of length is the scene's own. Angles in degrees here, as in the document; they
// become radians where they are used. Colours are linear, Rec. 709 primaries.
//
// Each object of the document has a header of its own, with the struct and below it the table of its fields (table.h).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/scene/accuracy.h"
#include "core/scene/camera.h"
#include "core/scene/cloud.h"
#include "core/scene/detail.h"
#include "core/scene/display.h"
#include "core/scene/effects.h"
#include "core/scene/ground.h"
#include "core/scene/haze.h"
#include "core/scene/image_settings.h"
#include "core/scene/medium.h"
#include "core/scene/sequence.h"
#include "core/scene/sky.h"
#include "core/scene/sun.h"
#include "core/scene/texture.h"

namespace awan {

// How a picture is made: by light as it is, or by the rules of a published system, which are a look and have no error
// against the truth (core/looks).
enum class Look { kPhysical, kOstroushko, kGardner, kUpchurch };
inline constexpr const char* kLookWords[] = {"physical", "ostroushko", "gardner", "upchurch"};

// Of clouds of spheres, implicit functions and ellipsoids that are given none, 1/unit. Others get what makes them deep
// enough (core/generate/auto_density.h).
inline constexpr double kDefaultDensity = 0.2;

struct SceneDraft {
    // True when the document has `cubes` at its top instead of `clouds`: then there is exactly one cloud and pointers
    // to its cubes read /cubes/i, else /clouds/k/cubes/i.
    bool top_level_cubes = true;
    std::vector<Cloud> clouds;
    Fill fill = Fill::kCumulus;
    std::uint64_t seed = 1;
    // What all clouds are painted with, and billboards per box. None: their particles are not painted; as many as a
    // cube has particles.
    std::optional<std::string> texture;
    std::optional<std::uint64_t> billboards;
    // None: automatic.
    std::optional<double> density;
    Medium medium;
    Sun sun;
    Sky sky;
    std::optional<Ground> ground;
    std::optional<Haze> haze;
    // None: the particles as they are.
    std::optional<Detail> detail = kAutomaticDetail;
    Camera camera;
    ImageSettings image;
    Effects effects{};
    Accuracy accuracy;
    Look look = Look::kPhysical;
    Display display = Display::kLit;
    double time = 0;
    std::optional<Sequence> sequence;
    // Textures that came beside the document.
    GivenTextures textures;
    // Of a scene with terrain, once it is validated.
    std::shared_ptr<ReliefSlot> relief;
};

// In scene.cpp.
template <>
const Table& table_of<SceneDraft>();

// A scene that can be made: every value in range, every request within what this version does.
class Scene {
  public:
    const SceneDraft* operator->() const { return &draft_; }
    const SceneDraft& operator*() const { return draft_; }

  private:
    explicit Scene(SceneDraft draft) : draft_(std::move(draft)) {}
    friend Result<Scene> validate(SceneDraft draft);
    SceneDraft draft_;
};

// Unit vector towards the sun. Elevation 90 is exactly (0, 1, 0).
glm::dvec3 sun_direction(const Sun& sun);

// Seconds of which the clouds are: the scene's time, or where they stand while the camera moves, the sequence's first.
double clouds_time(const SceneDraft& scene);

// What holds for a cloud: its own, else the scene's, else the default. No density: automatic.
std::optional<double> density_of(const SceneDraft& scene, const Cloud& cloud);
Fill fill_of(const SceneDraft& scene, const Cloud& cloud);
std::uint64_t seed_of(const SceneDraft& scene, const Cloud& cloud);

// Particles asked for in all clouds, of models that make their own as many as they may. Saturates.
std::uint64_t particle_count(const SceneDraft& scene);

}  // namespace awan
