#include "server/document/camera_text.h"

#include <nlohmann/json.hpp>

#include "core/flight_path.h"
#include "server/document/overrides.h"

namespace awan {
namespace {

constexpr std::string_view kSequence = "/sequence", kKeys = "/sequence/camera";

// Where the text stands in a scene.
std::string_view place_of(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '[' ? kKeys : kSequence;
}

}  // namespace

std::string text_pointer(std::string_view text, std::string_view pointer) {
    const std::string_view place = place_of(text);
    return std::string(pointer.starts_with(place) ? pointer.substr(place.size()) : pointer);
}

Status set_camera_keys(std::string_view text, SceneDraft& draft) {
    if (!nlohmann::json::accept(text))
        return Error{ErrorCode::kMalformed, "", "is not JSON, a list of camera keys"};
    const std::string_view place = place_of(text);
    const bool lasts = draft.sequence.has_value();
    if (!lasts) draft.sequence = Sequence{};
    if (Status wrong = set_in_scene(place, text, draft)) {
        wrong->pointer = text_pointer(text, wrong->pointer);
        return wrong;
    }
    if (!draft.sequence || draft.sequence->camera.empty())
        return Error{ErrorCode::kInvalidScene, "", "has no camera keys"};
    if (lasts || place == kSequence) return std::nullopt;
    Sequence& sequence = *draft.sequence;
    sequence.from = sequence.camera.front().time;
    sequence.to = sequence.camera.back().time;
    sequence.frames = kFlightFrames;
    sequence.clouds_stand = true;
    return std::nullopt;
}

}  // namespace awan
