#include "server/document/sheet_text.h"

#include <cmath>

#include "server/document/json_text.h"

namespace awan {
namespace {

void append_rectangle(const char* name, int x, int y, int w, int h, std::string& out) {
    json_text::name(name, out);
    out += '{';
    json_text::member("x", x, out);
    json_text::member("y", y, out);
    json_text::member("w", w, out);
    json_text::member("h", h, out);
    out += '}';
}

void append_size(const char* name, int w, int h, std::string& out) {
    json_text::name(name, out);
    out += '{';
    json_text::member("w", w, out);
    json_text::member("h", h, out);
    out += '}';
}

}  // namespace

std::string sheet_to_json(const SheetLayout& layout, std::string_view image,
                          std::span<const std::uint64_t> numbers, std::span<const double> times,
                          double frames_per_second) {
    const double duration_ms = std::round(1000 / frames_per_second);
    std::string out = "{";
    json_text::name("frames", out);
    out += '[';
    for (std::uint64_t i = 0; i < layout.frames; ++i) {
        out += i == 0 ? "\n{" : ",\n{";
        json_text::member("filename", std::string_view("frame." + std::to_string(numbers[i])), out);
        append_rectangle("frame", layout.x(i), layout.y(i), layout.width, layout.height, out);
        json_text::member("rotated", false, out);
        json_text::member("trimmed", false, out);
        append_rectangle("spriteSourceSize", 0, 0, layout.width, layout.height, out);
        append_size("sourceSize", layout.width, layout.height, out);
        json_text::member("duration", duration_ms, out);
        json_text::member("time", times[i], out);
        out += '}';
    }
    out += "\n]";
    json_text::name("meta", out);
    out += '{';
    json_text::member("app", std::string_view("Awan"), out);
    json_text::member("version", std::string_view(AWAN_VERSION), out);
    json_text::member("image", image, out);
    append_size("size", layout.sheet_width(), layout.sheet_height(), out);
    json_text::member("scale", std::string_view("1"), out);
    json_text::member("columns", layout.columns, out);
    json_text::member("rows", layout.rows, out);
    return out + "}}\n";
}

}  // namespace awan
