// Every limit of a scene, in one place: value, unit, reason. Validation quotes these in its
// messages; server/limits.h has those of the transport (bytes, seconds, connections).
#pragma once

#include <cstdint>

namespace awan::limits {

// --- How much

// Particles in all clouds together. Each takes 64 bytes in the light pass: 256 MiB.
inline constexpr std::uint64_t kMaxParticles = 1u << 22;
// Cubes in all clouds together. A layout is shaped by hand.
inline constexpr std::uint64_t kMaxCubes = 10'000;
// Clouds. A full sky is a few hundred.
inline constexpr std::uint64_t kMaxClouds = 1'000;

// Different textures in one scene. Each takes 2.7 MiB of the renderer's memory, and OpenGL 4.5 promises room for 2,048
// layers, of which each has 64.
inline constexpr std::size_t kMaxTextures = 16;
// Pixels of a picture that a texture is made of, and along its side: 4096 x 4096 are 64 MiB while it is read, and are
// brought down to 128 x 128.
inline constexpr std::uint64_t kMaxTexturePixels = 1u << 24;
inline constexpr std::uint64_t kMaxTexturePictureSide = 16'384;
// Bytes of its file: as many uncompressed pixels of 4 bytes.
inline constexpr std::uint64_t kMaxTextureBytes = 64u << 20;
// Bytes of a texture's name.
inline constexpr std::size_t kMaxTextureName = 64;

// --- Lengths, in scene units

// |coordinate|. Positions are kept in double and taken relative to the cloud before anything becomes float32. At 1e9 a
// double resolves 1e-7 units, a tenth of the smallest radius.
inline constexpr double kMaxCoordinate = 1e9;
// Sides of a cube: as small as is not yet nothing, as large as the space.
inline constexpr double kMinLength = 1e-9, kMaxLength = 1e9;
// Radii of particles. Their squares and the inverses of these stay far inside float32.
inline constexpr double kMinRadius = 1e-6, kMaxRadius = 1e6;
// The scale of a cloud, a factor. A unit radius then stays within the limits on radii.
inline constexpr double kMinScale = 1e-6, kMaxScale = 1e6;
// |degrees| of an azimuth or a turn. Within it, a degree keeps ten digits.
inline constexpr double kMaxAngle = 1e6;
// The sine of the angle between the camera's `up` and its view. With less there are no digits left to build the frame
// from.
inline constexpr double kMinUpSine = 1e-6;

// Share of a terrain's heights that is below the level ground. With more there is next to nothing left above it.
inline constexpr double kMaxTerrainLevel = 0.95;

// --- Matter

// Extinction, 1/unit. Together with kMaxRadius: an optical depth of 1e12.
inline constexpr double kMaxDensity = 1e6;
// |g|, the mean cosine of the phase function. At 1 the function is a delta and has no values.
inline constexpr double kMaxAnisotropy = 0.999;
// Effective diameter of droplets, micrometres. Smaller ones are haze, larger ones fall as drizzle, and the sum of their
// scattering takes over a tenth of a second.
inline constexpr double kMinDroplet = 2;
inline constexpr double kMaxDroplet = 50;

// --- Detail

// The size of its largest bumps, in mean particle radii. Finer is below every grid; coarser is shape, not detail.
inline constexpr double kMinDetailSize = 0.05, kMaxDetailSize = 4;

// --- Implicit clouds (core/scene/implicit.h)

// Spheres, ellipsoids, cylinders and pieces of skeletons together. Ebert 2002 needs "less than a few hundred".
inline constexpr std::uint64_t kMaxImplicitElements = 1'000;
// Key frames of one primitive: a minute of motion capture.
inline constexpr std::uint64_t kMaxImplicitKeys = 1'000;
// Attractors and vortices. Each is asked for every cell.
inline constexpr std::uint64_t kMaxImplicitWarps = 64;
// Vectors in a table of flow, 16^3. Such a table is drawn by hand, or thinned from a simulation.
inline constexpr std::uint64_t kMaxFlowVectors = 4'096;
// Cells along the longest side of the lattice: under 16 nothing is left of a shape, over 400 they are finer than
// pixels. And cells in all, which a lattice over flat clouds only keeps to: 160^3 cells, all full, are just within
// kMaxParticles.
inline constexpr std::uint64_t kMinImplicitResolution = 16, kMaxImplicitResolution = 400;
inline constexpr std::uint64_t kMaxImplicitCells = 4'096'000;
// |coordinate| and radii of primitives, scene units. With these and the limits on warps and resolution, a particle's
// radius stays within kMinRadius and kMaxRadius.
inline constexpr double kMaxImplicitCoordinate = 1e6;
inline constexpr double kMinImplicitRadius = 0.01, kMaxImplicitRadius = 1e5;
// An ellipsoid's semi-axes, each over its radius: a flat disc at one end, a long spindle at the other.
inline constexpr double kMinImplicitRadii = 0.02, kMaxImplicitRadii = 50;
// The weight of a primitive and the amount of the density (p1 of Ebert 2002), factors. What they make beyond
// kMaxImplicitDensity is cut.
inline constexpr double kMaxImplicitWeight = 100;
inline constexpr double kMaxImplicitAmount = 100;
// The exponent of the density (p2 of Ebert 2002). Beyond either end a cloud is all or nothing.
inline constexpr double kMinImplicitExponent = 0.1, kMaxImplicitExponent = 8;
// The density of the model, a factor on the cloud's; what is above is cut. Times kMaxDensity it is still a float32.
inline constexpr double kMaxImplicitDensity = 1'000;
// How far turbulence moves a point, in mean radii. Beyond, nothing is left of the primitives.
inline constexpr double kMaxDisplacement = 4;
// The size of the noise's largest octave, in mean radii: from finer than any lattice to wider than any cloud.
inline constexpr double kMinNoiseSize = 0.01, kMaxNoiseSize = 100;
// Octaves of noise. Ten have sizes from 1 to 1/512; the smallest are finer than the finest lattice.
inline constexpr std::uint64_t kMaxOctaves = 10;
// How much longer the noise is along the jet stream than across it, a factor. Beyond, it hardly changes along it.
inline constexpr double kMaxStretch = 100;
// How far the jet stream pushes a point, in mean radii. Beyond, nothing is left of the primitives.
inline constexpr double kMaxJet = 20;
// The wavelength of a ripple, in mean radii: finer than any lattice, or wider than any cloud.
inline constexpr double kMaxRipple = 1'000, kMinRipple = 0.01;
// Frames a second of the noise's path. At 1,000 it turns more than once a second.
inline constexpr double kMaxSwirl = 1'000;
// The strength of an attractor, a factor. At -1 its middle would be pushed to infinity.
inline constexpr double kMinAttraction = -0.9, kMaxAttraction = 10;
// |degrees| that a vortex turns: ten turns.
inline constexpr double kMaxVortexAngle = 3'600;
// Particles of a growing cloud. Each is a primitive; the largest that Ebert 2002 grows has 150.
inline constexpr std::uint64_t kMaxGrowth = 500;
// How far from their seeds' middle children begin, in radii.
inline constexpr double kMaxGrowthSpread = 100;
// How fast they move, in radii a second, and how fast that changes, in radii a second^2.
inline constexpr double kMaxGrowthMotion = 10;
// Lifetimes and durations of growth, seconds: from a few frames to a day.
inline constexpr double kMinGrowthSeconds = 0.1, kMaxGrowthSeconds = 1e5;

// Bubbles and the smaller ones on each, billows in a row, rings of Benard cells (127 cells) and parcels in each
// (core/scene/implicit_procedures.h). Each part is a primitive: some thousands at most.
inline constexpr std::uint64_t kMaxBubbles = 200, kMaxKnobs = 8;
inline constexpr std::uint64_t kMaxBillows = 12;
inline constexpr std::uint64_t kMaxCellRings = 6, kMaxCellParcels = 24;
// How high bubbles rise, in radii, and how many leave a second; both divide.
inline constexpr double kMinBubbleCeiling = 0.1, kMaxBubbleCeiling = 20, kMinBubbleRate = 1e-3;
// The wave that billows grow from, and what smooths their sheet, in wavelengths. At .2 a sheet crosses itself; below
// .02 the 96 points of it do not hold together.
inline constexpr double kMaxBillowAmplitude = 0.2, kMinBillowSmoothing = 0.02;
// Rows of a table of particles that were moved elsewhere: a few hundred particles through 200 frames.
inline constexpr std::uint64_t kMaxImplicitRows = 100'000;
// How many times as long a squash makes a cloud.
inline constexpr double kMinSquash = 0.1, kMaxSquash = 10;
// A formula (core/scene/formula.h): bytes; steps that it comes to; how deep it goes (a parenthesis is two); values that
// it holds at once; names that it gives; octaves of all its noise together; how often it asks for the primitives. A
// place takes some dozen times what it takes without, at the most.
inline constexpr std::uint64_t kMaxFormulaBytes = 4'096;
inline constexpr int kMaxFormulaSteps = 512, kMaxFormulaDepth = 64, kMaxFormulaValues = 32;
inline constexpr int kMaxFormulaNames = 24, kMaxFormulaOctaves = 48, kMaxFormulaPrimitives = 8;

// --- Ellipsoids (core/scene/ellipsoids.h)

// Terms of either sum of sines. Gardner 1985 has 4 to 7; at 8 the highest frequency is 128 times the first.
inline constexpr std::uint64_t kMaxTextureTerms = 8;
// The lowest frequency of the texture, radians/unit: from a wave as long as the space to one below the finest cell.
inline constexpr double kMinTextureFrequency = 1e-6, kMaxTextureFrequency = 1e6;
// The amplitude of a sine that is given by hand, a factor: only what amplitudes are to each other counts.
inline constexpr double kMinSineAmplitude = 1e-6, kMaxSineAmplitude = 100;
// T0 of the texture, dimensionless. By then the texture is flat within 2%.
inline constexpr double kMaxTextureOffset = 100;
// Thresholds of translucence, of T, which is from 0 to 1. A good way beyond either end, so that a cloud may be all or
// nothing.
inline constexpr double kMinTextureThreshold = -10, kMaxTextureThreshold = 10;
// D, the range of T over which the cloud fades. It divides; below this it is a step for any eye.
inline constexpr double kMinTextureRange = 1e-3, kMaxTextureRange = 10;
// The exponent of the highlight. At 1,000 it is 3 degrees wide.
inline constexpr double kMaxShininess = 1e3;
// Ellipsoids in one cloud. A pixel may have to look at all of them.
inline constexpr std::uint64_t kMaxEllipsoids = 1'000;
// Radii and |coordinates|, scene units. A particle is 1.3 times a cell wide, and a cell the box over `resolution`: with
// these it stays within kMinRadius and kMaxRadius, whatever the formations.
inline constexpr double kMinEllipsoidRadius = 1e-3, kMaxEllipsoidRadius = 1e3;
inline constexpr double kMaxEllipsoidCoordinate = 1e6;
// How much radii vary by chance, v: a factor from 1 - v to 1 + v, which must stay a radius.
inline constexpr double kMaxRadiusVariation = 0.9;
// How far a link of a formation goes from touching (0) to the same centre (1): overlapping, yet not all in one place.
inline constexpr double kMinLink = 0.05, kMaxLink = 0.95;
// Coefficients of a quadric, a1 x^2 + ... = 0: only what they are to each other counts.
inline constexpr double kMaxQuadric = 1e15, kMinQuadricSquare = 1e-12;
// Patterns over one sky plane. Each costs a pixel, or a cell, a texture of its own.
inline constexpr std::uint64_t kMaxPlanePatterns = 16;
// Sides of the sky plane, scene units. With kMaxPlaneResolution a particle stays within kMinRadius and kMaxRadius.
inline constexpr double kMinPlaneExtent = 1e-2, kMaxPlaneExtent = 1e6;
// Cells along the longest side of the lattice. 160^3 are 4.1 million, just within kMaxParticles; under 8 no shape is
// left.
inline constexpr std::uint64_t kMinLatticeResolution = 8, kMaxLatticeResolution = 160;
// Cells along the sky plane. It is one to a few cells thick, so a million.
inline constexpr std::uint64_t kMaxPlaneResolution = 1'000;

// --- Time

// |seconds|. A frame of 1/60 s keeps ten digits.
inline constexpr double kMaxTime = 1e6;
// Scene units a second, along an axis. In kMaxTime a cloud stays within a thousand times kMaxCoordinate.
inline constexpr double kMaxVelocity = 1e6;
// Frames of a sequence: an hour at 24 a second. Names of numbered files have as many digits.
inline constexpr std::uint64_t kMaxFrames = 100'000;
// Keys of a moving camera: one a frame for seven minutes, as a flight has them that was recorded.
inline constexpr std::uint64_t kMaxCameraKeys = 10'000;

// --- Automaton (core/scene/automaton.h)

// Cells along an axis, and in all: 1024 x 64 x 1024. A cell has four bits of state and 17 of probabilities: 180 MiB.
inline constexpr double kMaxAutomatonSide = 1024;
inline constexpr double kMaxAutomatonCells = 1u << 26;
// The side of a cell, scene units. The grid then stays within the limits on lengths, its particles within those on
// radii.
inline constexpr double kMinAutomatonCell = 1e-3, kMaxAutomatonCell = 1e3;
// Ellipsoids, those given and those made by chance together.
inline constexpr std::uint64_t kMaxAutomatonEllipsoids = 1'000;
// Bands of wind. Each moves every ellipsoid, or every layer, at each step.
inline constexpr std::uint64_t kMaxAutomatonBands = 100;
// |degrees a cell of height|: once around.
inline constexpr double kMaxAutomatonTurn = 360;
// Values of a table of how something falls off: finer than any ellipsoid has cells along its radius.
inline constexpr std::uint64_t kMaxAutomatonTable = 64;
// Radii of ellipsoids, cells. A smaller one may contain no cell's middle; within the largest, the whole grid lies in
// its core.
inline constexpr double kMinAutomatonRadius = 0.5;
inline constexpr double kMaxAutomatonRadius = 4096;
// |cells| of an ellipsoid's centre, or of a height: a hundred grids away.
inline constexpr double kMaxAutomatonPlace = 1e5;
// |cells a step|: the longest side of a grid.
inline constexpr double kMaxAutomatonSpeed = 1024;
// Steps: an hour at 24 a second.
inline constexpr std::uint64_t kMaxAutomatonSteps = 100'000;
// Cells times steps, and where ellipsoids move also theirs times steps: about a minute of one core.
inline constexpr double kMaxAutomatonWork = 0x1p36;
// Steps a second of scene time. With kMaxTime, their number still has all its digits.
inline constexpr double kMaxStepsPerSecond = 1e6;
// Half the side of the smoothing box, cells: 9 x 9 x 9 cells.
inline constexpr double kMaxAutomatonSmooth = 4;
// Steps over which the density is averaged. Each past one keeps a bit a cell.
inline constexpr std::uint64_t kMaxAutomatonHistory = 8;
// The metaballs' radius, cells. Below, single cells show; beyond, a coarser grid would do.
inline constexpr double kMinMetaballRadius = 1.5;
inline constexpr double kMaxMetaballRadius = 16;

// Sides of a look's billboards and points, cells: from far below a pixel to as large as many a cloud.
inline constexpr double kMinBillboardScale = 0.01, kMaxBillboardScale = 100;
// Times a density of 0..1. Beyond, the faintest cell is white.
inline constexpr double kMaxColorMultiplier = 1000;

// --- Spheres (core/scene/spheres.h)

// Levels of the hierarchy: 5^10 = 9,765,625 spheres, the most that Ostroushko et al. 2010 draw. Below, they are finer
// than any picture.
inline constexpr std::uint64_t kMaxSphereLevels = 10;
// Particles of one cloud. Two clouds of this kind and others find room in kMaxParticles.
inline constexpr std::uint64_t kMaxSpheresParticles = 1u << 20;
// Sides of the cloud, scene units. Radii of its particles are .36 of a side and less.
inline constexpr double kMinSpheresSide = 1e-5, kMaxSpheresSide = 1e6;
// The meteorological visual range in the cloud, scene units. The least is ln 50 / kMaxDensity, rounded up, so that
// every extinction stays allowed.
inline constexpr double kMinVisualRange = 4e-6, kMaxVisualRange = 1e9;
// Parts that a sphere is divided into, and spheres of the last level in all.
inline constexpr std::uint64_t kMinSphereParts = 2, kMaxSphereParts = 12;
inline constexpr std::uint64_t kMaxSphereLeaves = 9'765'625;
// The ratio of a child's radius to its parent's: at 0 there is no child, at 1 it is its parent. The upper end of a
// range is not so low that nothing is left.
inline constexpr double kMaxSphereRatio = 1, kLeastUpperRatio = 0.01;
// |degrees a second| that the parts of a sphere turn: ten times round.
inline constexpr double kMaxSphereTurning = 3'600;
// Poses of one cloud: a minute of motion capture.
inline constexpr std::uint64_t kMaxSpheresPoses = 1'000;
// Times the sides of the cloud: from a thousandth to a thousand times.
inline constexpr double kMinPoseScale = 1e-3, kMaxPoseScale = 1e3;
// The relief of a sphere: its height in radii, the waves that it is the sum of, and how often one goes round.
inline constexpr double kMaxBumpHeight = 1;
inline constexpr std::uint64_t kMaxBumpWaves = 16;
inline constexpr std::uint64_t kMaxBumpFrequency = 64;
// Seconds of one morph. Less is a cut.
inline constexpr double kMinMorphDuration = 1e-3;
// Morphs of one cloud, one after the other: one a frame of the longest sequence.
inline constexpr std::uint64_t kMaxMorphSteps = 100'000;

// --- Light

// The scale of an irradiance or a radiance. Every pixel stays finite in float32.
inline constexpr double kMaxIntensity = 1e6;
// One component of a colour of light.
inline constexpr double kMaxColor = 1e3;
// Turbidity, dimensionless. The fits of Preetham et al. 1999 were made for 2 to 6 and stay smooth to 10.
inline constexpr double kMinTurbidity = 2, kMaxTurbidity = 10;
// |stops|. 2^64 is still a float32.
inline constexpr double kMaxExposure = 64.0;

// --- Picture

// Pixels along a side, and in all: 8192 x 4096. Each takes 16 bytes while it is drawn: 512 MiB.
inline constexpr int kMaxImageSide = 8192;
inline constexpr std::uint64_t kMaxPixels = 1ull << 25;
// The vertical field of view, degrees. At 180 the image plane is infinite; the least is a telescope's.
inline constexpr double kMinFov = 0.01, kMaxFov = 170.0;

// --- Text

// Levels of nested JSON. The deepest value of the contract is at 6.
inline constexpr int kMaxJsonDepth = 32;
// Bytes of a document that begins with a preset, of which a tree is made: enough for thousands of cubes of its own.
inline constexpr std::size_t kMaxPresetDocument = 1 << 20;
// Bytes of a string. There are names only.
inline constexpr std::uint64_t kMaxString = 256;

}  // namespace awan::limits
