// Text -> SceneDraft, through nlohmann's SAX interface: no tree is built, numbers go straight to
// where they are kept, and reading stops at the first thing that is wrong. Every value is held
// against the tables of fields.cpp as it comes, so a document can only be as deep and as wide
// as they are.
#include <array>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>

#include "core/formats/numbers.h"
#include "core/scene/limits.h"
#include "server/document/fields.h"
#include "server/document/json.h"
#include "server/document/number_runs.h"

namespace awan {
namespace {

using nlohmann::json;

// One open bracket.
struct Frame {
    enum class Type : std::uint8_t {
        kObject,
        kList,    // of any length
        kVector,  // three numbers for a field
        kRow,     // three numbers, an element of a list
    };
    Type type = Type::kObject;
    ObjectKind object = ObjectKind::kNone;
    ListKind list = ListKind::kNone;
    int field = -1;          // the member being read, in fields_of(object)
    std::uint32_t seen = 0;  // members so far
    std::size_t index = 0;   // of the element being read, in the other types
    glm::dvec3* vector = nullptr;
};

// RFC 6901. A name that is long or not plain is left out: the pointer is then the object's.
std::string escaped_name(std::string_view name) {
    constexpr std::size_t kLongest = 40;
    if (name.size() > kLongest) return "";
    std::string out = "/";
    for (const char c : name) {
        if (c < ' ' || c > '~') return "";
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

// Position and reason of nlohmann's message, without the client's text in it.
std::string reason_of(std::string_view what) {
    const std::size_t begin = what.find(" - ");
    if (begin == std::string_view::npos) return "";
    what.remove_prefix(begin + 3);
    return std::string(what.substr(0, what.find("; last read")));
}

class SceneReader {
  public:
    std::optional<Error> error;
    DraftInProgress state;
    TextCursor text;  // where the parser is

    explicit SceneReader(std::string_view document)
        : text{document.data(), document.data() + document.size()}, begin_(document.data()) {}

    // --- nlohmann's SAX interface; false stops the reading

    bool null() { return wrong_type("null"); }
    bool binary(json::binary_t&) { return wrong_type("binary"); }

    bool boolean(bool value) {
        const Field* const field = open_field();
        if (!field || !field->flag) return wrong_type("a boolean");
        field->flag(state, value);
        return true;
    }

    bool number_integer(json::number_integer_t value) {
        const Field* const field = open_field();
        if (!field || !field->integer) return number(static_cast<double>(value));
        if (value == 0) return integer(*field, 0);  // "-0"
        return fail("must be " + std::string(field->wanted) + ", not " + std::to_string(value));
    }

    bool number_unsigned(json::number_unsigned_t value) {
        const Field* const field = open_field();
        if (field && field->integer) return integer(*field, value);
        return number(static_cast<double>(value));
    }

    bool number_float(json::number_float_t value, const std::string& text) {
        const Field* const field = open_field();
        if (!field || !field->integer) return number(value);
        // 200.0 is an integer written at length; beyond 2^53 its digits would be guesses.
        if (value >= 0 && value <= 9007199254740992.0 && std::floor(value) == value)
            return integer(*field, static_cast<std::uint64_t>(value));
        return fail("must be " + std::string(field->wanted) + ", not " + clipped(text));
    }

    bool string(std::string& value) {
        const Field* const field = open_field();
        if (!field || !field->word) return wrong_type("a string");
        if (value.size() > limits::kMaxString)
            return fail("must be at most " + std::to_string(limits::kMaxString) + " bytes long");
        if (field->word(state, value) == WordOutcome::kTaken) return true;
        return fail("must be " + std::string(field->wanted) + ", not " + short_quote(value));
    }

    bool start_object(std::size_t) {
        ObjectKind kind = ObjectKind::kNone;
        if (frames_.empty())
            kind = ObjectKind::kScene;
        else if (const Field* const field = open_field())
            kind = field->object;
        else
            kind = list_at(top().list).object;
        if (kind == ObjectKind::kNone) return wrong_type("an object");
        if (!has_room()) return false;
        state.begin(kind);
        return push({.type = Frame::Type::kObject, .object = kind});
    }

    bool key(std::string& name) {
        Frame& frame = top();
        frame.field = -1;
        const int field = find_field(frame.object, name);
        if (field < 0) {
            std::string at = pointer() + escaped_name(name);
            return fail_at(std::move(at), "unknown field " + short_quote(name) + "; allowed are " +
                                              allowed_names(frame.object));
        }
        frame.field = field;
        const std::uint32_t bit = 1u << field;
        if ((frame.seen & bit) != 0) return fail("stands twice in its object");
        frame.seen |= bit;
        if (frame.object == ObjectKind::kEffects) state.effect = static_cast<Effect>(field);
        return true;
    }

    bool end_object() {
        Frame& frame = top();
        frame.field = -1;
        if (const Status wrong = check_together(frame.object, frame.seen, state))
            return fail_at(pointer() + wrong->pointer, wrong->message, wrong->code);
        complete(frame.object, frame.seen, state);
        return pop();
    }

    bool start_array(std::size_t) {
        if (frames_.empty()) return wrong_type("an array");
        if (const Field* const field = open_field()) {
            if (field->vector)
                return push({.type = Frame::Type::kVector, .vector = field->vector(state)});
            if (field->list == ListKind::kNone) return wrong_type("an array");
            if (top().object == ObjectKind::kScene) {
                state.draft.top_level_cubes = field->list == ListKind::kCubes;
                if (field->list == ListKind::kCubes) state.begin(ObjectKind::kCloud);
            }
            const bool pushed = push({.type = Frame::Type::kList, .list = field->list});
            if (pushed) read_ahead();
            return pushed;
        }
        if (list_at(top().list).row == nullptr) return wrong_type("an array");
        if (!has_room()) return false;
        return push({.type = Frame::Type::kRow, .vector = &row_});
    }

    bool end_array() {
        const Frame& frame = top();
        if (frame.type == Frame::Type::kList) return pop();
        if (frame.index != 3) {
            const std::size_t count = frame.index;
            frames_.pop_back();
            return fail(wanted() + ", not " + std::to_string(count));
        }
        const bool is_row = frame.type == Frame::Type::kRow;
        pop();
        if (is_row) list_at(top().list).row(state, row_);
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const json::exception& e) {
        constexpr int kNumberOverflow = 406;
        if (e.id == kNumberOverflow) return fail("must be finite: the number overflows");
        error = Error{
            ErrorCode::kMalformed, "",
            "not JSON at byte " + std::to_string(text.at - begin_) + ": " + reason_of(e.what())};
        return false;
    }

  private:
    Frame& top() { return frames_.back(); }

    // The row of the member whose value comes next; null outside objects.
    const Field* open_field() {
        if (frames_.empty() || top().type != Frame::Type::kObject) return nullptr;
        return &field_at(top().object, top().field);
    }

    std::string pointer() const {
        std::string at;
        for (const Frame& frame : frames_) {
            if (frame.type != Frame::Type::kObject)
                at += "/" + std::to_string(frame.index);
            else if (frame.field >= 0)
                at += "/" + std::string(field_name(frame.object, frame.field));
        }
        return at;
    }

    bool fail_at(std::string at, std::string message, ErrorCode code = ErrorCode::kInvalidScene) {
        error = Error{code, std::move(at), std::move(message)};
        return false;
    }
    bool fail(std::string message) { return fail_at(pointer(), std::move(message)); }

    std::string wanted() {
        if (frames_.empty()) return "must be an object, the scene";
        if (const Field* const field = open_field()) return std::string("must be ") + field->wanted;
        return std::string("must be ") +
               (top().type == Frame::Type::kList ? list_at(top().list).wanted : "a number");
    }

    bool wrong_type(const char* what) { return fail(wanted() + ", not " + what); }

    static std::string clipped(const std::string& number) {
        constexpr std::size_t kLongest = 40;
        return number.size() <= kLongest ? number : number.substr(0, kLongest) + "...";
    }

    bool integer(const Field& field, std::uint64_t value) {
        if (value > field.largest_integer)
            return fail("must be " + std::string(field.wanted) + ", not " + std::to_string(value));
        field.integer(state, value);
        return true;
    }

    bool number(double value) {
        value += 0.0;  // -0 is 0: equal scenes have equal bytes
        if (frames_.empty()) return wrong_type("a number");
        Frame& frame = top();
        switch (frame.type) {
            case Frame::Type::kObject: {
                const Field& field = *open_field();
                if (!field.number) return wrong_type("a number");
                field.number(state, value);
                return true;
            }
            case Frame::Type::kVector:
            case Frame::Type::kRow:
                if (frame.index == 3) return too_long();
                (*frame.vector)[static_cast<int>(frame.index++)] = value;
                return true;
            case Frame::Type::kList:
                break;
        }
        const List& list = list_at(frame.list);
        if (list.number == nullptr) return wrong_type("a number");
        if (!has_room()) return false;
        list.number(state, value);
        ++frame.index;
        return true;
    }

    // The regular part of a list of numbers that begins here (number_runs.h).
    void read_ahead() {
        Frame& frame = top();
        const List& list = list_at(frame.list);
        if (list.number != nullptr)
            frame.index = take_run<1>(
                text, list.most, [&](const std::array<double, 1>& v) { list.number(state, v[0]); });
        if (list.row != nullptr)
            frame.index = take_run<3>(text, list.most, [&](const std::array<double, 3>& v) {
                list.row(state, {v[0], v[1], v[2]});
            });
    }

    bool too_long() {
        frames_.pop_back();
        return fail(wanted() + ", not more");
    }

    // Whether the open list may have one more element. validate() counts over all clouds; this
    // keeps a hostile text from filling memory before it gets there.
    bool has_room() {
        if (frames_.empty() || top().type != Frame::Type::kList) return true;
        const std::uint64_t most = list_at(top().list).most;
        if (top().index < most) return true;
        return fail("at most " + std::to_string(most) + " elements are allowed");
    }

    bool push(const Frame& frame) {
        // The tables are at most 6 deep; this guards the tables.
        if (frames_.size() >= static_cast<std::size_t>(limits::kMaxJsonDepth))
            return fail("nested deeper than " + std::to_string(limits::kMaxJsonDepth));
        frames_.push_back(frame);
        return true;
    }

    bool pop() {
        frames_.pop_back();
        if (!frames_.empty() && top().type == Frame::Type::kList) ++top().index;
        return true;
    }

    const char* begin_;
    std::vector<Frame> frames_;
    glm::dvec3 row_{0};  // of the list being read
};

}  // namespace

Result<SceneDraft> parse_scene(std::string_view text) {
    SceneReader reader(text);
    try {
        json::sax_parse(TextIterator(reader.text), TextIterator(), &reader);
    } catch (const std::exception& e) {
        return Error{ErrorCode::kInternal, "", std::string("reading JSON failed: ") + e.what()};
    }
    if (reader.error) return std::move(*reader.error);
    return std::move(reader.state.draft);
}

}  // namespace awan
