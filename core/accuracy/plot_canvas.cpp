#include "core/accuracy/plot_canvas.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>

#include "core/formats/tone.h"

namespace awan {
namespace {

constexpr PlotColor rgb(unsigned hex) {
    return {(hex >> 16 & 255u) / 255.0, (hex >> 8 & 255u) / 255.0, (hex & 255u) / 255.0};
}

// Those of the page (web/page.css). Blue and orange: told apart by everybody.
constexpr PlotColors kLightColors = {
    .ground = rgb(0xffffff),
    .panel = rgb(0xf7f9fb),
    .ink = rgb(0x17202b),
    .quiet = rgb(0x55616f),
    .line = rgb(0xc4ced9),
    .faint = rgb(0xe4e9ef),
    .accent = rgb(0x1f64ad),
    .below = rgb(0x1b4f9c),
    .neutral = rgb(0xf1f3f5),
    .above = rgb(0xc2500a),
};
constexpr PlotColors kDarkColors = {
    .ground = rgb(0x0f141a),
    .panel = rgb(0x151c24),
    .ink = rgb(0xe3e9f0),
    .quiet = rgb(0x97a5b4),
    .line = rgb(0x3a4755),
    .faint = rgb(0x222c37),
    .accent = rgb(0x7db6f2),
    .below = rgb(0x5aa2f5),
    .neutral = rgb(0x1d252e),
    .above = rgb(0xff9242),
};

// Cairo stops drawing at all after text that is not UTF-8.
std::string valid_utf8(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80                   ? 1
                                   : lead >= 0xC2 && lead < 0xE0 ? 2
                                   : lead >= 0xE0 && lead < 0xF0 ? 3
                                   : lead >= 0xF0 && lead < 0xF5 ? 4
                                                                 : 0;
        bool whole = length > 0 && i + length <= text.size() && lead >= 0x20 && lead != 0x7F;
        for (std::size_t k = 1; whole && k < length; ++k)
            whole = (static_cast<unsigned char>(text[i + k]) & 0xC0) == 0x80;
        if (whole && length == 3) {  // overlong forms and surrogates
            const auto next = static_cast<unsigned char>(text[i + 1]);
            whole = !(lead == 0xE0 && next < 0xA0) && !(lead == 0xED && next >= 0xA0);
        }
        if (whole && length == 4) {
            const auto next = static_cast<unsigned char>(text[i + 1]);
            whole = !(lead == 0xF0 && next < 0x90) && !(lead == 0xF4 && next >= 0x90);
        }
        out += whole ? text.substr(i, length) : "?";
        i += whole ? length : 1;
    }
    return out;
}

std::uint8_t byte_of(double value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
    // Nothing may be thrown through Cairo.
    try {
        static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
    } catch (const std::exception&) {
        return CAIRO_STATUS_NO_MEMORY;
    }
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

const PlotColors& plot_colors(PlotTheme theme) {
    return theme == PlotTheme::kDark ? kDarkColors : kLightColors;
}

PlotCanvas::PlotCanvas(int width, int height, double scale)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                          static_cast<int>(std::lround(width * scale)),
                                          static_cast<int>(std::lround(height * scale)))),
      pen_(cairo_create(surface_.get())) {
    cairo_scale(pen(), scale, scale);
    cairo_set_line_cap(pen(), CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(pen(), CAIRO_LINE_JOIN_ROUND);
    cairo_font_options_t* const options = cairo_font_options_create();
    // No hinting: widths are then the same at every scale, and on every machine.
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(pen(), options);
    cairo_font_options_destroy(options);
}

void PlotCanvas::color(const PlotColor& color, double opacity) const {
    cairo_set_source_rgba(pen(), color.r, color.g, color.b, opacity);
}

void PlotCanvas::rectangle(const PlotBox& box) const {
    cairo_rectangle(pen(), box.x, box.y, box.width, box.height);
    cairo_fill(pen());
}

void PlotCanvas::line(PlotPoint from, PlotPoint to, double width) const {
    cairo_set_line_width(pen(), width);
    cairo_move_to(pen(), from.x, from.y);
    cairo_line_to(pen(), to.x, to.y);
    cairo_stroke(pen());
}

void PlotCanvas::disc(PlotPoint at, double radius, bool filled) const {
    cairo_new_sub_path(pen());
    cairo_arc(pen(), at.x, at.y, radius, 0, 2 * std::numbers::pi);
    if (filled) {
        cairo_fill(pen());
    } else {
        cairo_set_line_width(pen(), 1.5);
        cairo_stroke(pen());
    }
}

double PlotCanvas::text_width(const std::string& text, const TextStyle& style) const {
    cairo_select_font_face(pen(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(pen(), style.size);
    cairo_text_extents_t extents{};
    cairo_text_extents(pen(), valid_utf8(text).c_str(), &extents);
    return extents.x_advance;
}

void PlotCanvas::text(const std::string& text, double x, double y, const TextStyle& style) const {
    const double width = text_width(text, style);
    const double shift = style.align == Align::kLeft     ? 0
                         : style.align == Align::kMiddle ? width / 2
                                                         : width;
    cairo_move_to(pen(), x - shift, y);
    cairo_show_text(pen(), valid_utf8(text).c_str());
    cairo_new_path(pen());
}

std::string PlotCanvas::cut(const std::string& text, double width, const TextStyle& style) const {
    if (text_width(text, style) <= width) return text;
    std::string part = valid_utf8(text.substr(0, 400));
    while (!part.empty() && text_width(part + "\xE2\x80\xA6", style) > width) {
        do {
            part.pop_back();
        } while (!part.empty() && (static_cast<unsigned char>(part.back()) & 0xC0) == 0x80);
        // A lead byte without what follows it.
        if (!part.empty() && static_cast<unsigned char>(part.back()) >= 0xC0) part.pop_back();
    }
    return part + "\xE2\x80\xA6";
}

void PlotCanvas::picture(const std::vector<std::uint8_t>& pixels, int width, int height,
                         const PlotBox& box) const {
    const std::unique_ptr<cairo_surface_t, Destroy> source(
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
    if (cairo_surface_status(source.get()) != CAIRO_STATUS_SUCCESS) return;
    cairo_surface_flush(source.get());
    unsigned char* const data = cairo_image_surface_get_data(source.get());
    const int stride = cairo_image_surface_get_stride(source.get());
    const std::size_t row = 4 * static_cast<std::size_t>(width);
    for (int y = 0; y < height; ++y)
        std::copy_n(pixels.data() + row * static_cast<std::size_t>(y), row,
                    data + static_cast<std::ptrdiff_t>(stride) * y);
    cairo_surface_mark_dirty(source.get());
    cairo_save(pen());
    cairo_rectangle(pen(), box.x, box.y, box.width, box.height);
    cairo_clip(pen());
    cairo_translate(pen(), box.x, box.y);
    cairo_scale(pen(), box.width / width, box.height / height);
    cairo_set_source_surface(pen(), source.get(), 0, 0);
    // Its edge pixels go on outside, so that smoothing does not fade the border.
    cairo_pattern_set_extend(cairo_get_source(pen()), CAIRO_EXTEND_PAD);
    cairo_pattern_set_filter(cairo_get_source(pen()), CAIRO_FILTER_GOOD);
    cairo_paint(pen());
    cairo_restore(pen());
}

Result<std::string> PlotCanvas::png() const {
    const auto failed = [](cairo_status_t status) {
        return Error{
            status == CAIRO_STATUS_NO_MEMORY ? ErrorCode::kOutOfMemory : ErrorCode::kInternal, "",
            std::string("the plot could not be drawn: ") + cairo_status_to_string(status)};
    };
    if (const auto status = cairo_status(pen()); status != CAIRO_STATUS_SUCCESS)
        return failed(status);
    std::string bytes;
    if (const auto status = cairo_surface_write_to_png_stream(surface_.get(), append, &bytes);
        status != CAIRO_STATUS_SUCCESS)
        return failed(status);
    return bytes;
}

std::vector<std::uint8_t> screen_pixels(const Image& image, const FilmSettings& settings) {
    const Film film(settings);
    std::vector<std::uint8_t> pixels(4 * image.pixel_count());
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const float* const from = image.pixels.data() + 4 * i;
        // Straight alpha for the tone curve, as in a PNG; premultiplied again for Cairo.
        const float alpha = from[3] > 0 ? std::min(from[3], 1.0F) : 0.0F;
        const float scale = alpha > 0 ? film.gain() / alpha : 0.0F;
        const auto codes = film.rounded(scale * glm::vec3(from[0], from[1], from[2]));
        for (std::size_t c = 0; c < 3; ++c)
            pixels[4 * i + 2 - c] = byte_of(static_cast<double>(alpha) * codes[c] / 255.0);
        pixels[4 * i + 3] = byte_of(static_cast<double>(alpha));
    }
    return pixels;
}

PlotColor difference_color(double share, const PlotColors& colors) {
    const double t = std::clamp(std::abs(share), 0.0, 1.0);
    const PlotColor& end = share < 0 ? colors.below : colors.above;
    const auto mixed = [t](double a, double b) { return a + t * (b - a); };
    return {mixed(colors.neutral.r, end.r), mixed(colors.neutral.g, end.g),
            mixed(colors.neutral.b, end.b)};
}

std::vector<std::uint8_t> difference_pixels(const std::vector<float>& difference, double full_scale,
                                            const PlotColors& colors) {
    std::vector<std::uint8_t> pixels(4 * difference.size());
    for (std::size_t i = 0; i < difference.size(); ++i) {
        const double share = static_cast<double>(difference[i]) / full_scale;
        const PlotColor color = difference_color(std::isnan(share) ? 0 : share, colors);
        pixels[4 * i] = byte_of(color.b);
        pixels[4 * i + 1] = byte_of(color.g);
        pixels[4 * i + 2] = byte_of(color.r);
        pixels[4 * i + 3] = 255;
    }
    return pixels;
}

}  // namespace awan
