// The contract and the service say the same: whatever the scene part of /openapi.json says of a document (defaults,
// both ends of every range, words, what is required) is what is read, checked and written. The schemas are walked; no
// field is named here. Fields that need others beside them: contract_companions.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/fingerprint.h"
#include "server/document/json.h"
#include "tests/contract_companions.h"
#include "tests/contract_schema.h"
#include "tests/contract_values.h"
#include "tests/scene_checks.h"

namespace awan::contract {
namespace {

using Pointer = json::json_pointer;
using scene_checks::read;

std::string shown(const json& document) {
    return document.dump().substr(0, 400);
}

// --- one document

// Written, it is the same scene, and written again the same text.
void expect_written_back(const std::string& text, const std::string& fingerprint_before) {
    const Result<SceneDraft> draft = parse_scene(text);
    ASSERT_TRUE(draft.ok());
    const std::string written = scene_to_json(*draft);
    const Result<SceneDraft> again = parse_scene(written);
    ASSERT_TRUE(again.ok()) << again.error().pointer << ": " << again.error().message << "\n"
                            << written.substr(0, 1000);
    EXPECT_EQ(scene_to_json(*again), written) << text.substr(0, 400);
    const Table& table = table_of<SceneDraft>();
    EXPECT_EQ(fingerprint_of(table, &*again), fingerprint_of(table, &*draft))
        << text.substr(0, 400) << "\n"
        << written.substr(0, 1000);
    const Result<Scene> scene = validate(*again);
    ASSERT_TRUE(scene.ok()) << scene.error().pointer << ": " << scene.error().message;
    EXPECT_EQ(fingerprint(*scene), fingerprint_before) << text.substr(0, 400);
}

// What /openapi.json says a body may be.
bool is_document(const Contract& contract, const json& document) {
    return 1 ==
           static_cast<int>(contract.allows(contract.named("Scene"), document)) +
               static_cast<int>(contract.allows(contract.named("SceneOfParticles"), document)) +
               static_cast<int>(contract.allows(contract.named("SceneOfPreset"), document));
}

void expect_refused(const Contract& contract, const json& document, const std::string& pointer) {
    EXPECT_FALSE(is_document(contract, document)) << shown(document);
    const Result<Scene> scene = read(document.dump());
    ASSERT_FALSE(scene.ok()) << "not refused: " << pointer << "\n" << shown(document);
    EXPECT_EQ(scene.error().pointer, pointer) << scene.error().message << "\n" << shown(document);
    EXPECT_TRUE(scene.error().code == ErrorCode::kInvalidScene ||
                scene.error().code == ErrorCode::kUnsupported)
        << scene.error().message;
}

// --- the walk

// An object in a document that may stand there.
struct Site {
    Alternative object;
    json document;
    Pointer at;
    // Members of objects that might stand there instead, with a value for each.
    std::map<std::string, json> foreign;

    const json& properties() const { return object.schema->at("properties"); }
};

// A document that was taken.
struct Taken {
    // Of the property, put in one way for what may be written in several; null: not to be compared.
    json value;
    json document;
    // Beside the object; null: none.
    const Companion* companion;
    std::string fingerprint;
};

class Walk {
  public:
    void everything() {
        const Alternative scene{"Scene", &contract_.named("Scene")};
        visit({scene, values_.ordinary(scene), Pointer(), {}});
        for (const json& wrong : {json(), json(true), json(1.5), json("x"), json::array()})
            expect_refused(contract_, wrong, "");
        // Its other members are the scene's.
        const Alternative answer{"SceneOfParticles", &contract_.named("SceneOfParticles")};
        visited_.insert(answer.name);
        visit_property({answer, values_.ordinary(answer), Pointer(), {}}, "particles");
        // Replaced by a document of the scene before anything is looked at (presets_test tries each).
        visited_.insert("SceneOfPreset");
    }

