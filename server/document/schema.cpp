#include "server/document/schema.h"

#include <functional>
#include <limits>
#include <map>

#include "core/scene/fingerprint.h"
#include "core/scene/formula.h"
#include "core/scene/implicit.h"
#include "core/scene/layers.h"
#include "core/scene/limits.h"
#include "core/scene/rungs.h"
#include "core/scene/scene.h"
#include "core/scene/spheres.h"
#include "server/document/field_values.h"
#include "server/document/json.h"
#include "server/document/json_text.h"
#include "server/document/particle_answer.h"
#include "server/document/presets.h"

namespace awan {
namespace {

using json_text::member;
using json_text::name;

void words(const char* field, const char* value, std::string& out) {
    member(field, std::string_view(value), out);
}

// Schemas by name, each written once.
using Schemas = std::map<std::string, std::string>;

void ends(const Range& range, std::string& out) {
    const char* const lowest = range.above ? "exclusiveMinimum" : "minimum";
    member(lowest, range.lowest, out);
    if (range.highest < std::numeric_limits<double>::max()) member("maximum", range.highest, out);
}

// Whether numbers are kept as float32: what rounds to an end of their range is in it.
bool is_single(const Field& field) {
    return field.access.holds == Holds::kFloats || field.access.holds == Holds::kColors;
}

// One number: of a field, of a component, or of a list's element.
std::string number_schema(const Field& field) {
    std::string out = "{";
    words("type", field.whole ? "integer" : "number", out);
    if (is_single(field)) words("format", "float", out);
    ends(field.range, out);
    out += '}';
    if (!field.or_zero) return out;
    return R"({"anyOf":[{"type":"number","const":0},)" + out + "]}";
}

std::string array_schema(const std::string& items, std::uint64_t least, std::uint64_t most) {
    std::string out = "{";
    words("type", "array", out);
    name("items", out);
    out += items;
    if (least > 0) member("minItems", least, out);
    member("maxItems", most, out);
    return out + '}';
}

std::string integer_schema(const Field& field) {
    std::string out = "{";
    words("type", "integer", out);
    member("minimum", field.counts.lowest, out);
    member("maximum", field.counts.highest, out);
    return out + '}';
}

std::string word_list(std::span<const char* const> words) {
    std::string out = "[";
    for (const char* const word : words) {
        if (out.size() > 1) out += ',';
        append_json_string(word, out);
    }
    return out + ']';
}

std::string words_schema(std::span<const char* const> words) {
    return R"({"type":"string","enum":)" + word_list(words) + '}';
}

std::string reference(const std::string& schema) {
    return R"({"$ref":"#/components/schemas/)" + schema + "\"}";
}

std::string layers_schema() {
    std::string names;
    for (const char* const word : kLayerWords)
        names += (names.empty() ? "" : "|") + std::string(word);
    return R"({"type":"string","pattern":"^(all|none|()" + names + ")(,(" + names +
           R"())*)$","examples":["none","all","depth,sun"]})";
}

// Names of textures with commas between.
std::string textures_schema() {
    const std::string name = "[A-Za-z0-9][A-Za-z0-9._-]*";
    return R"({"type":"string","pattern":"^)" + name + "(," + name +
           R"()*$","examples":["puff","wisp,hard"]})";
}

// What a formula may say is no pattern; its names and functions are told.
std::string formula_schema(const Field& field) {
    std::string out = R"({"type":"string","maxLength":)" + std::to_string(most_bytes(field));
    out += R"x(,"examples":["density * (0.3 + height)",)x"
           R"x("a = noise(x / 40, y / 40, z / 40); density * smoothstep(-0.2, 0.4, a)"])x"
           R"x(,"x-names":{)x";
    for (const FormulaName& input : kFormulaInputs) words(input.name, input.says, out);
    words("pi", "3.14159", out);
    out += R"(},"x-functions":{)";
    for (const FormulaFunction& f : kFormulaFunctions) {
        std::string call = std::string(f.name) + '(';
        for (int i = 0; i < f.takes; ++i) call += std::string(i > 0 ? ", " : "") + "abcd"[i];
        words((call + (f.more ? ", ...)" : ")")).c_str(), f.says, out);
    }
    return out + "}}";
}

