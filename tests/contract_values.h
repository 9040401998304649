// Values made from a schema: those at the ends of what it allows, and those just beyond.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tests/contract_schema.h"

namespace awan::contract {

// A value that a schema does not allow.
struct Wrong {
    json value;
    // JSON pointer, from the value, to what is wrong in it.
    std::string place;
};

// Longer lists are left to tests of lists (scene_json_lists_test).
inline constexpr std::uint64_t kLongestList = 10'000;

class Values {
  public:
    explicit Values(const Contract& contract) : contract_(&contract) {}

    // An ordinary value; of an object, that with the fewest members.
    json ordinary(const std::string& name, const json& schema) const {
        return ordinary(contract_->alternatives(name, schema).at(0));
    }
    json ordinary(const Alternative& of) const {
        const json& schema = *of.schema;
        if (schema.contains("const")) return schema.at("const");
        if (schema.contains("enum")) return schema.at("enum").at(0);
        if (schema.contains("examples")) return schema.at("examples").at(0);
        const std::string type = schema.at("type").get<std::string>();
        if (type == "boolean") return false;
        if (type == "array") return list(of, least_length(schema));
        if (type == "object") return smallest(of);
        const auto [least, most] = ends(schema);
        if (json(1) < least) return least;
        if (json(1) > most) return most;
        return 1;
    }

    // Members that an object cannot do without.
    static std::vector<std::string> needed(const json& schema) {
        std::vector<std::string> names;
        if (schema.contains("required")) names = schema.at("required");
        if (schema.contains("oneOf"))
            for (const json& name : schema.at("oneOf").at(0).at("required")) names.push_back(name);
        if (names.empty() && schema.contains("minProperties"))
            names.push_back(schema.at("properties").begin().key());
        return names;
    }

    // At both ends and between them, in each place where there are ends. `standard`: of a vector, the other components.
    std::vector<json> at_ends(const Alternative& of, const json& standard) const {
        const json& schema = *of.schema;
        if (schema.contains("const")) return {schema.at("const")};
        if (schema.contains("enum")) return schema.at("enum");
        if (schema.contains("examples")) return schema.at("examples");
        const std::string type = schema.at("type").get<std::string>();
        if (type == "boolean") return {false, true};
        if (type == "object") return {smallest(of)};
        if (type == "array") return is_vector(schema) ? vectors(of, standard) : lists(of);
        return numbers(schema);
    }

    // All that the schema does not allow: beyond each end, of a wrong type, a word that is not there.
    std::vector<Wrong> beyond(const std::string& name, const json& schema,
                              const json& standard) const {
        std::vector<Wrong> all;
        for (const json& value :
             {json(), json(true), json(1.5), json("no such word"), json::array(), json::object()})
            all.push_back({value, ""});
        bool vector = false, number = false;
        for (const Alternative& one : contract_->alternatives(name, schema)) {
            for (Wrong& wrong : beyond(one, standard)) all.push_back(std::move(wrong));
            vector = vector || is_vector(*one.schema);
            number = number || one.schema->at("type") == "number";
        }
        // A number for all components of a vector is refused as the first of them.
        for (Wrong& wrong : all)
            if (vector && number && wrong.value.is_number()) wrong.place = "/0";
        // What one alternative does not allow another may.
        std::erase_if(all,
                      [&](const Wrong& wrong) { return contract_->allows(schema, wrong.value); });
        return all;
    }

    static bool is_vector(const json& schema) {
        return schema.contains("minItems") && schema.at("minItems") == schema.at("maxItems");
    }
    static bool is_list_of_objects(const json& schema) {
        return schema.value("type", "") == "array" && !is_vector(schema) &&
               !schema.at("items").contains("type");
    }

  private:
    static std::uint64_t least_length(const json& schema) {
        return schema.value("minItems", std::uint64_t{0});
    }

    // The next number that a value of the schema can be.
    static double next(const json& schema, double from, double towards) {
        if (schema.value("format", "") == "float")
            return std::nextafter(static_cast<float>(from), static_cast<float>(towards));
        return std::nextafter(from, towards);
    }

    static std::pair<json, json> ends(const json& schema) {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        const json least =
            schema.contains("exclusiveMinimum")
                ? json(next(schema, schema.at("exclusiveMinimum").get<double>(), kInfinity))
                : schema.at("minimum");
        return {least, schema.value("maximum", json(std::numeric_limits<double>::max()))};
    }

