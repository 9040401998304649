#include "core/draw/display.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/draw/billboards.h"
#include "core/draw/display_shapes.h"
#include "core/generate/own_textures.h"
#include "core/gl/programs.h"

namespace awan {
namespace {

// Pixels that are drawn at a time, and samples in each: 64 MiB of the renderer's memory.
constexpr int kBandPixels = 1 << 20, kSamples = 4;
// Billboards and vertices between two looks at the deadline.
constexpr std::size_t kBillboards = 1 << 15, kVertices = 6 * kBillboards;
constexpr glm::vec4 kBackground{0.155f, 0.165f, 0.18f, 1};

// Where a band is drawn: with several samples a pixel, then one. Move-only by its parts.
class Canvas {
  public:
    Canvas(int width, int height) : width_(width), height_(height) {
        glCreateFramebuffers(2, frames_);
        glCreateRenderbuffers(3, buffers_);
        glNamedRenderbufferStorageMultisample(buffers_[0], kSamples, GL_RGBA16F, width, height);
        glNamedRenderbufferStorageMultisample(buffers_[1], kSamples, GL_DEPTH_COMPONENT32F, width,
                                              height);
        glNamedRenderbufferStorage(buffers_[2], GL_RGBA16F, width, height);
        glNamedFramebufferRenderbuffer(frames_[0], GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                       buffers_[0]);
        glNamedFramebufferRenderbuffer(frames_[0], GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                       buffers_[1]);
        glNamedFramebufferRenderbuffer(frames_[1], GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                       buffers_[2]);
        glCreateVertexArrays(1, &vertices_);
    }
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;
    ~Canvas() {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glBindVertexArray(0);
        glDeleteVertexArrays(1, &vertices_);
        glDeleteFramebuffers(2, frames_);
        glDeleteRenderbuffers(3, buffers_);
    }

    void begin(const glm::vec4& background) const {
        glBindFramebuffer(GL_FRAMEBUFFER, frames_[0]);
        glBindVertexArray(vertices_);
        glViewport(0, 0, width_, height_);
        const float far = 1;
        glClearNamedFramebufferfv(frames_[0], GL_COLOR, 0, &background.x);
        glClearNamedFramebufferfv(frames_[0], GL_DEPTH, 0, &far);
    }
    // The first `rows` rows, the lowest in GL first, which is the highest of the picture.
    void read(int rows, float* to) const {
        glBlitNamedFramebuffer(frames_[0], frames_[1], 0, 0, width_, height_, 0, 0, width_, height_,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, frames_[1]);
        glPixelStorei(GL_PACK_ALIGNMENT, 4);
        glReadPixels(0, 0, width_, rows, GL_RGBA, GL_FLOAT, to);
    }

  private:
    int width_, height_;
    GLuint frames_[2]{}, buffers_[3]{}, vertices_ = 0;
};

// The textures of the scene and after them "soft", a layer each.
gl::TextureArray plain_textures(const Scene& scene) {
    std::vector<std::string_view> used = textures_of(*scene);
    used.push_back(kOwnTextures[0].hash);
    gl::TextureArray array(kTextureSide, static_cast<int>(used.size()));
    int layer = 0;
    for (const std::string_view hash : used) {
        const auto texture = texture_of_hash(*scene, hash);
        std::vector<float> texels;
        for (const std::uint8_t one : texture->depth)
            texels.push_back(static_cast<float>(one) / 255.0f);
        for (int mip = 0; !texels.empty(); ++mip) {
            array.put(layer, mip, texels);
            texels = texels.size() > 1 ? halved(texels) : std::vector<float>();
        }
        ++layer;
    }
    return array;
}

void draw_vertices(std::span<const DisplayVertex> vertices) {
    if (vertices.empty()) return;
    const gl::TexelBuffer buffer{vertices};
    buffer.bind(0);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
    glFinish();
}

Status draw_all(const std::vector<DisplayVertex>& vertices, const Deadline& deadline) {
    const std::span<const DisplayVertex> all(vertices);
    for (std::size_t first = 0; first < all.size(); first += kVertices) {
        if (auto error = deadline.over()) return error;
        draw_vertices(all.subspan(first, std::min(kVertices, all.size() - first)));
    }
    return std::nullopt;
}

struct Displayed {
    const Scene& scene;
    const ParticleSet& particles;
    const View& view;
    const std::vector<DisplayBox>& boxes;
    const DisplayShapes& shapes;
    const std::vector<std::uint32_t>& order;  // of billboards
};

Status draw_band(const Displayed& shown, const Deadline& deadline) {
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_TRUE);
    Status failed = draw_all(shown.shapes.solid, deadline);
    glDepthMask(GL_FALSE);
    if (!failed) failed = draw_all(shown.shapes.sheer, deadline);
    const auto plain = static_cast<int>(textures_of(*shown.scene).size());
    for (std::size_t last = shown.order.size(); last > 0 && !failed;) {
        if ((failed = deadline.over())) break;
        const std::size_t first = last > kBillboards ? last - kBillboards : 0;
        draw_vertices(display_billboards(shown.scene, shown.particles, shown.boxes, shown.view,
                                         shown.order, first, last, plain));
        last = first;
    }
    // The compute passes expect none of it.
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    return failed;
}

}  // namespace

Result<Image> draw_display(const Scene& scene, const ParticleSet& particles, const View& view,
                           Device& device, const Deadline& deadline) {
    Image image{
        scene->image.width, scene->image.height, scene->image.background == Background::kSky, {}};
    image.pixels.resize(4 * image.pixel_count());
    const std::vector<DisplayBox> boxes = display_boxes(scene, particles);
    const auto ellipsoids = display_ellipsoids(scene, deadline);
    if (!ellipsoids.ok()) return ellipsoids.error();
    const DisplayShapes shapes = display_shapes(scene, boxes, *ellipsoids, view);
    std::vector<std::uint32_t> order;
    if (scene->display == Display::kBillboards) order = display_order(particles, view);
    const Displayed shown{scene, particles, view, boxes, shapes, order};

    const auto program = device.programs().display();
    if (!program.ok()) return program.error();
    const gl::TextureArray textures = plain_textures(scene), colors = upload_colors(scene, true);
    const int rows = std::clamp(kBandPixels / image.width, 1, image.height);
    const Canvas canvas(image.width, rows);
    for (int top = 0; top < image.height; top += rows) {
        canvas.begin(image.opaque ? kBackground : glm::vec4(0));
        (*program)->use();
        textures.bind(1);
        colors.bind(2);
        // Rows count downward from the picture's top: row `top` is at y = 1 - 2 top / height, and becomes -1.
        const double scale = -static_cast<double>(image.height) / rows;
        const double y_top = 1 - 2.0 * top / image.height;
        glUniform2f(0, static_cast<float>(scale), static_cast<float>(-1 - scale * y_top));
        if (Status failed = draw_band(shown, deadline)) return *failed;
        canvas.read(std::min(rows, image.height - top),
                    image.pixels.data() +
                        4 * static_cast<std::size_t>(top) * static_cast<std::size_t>(image.width));
        if (Status failed = gl::gl_status("the display pass")) return *failed;
    }
    if (image.opaque)
        for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 1;
    return image;
}

}  // namespace awan