    // After the walk.
    void expect_all_used() const {
        for (const auto& [name, schema] : contract_.schemas().items())
            if (schema.contains("properties")) {
                EXPECT_TRUE(visited_.contains(name)) << name << " is in no document";
            }
        for (const Companion& one : kCompanions)
            EXPECT_TRUE(used_.contains(&one))
                << "no longer needed: " << one.object << "/" << one.property << ": " << one.reason;
        for (const OutOfReach& one : kOutOfReach)
            EXPECT_TRUE(used_.contains(&one)) << "in reach: " << one.object << "/" << one.property;
        for (const Silent& one : kSilent)
            EXPECT_TRUE(used_.contains(&one))
                << "not silent: " << one.object << "/" << one.property;
    }

  private:
    void visit(const Site& site) {
        const ::testing::ScopedTrace trace(__FILE__, __LINE__,
                                           site.object.name + " at " + site.at.to_string());
        visited_.insert(site.object.name);
        EXPECT_EQ(site.object.schema->value("additionalProperties", json(true)), json(false));
        expect_strangers_refused(site);
        expect_needed(site);
        for (const auto& [name, schema] : site.properties().items()) visit_property(site, name);
        for (const auto& [name, schema] : site.properties().items())
            for (const json& word : schema.value("enum", json::array()))
                expect_defaults_beside(site, name, word);
    }

    // Defaults hold whatever words the object has, but for what the schema says each word decides.
    void expect_defaults_beside(const Site& site, const std::string& name, const json& word) {
        const ::testing::ScopedTrace trace(__FILE__, __LINE__, name + ": " + word.dump());
        const std::optional<Taken> taken = take(site, name, word);
        ASSERT_TRUE(taken.has_value());
        json decided = json::object();
        const json& schema = *site.object.schema;
        if (schema.value("x-presets-by", "") == name) decided = schema.at("x-presets").at(word);
        json spelled_out = taken->document;
        spelled_out[site.at].update(decided);
        const Result<Scene> scene = read(spelled_out.dump());
        ASSERT_TRUE(scene.ok()) << scene.error().message << "\n" << shown(spelled_out);
        EXPECT_EQ(fingerprint(*scene), taken->fingerprint) << shown(spelled_out);
        for (const auto& [other, says] : site.properties().items()) {
            if (!says.contains("default") || spelled_out[site.at].contains(other)) continue;
            json document = spelled_out;
            document[site.at][other] = says.at("default");
            const Result<Scene> same = read(document.dump());
            if (same) {
                EXPECT_EQ(fingerprint(*same), taken->fingerprint) << shown(document);
            } else {  // it does not belong beside that word
                EXPECT_EQ(same.error().pointer, (site.at / other).to_string());
            }
        }
    }

    void visit_property(const Site& site, const std::string& name) {
        const ::testing::ScopedTrace trace(__FILE__, __LINE__, name);
        const json& schema = site.properties().at(name);
        const json standard = schema.value("default", json());
        const std::string named = site.object.name + "/" + name;
        std::vector<json> values;
        for (const Alternative& one : contract_.alternatives(named, schema))
            for (json& value : values_.at_ends(one, standard)) values.push_back(std::move(value));
        if (schema.contains("default")) values.push_back(standard);
        std::vector<Taken> taken;
        for (const json& value : values)
            if (std::optional<Taken> it = take(site, name, value)) taken.push_back(std::move(*it));
        leave_out(site, name, taken);
        compare(site, name, taken);
        for (const Wrong& wrong : values_.beyond(named, schema, standard))
            expect_refused(contract_, with(site, name, wrong.value),
                           (site.at / name).to_string() + wrong.place);
        for (const Alternative& one : contract_.alternatives(named, schema))
            visit_objects(site, name, one);
    }

