// What a scene document may hold, said once: a table for each of its objects, a row for each field. A table stands
// below its struct (haze.h, sun.h, ...) and drives all that goes over every field:
//   reading            server/document/parse.cpp
//   ranges             core/scene/check_ranges.h
//   writing            server/document/write_scene.cpp
//   fingerprints       core/scene/fingerprint.cpp
//   the contract       server/document/schema.cpp, and from it the page's controls
// What concerns several fields at once is code, in core/scene/rules.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace awan {

struct Table;

// Both ends are allowed, unless `above`: then `lowest` itself is not. NaN is in no range.
struct Range {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool above = false;
};
constexpr Range from_to(double lowest, double highest) {
    return {lowest, highest, false};
}
// As far from 0 either way.
constexpr Range within(double most) {
    return {-most, most, false};
}
constexpr Range above_zero() {
    return {0, std::numeric_limits<double>::max(), true};
}

// Of whole numbers, both ends allowed; of a list's length.
struct Counts {
    std::uint64_t lowest = 0;
    std::uint64_t highest = std::numeric_limits<std::uint64_t>::max();
};
constexpr Counts count_from_to(std::uint64_t lowest, std::uint64_t highest) {
    return {lowest, highest};
}
constexpr Counts at_most(std::uint64_t highest) {
    return {0, highest};
}

// What is said of a field, whatever it is made of.
struct Row {
    // In documents. "": the member is not in documents (see outside_document, absence).
    const char* name = "";
    // Completes "must be ...", for a value of the wrong kind. "": by the words, see wanted_of.
    const char* wanted = "";
    // Of a number, or of each component of a vector.
    Range range{};
    // Each component is a whole number.
    bool whole = false;
    // 0 is allowed too, whatever the range.
    bool or_zero = false;
    // Of a whole number, or of a list's length.
    Counts counts{};
    // Whether the object cannot do without.
    bool required = false;
    // A vector may be written as one number, for all three components.
    bool one_for_all = false;
    // The word for "not given" of an optional member, e.g. "auto" or "none"; null: it is given or left out.
    const char* absent = nullptr;
    // Of an enumeration, in its order; of a bool those for false and true.
    std::span<const char* const> words{};
    const char* unit = nullptr;
    // One line for people.
    const char* says = "";
    // What holds when the field is left out, where that is not a value of its own, e.g. "the scene's".
    const char* otherwise = nullptr;
    // What holds when the field is left out, where that depends on the rest of the object; null: the struct's.
    double (*usual)(const void* object) = nullptr;
    // Completes "must be ..." for a number out of range, instead of the two ends; null: the ends.
    const char* outside = nullptr;
    // The value of a Cloud's `model` to which the field belongs; none: to all.
    std::optional<int> of_model{};
    // Whether the rest of the object makes it mean nothing; null: it always means something.
    bool (*idle)(const void* object) = nullptr;
    // A field of later days: where it is absent, an empty list, or a switch that is automatic, it leaves no trace in
    // fingerprints, so that those of older documents stay as they were.
    bool traceless = false;
    // Names the member of which this is a part, where the document is flatter than the struct.
    const char* part_of = nullptr;
};

enum class Holds : std::uint8_t {
    kNumber,   // double
    kInteger,  // std::uint64_t
    kInt,      // int, never negative
    kVector,   // glm::dvec3
    kWord,     // an enumeration or a bool, by Row::words
    kText,     // std::string: any word, e.g. the name of a texture
    kSwitch,   // Switch: true, false or "auto"
    kObject,   // a struct with a table
    kObjects,  // a list of them
    kFloats,   // std::vector<float>
    kPoints,   // std::vector<glm::dvec3>
    kColors,   // std::vector<glm::vec3>
    kAbsence,  // bool: whether the whole object is not there; Row::absent is its word
    kOutside,  // not in documents
};

// How to reach a member. Objects are passed without their type: a Field belongs to the struct of its Table.
struct Access {
    Holds holds = Holds::kOutside;
    // Whether it can be absent: a std::optional or a std::shared_ptr.
    bool optional = false;
    // Another text for each member, for comparisons while compiling: under -fsanitize=undefined GCC 12 can't compare
    // addresses of functions then.
    std::string_view called{};
    // One address for each type of a member: a struct and its first member stand in one place.
    const void* type = nullptr;
    // The member as it stands, e.g. the std::optional itself.
    const void* (*member)(const void* object) = nullptr;
    // Its value; null when absent.
    const void* (*get)(const void* object) = nullptr;
    // Its value, made (with the defaults) when absent.
    void* (*put)(void* object) = nullptr;
    // Makes it absent; null when it cannot be.
    void (*clear)(void* object) = nullptr;
    // Of kWord: the place in Row::words.
    std::uint64_t (*word)(const void* value) = nullptr;
    void (*set_word)(void* value, std::uint64_t index) = nullptr;
    // Of kObjects.
    std::size_t (*size)(const void* list) = nullptr;
    const void* (*element)(const void* list, std::size_t index) = nullptr;
    void* (*append)(void* list) = nullptr;
    // Of kObject and kObjects.
    const Table& (*table)() = nullptr;
    // Whether a bool stands beside the member that says it does not count (then Row::absent stands in the document).
    bool beside = false;
    const bool* (*unused)(const void* object) = nullptr;
    bool* (*set_unused)(void* object) = nullptr;
};

