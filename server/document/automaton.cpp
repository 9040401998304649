// The fields of a cloud of model "automaton".
#include "core/scene/automaton.h"

#include "core/scene/limits.h"
#include "server/document/models.h"

namespace awan {
namespace {

using State = DraftInProgress;

constexpr const char* kCellsWanted = "[x, y, z]: three numbers (cells)";
constexpr const char* kShareWanted = "a number from 0 to 1";
constexpr const char* kCountWanted = "an integer >= 0";

AutomatonWindBand& band(State& s) {
    return s.automaton->wind.ellipsoids.back();
}

constexpr Field kAutomatonFields[] = {
    {.name = "cells",
     .wanted = "[x, y, z]: three whole numbers",
     .vector = [](State& s) { return &s.automaton->cells; }},
    {.name = "cell",
     .wanted = "a number > 0 (units)",
     .number = [](State& s, double v) { s.automaton->cell = v; }},
    {.name = "ellipsoids",
     .wanted = "a list of ellipsoids",
     .list = ListKind::kAutomatonEllipsoids},
    {.name = "random", .wanted = "an object", .object = ObjectKind::kAutomatonRandom},
    {.name = "overlap",
     .wanted = R"("deepest" or "first")",
     .word =
         [](State& s, std::string_view v) {
             s.automaton->overlap =
                 v == "first" ? AutomatonOverlap::kFirst : AutomatonOverlap::kDeepest;
             return v == "first" || v == "deepest" ? WordOutcome::kTaken : WordOutcome::kUnknown;
         }},
    {.name = "base",
     .wanted = "a number (cells)",
     .number = [](State& s, double v) { s.automaton->base = v; }},
    {.name = "humidity",
     .wanted = kShareWanted,
     .number = [](State& s, double v) { s.automaton->humidity = v; }},
    {.name = "activation",
     .wanted = kShareWanted,
     .number = [](State& s, double v) { s.automaton->activation = v; }},
    {.name = "extinction",
     .wanted = kShareWanted,
     .number = [](State& s, double v) { s.automaton->extinction = v; }},
    {.name = "outside_extinction",
     .wanted = kShareWanted,
     .number = [](State& s, double v) { s.automaton->outside_extinction = v; }},
    {.name = "wind", .wanted = "an object", .object = ObjectKind::kAutomatonWind},
    {.name = "warm_up",
     .wanted = kCountWanted,
     .integer = [](State& s, std::uint64_t v) { s.automaton->warm_up = v; }},
    {.name = "steps_per_second",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { s.automaton->steps_per_second = v; }},
    {.name = "steps",
     .wanted = kCountWanted,
     .integer = [](State& s, std::uint64_t v) { s.automaton->steps = v; }},
    {.name = "smooth",
     .wanted = "[x, y, z]: three whole numbers (cells)",
     .vector = [](State& s) { return &s.automaton->smooth; }},
    {.name = "smooth_steps",
     .wanted = "an integer >= 1",
     .integer = [](State& s, std::uint64_t v) { s.automaton->smooth_steps = v; }},
    {.name = "metaball_radius",
     .wanted = "a number (cells)",
     .number = [](State& s, double v) { s.automaton->metaball_radius = v; }},
    {.name = "threshold",
     .wanted = kShareWanted,
     .number = [](State& s, double v) { s.automaton->threshold = v; }},
    {.name = "most_particles",
     .wanted = "an integer >= 1",
     .integer = [](State& s, std::uint64_t v) { s.automaton->most_particles = v; }},
};

constexpr Field kEllipsoidFields[] = {
    {.name = "center",
     .wanted = kCellsWanted,
     .required = true,
     .vector = [](State& s) { return &s.automaton->ellipsoids.back().center; }},
    {.name = "radii",
     .wanted = kCellsWanted,
     .required = true,
     .vector = [](State& s) { return &s.automaton->ellipsoids.back().radii; }},
};

constexpr Field kRandomFields[] = {
    {.name = "count",
     .wanted = kCountWanted,
     .integer = [](State& s, std::uint64_t v) { s.automaton->random->count = v; }},
    {.name = "smallest",
     .wanted = kCellsWanted,
     .vector = [](State& s) { return &s.automaton->random->smallest; }},
    {.name = "largest",
     .wanted = kCellsWanted,
     .vector = [](State& s) { return &s.automaton->random->largest; }},
    {.name = "level",
     .wanted = R"(a number (cells) or "any")",
     .number = [](State& s, double v) { s.automaton->random->level = v; },
     .word =
         [](State& s, std::string_view v) {
             s.automaton->random->level.reset();
             return v == "any" ? WordOutcome::kTaken : WordOutcome::kUnknown;
         }},
};

constexpr Field kWindFields[] = {
    {.name = "layers", .wanted = "an object", .object = ObjectKind::kAutomatonLayers},
    {.name = "ellipsoids", .wanted = "a list of bands", .list = ListKind::kAutomatonWindBands},
    {.name = "mutation",
     .wanted = kShareWanted,
     .number = [](State& s, double v) { s.automaton->wind.mutation = v; }},
};

constexpr Field kLayersFields[] = {
    {.name = "constant",
     .wanted = "a number (cells a step)",
     .number = [](State& s, double v) { s.automaton->wind.layers.constant = v; }},
    {.name = "linear",
     .wanted = "a number (cells a step, a cell of height)",
     .number = [](State& s, double v) { s.automaton->wind.layers.linear = v; }},
    {.name = "quadratic",
     .wanted = "a number (cells a step, a cell of height squared)",
     .number = [](State& s, double v) { s.automaton->wind.layers.quadratic = v; }},
};

constexpr Field kBandFields[] = {
    {.name = "from",
     .wanted = "a number (cells)",
     .number = [](State& s, double v) { band(s).from = v; }},
    {.name = "to",
     .wanted = "a number (cells)",
     .number = [](State& s, double v) { band(s).to = v; }},
    {.name = "constant",
     .wanted = "a number (cells a step)",
     .number = [](State& s, double v) { band(s).speed.constant = v; }},
    {.name = "linear",
     .wanted = "a number (cells a step, a cell of height)",
     .number = [](State& s, double v) { band(s).speed.linear = v; }},
    {.name = "quadratic",
     .wanted = "a number (cells a step, a cell of height squared)",
     .number = [](State& s, double v) { band(s).speed.quadratic = v; }},
};

void write_speed(const AutomatonSpeed& speed, ObjectText& text) {
    text.number("constant", speed.constant, 0);
    text.number("linear", speed.linear, 0);
    text.number("quadratic", speed.quadratic, 0);
}

void append_ellipsoid(const AutomatonEllipsoid& ellipsoid, std::string& out) {
    ObjectText text(out);
    text.vector("center", ellipsoid.center);
    text.vector("radii", ellipsoid.radii);
    text.end();
}

void append_band(const AutomatonWindBand& wind, std::string& out) {
    const AutomatonWindBand standard;
    ObjectText text(out);
    text.number("from", wind.from, standard.from);
    text.number("to", wind.to, standard.to);
    write_speed(wind.speed, text);
    text.end();
}

// Also where all of it is the default: that it was given says something.
void write_random(const RandomEllipsoids& random, ObjectText& text) {
    const RandomEllipsoids standard;
    text.integer("count", random.count);
    text.vector("smallest", random.smallest, standard.smallest);
    text.vector("largest", random.largest, standard.largest);
    if (!random.level)
        text.text("level", "any");
    else
        text.number("level", *random.level, *standard.level);
}

}  // namespace

std::span<const Field> automaton_fields(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::kAutomatonEllipsoid:
            return kEllipsoidFields;
        case ObjectKind::kAutomatonRandom:
            return kRandomFields;
        case ObjectKind::kAutomatonWind:
            return kWindFields;
        case ObjectKind::kAutomatonLayers:
            return kLayersFields;
        case ObjectKind::kAutomatonWindBand:
            return kBandFields;
        default:
            return kAutomatonFields;
    }
}

