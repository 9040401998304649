// How the look "upchurch" draws the cells of an automaton (core/looks/upchurch.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// The render modes of Upchurch 2009: billboards painted with textures of the user's choice, or with textures made by
// rule; points of cells by their density, or by whether there is cloud in them.
enum class AutomatonMode { kTextures, kGenerated, kDensity, kPresence };
inline constexpr const char* kAutomatonModeWords[] = {"textures", "generated", "density",
                                                      "presence"};

inline constexpr const char* kBetweenStepsWords[] = {"blend", "hold"};

// A cell of density q is a square of so much times q cells' widths, of opacity `opacity` q and of whiteness
// `color_multiplier` q, both at most 1. Points are all as large, and those by presence opaque and white.
struct AutomatonDrawing {
    AutomatonMode mode = AutomatonMode::kGenerated;
    // Names with commas between; which of them a cell has, its place says.
    std::string textures = "puff,cauliflower,torn";
    double billboard_scale = 9;
    double color_multiplier = 1.5;
    double opacity = 0.5;
    double point_size = 1;
    // Whether frames between two steps show the earlier one, instead of densities between both.
    bool hold = false;
};

inline constexpr Field kAutomatonDrawingFields[] = {
    field<&AutomatonDrawing::mode>(
        {.name = "mode",
         .words = kAutomatonModeWords,
         .says = "Billboards painted with `textures`, or with textures made by rule (generated); "
                 "points by density, or by presence of cloud."}),
    field<&AutomatonDrawing::textures>(
        {.name = "textures",
         .wanted = "names of textures with commas between",
         .says = "Of mode textures: Awan's own, uploaded ones, or hashes."}),
    field<&AutomatonDrawing::billboard_scale>(
        {.name = "billboard_scale",
         .wanted = "a number > 0 (cells)",
         .range = from_to(limits::kMinBillboardScale, limits::kMaxBillboardScale),
         .unit = "cells",
         .says = "Side of the billboard of a cell of density 1; others are smaller with it."}),
    field<&AutomatonDrawing::color_multiplier>(
        {.name = "color_multiplier",
         .wanted = "a number >= 0",
         .range = from_to(0, limits::kMaxColorMultiplier),
         .says = "Times the density is how white a cell is, at most 1."}),
    field<&AutomatonDrawing::opacity>({.name = "opacity",
                                       .wanted = "a number >= 0",
                                       .range = from_to(0, limits::kMaxColorMultiplier),
                                       .says = "Times the density is how opaque, at most 1."}),
    field<&AutomatonDrawing::point_size>(
        {.name = "point_size",
         .wanted = "a number > 0 (cells)",
         .range = from_to(limits::kMinBillboardScale, limits::kMaxBillboardScale),
         .unit = "cells",
         .says = "Side of a point."}),
    field<&AutomatonDrawing::hold>(
        {.name = "between_steps",
         .words = kBetweenStepsWords,
         .says = "blend: between two steps densities go over from one to the next; hold: they "
                 "stay until it comes."}),
};
static_assert(covers<AutomatonDrawing>(kAutomatonDrawingFields));
inline constexpr Table kAutomatonDrawingTable{
    .name = "AutomatonDrawing",
    .says = "How the look upchurch draws cells; of that look only.",
    .fields = kAutomatonDrawingFields,
    .standard = standard_of<AutomatonDrawing>};
template <>
inline const Table& table_of<AutomatonDrawing>() {
    return kAutomatonDrawingTable;
}

// The names in a list with commas between; those that are empty too.
std::vector<std::string_view> names_in(std::string_view list);

}  // namespace awan