// A name; of a rung, one of those there are; of a texture, those that are always there as examples.
std::string text_schema(const Field& field) {
    if (std::string_view(field.name) == "rung") return reference("Rung");
    if (std::string_view(field.name) == "layers") return layers_schema();
    if (std::string_view(field.name) == "textures") return textures_schema();
    if (std::string_view(field.name) == "texture" || std::string_view(field.name) == "map")
        return reference("TextureName");
    if (std::string_view(field.name) == "formula") return formula_schema(field);
    return R"({"type":"string","maxLength":)" + std::to_string(most_bytes(field)) + '}';
}

// The alternatives, each a schema; one stands alone.
std::string any_of(const std::vector<std::string>& schemas) {
    if (schemas.size() == 1) return schemas[0];
    std::string out = R"({"oneOf":[)";
    for (std::size_t i = 0; i < schemas.size(); ++i) out += (i > 0 ? "," : "") + schemas[i];
    return out + "]}";
}

std::string object_schema(const Table& table, const void* standards, Schemas& schemas);
std::string object_members(const Table& table, const void* standards, std::optional<int> model,
                           Schemas& schemas);

// Named, unless its defaults are other than those of its kind.
std::string object_reference(const Table& table, const void* standards, Schemas& schemas) {
    const bool usual = standards == nullptr ||
                       fingerprint_of(table, standards) == fingerprint_of(table, table.standard());
    // Its field describes it.
    if (!usual) return '{' + object_members(table, standards, {}, schemas) + '}';
    if (!schemas.contains(table.name)) {
        // A mark first: what refers to itself ends.
        schemas[table.name] = "{}";
        schemas[table.name] = object_schema(table, table.standard(), schemas);
    }
    return reference(table.name);
}

std::string value_schema(const Field& field, const void* standard, Schemas& schemas) {
    const auto [least, most] = field.counts;
    const std::string number = number_schema(field);
    switch (field.access.holds) {
        case Holds::kNumber:
            return number;
        case Holds::kInteger:
        case Holds::kInt:
            return integer_schema(field);
        case Holds::kVector:
            return array_schema(number, 3, 3);
        case Holds::kWord:
            return words_schema(field.words);
        case Holds::kText:
            return text_schema(field);
        case Holds::kSwitch:
            return R"({"type":"boolean"})";
        case Holds::kObject:
            return object_reference(field.access.table(), standard, schemas);
        case Holds::kObjects:
            return array_schema(object_reference(field.access.table(), nullptr, schemas), least,
                                most);
        case Holds::kFloats:
            return array_schema(number, least, most);
        case Holds::kPoints:
        case Holds::kColors:
            return array_schema(array_schema(number, 3, 3), least, most);
        case Holds::kAbsence:
        case Holds::kOutside:
            return "{}";
    }
    return "{}";
}

// What may stand for the field: its value, one number for a vector, words.
std::vector<std::string> alternatives(const Field& field, const void* standard, Schemas& schemas) {
    std::vector<std::string> all;
    if (field.one_for_all) all.push_back(number_schema(field));
    all.push_back(value_schema(field, standard, schemas));
    std::vector<const char*> instead;
    if (field.access.holds == Holds::kObject) {
        const Table& table = field.access.table();
        if (const Field* const absence = absence_of(table)) instead.push_back(absence->absent);
        for (const Field& inner : table.fields)
            if (table.shorthand != nullptr && std::string_view(inner.name) == table.shorthand)
                instead.insert(instead.end(), inner.words.begin(), inner.words.end());
    }
    if (field.absent != nullptr) instead.push_back(field.absent);
    if (!instead.empty()) all.push_back(words_schema(instead));
    return all;
}

void add_default(const Field& field, const void* standards, std::string& out) {
    const void* const value = field.access.get(standards);
    if (field.required || field.access.holds == Holds::kObjects) return;
    if (field.usual != nullptr) return member("default", field.usual(standards), out);
    if (field.access.unused != nullptr && *field.access.unused(standards))
        return words("default", field.absent, out);
    switch (field.access.holds) {
        case Holds::kNumber:
            if (value) member("default", *static_cast<const double*>(value), out);
            break;
        case Holds::kInteger:
            if (value) member("default", *static_cast<const std::uint64_t*>(value), out);
            break;
        case Holds::kInt:
            if (value) member("default", *static_cast<const int*>(value), out);
            break;
        case Holds::kVector:
            if (value) {
                name("default", out);
                append_json_vector(*static_cast<const glm::dvec3*>(value), out);
            }
            break;
        case Holds::kWord:
            if (value) words("default", field.words[field.access.word(value)], out);
            break;
        case Holds::kText:
            if (value) words("default", static_cast<const std::string*>(value)->c_str(), out);
            break;
        case Holds::kSwitch:
            words("default", "auto", out);
            break;
        case Holds::kObject: {
            const Table& table = field.access.table();
            if (value && is_absent(table, value)) words("default", absence_of(table)->absent, out);
            // None of its fields has one: they exclude each other.
            if (&table == &table_of<Accuracy>()) {
                name("default", out);
                out += '{';
                member("error", kDefaultError, out);
                out += '}';
            }
            break;
        }
        default:
            break;
    }
    if (!value && field.absent != nullptr && field.access.unused == nullptr)
        words("default", field.absent, out);
}