    // Those that a property holds.
    void visit_objects(const Site& site, const std::string& name, const Alternative& held) {
        const json& schema = *held.schema;
        if (schema.contains("properties")) {
            const json document = with(site, name, values_.ordinary(held));
            if (auto taken = take_document(document, {{held.name, "", site.at / name}}))
                visit({held, taken->document, site.at / name, {}});
        }
        if (!Values::is_list_of_objects(schema)) return;
        const auto elements = contract_.alternatives(held.name, schema.at("items"));
        for (const Alternative& element : elements) {
            const json document = with(site, name, json::array({values_.ordinary(element)}));
            const Pointer at = site.at / name / 0;
            if (auto taken = take_document(document, {{element.name, "", at}}))
                visit({element, taken->document, at, foreign_to(element, elements)});
        }
    }

    std::map<std::string, json> foreign_to(const Alternative& own,
                                           const std::vector<Alternative>& all) const {
        std::map<std::string, json> foreign;
        for (const Alternative& other : all)
            for (const auto& [name, schema] : other.schema->at("properties").items())
                if (!own.schema->at("properties").contains(name))
                    foreign[name] = values_.ordinary(other.name, schema);
        return foreign;
    }

    // --- documents

    // The property set, and what cannot stand beside it taken away.
    json with(const Site& site, const std::string& name, const json& value) const {
        json document = site.document;
        json& object = document[site.at];
        const json& schema = *site.object.schema;
        if (schema.value("maxProperties", 0) == 1) object = json::object();
        if (schema.contains("oneOf"))
            for (const json& one : schema.at("oneOf"))
                for (const json& other : one.at("required")) object.erase(other.get<std::string>());
        if (schema.contains("oneOf") && !is_one_of(schema, name))
            for (const std::string& needed : Values::needed(schema))
                object[needed] = values_.ordinary("", schema.at("properties").at(needed));
        object[name] = value;
        return document;
    }
    static bool is_one_of(const json& schema, const std::string& name) {
        for (const json& one : schema.at("oneOf"))
            for (const json& required : one.at("required"))
                if (required == name) return true;
        return false;
    }

    struct Key {
        std::string object;
        std::string property;
        Pointer at;  // the object
    };

    // Alone, or with what it needs beside it.
    std::optional<Taken> take_document(const json& document, const std::vector<Key>& keys) {
        const Result<Scene> alone = read(document.dump());
        if (alone) return taken(document, nullptr, *alone);
        for (const Key& key : keys)
            for (const Companion& one : kCompanions) {
                if (!belongs(one.object, one.property, key.object, key.property)) continue;
                const std::optional<json> more = beside(one, document, key.at);
                if (!more) continue;
                const Result<Scene> scene = read(more->dump());
                if (!scene) continue;
                used_.insert(&one);
                const bool within = key.property.empty();
                return taken(*more, within ? nullptr : &one, *scene);
            }
        for (const Key& key : keys)
            for (const OutOfReach& one : kOutOfReach)
                if (belongs(one.object, one.property, key.object, key.property) &&
                    contains(document.at(key.at).at(one.property), one.end) &&
                    alone.error().pointer.starts_with(key.at.to_string())) {
                    used_.insert(&one);
                    return std::nullopt;
                }
        ADD_FAILURE() << "refused: " << alone.error().pointer << ": " << alone.error().message
                      << "\n"
                      << shown(document);
        return std::nullopt;
    }
    static bool contains(const json& vector, double number) {
        return std::find(vector.begin(), vector.end(), json(number)) != vector.end();
    }

    static std::optional<json> beside(const Companion& one, json document, const Pointer& at) {
        if (!document.contains(at)) return std::nullopt;
        one.put_beside(document, document[at]);
        return document;
    }

    Taken taken(const json& document, const Companion* companion, const Scene& scene) const {
        EXPECT_TRUE(is_document(contract_, document)) << shown(document);
        const std::string print = fingerprint(scene);
        expect_written_back(document.dump(), print);
        return {json(), document, companion, print};
    }

    std::optional<Taken> take(const Site& site, const std::string& name, const json& value) {
        std::vector<Key> keys{{site.object.name, name, site.at}};
        const std::string own = site.object.name + "/" + name;
        for (const Alternative& one : contract_.alternatives(own, site.properties().at(name)))
            keys.push_back({one.name, "", site.at / name});
        std::optional<Taken> it = take_document(with(site, name, value), keys);
        if (it) it->value = in_one_way(site, name, value);
        return it;
    }

