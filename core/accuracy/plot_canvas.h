// Cairo with the few things that plots need; nobody but the plots includes it.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/accuracy/plot.h"
#include "core/accuracy/plot_layout.h"
#include "core/base/image.h"
#include "core/formats/tone.h"

namespace awan {

struct PlotColor {
    double r = 0, g = 0, b = 0;
};

struct PlotColors {
    PlotColor ground, panel, ink, quiet, line, faint, accent;
    // Of a difference to the truth: darker, none, brighter.
    PlotColor below, neutral, above;
};
const PlotColors& plot_colors(PlotTheme theme);

enum class Align { kLeft, kMiddle, kRight };

struct TextStyle {
    double size = 12;
    bool bold = false;
    Align align = Align::kLeft;
};

class PlotCanvas {
  public:
    PlotCanvas(int width, int height, double scale);

    cairo_t* pen() const { return pen_.get(); }
    void color(const PlotColor& color, double opacity = 1) const;
    void rectangle(const PlotBox& box) const;  // filled
    void line(PlotPoint from, PlotPoint to, double width) const;
    void disc(PlotPoint at, double radius, bool filled) const;

    // (x, y) is on the text's base line, at its left end, middle or right end. What is not UTF-8
    // shows as "?".
    void text(const std::string& text, double x, double y, const TextStyle& style) const;
    double text_width(const std::string& text, const TextStyle& style) const;
    // Cut to a width, with an ellipsis.
    std::string cut(const std::string& text, double width, const TextStyle& style) const;

    // 4 bytes a pixel: blue, green, red, alpha, premultiplied.
    void picture(const std::vector<std::uint8_t>& pixels, int width, int height,
                 const PlotBox& box) const;

    Result<std::string> png() const;

  private:
    struct Destroy {
        void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
        void operator()(cairo_t* pen) const { cairo_destroy(pen); }
    };
    std::unique_ptr<cairo_surface_t, Destroy> surface_;
    std::unique_ptr<cairo_t, Destroy> pen_;
};

// Pixels for PlotCanvas::picture.
std::vector<std::uint8_t> screen_pixels(const Image& image, const FilmSettings& film);
std::vector<std::uint8_t> difference_pixels(const std::vector<float>& difference, double full_scale,
                                            const PlotColors& colors);
// The colour of a share -1..1 of the full scale.
PlotColor difference_color(double share, const PlotColors& colors);

}  // namespace awan
