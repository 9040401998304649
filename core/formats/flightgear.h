// A cloud as FlightGear's sky has them: property lists of clouds that are heaps of sprites (FlightGear's
// Docs/README.3DClouds; read by src/Environment/fgclouds.cxx and simgear/scene/sky/newcloud.cxx, 2020.3).
#pragma once

#include <string>

#include "core/generate/particle_set.h"
#include "core/scene/scene.h"

namespace awan {

// The particles of `scene` as an XML property list, in the manner of FlightGear's Environment/cloudlayers.xml:
//   clouds   the kinds of heaps that occur, `awan-1` ...: widths, heights, sprites, shading
//   boxes    `awan`: how many of each kind, in how wide and how high a space
//   layers   `st`, `sc`, `cu`, `ac`, `ns`, `cb`, each made of `awan`: what the weather calls a layer does not matter
//   placed   every heap where it stands, a `cloud` each, whose properties are those of the command add-cloud but for
//            lon-deg and lat-deg; offsets x to the east and y to the north, alt-ft from the scene's lowest heap
// +x of the scene is east, +z south. A heap is a cube of the scene, cut along its longer side into nearly square ones;
// of other models the particles of a cell, at most a quarter of the cloud a side. Its lower and farther sides have
// 1 / (1 + 3/4 (1 - g) tau) of the light (two streams, tau its optical depth upwards, g of the medium), no less than
// .2; its alpha is 1 - exp(-tau), no less than .01.
// metres: of a unit of length, > 0. Error: there are no particles.
Result<std::string> write_flightgear(const Scene& scene, const ParticleSet& particles,
                                     double metres);

}  // namespace awan
