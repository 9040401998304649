// SceneDraft -> a document for people to go on with: a cube a line, defaults left out. A walk over the tables of
// core/scene, so what can be read is written.
#include <string>

#include "server/document/json.h"
#include "server/document/json_text.h"

namespace awan {
namespace {

// How deep an object stands: the scene 0, a cloud or the sun 1, ...
// `standards`: an object of the table with what need not be said.
void append_object(const Table& table, const void* object, const void* standards, int depth,
                   std::string& out);

// Elements a line each where people shape them by hand: cubes and clouds.
void append_objects(const Field& field, const void* list, int depth, std::string& out) {
    const std::size_t size = field.access.size(list);
    const bool lines = depth <= 1 && size > 0;
    const std::string indent(static_cast<std::size_t>(2 * depth + 2), ' ');
    out += '[';
    for (std::size_t i = 0; i < size; ++i) {
        if (i > 0) out += ',';
        if (lines) out += "\n" + indent + "  ";
        const Table& table = field.access.table();
        append_object(table, field.access.element(list, i), table.standard(), depth + 1, out);
    }
    if (lines) out += "\n" + indent;
    out += ']';
}

template <typename T, typename Append>
void append_list(const void* list, Append append, std::string& out) {
    const auto& values = *static_cast<const std::vector<T>*>(list);
    out += '[';
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) out += ',';
        append(values[i], out);
    }
    out += ']';
}

void append_switch(Switch value, std::string& out) {
    out += value == Switch::kOn ? "true" : value == Switch::kOff ? "false" : "\"auto\"";
}

void append_value(const Field& field, const void* value, int depth, std::string& out) {
    const auto number = [](float v, std::string& to) { append_json_number(v, to); };
    const auto vector = [](const auto& v, std::string& to) { append_json_vector(v, to); };
    switch (field.access.holds) {
        case Holds::kNumber:
            return append_json_number(*static_cast<const double*>(value), out);
        case Holds::kInteger:
            out += std::to_string(*static_cast<const std::uint64_t*>(value));
            return;
        case Holds::kInt:
            out += std::to_string(*static_cast<const int*>(value));
            return;
        case Holds::kVector:
            return append_json_vector(*static_cast<const glm::dvec3*>(value), out);
        case Holds::kWord:
            return append_json_string(field.words[field.access.word(value)], out);
        case Holds::kText:
            return append_json_string(*static_cast<const std::string*>(value), out);
        case Holds::kSwitch:
            return append_switch(*static_cast<const Switch*>(value), out);
        case Holds::kObjects:
            return append_objects(field, value, depth, out);
        case Holds::kFloats:
            return append_list<float>(value, number, out);
        case Holds::kPoints:
            return append_list<glm::dvec3>(value, vector, out);
        case Holds::kColors:
            return append_list<glm::vec3>(value, vector, out);
        case Holds::kObject:  // add_object
        case Holds::kAbsence:
        case Holds::kOutside:
            return;
    }
}

bool is_empty_list(const Field& field, const void* value) {
    switch (field.access.holds) {
        case Holds::kObjects:
            return field.access.size(value) == 0;
        case Holds::kFloats:
            return static_cast<const std::vector<float>*>(value)->empty();
        case Holds::kPoints:
            return static_cast<const std::vector<glm::dvec3>*>(value)->empty();
        case Holds::kColors:
            return static_cast<const std::vector<glm::vec3>*>(value)->empty();
        default:
            return false;
    }
}

// Whether a value that is there says no more than the default, which is there too.
bool is_standard(const Field& field, const void* value, const void* standard, const void* object) {
    switch (field.access.holds) {
        case Holds::kNumber:
            return *static_cast<const double*>(value) ==
                   (field.usual ? field.usual(object) : *static_cast<const double*>(standard));
        case Holds::kInteger:
            return *static_cast<const std::uint64_t*>(value) ==
                   *static_cast<const std::uint64_t*>(standard);
        case Holds::kInt:
            return *static_cast<const int*>(value) == *static_cast<const int*>(standard);
        case Holds::kVector:
            return *static_cast<const glm::dvec3*>(value) ==
                   *static_cast<const glm::dvec3*>(standard);
        case Holds::kWord:
            return field.access.word(value) == field.access.word(standard);
        case Holds::kText:
            return *static_cast<const std::string*>(value) ==
                   *static_cast<const std::string*>(standard);
        case Holds::kSwitch:
            return *static_cast<const Switch*>(value) == *static_cast<const Switch*>(standard);
        default:
            // A list that may be absent says something by being empty.
            return !field.access.optional && is_empty_list(field, value);
    }
}

class Members {
  public:
    Members(std::string& out, int depth) : out_(out), depth_(depth) { out_ += '{'; }

    // Names a member; its value comes next.
    std::string& name(const char* field) {
        if (!empty_) out_ += ',';
        empty_ = false;
        out_ += depth_ == 0 ? "\n  \"" : " \"";
        out_ += field;
        out_ += "\": ";
        return out_;
    }
    void end() { out_ += depth_ == 0 ? "\n}" : empty_ ? "}" : " }"; }

  private:
    std::string& out_;
    int depth_;
    bool empty_ = true;
};

void add_word(const char* word, const char* field, Members& members) {
    append_json_string(word, members.name(field));
}

// Objects that are always there say nothing by being empty; those that need not be do.
void add_object(const Field& field, const void* value, const void* standard, int depth,
                Members& members) {
    const Table& table = field.access.table();
    const bool usually_absent = standard == nullptr || is_absent(table, standard);
    if (is_absent(table, value)) {
        if (!usually_absent) add_word(absence_of(table)->absent, field.name, members);
        return;
    }
    std::string text;
    append_object(table, value, standard ? standard : table.standard(), depth + 1, text);
    if (text != "{}" || usually_absent) members.name(field.name) += text;
}

void add_member(const Field& field, const void* object, const void* standards, int depth,
                Members& members) {
    if (field.idle != nullptr && field.idle(object)) return;
    const void* const value = field.access.get(object);
    const void* const standard = field.access.get(standards);
    const auto is_unused = [&field](const void* of) {
        return field.access.unused != nullptr && *field.access.unused(of);
    };
    const bool unused = is_unused(object), usually_unused = is_unused(standards);
    if (value == nullptr || unused) {
        // Not given, where that is not what leaving it out means.
        if (field.absent != nullptr && (unused ? !usually_unused : standard != nullptr))
            add_word(field.absent, field.name, members);
        return;
    }
    if (field.access.holds == Holds::kObject)
        return add_object(field, value, standard, depth, members);
    const bool may_be_left_out = standard != nullptr && !usually_unused && !field.required;
    if (may_be_left_out && is_standard(field, value, standard, object)) return;
    if (field.of_model &&
        *field.of_model != static_cast<int>(static_cast<const Cloud*>(object)->model))
        return;
    append_value(field, value, depth, members.name(field.name));
}

void append_object(const Table& table, const void* object, const void* standards, int depth,
                   std::string& out) {
    Members members(out, depth);
    for (const Field& field : table.fields)
        if (field.in_documents()) add_member(field, object, standards, depth, members);
    members.end();
}

}  // namespace

std::string scene_to_json(const SceneDraft& scene) {
    std::string out;
    const Table& table = table_of<SceneDraft>();
    append_object(table, &scene, table.standard(), 0, out);
    return out + "\n";
}

std::string object_to_json(const Table& table, const void* object, const void* standards) {
    constexpr int kDeep = 2;
    std::string out;
    append_object(table, object, standards, kDeep, out);
    return out;
}

}  // namespace awan
