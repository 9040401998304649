// Values of a document into the fields of an object, by its table. What a text may hold where (parse.cpp) is looked up
// here; no JSON.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace awan {

// The place of a name in table.fields, of those that stand in documents; -1: there is none.
int find_field(const Table& table, std::string_view name);
// `"a", "b", ...`: what find_field would find.
std::string allowed_names(const Table& table);

// Whether any string may be the field's value.
bool takes_words(const Field& field);
// Whether the word is one that the field has; then it is taken.
bool take_word(const Field& field, void* object, std::string& word);

// No longer may the string be.
std::uint64_t most_bytes(const Field& field);

// Where the value goes, which is then used.
void* put_field(const Field& field, void* object);
// Of an object that a word may stand for: whether it is there.
void set_absent(const Table& table, void* object, bool absent);
// Defaults that depend on other fields of the object, once it has ended. seen: bit i for field i.
void complete_defaults(const Table& table, std::uint64_t seen, void* object);

bool is_integer_field(const Field& field);
bool is_list_field(const Field& field);
// Whether it is a list of three numbers each.
bool is_of_rows(const Field& list);
// Completes "must be ...", for an element of a list.
const char* wanted_element(const Field& list);
// An element of a list of numbers, and of one of three numbers each. What is out of float32's range becomes infinite,
// which validate() refuses.
void append_to_list(void* list, double value);
void append_row(const Field& field, void* list, const glm::dvec3& v);

}  // namespace awan
