// What the passes are measured against: the same pictures made the plain way, with the raster
// pipeline.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <vector>

#include "core/draw/splats.h"
#include "core/pipeline.h"

namespace awan::bench {

// The light pass as the papers describe it (Harris & Lastra 2001): particles in the sun's order, for each
// one a glReadPixels of the light where its centre is, then a quad blended into the light buffer
// (512 x 512, R32F).
class ReadbackLight {
  public:
    ReadbackLight(const ParticleSet& particles, glm::dvec3 to_sun, double gain);
    ~ReadbackLight();
    ReadbackLight(const ReadbackLight&) = delete;
    ReadbackLight& operator=(const ReadbackLight&) = delete;
    std::vector<float> run();  // light on each particle, in the sun's order

  private:
    struct Quad {
        float u, v, half, tau;  // in -1..1
    };
    std::vector<Quad> quads_;
    float gain_;
    GLuint program_ = 0, texture_ = 0, frame_ = 0, array_ = 0;
};

// The eye pass as instanced quads blended back to front into RGBA32F, with the same arithmetic in
// each fragment.
class QuadSplats {
  public:
    QuadSplats(const SplatList& list, int width, int height, double tan_x, double tan_y,
               glm::dvec3 to_sun, double g);
    ~QuadSplats();
    QuadSplats(const QuadSplats&) = delete;
    QuadSplats& operator=(const QuadSplats&) = delete;
    std::vector<float> run();
    double fragments() const { return fragments_; }  // pixels of all quads inside the picture

  private:
    int width_, height_;
    GLsizei count_;
    double fragments_ = 0;
    GLuint program_ = 0, texture_ = 0, frame_ = 0, array_ = 0, buffer_ = 0, texels_ = 0;
};

}  // namespace awan::bench