    // --- what is the same, and what is not

    // What may be written in several ways: a number for all components of a vector, a word for an object with it.
    json in_one_way(const Site& site, const std::string& name, const json& value) const {
        const json& schema = site.properties().at(name);
        const auto all = contract_.alternatives(site.object.name + "/" + name, schema);
        if (value.is_number())
            for (const Alternative& one : all)
                if (one.schema->at("type") == "array")
                    return json(one.schema->at("minItems").get<std::size_t>(), value);
        for (const Alternative& one : all) {
            if (one.schema->at("type") != "string" || !one.schema->contains("enum")) continue;
            for (const json& word : one.schema->at("enum"))
                if (const std::optional<std::string> member = member_with(all, word)) {
                    if (value == word) return json{{*member, word}};
                    if (value.is_object()) return json{{*member, default_of(all, *member)}};
                }
        }
        return value;
    }
    // Of the object among the alternatives: the member that may be the word.
    static std::optional<std::string> member_with(const std::vector<Alternative>& all,
                                                  const json& word) {
        for (const Alternative& one : all)
            if (one.schema->contains("properties"))
                for (const auto& [name, schema] : one.schema->at("properties").items())
                    if (is_word_of(schema, word)) return name;
        return std::nullopt;
    }
    static bool is_word_of(const json& schema, const json& word) {
        // A word in the place of an object says that it is not there.
        if (schema.contains("oneOf"))
            for (const json& one : schema.at("oneOf"))
                if (one.contains("$ref") || one.contains("properties")) return false;
        if (schema.contains("enum"))
            for (const json& one : schema.at("enum"))
                if (one == word) return true;
        if (schema.contains("oneOf"))
            for (const json& one : schema.at("oneOf"))
                if (is_word_of(one, word)) return true;
        return false;
    }
    static json default_of(const std::vector<Alternative>& all, const std::string& member) {
        for (const Alternative& one : all)
            if (one.schema->contains("properties"))
                return one.schema->at("properties").at(member).value("default", json());
        return {};
    }

    // Adds the documents without the property, which then has its default.
    void leave_out(const Site& site, const std::string& name, std::vector<Taken>& taken) const {
        const json& schema = site.properties().at(name);
        if (!schema.contains("default")) return;
        // To give one of these says more than its value. Beside what it says, its default is tried with the words.
        if (decides_by_being_there(site.object.name, name)) return;
        const json standard = in_one_way(site, name, schema.at("default"));
        EXPECT_TRUE(contract_.allows(schema, schema.at("default")));
        json document = site.document;
        document[site.at].erase(name);
        std::set<const Companion*> companions{nullptr};
        for (const Taken& one : taken) companions.insert(one.companion);
        for (const Companion* const companion : companions) {
            const std::optional<json> it =
                companion ? beside(*companion, document, site.at) : document;
            const Result<Scene> scene = read(it->dump());
            EXPECT_TRUE(scene.ok() || companion != nullptr) << shown(*it);
            if (!scene) continue;
            taken.push_back({standard, *it, companion, fingerprint(*scene)});
        }
    }

    // Equal values have equal fingerprints, and others have others.
    void compare(const Site& site, const std::string& name, const std::vector<Taken>& taken) {
        std::set<json> values;
        for (const Taken& one : taken) values.insert(one.value);
        std::size_t others = 0;
        for (std::size_t i = 0; i < taken.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const Taken &a = taken[i], &b = taken[j];
                if (a.companion != b.companion) continue;
                if (a.value == b.value) {
                    EXPECT_EQ(a.fingerprint, b.fingerprint) << shown(a.document) << "\n"
                                                            << shown(b.document);
                    continue;
                }
                ++others;
                EXPECT_TRUE(a.fingerprint != b.fingerprint || differ_after_all(site, name, a, b))
                    << "the same fingerprint\n"
                    << shown(a.document) << "\n"
                    << shown(b.document);
            }
        if (values.size() > 1) {
            EXPECT_GT(others, 0u) << "nothing to compare with";
        }
    }

