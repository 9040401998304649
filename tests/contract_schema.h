// The scene part of the contract as a stranger reads it: JSON Schema 2020-12, of which this knows the words that are
// used and no others.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "server/document/schema.h"

namespace awan::contract {

using nlohmann::json;

// One of the schemas of which a value must have one.
struct Alternative {
    // As in components/schemas; without a name of its own that of the object and its property, "Sun/color".
    std::string name;
    const json* schema;
};

class Contract {
  public:
    Contract() : schemas_(json::parse("{" + scene_schemas() + "}")) {}

    const json& schemas() const { return schemas_; }
    const json& named(const std::string& name) const { return schemas_.at(name); }

    // "#/components/schemas/Sun" -> "Sun".
    static std::string name_of(const json& reference) {
        constexpr std::string_view kWhere = "#/components/schemas/";
        const std::string text = reference.get<std::string>();
        EXPECT_TRUE(text.starts_with(kWhere)) << text;
        return text.substr(std::min(kWhere.size(), text.size()));
    }

    std::vector<Alternative> alternatives(const std::string& name, const json& schema) const {
        if (schema.contains("$ref")) {
            const std::string other = name_of(schema.at("$ref"));
            return alternatives(other, named(other));
        }
        // Beside a type they say which members go together.
        if (schema.contains("type")) return {{name, &schema}};
        std::vector<Alternative> all;
        for (const char* const word : {"oneOf", "anyOf"})
            if (schema.contains(word))
                for (const json& one : schema.at(word))
                    for (Alternative& inner : alternatives(name, one))
                        all.push_back(std::move(inner));
        return all;
    }

    // Whether a value has the schema.
    bool allows(const json& schema, const json& value) const {
        return std::all_of(schema.items().begin(), schema.items().end(), [&](const auto& word) {
            return word_allows(word.key(), word.value(), schema, value);
        });
    }

  private:
    static bool is_of_type(const std::string& type, const json& value) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "boolean") return value.is_boolean();
        if (type == "number") return value.is_number();
        if (type != "integer") ADD_FAILURE() << "a type that the test does not know: " << type;
        // 5.0 is an integer. No integer of a document is 2^64 or more, where doubles and the ends of ranges run
        // together.
        if (!value.is_number_float()) return value.is_number();
        const double number = value.get<double>();
        return std::floor(number) == number && number < 0x1p64;
    }

    bool any_pattern_allows(const json& schema, const std::string& key, const json& value) const {
        if (!schema.contains("patternProperties")) return false;
        const json& patterns = schema.at("patternProperties");
        return std::any_of(patterns.items().begin(), patterns.items().end(),
                           [&](const auto& pattern) {
                               return std::regex_search(key, std::regex(pattern.key())) &&
                                      allows(pattern.value(), value);
                           });
    }

    bool members_allowed(const json& schema, const json& value) const {
        static const json kNone = json::object();
        const json& properties = schema.contains("properties") ? schema.at("properties") : kNone;
        return std::all_of(value.items().begin(), value.items().end(), [&](const auto& member) {
            if (properties.contains(member.key()))
                return allows(properties.at(member.key()), member.value());
            return any_pattern_allows(schema, member.key(), member.value());
        });
    }

    std::size_t count_allowing(const json& list, const json& value) const {
        return static_cast<std::size_t>(std::count_if(
            list.begin(), list.end(), [&](const json& one) { return allows(one, value); }));
    }

    bool word_allows(const std::string& word, const json& says, const json& schema,
                     const json& value) const {
        static const std::set<std::string> kProse{
            "description", "default",   "example",      "examples", "format",     "x-unit",
            "x-otherwise", "x-presets", "x-presets-by", "x-names",  "x-functions"};
        if (kProse.contains(word)) return true;
        if (word == "$ref") return allows(named(name_of(says)), value);
        if (word == "oneOf") return count_allowing(says, value) == 1;
        if (word == "anyOf") return count_allowing(says, value) > 0;
        if (word == "type") return is_of_type(says.get<std::string>(), value);
        if (word == "const") return value == says;
        if (word == "pattern")
            return !value.is_string() ||
                   std::regex_search(value.get<std::string>(), std::regex(says.get<std::string>()));
        if (word == "maxLength")
            return !value.is_string() || value.get<std::string>().size() <= says.get<std::size_t>();
        if (word == "enum") return std::find(says.begin(), says.end(), value) != says.end();
        if (word == "pattern")
            return !value.is_string() ||
                   std::regex_search(value.get<std::string>(), std::regex(says.get<std::string>()));
        if (word == "minimum") return !value.is_number() || value >= says;
        if (word == "exclusiveMinimum") return !value.is_number() || value > says;
        if (word == "maximum") return !value.is_number() || value <= says;
        if (word == "minItems") return !value.is_array() || value.size() >= says;
        if (word == "maxItems") return !value.is_array() || value.size() <= says;
        if (word == "items")
            return !value.is_array() ||
                   std::all_of(value.begin(), value.end(),
                               [&](const json& item) { return allows(says, item); });
        if (word == "minProperties") return !value.is_object() || value.size() >= says;
        if (word == "maxProperties") return !value.is_object() || value.size() <= says;
        if (word == "required")
            return !value.is_object() ||
                   std::all_of(says.begin(), says.end(),
                               [&](const json& name) { return value.contains(name); });
        // Together with the next.
        if (word == "properties" || word == "patternProperties") return true;
        if (word == "additionalProperties") {
            EXPECT_EQ(says, json(false));
            return !value.is_object() || members_allowed(schema, value);
        }
        ADD_FAILURE() << "a word that the test does not know: " << word;
        return false;
    }

    json schemas_;
};

}  // namespace awan::contract
