// Text -> SceneDraft, through nlohmann's SAX interface: no tree is built, numbers go straight to
// where they are kept, and reading stops at the first thing that is wrong. Every value is held
// against the tables of core/scene (table.h) as it comes, so a document can only be as deep and as
// wide as they are.
#include <array>
#include <climits>
#include <cmath>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/thrown.h"
#include "core/formats/numbers.h"
#include "core/scene/limits.h"
#include "core/scene/rules.h"
#include "server/document/field_values.h"
#include "server/document/json.h"
#include "server/document/json_place.h"
#include "server/document/left_alone.h"
#include "server/document/number_runs.h"
#include "server/document/particle_answer.h"
#include "server/document/presets.h"

namespace awan {
namespace {

using nlohmann::json;

// What is no place in a table's fields: no member, and `particles` of an answer that comes back.
constexpr int kNoField = -1, kAnswerField = -2;

// One open bracket.
struct Frame {
    enum class Type : std::uint8_t {
        kObject,
        kList,    // of any length
        kVector,  // three numbers for a field
        kRow,     // three numbers, an element of a list
    };
    Type type = Type::kObject;
    // Of an object.
    const Table* table = nullptr;
    void* object = nullptr;
    // The member being read, in table->fields; none: kNoField; of the scene also kAnswerField.
    int field = kNoField;
    // Members so far, bit i for field i.
    std::uint64_t seen = 0;
    // Of a list: the field that it is the value of, and where its elements go.
    const Field* list_field = nullptr;
    void* list = nullptr;
    // Of the element being read, in the other types.
    std::size_t index = 0;
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
    // The scene names a preset: reading stopped there.
    bool begins_with_preset = false;
    SceneDraft draft;
    TextCursor text;  // where the parser is

    explicit SceneReader(std::string_view document)
        : text{document.data(), document.data() + document.size()}, begin_(document.data()) {}

    // --- nlohmann's SAX interface; false stops the reading

    bool null() { return left_.passed() || wrong_type("null"); }
    bool binary(json::binary_t&) { return wrong_type("binary"); }

    bool boolean(bool value) {
        if (left_.passed()) return true;
        const Field* const field = open_field();
        if (!field || field->access.holds != Holds::kSwitch) return wrong_type("a boolean");
        *static_cast<Switch*>(put_field(*field, top().object)) = value ? Switch::kOn : Switch::kOff;
        return true;
    }

    bool number_integer(json::number_integer_t value) {
        if (left_.passed()) return true;
        const Field* const field = open_field();
        if (!field || !is_integer_field(*field)) return number(static_cast<double>(value));
        if (value == 0) return integer(*field, 0);  // "-0"
        return fail("must be " + wanted_of(*field) + ", not " + std::to_string(value));
    }

    bool number_unsigned(json::number_unsigned_t value) {
        if (left_.passed()) return true;
        const Field* const field = open_field();
        if (field && is_integer_field(*field)) return integer(*field, value);
        return number(static_cast<double>(value));
    }

    bool number_float(json::number_float_t value, const std::string& digits) {
        if (left_.passed()) return true;
        const Field* const field = open_field();
        if (!field || !is_integer_field(*field)) return number(value);
        // 200.0 is an integer written at length; beyond 2^53 its digits would be guesses.
        if (value >= 0 && value <= 9007199254740992.0 && std::floor(value) == value)
            return integer(*field, static_cast<std::uint64_t>(value));
        return fail("must be " + wanted_of(*field) + ", not " + clipped(digits));
    }

    bool string(std::string& value) {
        if (left_.passed()) return true;
        const Field* const field = open_field();
        if (!field || !takes_words(*field)) return wrong_type("a string");
        if (const std::uint64_t most = most_bytes(*field); value.size() > most)
            return fail("must be at most " + std::to_string(most) + " bytes long");
        if (take_word(*field, top().object, value)) return true;
        return fail("must be " + wanted_of(*field) + ", not " + short_quote(value));
    }

    bool start_object(std::size_t) {
        if (left_.passing()) return pass_into();
        if (frames_.empty()) return push_object(table_of<SceneDraft>(), &draft);
        if (const Field* const field = open_field()) {
            if (field->access.holds != Holds::kObject) return wrong_type("an object");
            return push_object(field->access.table(), put_field(*field, top().object));
        }
        const Field* const list = top().list_field;
        if (list == nullptr || list->access.holds != Holds::kObjects)
            return wrong_type("an object");
        if (!has_room()) return false;
        return push_object(list->access.table(), list->access.append(top().list));
    }