    // With a companion, or in what is written where they are silent.
    bool differ_after_all(const Site& site, const std::string& name, const Taken& a,
                          const Taken& b) {
        for (const Silent& one : kSilent)
            if (belongs(one.object, one.property, site.object.name, name)) {
                used_.insert(&one);
                return written(a) != written(b);
            }
        for (const Companion& one : kCompanions) {
            if (!belongs(one.object, one.property, site.object.name, name)) continue;
            const Result<Scene> c = read(beside(one, a.document, site.at)->dump());
            const Result<Scene> d = read(beside(one, b.document, site.at)->dump());
            if (!c || !d || fingerprint(*c) == fingerprint(*d)) continue;
            used_.insert(&one);
            return true;
        }
        return false;
    }
    static std::string written(const Taken& one) {
        return scene_to_json(*parse_scene(one.document.dump()));
    }

    // --- members that may not, or must, be there

    void expect_strangers_refused(const Site& site) const {
        std::map<std::string, json> strangers = site.foreign;
        strangers["no_such_field"] = 1;
        for (const auto& [name, value] : strangers) {
            json document = site.document;
            document[site.at][name] = value;
            expect_refused(contract_, document, (site.at / name).to_string());
        }
    }

    void expect_needed(const Site& site) const {
        const json& schema = *site.object.schema;
        const std::string at = site.at.to_string();
        for (const json& name : schema.value("required", json::array()))
            expect_required(site, name.get<std::string>());
        if (schema.contains("oneOf")) {
            json none = site.document, all = site.document;
            for (const json& one : schema.at("oneOf"))
                for (const json& name : one.at("required")) {
                    none[site.at].erase(name.get<std::string>());
                    all[site.at][name.get<std::string>()] =
                        values_.ordinary("", schema.at("properties").at(name));
                }
            expect_refused(contract_, none, at);
            expect_refused(contract_, all, at);
        }
        if (!schema.contains("minProperties")) return;
        json none = site.document;
        none[site.at] = json::object();
        expect_refused(contract_, none, at);
        for (const auto& [name, one] : schema.at("properties").items())
            for (const auto& [other_name, other] : schema.at("properties").items()) {
                if (name == other_name) continue;
                json two = none;
                two[site.at][name] = values_.ordinary("", one);
                two[site.at][other_name] = values_.ordinary("", other);
                expect_refused(contract_, two, at);
            }
    }

    void expect_required(const Site& site, const std::string& name) const {
        json document = site.document;
        document[site.at].erase(name);
        const json words = site.properties().at(name).value("enum", json::array());
        if (words.size() != 1) return expect_refused(contract_, document, site.at.to_string());
        // A word that says which object it is: without it the others do not belong.
        EXPECT_FALSE(is_document(contract_, document)) << shown(document);
        const Result<Scene> scene = read(document.dump());
        ASSERT_FALSE(scene.ok()) << shown(document);
        const Pointer stranger(scene.error().pointer);
        EXPECT_EQ(stranger.parent_pointer(), site.at);
        EXPECT_TRUE(document.contains(stranger)) << scene.error().pointer;
    }