std::string field_schema(const Field& field, const void* standards, Schemas& schemas) {
    std::string out = any_of(alternatives(field, field.access.get(standards), schemas));
    out.pop_back();  // its bracket: there is more to say
    words("description", field.says, out);
    if (field.unit != nullptr) words("x-unit", field.unit, out);
    add_default(field, standards, out);
    if (field.otherwise != nullptr) words("x-otherwise", field.otherwise, out);
    return out + '}';
}

// The members of one object, those of a cloud only of its model.
std::string object_members(const Table& table, const void* standards, std::optional<int> model,
                           Schemas& schemas) {
    std::string properties, required;
    for (const Field& field : table.fields) {
        if (!field.in_documents()) continue;
        if (field.of_model && field.of_model != model) continue;
        if (!properties.empty()) properties += ',';
        append_json_string(field.name, properties);
        properties += ':' + field_schema(field, standards, schemas);
        if (!field.required) continue;
        if (!required.empty()) required += ',';
        append_json_string(field.name, required);
    }
    // Keys that nobody reads may stand in every object.
    std::string out =
        R"("type":"object","properties":{)" + properties +
        R"(},"patternProperties":{"^(_.*|name|description|\\$schema)$":{}},"additionalProperties":false)";
    if (!required.empty()) out += ",\"required\":[" + required + ']';
    return out;
}

std::string capitalised(std::string word) {
    word[0] = static_cast<char>(word[0] - 'a' + 'A');
    return word;
}

// A schema for clouds of each model, and that one of them holds.
std::string cloud_schema(const Table& table, const void* standards, Schemas& schemas) {
    std::vector<std::string> models;
    for (std::size_t i = 0; i < std::size(kCloudModelWords); ++i) {
        const std::string word = kCloudModelWords[i];
        const std::string schema = capitalised(word) + "Cloud";
        std::string members = object_members(table, standards, static_cast<int>(i), schemas);
        // Which model it is: the word, and nothing else. Cubes are what a cloud is that does not say.
        const std::string all = word_list(kCloudModelWords);
        members.replace(members.find(all), all.size(), "[\"" + word + "\"]");
        const std::string standard = R"("default":"cubes")";
        if (i != static_cast<std::size_t>(CloudModel::kCubes)) {
            const std::size_t at = members.find("," + standard);
            members.erase(at, standard.size() + 1);
            const std::size_t list = members.rfind("\"required\":[") + 12;
            members.insert(list, "\"model\",");
        }
        schemas[schema] = '{' + members + '}';
        models.push_back(reference(schema));
    }
    return any_of(models);
}

// What the fields come to that a preset decides: a member for each word of the field `by`, `object` of its place there.
void add_presets(const char* by, std::span<const char* const> words,
                 const std::function<std::string(std::size_t)>& object, std::string& out) {
    member("x-presets-by", std::string_view(by), out);
    name("x-presets", out);
    out += '{';
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) out += ',';
        append_json_string(words[i], out);
        out += ':' + object(i);
    }
    out += '}';
}

std::string implicit_preset(std::size_t preset) {
    ImplicitCloud cloud;
    cloud.preset = static_cast<ImplicitPreset>(preset);
    const ImplicitCloud all = spelled_out(cloud);
    return object_to_json(table_of<ImplicitCloud>(), &all, &cloud);
}

std::string spheres_of_kind(std::size_t kind) {
    SpheresCloud cloud;
    cloud.kind = static_cast<SpheresKind>(kind);
    SpheresCloud all = cloud;
    all.ratio_min = ratios_of(cloud).low;
    all.ratio_max = ratios_of(cloud).high;
    all.shift_min = shifts_of(cloud).low;
    all.shift_max = shifts_of(cloud).high;
    return object_to_json(table_of<SpheresCloud>(), &all, &cloud);
}