struct Field : Row {
    Access access;

    constexpr Field(const Row& row, const Access& how) : Row(row), access(how) {}
    constexpr bool in_documents() const { return name[0] != '\0'; }
};

struct Given;

struct Table {
    // Of the schema, e.g. "Haze".
    const char* name;
    const char* says;
    std::span<const Field> fields;
    // One of these with all the defaults.
    const void* (*standard)();
    // Where a word may stand for the whole object, the field that it sets: {"model": "physical"} is "physical". Null:
    // none.
    const char* shorthand = nullptr;
    // Sets what was not given where that follows from what was (below); null: nothing does.
    void (*complete)(void* object, const Given& given) = nullptr;
};

// The fields of one object that a document gives: bit i for field i of its table.
struct Given {
    const Table& table;
    std::uint64_t bits = 0;

    bool has(std::string_view name) const;
};

// Completes "must be ...": what the row says, else its words, `"a" or "b"` or `one of "a", "b", "c"`.
std::string wanted_of(const Row& row);

// The row by which the whole object can be absent (absence() below); null: it has none.
const Field* absence_of(const Table& table);

// Whether that row says that `object` is not there.
bool is_absent(const Table& table, const void* object);

// The table of a struct of the document; defined below each of them.
template <typename Object>
const Table& table_of();

template <typename T>
inline constexpr char kTypeTag = 0;

template <typename Object>
const void* standard_of() {
    static const Object standard{};
    return &standard;
}

// What follows makes an Access from a pointer to a member.
namespace table_detail {

template <typename T>
struct Optional {
    static constexpr bool kIs = false;
    using Value = T;
};
template <typename T>
struct Optional<std::optional<T>> {
    static constexpr bool kIs = true;
    using Value = T;
};
template <typename T>
struct Optional<std::shared_ptr<const T>> {
    static constexpr bool kIs = true;
    using Value = T;
};

template <typename T>
struct List {
    static constexpr bool kIs = false;
};
template <typename T>
struct List<std::vector<T>> {
    static constexpr bool kIs = true;
    using Element = T;
};

template <typename T>
constexpr Holds holds() {
    if constexpr (std::is_same_v<T, double>) return Holds::kNumber;
    if constexpr (std::is_same_v<T, std::uint64_t>) return Holds::kInteger;
    if constexpr (std::is_same_v<T, int>) return Holds::kInt;
    if constexpr (std::is_same_v<T, glm::dvec3>) return Holds::kVector;
    if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) return Holds::kWord;
    if constexpr (std::is_same_v<T, std::string>) return Holds::kText;
    if constexpr (std::is_same_v<T, std::vector<float>>) return Holds::kFloats;
    if constexpr (std::is_same_v<T, std::vector<glm::dvec3>>) return Holds::kPoints;
    if constexpr (std::is_same_v<T, std::vector<glm::vec3>>) return Holds::kColors;
    return List<T>::kIs ? Holds::kObjects : Holds::kObject;
}

template <typename T>
const void* get_from(const T& member) {
    if constexpr (Optional<T>::kIs)
        return member ? &*member : nullptr;
    else
        return &member;
}

template <typename T>
void* put_into(std::optional<T>& member) {
    return &member.emplace();
}
template <typename T>
void* put_into(std::shared_ptr<const T>& member) {
    auto made = std::make_shared<T>();
    T* const value = made.get();
    member = std::move(made);
    return value;
}
template <typename T>
void* put_into(T& member) {
    return &member;
}

template <typename Member>
constexpr std::string_view called() {
    return __PRETTY_FUNCTION__;
}

// `Member` gives the member of an object, const or not.
template <typename Object, typename T, typename Member>
constexpr Access access_by(Member) {
    using Value = typename Optional<T>::Value;
    constexpr Holds kHolds = holds<Value>();
    Access a;
    a.holds = kHolds;
    a.optional = Optional<T>::kIs;
    a.called = called<Member>();
    a.type = &kTypeTag<T>;
    a.member = [](const void* o) -> const void* {
        return &Member::of(*static_cast<const Object*>(o));
    };
    a.get = [](const void* o) { return get_from(Member::of(*static_cast<const Object*>(o))); };
    a.put = [](void* o) { return put_into(Member::of(*static_cast<Object*>(o))); };
    if constexpr (Optional<T>::kIs)
        a.clear = [](void* o) { Member::of(*static_cast<Object*>(o)).reset(); };
    if constexpr (kHolds == Holds::kWord) {
        a.word = [](const void* v) {
            return static_cast<std::uint64_t>(*static_cast<const Value*>(v));
        };
        a.set_word = [](void* v, std::uint64_t i) {
            *static_cast<Value*>(v) = static_cast<Value>(i);
        };
    }
    if constexpr (kHolds == Holds::kObjects) {
        a.size = [](const void* l) { return static_cast<const Value*>(l)->size(); };
        a.element = [](const void* l, std::size_t i) -> const void* {
            return &(*static_cast<const Value*>(l))[i];
        };
        a.append = [](void* l) -> void* { return &static_cast<Value*>(l)->emplace_back(); };
        a.table = &table_of<typename List<Value>::Element>;
    }
    if constexpr (kHolds == Holds::kObject) a.table = &table_of<Value>;
    return a;
}

