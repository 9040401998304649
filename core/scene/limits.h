// Every limit of a scene, in one place: value, unit, reason. Validation quotes these in its
// messages; server/limits.h has those of the transport (bytes, seconds, connections).
#pragma once

#include <cstdint>

namespace awan::limits {

// --- how much
// -------------------------------------------------------------------------------------
inline constexpr std::uint64_t kMaxParticles =
    1u << 22;  // in all clouds together: 64 B each in the light pass, 256 MiB
inline constexpr std::uint64_t kMaxCubes =
    10'000;  // in all clouds together: a layout is shaped by hand
inline constexpr std::uint64_t kMaxClouds = 1'000;  // a full sky is a few hundred

// --- lengths, in scene units
// ------------------------------------------------------------------------ Positions are kept in
// double and rebased to the cloud before anything becomes float32. 1e9 leaves 1e-7 units of a
// double, a hundredth of the smallest radius apart from the rounding of the input.
inline constexpr double kMaxCoordinate = 1e9;
inline constexpr double kMinLength = 1e-9, kMaxLength = 1e9;  // sides of a cube
inline constexpr double kMinRadius = 1e-6,
                        kMaxRadius = 1e6;  // squares and their inverses stay far inside float32
inline constexpr double kMinScale = 1e-6, kMaxScale = 1e6;  // of a cloud
inline constexpr double kMaxAngle =
    1e6;  // |degrees| of an azimuth or a turn; below, a degree keeps ten digits
inline constexpr double kMinUpSine =
    1e-6;  // sine of the angle between `up` and the view; less leaves no digits for the frame

// --- matter
// -----------------------------------------------------------------------------------------
inline constexpr double kMaxDensity =
    1e6;  // extinction, 1/unit; with kMaxRadius an optical depth of 1e12
inline constexpr double kMaxAnisotropy =
    0.999;  // |g|: at 1 the phase function is a delta and has no values

// --- detail
// -----------------------------------------------------------------------------------------
inline constexpr double kMinDetailSize = 0.05,
                        kMaxDetailSize =
                            4;  // mean particle radii: finer is below every grid, coarser is shape

// --- implicit clouds
// ------------------------------------------------------------------------------------
// Spheres, ellipsoids, cylinders and pieces of skeletons: the document needs "less than a few hundred".
inline constexpr std::uint64_t kMaxImplicitElements = 1'000;
inline constexpr std::uint64_t kMaxImplicitKeys =
    1'000;  // of a primitive: a minute of motion capture
inline constexpr std::uint64_t kMaxImplicitWarps =
    64;  // attractors, vortices: each is asked for every cell
inline constexpr std::uint64_t kMaxFlowVectors =
    4'096;  // 16^3: a vector table is drawn by hand or thinned
// 160^3 cells, all full, are 4,096,000 particles: just within kMaxParticles. Under 16 nothing is left of a shape.
inline constexpr std::uint64_t kMinImplicitResolution = 16, kMaxImplicitResolution = 160;
// Units. With the limits on radii, warps and resolution a Gaussian's radius stays within kMinRadius .. kMaxRadius.
inline constexpr double kMaxImplicitCoordinate = 1e6;
inline constexpr double kMinImplicitRadius = 0.01, kMaxImplicitRadius = 1e5;
inline constexpr double kMinImplicitRadii = 0.02,
                        kMaxImplicitRadii = 50;  // an ellipsoid's semi-axes over its radius
inline constexpr double kMaxImplicitWeight = 100;
inline constexpr double kMaxImplicitAmount = 100;
inline constexpr double kMinImplicitExponent = 0.1,
                        kMaxImplicitExponent = 8;  // beyond, a cloud is all or nothing
inline constexpr double kMaxImplicitDensity =
    1'000;  // of the model: what is above is cut; times kMaxDensity still float32
inline constexpr double kMaxDisplacement =
    4;  // mean radii: beyond, nothing is left of the primitives
inline constexpr double kMinNoiseSize = 0.01, kMaxNoiseSize = 100;  // mean radii
inline constexpr std::uint64_t kMaxOctaves = 10;  // sizes 1 : 512, below the finest lattice
inline constexpr double kMaxStretch = 100;
inline constexpr double kMaxJet = 20;                           // mean radii
inline constexpr double kMaxRipple = 1'000, kMinRipple = 0.01;  // wavelengths, mean radii
inline constexpr double kMaxSwirl = 1'000;                      // frames a second
inline constexpr double kMinAttraction = -0.9,
                        kMaxAttraction = 10;      // at -1 the middle would be pushed to infinity
inline constexpr double kMaxVortexAngle = 3'600;  // degrees: ten turns
inline constexpr std::uint64_t kMaxGrowth =
    500;  // particles: each is a primitive; the document's largest has 150
inline constexpr double kMaxGrowthSpread = 100;  // radii
inline constexpr double kMaxGrowthMotion = 10;   // radii a second, or a second^2
inline constexpr double kMinGrowthSeconds = 0.1, kMaxGrowthSeconds = 1e5;  // lifetimes, durations
// --- ellipsoids (core/scene/ellipsoids.h)
// -----------------------------------------------------------------------------------------
inline constexpr std::uint64_t kMaxTextureTerms =
    8;  // the source: 4 to 7; the highest frequency is then 128 times the first
inline constexpr double kMinTextureFrequency = 1e-6, kMaxTextureFrequency = 1e6;  // radians/unit
inline constexpr double kMaxTextureOffset = 100;  // T0: by then the texture is flat within 2%
// Of T, which is from 0 to 1, and of where it fades: a little beyond either end, so that a cloud may be all or nothing.
inline constexpr double kMinTextureThreshold = -10, kMaxTextureThreshold = 10;
inline constexpr double kMinTextureRange = 1e-3,
                        kMaxTextureRange = 10;  // D divides: less is a step for any eye
inline constexpr double kMaxShininess = 1e3;    // a highlight of 3 degrees
inline constexpr std::uint64_t kMaxEllipsoids =
    1'000;  // in a cloud: a pixel may have to look at all of them
// A particle is 1.3 times a cell wide, and a cell the box over `resolution`: with these it stays within kMinRadius and
// kMaxRadius, whatever the formations.
inline constexpr double kMinEllipsoidRadius = 1e-3, kMaxEllipsoidRadius = 1e3;  // units
inline constexpr double kMaxEllipsoidCoordinate = 1e6;                          // |units|
inline constexpr double kMaxRadiusVariation = 0.9;         // (1 - v) stays a radius
inline constexpr double kMinLink = 0.05, kMaxLink = 0.95;  // overlapping, yet not all in one place
inline constexpr double kMinPlaneExtent = 1e-2, kMaxPlaneExtent = 1e6;  // units
// Cells along the longest side; 160^3 are 4.1 million.
inline constexpr std::uint64_t kMinLatticeResolution = 8, kMaxLatticeResolution = 160;
inline constexpr std::uint64_t kMaxPlaneResolution = 1'000;  // cells along the plane

// --- time
// -------------------------------------------------------------------------------------------
inline constexpr double kMaxTime = 1e6;      // |seconds|: a frame of 1/60 s keeps ten digits
inline constexpr double kMaxVelocity = 1e6;  // units a second, along an axis
inline constexpr std::uint64_t kMaxFrames =
    100'000;  // an hour at 24 frames a second; names of files have as many digits

// --- automaton (core/scene/automaton.h)
// --------------------------------------------------------------------
inline constexpr double kMaxAutomatonSide = 1024;  // cells along an axis
// 1024 x 64 x 1024: four bits a cell of state and 17 of probabilities, 180 MiB.
inline constexpr double kMaxAutomatonCells = 1u << 26;
inline constexpr double kMinAutomatonCell = 1e-3, kMaxAutomatonCell = 1e3;  // units
inline constexpr std::uint64_t kMaxAutomatonEllipsoids = 1'000;             // both kinds together
inline constexpr std::uint64_t kMaxAutomatonBands = 100;  // each moves every ellipsoid at each step
inline constexpr double kMinAutomatonRadius = 0.5;        // cells: below, it may contain none
inline constexpr double kMaxAutomatonRadius = 4096;       // cells: the whole grid in its core
inline constexpr double kMaxAutomatonPlace = 1e5;         // |cells|, of a centre or a height
inline constexpr double kMaxAutomatonSpeed = 1024;        // |cells a step|: the grid's side
inline constexpr std::uint64_t kMaxAutomatonSteps = 100'000;
// Cells times steps, and where ellipsoids move theirs times steps: a minute of one core.
inline constexpr double kMaxAutomatonWork = 0x1p36;
inline constexpr double kMaxStepsPerSecond = 1e6;
inline constexpr double kMaxAutomatonSmooth = 4;          // 9 x 9 x 9 cells
inline constexpr std::uint64_t kMaxAutomatonHistory = 8;  // steps: a bit a cell each
inline constexpr double kMinMetaballRadius = 1.5;         // cells: below, cells show
inline constexpr double kMaxMetaballRadius = 16;          // cells: beyond, a coarser grid does
// --- spheres (core/scene/spheres.h)
// -----------------------------------------------------------------------------------------
inline constexpr std::uint64_t kMaxSphereLevels =
    10;  // 9,765,625 spheres, the most of the source; below, they are finer than any picture
inline constexpr std::uint64_t kMaxSpheresParticles =
    1u << 20;  // of one cloud: two clouds of this kind and others find room in kMaxParticles
inline constexpr double kMinSpheresSide = 1e-5,
                        kMaxSpheresSide = 1e6;  // radii of particles are .36 of a side and less
inline constexpr double kMinVisualRange =
                            4e-6,  // ln 50 / kMaxDensity, rounded up: extinctions stay allowed
    kMaxVisualRange = 1e9;
inline constexpr double kMinSphereRatio = 0.05,
                        kMaxSphereRatio =
                            0.9;  // at 0 there is no child, at 1 all five are their parent
inline constexpr double kMinMorphDuration = 1e-3;         // seconds: less is a cut
inline constexpr std::uint64_t kMaxMorphSteps = 100'000;  // one a frame

// --- light
// ------------------------------------------------------------------------------------------
inline constexpr double kMaxIntensity =
    1e6;  // irradiance or radiance scale; keeps every pixel finite in half floats' maker, float32
inline constexpr double kMaxColor = 1e3;  // one component of a colour of light
// Preetham et al.'s fits were made for 2 to 6 and stay smooth to 10.
inline constexpr double kMinTurbidity = 2, kMaxTurbidity = 10;
inline constexpr double kMaxExposure = 64.0;  // |stops|: 2^64 is still a float32

// --- picture
// ----------------------------------------------------------------------------------------
inline constexpr int kMaxImageSide = 8192;  // pixels
inline constexpr std::uint64_t kMaxPixels =
    1ull << 25;  // 8192 x 4096: 16 B a pixel while drawing, 512 MiB
inline constexpr double kMinFov = 0.01,
                        kMaxFov = 170.0;  // degrees, vertical; the image plane degenerates at 180

// --- text
// -------------------------------------------------------------------------------------------
inline constexpr int kMaxJsonDepth = 32;          // the contract's deepest value is at 6
inline constexpr std::uint64_t kMaxString = 256;  // bytes; names only

}  // namespace awan::limits
