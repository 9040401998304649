// The documents of the models that make their own particles, a file each (<model>.cpp): the rows of the tables of
// fields.h, and the writing.
#pragma once

#include <span>

#include "core/scene/scene.h"
#include "server/document/fields.h"
#include "server/document/object_text.h"

namespace awan {

std::span<const Field> automaton_fields(ObjectKind kind);
const List& automaton_list(ListKind kind);
std::span<const Field> spheres_fields();
std::span<const Field> spheres_morph_fields();
std::span<const Field> implicit_fields();
// Of the object itself and those in it.
std::span<const Field> implicit_fields(ObjectKind kind);
const List& implicit_list(ListKind kind);
void begin_implicit(ObjectKind kind, ImplicitCloud& cloud);
std::span<const Field> ellipsoids_fields();
std::span<const Field> ellipsoids_part_fields(ObjectKind kind);  // of the objects in it
const List& ellipsoids_list(ListKind kind);                      // and of its lists

// Members of the model's object that are not the default.
void write_automaton(const AutomatonCloud& cloud, ObjectText& text);
void write_spheres(const SpheresCloud& cloud, ObjectText& text);
void write_implicit(const ImplicitCloud& cloud, ObjectText& text);
void write_ellipsoids(const EllipsoidsCloud& cloud, ObjectText& text);

// `model` and the model's object, of a cloud that is_procedural().
void write_model(const Cloud& cloud, ObjectText& text);

}  // namespace awan