template <typename Object, typename T>
T type_of(T Object::*);
template <typename Object, typename T>
Object owner_of(T Object::*);
template <auto Pointer>
using TypeOf = decltype(type_of(Pointer));
template <auto Pointer>
using OwnerOf = decltype(owner_of(Pointer));

template <auto Pointer>
struct Direct {
    static auto& of(auto& object) { return object.*Pointer; }
};
template <auto Part, auto Pointer>
struct Within {
    static auto& of(auto& object) { return object.*Part.*Pointer; }
};

}  // namespace table_detail

// A field that is a member.
template <auto Member>
constexpr Field field(const Row& row) {
    using namespace table_detail;
    return {row, access_by<OwnerOf<Member>, TypeOf<Member>>(Direct<Member>())};
}

// A field that is a member of a member; Row::part_of names that.
template <auto Part, auto Member>
constexpr Field field_within(const Row& row) {
    using namespace table_detail;
    return {row, access_by<OwnerOf<Part>, TypeOf<Member>>(Within<Part, Member>())};
}

// A member beside which a bool says that it is not used, as the word Row::absent does in documents.
template <auto Member, auto Unused>
constexpr Field field_unless(const Row& row) {
    using namespace table_detail;
    using Object = OwnerOf<Member>;
    Field made = field<Member>(row);
    made.access.beside = true;
    made.access.unused = [](const void* o) { return &(static_cast<const Object*>(o)->*Unused); };
    made.access.set_unused = [](void* o) { return &(static_cast<Object*>(o)->*Unused); };
    return made;
}

// A bool that says the whole object is not there: where the object would stand, a document has the word.
template <auto Member>
constexpr Field absence(const char* word) {
    Field made = field<Member>({.absent = word});
    made.access.holds = Holds::kAbsence;
    return made;
}

// A member that no document gives. Nothing goes over it; who needs it says why that is right.
template <auto Member>
constexpr Field outside_document(const char* why) {
    return {{.says = why}, Access{}};
}

// --- that no member is forgotten

namespace table_detail {

struct Anything {
    template <typename T>
    operator T() const&&;  // never defined: only its type is asked
};

template <typename Object, typename... Members>
constexpr std::size_t members_of() {
    if constexpr (requires { Object{Members()..., Anything()}; })
        return members_of<Object, Members..., Anything>();
    else
        return sizeof...(Members);
}

// Whether two rows are for one member, or have one name.
constexpr bool any_twice(std::span<const Field> fields) {
    for (std::size_t i = 0; i < fields.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Field &a = fields[i], &b = fields[j];
            if (!a.access.called.empty() && a.access.called == b.access.called) return true;
            if (a.in_documents() && std::string_view(a.name) == b.name) return true;
        }
    return false;
}

}  // namespace table_detail

// Whether the rows are as many as the struct's members, none twice; a member that is a struct of which the rows name
// the parts (Row::part_of) is counted once, and a bool of field_unless is counted too. Tables assert it: a member
// without a row does not compile.
template <typename Object, std::size_t N>
constexpr bool covers(const Field (&fields)[N]) {
    static_assert(N <= 64, "readers keep a bit for each field");
    if (table_detail::any_twice(fields)) return false;
    std::size_t covered = 0;
    for (std::size_t i = 0; i < N; ++i) {
        bool counted = false;
        for (std::size_t j = 0; j < i && fields[i].part_of != nullptr; ++j)
            counted = counted || (fields[j].part_of != nullptr &&
                                  std::string_view(fields[j].part_of) == fields[i].part_of);
        if (!counted) ++covered;
        if (fields[i].access.beside) ++covered;
    }
    return covered == table_detail::members_of<Object>();
}

// The same for a member's parts.
template <typename Part, std::size_t N>
constexpr bool covers_part(const Field (&fields)[N], std::string_view name) {
    if (table_detail::any_twice(fields)) return false;
    std::size_t covered = 0;
    for (const Field& one : fields)
        if (one.part_of != nullptr && name == one.part_of) ++covered;
    return covered == table_detail::members_of<Part>();
}

}  // namespace awan
