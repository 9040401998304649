// Scenes from bytes.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/formats/awn.h"
#include "core/scene/fingerprint.h"
#include "core/scene/validate.h"
#include "server/document/job_text.h"
#include "server/document/json.h"
#include "server/document/scene_text.h"
#include "server/document/text_bytes.h"
#include "tests/fuzz/targets.h"

namespace awan::fuzz {
namespace {

// What is unpacked of a file; a fuzzer's are small.
constexpr std::size_t kMostUnpacked = 1u << 20;
// An error quotes a little of a text, never all of it.
constexpr std::size_t kLongestMessage = 2'000;

bool is_plain(std::string_view text) {
    return std::none_of(text.begin(), text.end(),
                        [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; });
}

void check_error(const Error& error) {
    require(error.code != ErrorCode::kInternal, "what is wrong with a text is no bug of ours");
    require(!error.message.empty(), "an error says what is wrong");
    require(is_plain(error.message) && is_plain(error.pointer), "an error is one plain line");
    require(error.message.size() < kLongestMessage && error.pointer.size() < kLongestMessage,
            "an error is short");
    require(
        error.pointer.empty() || error.pointer.front() == '/' || error.pointer.starts_with("line "),
        "a pointer is one into a document, or a line");
    // Throws on what is not UTF-8.
    const std::string problem = problem_to_json(400, "title", error.message, error.pointer, "id");
    require(problem.front() == '{', "an error can be told as JSON");
}

// A scene that was read: as a document it is the same scene, and so is that document's document.
void check_draft(SceneDraft draft) {
    const auto scene = validate(std::move(draft));
    if (!scene) return check_error(scene.error());
    const std::string text = scene_to_json(**scene);
    auto read = parse_scene(text);
    require(read.ok(), "a scene as a document can be read");
    require(scene_to_json(*read) == text, "a document that was read is written as it was");
    const auto again = validate(*std::move(read));
    require(again.ok(), "a scene as a document is valid");
    require(fingerprint(*again) == fingerprint(*scene), "a scene as a document is the same scene");
}

void check_read(SceneFormat format, std::string_view bytes, std::optional<double> radius = {}) {
    std::vector<std::string> notes;
    auto draft = read_scene(format, bytes, {radius, &notes});
    for (const std::string& note : notes)
        require(is_plain(note) && note.size() < kLongestMessage, "a note is one plain line");
    if (!draft) return check_error(draft.error());
    check_draft(*std::move(draft));
}

}  // namespace

void fuzz_json(std::string_view bytes) {
    check_read(SceneFormat::kJson, bytes);
    const auto job = parse_job(bytes);
    if (!job) return check_error(job.error());
    const auto within = [&](std::string_view part) {
        return part.empty() || (part.data() >= bytes.data() &&
                                part.data() + part.size() <= bytes.data() + bytes.size());
    };
    require(within(job->kind) && within(job->scene) && within(job->format),
            "a job's parts stand in its text");
}

void fuzz_awn(std::string_view bytes) {
    check_read(SceneFormat::kAwn, bytes);
    auto draft = read_awn(bytes);
    if (!draft) return;
    auto scene = validate(*std::move(draft));
    if (!scene) return;
    const auto layout = write_awn(**scene);
    require(layout.ok(), "what was a layout can be written as one");
    auto read = read_awn(*layout);
    require(read.ok(), "a layout that was written can be read");
    const auto again = validate(*std::move(read));
    require(again.ok() && fingerprint(*again) == fingerprint(*scene),
            "a layout that was written is the same scene");
}

void fuzz_ply(std::string_view bytes) {
    check_read(SceneFormat::kPly, bytes);
    check_read(SceneFormat::kPly, bytes, 0.5);
}

void fuzz_csv(std::string_view bytes) {
    check_read(SceneFormat::kCsv, bytes);
    check_read(SceneFormat::kCsv, bytes, 0.5);
}

void fuzz_file(std::string_view bytes) {
    std::string unpacked;
    if (is_gzip(bytes)) {
        auto out = gunzip(bytes, kMostUnpacked);
        if (!out) return check_error(out.error());
        require(out->size() <= kMostUnpacked, "no more is unpacked than is allowed");
        unpacked = *std::move(out);
        bytes = unpacked;
    }
    check_read(sniff_scene_format(bytes), bytes);
}

}  // namespace awan::fuzz