const List& automaton_list(ListKind kind) {
    static constexpr List kEllipsoids{.wanted = "an object",
                                      .most = limits::kMaxAutomatonEllipsoids,
                                      .object = ObjectKind::kAutomatonEllipsoid};
    static constexpr List kBands{.wanted = "an object",
                                 .most = limits::kMaxAutomatonBands,
                                 .object = ObjectKind::kAutomatonWindBand};
    return kind == ListKind::kAutomatonEllipsoids ? kEllipsoids : kBands;
}

void write_automaton(const AutomatonCloud& cloud, ObjectText& text) {
    const AutomatonCloud standard;
    const auto count = [&](const char* field, std::uint64_t value, std::uint64_t usual) {
        if (value != usual) text.integer(field, value);
    };
    text.vector("cells", cloud.cells, standard.cells);
    text.number("cell", cloud.cell, standard.cell);
    if (!cloud.ellipsoids.empty())
        write_list(text, "ellipsoids", cloud.ellipsoids, append_ellipsoid);
    if (cloud.random)
        write_object(text, "random", [&](ObjectText& t) { write_random(*cloud.random, t); });
    if (cloud.overlap == AutomatonOverlap::kFirst) text.text("overlap", "first");
    text.number("base", cloud.base, standard.base);
    text.number("humidity", cloud.humidity, standard.humidity);
    text.number("activation", cloud.activation, standard.activation);
    text.number("extinction", cloud.extinction, standard.extinction);
    text.number("outside_extinction", cloud.outside_extinction, standard.outside_extinction);
    write_object(text, "wind", [&](ObjectText& t) {
        write_object(t, "layers", [&](ObjectText& l) { write_speed(cloud.wind.layers, l); });
        if (!cloud.wind.ellipsoids.empty())
            write_list(t, "ellipsoids", cloud.wind.ellipsoids, append_band);
        t.number("mutation", cloud.wind.mutation, standard.wind.mutation);
    });
    count("warm_up", cloud.warm_up, standard.warm_up);
    text.number("steps_per_second", cloud.steps_per_second, standard.steps_per_second);
    count("steps", cloud.steps, standard.steps);
    text.vector("smooth", cloud.smooth, standard.smooth);
    count("smooth_steps", cloud.smooth_steps, standard.smooth_steps);
    text.number("metaball_radius", cloud.metaball_radius, standard.metaball_radius);
    text.number("threshold", cloud.threshold, standard.threshold);
    count("most_particles", cloud.most_particles, standard.most_particles);
}

}  // namespace awan