std::string sky_of_model(std::size_t model) {
    Sky sky;
    sky.physical = model == 1;
    std::string out = "{";
    for (const Field& field : kSkyFields)
        if (field.usual != nullptr) member(field.name, field.usual(&sky), out);
    return out + '}';
}

// Whatever one of its words decides about the rest of an object.
void add_presets_of(const Table& table, std::string& out) {
    if (&table == &table_of<ImplicitCloud>())
        add_presets("preset", kImplicitPresetWords, implicit_preset, out);
    if (&table == &table_of<SpheresCloud>())
        add_presets("kind", kSpheresKindWords, spheres_of_kind, out);
    if (&table == &table_of<Sky>()) add_presets("model", kSkyModelWords, sky_of_model, out);
}

void insert_property(std::string_view property, std::string& schema) {
    constexpr std::string_view kProperties = "\"properties\":{";
    schema.insert(schema.find(kProperties) + kProperties.size(), property);
}

std::string object_schema(const Table& table, const void* standards, Schemas& schemas) {
    if (&table == &table_of<Cloud>()) return cloud_schema(table, standards, schemas);
    std::string out = '{' + object_members(table, standards, {}, schemas);
    words("description", table.says, out);
    if (&table == &table_of<SceneDraft>())
        out +=
            R"(,"oneOf":[{"required":["cubes"]},{"required":["clouds"]}],"example":{"cubes":[{"particles":200,)"
            R"("size":[7.4,1.07,2.9],"center":[-3.4,-3.3,-0.6],"radius":2.1}]})";
    if (&table == &table_of<Accuracy>()) out += R"(,"minProperties":1,"maxProperties":1)";
    add_presets_of(table, out);
    return out + '}';
}

// A document in which ready particles stand in place of cubes and clouds, as /v1/particles answers.
std::string scene_of_particles(Schemas& schemas) {
    Table scene = table_of<SceneDraft>();
    std::vector<Field> rest;
    for (const Field& field : scene.fields)
        if (field.name != std::string_view("cubes") && field.name != std::string_view("clouds"))
            rest.push_back(field);
    scene.fields = rest;
    std::string out = '{' + object_members(scene, scene.standard(), {}, schemas);
    const ParticleAnswer none;
    const std::string own =
        "\"particles\":" + field_schema(kAnsweredParticles, &none, schemas) +
        R"(,"count":{"description":"Not read: the list says it."},"bounds":{"description":"Not read."},)";
    insert_property(own, out);
    words("description", "An answer of /v1/particles, with whatever else a scene has.", out);
    return out + R"(,"required":["particles"]})";
}

// A document that begins with a preset, whose place its other members take (presets.h).
std::string scene_of_preset(Schemas& schemas) {
    const Table& scene = table_of<SceneDraft>();
    std::string out = '{' + object_members(scene, scene.standard(), {}, schemas);
    std::string own = "\"preset\":{";
    std::vector<std::string> names;
    for (const PresetEntry& preset : preset_entries()) {
        names.emplace_back(preset.name);
        if (!preset.genus.empty()) names.emplace_back(preset.genus);
    }
    own += "\"enum\":[";
    for (const std::string& name : names) {
        if (&name != &names.front()) own += ',';
        append_json_string(name, own);
    }
    insert_property(own + "]},", out);
    words("description", "A preset with what is to be otherwise, merged into it as RFC 7396 says.",
          out);
    return out + R"(,"required":["preset"]})";
}

}  // namespace

std::string scene_schemas() {
    Schemas schemas;
    object_reference(table_of<SceneDraft>(), nullptr, schemas);
    schemas["SceneOfParticles"] = scene_of_particles(schemas);
    schemas["SceneOfPreset"] = scene_of_preset(schemas);
    std::vector<const char*> rungs;
    for (const Rung& rung : ladder()) rungs.push_back(rung.name);
    schemas["Rung"] = words_schema(rungs);
    std::vector<const char*> textures;
    for (const OwnTexture& own : kOwnTextures) textures.push_back(own.name);
    schemas["TextureName"] =
        R"({"type":"string","pattern":"^[A-Za-z0-9][A-Za-z0-9._-]{0,63}$","examples":)" +
        word_list(textures) +
        R"(,"description":"Of one of these, of one that was uploaded, a texture's hash (32 hex digits), or none."})";
    std::string out;
    for (const auto& [schema, text] : schemas) {
        if (!out.empty()) out += ",\n";
        append_json_string(schema, out);
        out += ": " + text;
    }
    return out;
}

}  // namespace awan
