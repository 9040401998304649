#include "core/formats/texture_file.h"

#include <algorithm>
#include <vector>

#include "core/formats/picture_program.h"
#include "core/formats/picture_reader.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// Means of a row of `size` values, `stride` apart and with as much of nothing before them as behind, that is `whole`
// long in all, over kTextureSide even parts of it.
template <typename Value>
void part_means(const Value* values, std::size_t stride, int size, int whole, double* out) {
    const double before = 0.5 * (whole - size), part = static_cast<double>(whole) / kTextureSide;
    for (int i = 0; i < kTextureSide; ++i) {
        const double low = std::max(i * part - before, 0.0);
        const double high = std::min((i + 1) * part - before, static_cast<double>(size));
        double sum = 0;
        for (int k = static_cast<int>(low); k < high; ++k) {
            const double covered = std::min(high, k + 1.0) - std::max(low, static_cast<double>(k));
            sum += covered * static_cast<double>(values[static_cast<std::size_t>(k) * stride]);
        }
        out[i] = sum / part;
    }
}

std::vector<std::uint8_t> as_texture(const GreyPicture& picture) {
    constexpr auto kSide = static_cast<std::size_t>(kTextureSide);
    const int whole = std::max(picture.width, picture.height);
    std::vector<double> rows(kSide * static_cast<std::size_t>(picture.height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y)
        part_means(&picture.values[y * static_cast<std::size_t>(picture.width)], 1, picture.width,
                   whole, &rows[y * kSide]);
    std::vector<std::uint8_t> depth(kSide * kSide);
    std::vector<double> column(kSide);
    for (std::size_t x = 0; x < kSide; ++x) {
        part_means(&rows[x], kSide, picture.height, whole, column.data());
        for (std::size_t y = 0; y < kSide; ++y)
            depth[y * kSide + x] = static_cast<std::uint8_t>(std::min(column[y], 255.0) + 0.5);
    }
    return depth;
}

HeightMap height_map_of(const GreyPicture& picture) {
    static_assert(kHeightMapSide == kPictureHeights);
    HeightMap map{picture.across, picture.down, picture.luminance, {}};
    map.hash = height_map_hash(map);
    return map;
}

}  // namespace

Result<std::shared_ptr<const Texture>> read_texture(std::string name, std::string_view bytes,
                                                    const Deadline& deadline) {
    if (Status wrong = check_texture_name(name)) return *wrong;
    const auto refused = [&](ErrorCode code, const std::string& why) {
        return Error{code, "", "the texture " + name + " cannot be used: " + why};
    };
    if (bytes.size() > limits::kMaxTextureBytes)
        return refused(
            ErrorCode::kTooLarge,
            "its file is longer than " + std::to_string(limits::kMaxTextureBytes) + " bytes");
    const auto picture = read_picture(bytes, deadline);
    if (!picture) {
        const Error& error = picture.error();
        const bool of_picture = error.code == ErrorCode::kInvalidScene ||
                                error.code == ErrorCode::kTooLarge ||
                                error.code == ErrorCode::kUnsupported;
        return of_picture ? refused(error.code, error.message) : error;
    }
    std::vector<std::uint8_t> depth = as_texture(*picture);
    if (std::all_of(depth.begin(), depth.end(), [](std::uint8_t one) { return one == 0; }))
        return refused(ErrorCode::kInvalidScene,
                       "there is nothing in it: its alpha (or luminance) is 0 everywhere");
    static_assert(kTextureSide == kPictureHues);
    std::string hash = texture_hash(depth, picture->hues);
    return std::make_shared<const Texture>(Texture{std::move(name), std::move(hash),
                                                   std::move(depth), false, height_map_of(*picture),
                                                   picture->hues});
}

}  // namespace awan
