// Tables of fields (core/scene/table.h): a struct with a member that has no row of its own makes no table.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "core/scene/table.h"

namespace awan {
namespace {

struct Part {
    double c = 0;
    double d = 0;
};
struct Thing {
    double a = 0;
    std::optional<double> b;
    Part part;
    std::vector<float> list;
    bool unused = false;
};

constexpr Field kA = field<&Thing::a>({.name = "a"});
constexpr Field kB = field<&Thing::b>({.name = "b"});
constexpr Field kBUnused = field_unless<&Thing::b, &Thing::unused>({.name = "b"});
constexpr Field kC = field_within<&Thing::part, &Part::c>({.name = "c", .part_of = "part"});
constexpr Field kD = field_within<&Thing::part, &Part::d>({.name = "d", .part_of = "part"});
constexpr Field kList = field<&Thing::list>({.name = "list"});
constexpr Field kOutside = outside_document<&Thing::unused>("is of no document");

constexpr Field kAll[] = {kA, kB, kC, kD, kList, kOutside};
static_assert(covers<Thing>(kAll));
static_assert(covers_part<Part>(kAll, "part"));

// The bool beside a member counts as that member's.
constexpr Field kWithUnused[] = {kA, kBUnused, kC, kD, kList};
static_assert(covers<Thing>(kWithUnused));

// The last member forgotten, the first, one between.
constexpr Field kNotUnused[] = {kA, kB, kC, kD, kList};
static_assert(!covers<Thing>(kNotUnused));
constexpr Field kNotA[] = {kB, kC, kD, kList, kOutside};
static_assert(!covers<Thing>(kNotA));
constexpr Field kNotPart[] = {kA, kB, kList, kOutside};
static_assert(!covers<Thing>(kNotPart));

// A part of a member forgotten.
constexpr Field kNotD[] = {kA, kB, kC, kList, kOutside};
static_assert(covers<Thing>(kNotD));
static_assert(!covers_part<Part>(kNotD, "part"));

// As many rows as members, but one member twice and another forgotten; or two members by one name.
constexpr Field kTwiceA[] = {kA, kA, kC, kD, kList, kOutside};
static_assert(!covers<Thing>(kTwiceA));
constexpr Field kTwiceC[] = {kA, kB, kC, kC, kList, kOutside};
static_assert(!covers_part<Part>(kTwiceC, "part"));
constexpr Field kNamedA = field<&Thing::b>({.name = "a"});
constexpr Field kOneName[] = {kA, kNamedA, kC, kD, kList, kOutside};
static_assert(!covers<Thing>(kOneName));

// A member more than the rows know of.
struct LargerPart {
    double c = 0;
    double d = 0;
    double e = 0;
};
static_assert(!covers_part<LargerPart>(kAll, "part"));

// What a row reaches is the member that it names.
TEST(Table, ReachesEachMember) {
    Thing thing;
    for (const Field& field : {kA, kB, kC, kD}) {
        ASSERT_EQ(field.access.holds, Holds::kNumber) << field.name;
        *static_cast<double*>(field.access.put(&thing)) = field.name[0];
    }
    EXPECT_EQ(thing.a, 'a');
    EXPECT_EQ(thing.b, 'b');
    EXPECT_EQ(thing.part.c, 'c');
    EXPECT_EQ(thing.part.d, 'd');
    EXPECT_EQ(kB.access.member(&thing), &thing.b);
    EXPECT_EQ(kB.access.get(&thing), &*thing.b);
    kB.access.clear(&thing);
    EXPECT_EQ(kB.access.get(&thing), nullptr);
    EXPECT_EQ(kA.access.clear, nullptr);
}

}  // namespace
}  // namespace awan