    bool key(std::string& name) {
        if (left_.inside()) return true;
        Frame& frame = top();
        frame.field = kNoField;
        const int field = find_field(*frame.table, name);
        if (field < 0) {
            if (is_left_alone(name)) return pass_over_next();
            if (name == "preset" && frames_.size() == 1) {
                begins_with_preset = true;
                return false;
            }
            if (key_of_answer(name)) return true;
            std::string at = pointer() + escaped_name(name);
            return fail_at(std::move(at), "unknown field " + short_quote(name) + "; allowed are " +
                                              allowed_names(*frame.table));
        }
        frame.field = field;
        const std::uint64_t bit = std::uint64_t{1} << field;
        if ((frame.seen & bit) != 0) return fail("stands twice in its object");
        frame.seen |= bit;
        return true;
    }

    bool end_object() {
        if (left_.leave()) return true;
        Frame& frame = top();
        frame.field = kNoField;
        if (frames_.size() == 1 && !end_answer(frame)) return false;
        complete_defaults(*frame.table, frame.seen, frame.object);
        if (const Status wrong = check_written({*frame.table, frame.seen}, frame.object))
            return fail_at(pointer() + wrong->pointer, wrong->message, wrong->code);
        return pop();
    }

    bool start_array(std::size_t) {
        if (left_.passing()) return pass_into();
        if (frames_.empty()) return wrong_type("an array");
        if (const Field* const field = open_field()) {
            if (field->access.holds == Holds::kVector)
                return push({.type = Frame::Type::kVector,
                             .vector = static_cast<glm::dvec3*>(put_field(*field, top().object))});
            if (!is_list_field(*field)) return wrong_type("an array");
            void* const list =
                put_field(*field, field == &kAnsweredParticles ? &answer_.answer : top().object);
            const bool pushed =
                push({.type = Frame::Type::kList, .list_field = field, .list = list});
            if (pushed) read_ahead();
            return pushed;
        }
        if (top().list_field == nullptr || !is_of_rows(*top().list_field))
            return wrong_type("an array");
        if (!has_room()) return false;
        return push({.type = Frame::Type::kRow, .vector = &row_});
    }

    bool end_array() {
        if (left_.leave()) return true;
        const Frame& frame = top();
        if (frame.type == Frame::Type::kList) return pop();
        if (frame.index != 3) {
            const std::size_t count = frame.index;
            frames_.pop_back();
            return fail(wanted() + ", not " + std::to_string(count));
        }
        const bool is_row = frame.type == Frame::Type::kRow;
        pop();
        if (is_row) append_row(*top().list_field, top().list, row_);
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const json::exception& e) {
        constexpr int kNumberOverflow = 406;
        if (e.id == kNumberOverflow) return fail("must be finite: the number overflows");
        const std::string_view document(begin_, static_cast<std::size_t>(text.end - begin_));
        error = Error{
            ErrorCode::kMalformed, "",
            not_json(document, static_cast<std::size_t>(text.at - begin_), reason_of(e.what()))};
        return false;
    }

  private:
    Frame& top() { return frames_.back(); }

    // The row of the member whose value comes next; null outside objects.
    const Field* open_field() {
        if (frames_.empty() || top().type != Frame::Type::kObject) return nullptr;
        if (top().field == kAnswerField) return &kAnsweredParticles;
        return &top().table->fields[static_cast<std::size_t>(top().field)];
    }

    bool pass_over_next() {
        left_.expect();
        return true;
    }
    bool pass_into() {
        if (left_.enter(frames_.size())) return true;
        return fail("nested deeper than " + std::to_string(limits::kMaxJsonDepth));
    }

    // Whether a key of the scene itself may stand there for an answer that comes back; what follows from it is done.
    bool key_of_answer(std::string_view name) {
        if (frames_.size() != 1) return false;
        switch (answer_.key(name)) {
            case AnswerInScene::Key::kParticles:
                top().field = kAnswerField;
                return true;
            case AnswerInScene::Key::kFollows:
                return pass_over_next();
            case AnswerInScene::Key::kNone:
                break;
        }
        return false;
    }

