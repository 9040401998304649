#include "server/document/job_text.h"

#include <cmath>
#include <optional>

#include "server/document/json_place.h"
#include "server/document/json_text.h"

namespace awan {
namespace {

// Walks over JSON text without reading what it says.
class JobScanner {
  public:
    explicit JobScanner(std::string_view text) : text_(text) {}

    Result<JobText> read() {
        JobText job;
        blanks();
        if (!take('{')) return malformed("a job is an object");
        blanks();
        bool first = true;
        while (!take('}')) {
            if (!first && !take(',')) return malformed("expected `,` or `}`");
            first = false;
            blanks();
            const auto name = string();
            if (!name) return malformed("expected the name of a member");
            blanks();
            if (!take(':')) return malformed("expected `:`");
            blanks();
            const std::size_t begin = at_;
            if (!value()) return malformed("expected a value");
            const std::string_view found = text_.substr(begin, at_ - begin);
            if (Status wrong = member(*name, found, job)) return *wrong;
            blanks();
        }
        blanks();
        if (at_ != text_.size()) return malformed("expected the end");
        if (job.kind.empty()) return invalid("/kind", "is missing");
        if (job.scene.empty()) return invalid("/scene", "is missing");
        return job;
    }

  private:
    static Error invalid(const std::string& pointer, const std::string& what) {
        return {ErrorCode::kInvalidScene, pointer, what};
    }
    Error malformed(const std::string& what) const {
        return {ErrorCode::kMalformed, "", not_json(text_, at_ + 1, what)};
    }

    static Status member(std::string_view name, std::string_view value, JobText& job) {
        std::string_view* const to = name == "kind"              ? &job.kind
                                     : name == "scene"           ? &job.scene
                                     : name == "format"          ? &job.format
                                     : name == "path"            ? &job.path
                                     : name == "mode"            ? &job.mode
                                     : name == "frames"          ? &job.frames
                                     : name == "rung"            ? &job.rung
                                     : name == "impostors"       ? &job.impostors
                                     : name == "impostor_pixels" ? &job.impostor_pixels
                                     : name == "views"           ? &job.views
                                     : name == "size"            ? &job.size
                                     : name == "mapping"         ? &job.mapping
                                                                 : nullptr;
        if (to == nullptr) {
            // As everywhere in a document: such names are the client's own.
            if (name.starts_with('_') || name == "name" || name == "description" ||
                name == "$schema")
                return std::nullopt;
            return invalid(
                "",
                "a job has kind, scene and format, one of kind fly also path, mode, frames, rung, "
                "impostors and impostor_pixels, one of kind impostor views, size and mapping, and "
                "no other "
                "member");
        }
        const std::string pointer = "/" + std::string(name);
        if (!to->empty()) return invalid(pointer, "stands twice");
        if (to == &job.scene) {
            if (!value.starts_with('{')) return invalid(pointer, "must be an object");
        } else if (to != &job.frames && to != &job.impostor_pixels && to != &job.views &&
                   to != &job.size) {
            if (!value.starts_with('"')) return invalid(pointer, "must be a string");
            value = value.substr(1, value.size() - 2);
            if (value.empty()) return invalid(pointer, "must not be empty");
        }
        *to = value;
        return std::nullopt;
    }

    void blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' ||
                                      text_[at_] == '\n' || text_[at_] == '\r'))
            ++at_;
    }
    bool take(char c) {
        if (at_ == text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    // Without its quotes.
    std::optional<std::string_view> string() {
        if (!take('"')) return std::nullopt;
        const std::size_t begin = at_;
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '\\') {
                ++at_;
            } else if (text_[at_] == '"') {
                return text_.substr(begin, at_++ - begin);
            }
        }
        return std::nullopt;
    }
    // A string, or what is between brackets, or what ends before the next mark.
    bool value() {
        if (at_ < text_.size() && text_[at_] == '"') return string().has_value();
        const std::size_t begin = at_;
        std::size_t depth = 0;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"') {
                if (!string()) return false;
                continue;
            }
            if (depth == 0 && (c == ',' || c == '}' || c == ']')) break;
            if (c == '{' || c == '[') ++depth;
            if (c == '}' || c == ']') --depth;
            ++at_;
            if (depth == 0 && (c == '}' || c == ']')) break;
        }
        return depth == 0 && at_ > begin;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

Result<JobText> parse_job(std::string_view text) {
    return JobScanner(text).read();
}

std::string job_to_json(const JobStatus& job) {
    using namespace json_text;
    const std::string path = "/v1/jobs/" + std::string(job.id);
    std::string out = "{";
    member("id", job.id, out);
    member("kind", job.kind, out);
    member("state", job.state, out);
    member("progress", std::round(1000 * job.progress) / 1000, out);
    member("age", std::round(1000 * job.age) / 1000, out);
    if (job.status != 0) member("status", job.status, out);
    member("self", std::string_view(path), out);
    member("events", std::string_view(path + "/events"), out);
    member("result", std::string_view(path + "/result"), out);
    return out + "}";
}

}  // namespace awan