    Contract contract_;
    Values values_{contract_};
    std::set<std::string> visited_;
    // Rows of contract_companions.h.
    std::set<const void*> used_;
};

TEST(Contract, SaysWhatTheServiceDoes) {
    Walk walk;
    walk.everything();
    walk.expect_all_used();
}

// --- the schemas themselves

void expect_references(const Contract& contract, const json& schema) {
    if (schema.is_object() && schema.contains("$ref")) {
        EXPECT_TRUE(contract.schemas().contains(Contract::name_of(schema.at("$ref"))))
            << schema.at("$ref");
    }
    for (const json& inner : schema)
        if (inner.is_structured()) expect_references(contract, inner);
}

TEST(Contract, EveryReferenceLeadsToASchema) {
    const Contract contract;
    EXPECT_TRUE(contract.schemas().contains("Scene"));
    expect_references(contract, contract.schemas());
}

// What holds where the field is not given. An object or a list that is not given is none, or one of the defaults; of an
// object with one member no other is to be given.
void expect_said_when_left_out(const Alternative& object, const Field& field, const json& schema) {
    const bool held = field.access.table != nullptr || field.access.holds == Holds::kFloats ||
                      field.access.holds == Holds::kPoints || field.access.holds == Holds::kColors;
    if (field.required || held || object.schema->contains("maxProperties")) return;
    EXPECT_TRUE(schema.contains("default") || schema.contains("x-otherwise") ||
                schema.value("enum", json::array()).size() == 1);
}

// Every field of a table is in the schema of its object, of clouds in that of its model.
void expect_fields(const Contract& contract, const Table& table,
                   const std::vector<Alternative>& objects, const std::string& name) {
    for (const Field& field : table.fields) {
        if (!field.in_documents()) continue;
        const ::testing::ScopedTrace trace(__FILE__, __LINE__, name + "/" + field.name);
        std::size_t found = 0;
        for (const Alternative& object : objects) {
            const json& properties = object.schema->at("properties");
            if (!properties.contains(field.name)) continue;
            ++found;
            const json& schema = properties.at(field.name);
            EXPECT_FALSE(schema.value("description", "").empty());
            expect_said_when_left_out(object, field, schema);
            if (field.access.table == nullptr) continue;
            std::vector<Alternative> inner;
            for (const Alternative& one : contract.alternatives(name, schema)) {
                if (one.schema->contains("properties")) inner.push_back(one);
                if (!Values::is_list_of_objects(*one.schema)) continue;
                inner = contract.alternatives(name, one.schema->at("items"));
            }
            ASSERT_FALSE(inner.empty());
            expect_fields(contract, field.access.table(), inner, name + "/" + field.name);
        }
        EXPECT_EQ(found, field.of_model ? 1 : objects.size());
    }
}

TEST(Contract, HasEveryFieldOfEveryTable) {
    const Contract contract;
    const Alternative scene{"Scene", &contract.named("Scene")};
    expect_fields(contract, table_of<SceneDraft>(), {scene}, "");
}

// What the service serves as examples.
TEST(Contract, AllowsEveryPresetOfThePage) {
    const Contract contract;
    std::size_t count = 0;
    const std::filesystem::path presets = std::filesystem::path(AWAN_SOURCE_DIR) / "web/presets";
    for (const auto& entry : std::filesystem::directory_iterator(presets)) {
        if (entry.path().extension() != ".json" || entry.path().stem() == "index") continue;
        std::ifstream file(entry.path());
        const json document = json::parse(file);
        EXPECT_TRUE(contract.allows(contract.named("Scene"), document)) << entry.path();
        const Result<Scene> scene = read(document.dump());
        ASSERT_TRUE(scene.ok()) << entry.path();
        expect_written_back(document.dump(), fingerprint(*scene));
        ++count;
    }
    EXPECT_GT(count, 10u);
}

// Where one field decides about others, each of its words is said to, for each field that is said to have it so.
TEST(Contract, SaysWhatEachWordDecides) {
    const Contract contract;
    std::size_t count = 0;
    for (const auto& [name, schema] : contract.schemas().items()) {
        if (!schema.contains("x-presets")) continue;
        const std::string by = schema.at("x-presets-by");
        const json& words = schema.at("properties").at(by).at("enum");
        EXPECT_EQ(schema.at("x-presets").size(), words.size()) << name;
        for (const json& word : words)
            for (const auto& [field, says] : schema.at("properties").items())
                if (says.value("x-otherwise", "") == "the " + by + "'s") {
                    ++count;
                    EXPECT_TRUE(schema.at("x-presets").at(word).contains(field)) << word << field;
                }
    }
    EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace awan::contract