    bool end_answer(Frame& scene) {
        const std::uint64_t clouds = std::uint64_t{1} << find_field(*scene.table, "clouds");
        const std::uint64_t cubes = std::uint64_t{1} << find_field(*scene.table, "cubes");
        const auto made = answer_.end((scene.seen & (clouds | cubes)) != 0, draft);
        if (!made) {
            error = made.error();
            return false;
        }
        if (*made) scene.seen |= clouds;
        return true;
    }

    std::string pointer() const {
        std::string at;
        for (const Frame& frame : frames_) {
            if (frame.type != Frame::Type::kObject)
                at += "/" + std::to_string(frame.index);
            else if (frame.field == kAnswerField)
                at += "/particles";
            else if (frame.field >= 0)
                at += "/" +
                      std::string(frame.table->fields[static_cast<std::size_t>(frame.field)].name);
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
        if (const Field* const field = open_field()) return "must be " + wanted_of(*field);
        return std::string("must be ") +
               (top().type == Frame::Type::kList ? wanted_element(*top().list_field) : "a number");
    }

    bool wrong_type(const char* what) { return fail(wanted() + ", not " + what); }

    static std::string clipped(const std::string& number) {
        constexpr std::size_t kLongest = 40;
        return number.size() <= kLongest ? number : number.substr(0, kLongest) + "...";
    }

    bool integer(const Field& field, std::uint64_t value) {
        void* const place = put_field(field, top().object);
        if (field.access.holds == Holds::kInteger) {
            *static_cast<std::uint64_t*>(place) = value;
            return true;
        }
        if (value > INT_MAX)
            return fail("must be " + wanted_of(field) + ", not " + std::to_string(value));
        *static_cast<int*>(place) = static_cast<int>(value);
        return true;
    }

    bool number(double value) {
        value += 0.0;  // -0 is 0: equal scenes have equal bytes
        if (frames_.empty()) return wrong_type("a number");
        Frame& frame = top();
        switch (frame.type) {
            case Frame::Type::kObject: {
                const Field& field = *open_field();
                if (field.access.holds == Holds::kNumber)
                    *static_cast<double*>(put_field(field, frame.object)) = value;
                else if (field.one_for_all)
                    *static_cast<glm::dvec3*>(put_field(field, frame.object)) = glm::dvec3(value);
                else
                    return wrong_type("a number");
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
        if (frame.list_field->access.holds != Holds::kFloats) return wrong_type("a number");
        if (!has_room()) return false;
        append_to_list(frame.list, value);
        ++frame.index;
        return true;
    }

    // The regular part of a list of numbers that begins here (number_runs.h).
    void read_ahead() {
        Frame& frame = top();
        const Field& field = *frame.list_field;
        const std::uint64_t most = field.counts.highest;
        if (&field == &kAnsweredParticles) frame.index = take_answered(text, answer_.answer);
        if (field.access.holds == Holds::kFloats)
            frame.index = take_run<1>(text, most, [&](const std::array<double, 1>& v) {
                append_to_list(frame.list, v[0]);
            });
        if (is_of_rows(field))
            frame.index = take_run<3>(text, most, [&](const std::array<double, 3>& v) {
                append_row(field, frame.list, {v[0], v[1], v[2]});
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
        const std::uint64_t most = top().list_field->counts.highest;
        if (top().index < most) return true;
        return fail("at most " + std::to_string(most) + " elements are allowed");
    }

    bool push_object(const Table& table, void* object) {
        set_absent(table, object, false);
        return push({.type = Frame::Type::kObject, .table = &table, .object = object});
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
    LeftAlone left_;
    AnswerInScene answer_;
};

}  // namespace

Result<SceneDraft> parse_scene(std::string_view text) {
    // To the reader, a NUL is the end of the text, and whatever follows it would be passed over.
    if (text.find('\0') != std::string_view::npos)
        return Error{ErrorCode::kMalformed, "", "the text holds a NUL, which JSON does not allow"};
    SceneReader reader(text);
    try {
        json::sax_parse(TextIterator(reader.text), TextIterator(), &reader);
        if (reader.begins_with_preset) {
            const auto whole = with_preset(text);
            if (!whole.ok()) return whole.error();
            return parse_scene(*whole);
        }
    } catch (const std::exception& e) {
        Error error = error_of_thrown(e);
        if (error.code == ErrorCode::kInternal)
            error.message = "reading JSON failed: " + error.message;
        return error;
    }
    if (reader.error) return std::move(*reader.error);
    return std::move(reader.draft);
}

}  // namespace awan