    static std::vector<json> numbers(const json& schema) {
        const auto [least, most] = ends(schema);
        // Away from 0 where a range is as wide either way.
        constexpr double kShare = 0.625;
        if (schema.at("type") == "number") {
            const double low = least.get<double>(), high = most.get<double>();
            return {least, most, low + kShare * (high - low)};
        }
        const auto low = least.get<std::uint64_t>(), high = most.get<std::uint64_t>();
        // Also written as 1.0.
        return {least, most, low + (high - low) / 8 * 5, static_cast<double>(low)};
    }

    static std::vector<Wrong> beyond_numbers(const json& schema) {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        const auto [least, most] = ends(schema);
        const double low = least.get<double>(), high = most.get<double>();
        std::vector<Wrong> all;
        if (schema.at("type") == "number") {
            all.push_back({next(schema, low, -kInfinity), ""});
            if (schema.contains("maximum")) all.push_back({next(schema, high, kInfinity), ""});
            return all;
        }
        all.push_back({least.get<std::int64_t>() - 1, ""});
        all.push_back({low + 0.5, ""});
        if (high < 0x1p64)
            all.push_back({most.get<std::uint64_t>() + 1, ""});
        else
            all.push_back({high, ""});
        return all;
    }

    json list(const Alternative& of, std::uint64_t length) const {
        return json(length, ordinary(of.name, of.schema->at("items")));
    }

    // `standard` with each component at each of its ends.
    std::vector<json> vectors(const Alternative& of, const json& standard) const {
        std::vector<json> all;
        const json& items = of.schema->at("items");
        const json usual = standard.is_array() ? standard : ordinary(of);
        for (std::size_t i = 0; i < usual.size(); ++i)
            for (const Alternative& item : contract_->alternatives(of.name, items))
                for (const json& value : at_ends(item, json())) {
                    json vector = usual;
                    vector[i] = value;
                    all.push_back(std::move(vector));
                }
        return all;
    }

    // The shortest, the longest, and one element at its ends.
    std::vector<json> lists(const Alternative& of) const {
        const json& schema = *of.schema;
        std::vector<json> all{list(of, least_length(schema))};
        if (schema.at("maxItems") <= kLongestList)
            all.push_back(list(of, schema.at("maxItems").get<std::uint64_t>()));
        for (const Alternative& item : contract_->alternatives(of.name, schema.at("items")))
            for (const json& value : at_ends(item, json())) all.push_back(json::array({value}));
        return all;
    }

    std::vector<Wrong> beyond(const Alternative& of, const json& standard) const {
        const json& schema = *of.schema;
        const std::string type = schema.at("type").get<std::string>();
        if (schema.contains("const") && type == "number")
            return {{next(schema, schema.at("const").get<double>(), -1), ""}};
        if (schema.contains("enum") || schema.contains("examples") || type == "boolean" ||
            type == "object" || type == "string")
            return {};
        if (type != "array") return beyond_numbers(schema);
        const json& items = schema.at("items");
        std::vector<Wrong> all;
        if (is_vector(schema)) {
            json vector = standard.is_array() ? standard : ordinary(of);
            for (std::size_t i = 0; i < vector.size(); ++i)
                for (Wrong& wrong : beyond(of.name, items, json())) {
                    json other = vector;
                    other[i] = std::move(wrong.value);
                    all.push_back({std::move(other), "/" + std::to_string(i) + wrong.place});
                }
            json longer = vector;
            longer.push_back(vector.at(0));
            vector.erase(vector.size() - 1);
            all.push_back({std::move(longer), ""});
            all.push_back({std::move(vector), ""});
            return all;
        }
        for (Wrong& wrong : beyond(of.name, items, json()))
            all.push_back({json::array({std::move(wrong.value)}), "/0" + wrong.place});
        const auto least = least_length(schema);
        if (least > 0) all.push_back({list(of, least - 1), ""});
        const auto most = schema.at("maxItems").get<std::uint64_t>();
        // The first element too many.
        if (most <= kLongestList) all.push_back({list(of, most + 1), "/" + std::to_string(most)});
        return all;
    }

    json smallest(const Alternative& of) const {
        json object = json::object();
        for (const std::string& name : needed(*of.schema))
            object[name] = ordinary(of.name + "/" + name, of.schema->at("properties").at(name));
        return object;
    }

    const Contract* contract_;
};

}  // namespace awan::contract
