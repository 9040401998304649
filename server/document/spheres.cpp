// The fields of a cloud of model "spheres".
#include "core/scene/spheres.h"

#include "server/document/models.h"

namespace awan {
namespace {

using State = DraftInProgress;

template <typename T>
WordOutcome choose(T& into, std::string_view word, std::string_view first, T is_first,
                   std::string_view second, T is_second) {
    if (word != first && word != second) return WordOutcome::kUnknown;
    into = word == first ? is_first : is_second;
    return WordOutcome::kTaken;
}

constexpr const char* kRatioWanted =
    "a number from 0.05 to 0.9 (radius of a sphere over its parent's)";
constexpr const char* kShiftWanted = "a number from 0 to 1";

constexpr Field kFields[] = {
    {.name = "kind",
     .wanted = R"("cumulus" or "cirrus")",
     .word =
         [](State& s, std::string_view v) {
             return choose(s.spheres->kind, v, "cumulus", SpheresKind::kCumulus, "cirrus",
                           SpheresKind::kCirrus);
         }},
    {.name = "levels",
     .wanted = "an integer from 0 to 10",
     .integer = [](State& s, std::uint64_t v) { s.spheres->levels = v; }},
    {.name = "size",
     .wanted = "[x, y, z]: three numbers > 0 (sides, scene units)",
     .vector = [](State& s) { return &s.spheres->size; }},
    {.name = "visual_range",
     .wanted = "a number > 0 (meteorological optical range, scene units)",
     .number = [](State& s, double v) { s.spheres->visual_range = v; }},
    {.name = "ratio_min",
     .wanted = kRatioWanted,
     .number = [](State& s, double v) { s.spheres->ratio_min = v; }},
    {.name = "ratio_max",
     .wanted = kRatioWanted,
     .number = [](State& s, double v) { s.spheres->ratio_max = v; }},
    {.name = "shift_min",
     .wanted = kShiftWanted,
     .number = [](State& s, double v) { s.spheres->shift_min = v; }},
    {.name = "shift_max",
     .wanted = kShiftWanted,
     .number = [](State& s, double v) { s.spheres->shift_max = v; }},
    {.name = "scaling",
     .wanted = R"("first" or "every")",
     .word =
         [](State& s, std::string_view v) {
             return choose(s.spheres->scaling, v, "first", SpheresScaling::kFirst, "every",
                           SpheresScaling::kEvery);
         }},
    {.name = "growth",
     .wanted = R"("up" or "down")",
     .word =
         [](State& s, std::string_view v) {
             return choose(s.spheres->growth, v, "up", SpheresGrowth::kUp, "down",
                           SpheresGrowth::kDown);
         }},
    {.name = "morph",
     .wanted = R"(an object or "none")",
     .word =
         [](State&, std::string_view v) {
             return v == "none" ? WordOutcome::kTaken : WordOutcome::kUnknown;
         },
     .object = ObjectKind::kSpheresMorph},
};

constexpr Field kMorphFields[] = {
    {.name = "seed",
     .wanted = "an integer from 0 to 18446744073709551615",
     .integer = [](State& s, std::uint64_t v) { s.spheres->morph->seed = v; }},
    {.name = "duration",
     .wanted = "a number > 0 (seconds)",
     .number = [](State& s, double v) { s.spheres->morph->duration = v; }},
    {.name = "steps",
     .wanted = "an integer >= 1",
     .integer = [](State& s, std::uint64_t v) { s.spheres->morph->steps = v; }},
};

}  // namespace

std::span<const Field> spheres_fields() {
    return kFields;
}

std::span<const Field> spheres_morph_fields() {
    return kMorphFields;
}

void write_spheres(const SpheresCloud& cloud, ObjectText& text) {
    const SpheresCloud standard;
    if (cloud.kind == SpheresKind::kCirrus) text.text("kind", "cirrus");
    if (cloud.levels != standard.levels) text.integer("levels", cloud.levels);
    text.vector("size", cloud.size, standard.size);
    if (cloud.visual_range) text.number("visual_range", *cloud.visual_range);
    if (cloud.ratio_min) text.number("ratio_min", *cloud.ratio_min);
    if (cloud.ratio_max) text.number("ratio_max", *cloud.ratio_max);
    if (cloud.shift_min) text.number("shift_min", *cloud.shift_min);
    if (cloud.shift_max) text.number("shift_max", *cloud.shift_max);
    if (cloud.scaling == SpheresScaling::kEvery) text.text("scaling", "every");
    if (cloud.growth == SpheresGrowth::kDown) text.text("growth", "down");
    if (!cloud.morph) return;
    // Written in full: an empty object would be left out, and a morph with it.
    write_object(text, "morph", [&](ObjectText& morph) {
        morph.integer("seed", cloud.morph->seed);
        morph.number("duration", cloud.morph->duration);
        morph.integer("steps", cloud.morph->steps);
    });
}

}  // namespace awan
