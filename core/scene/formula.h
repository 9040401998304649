// Functions of a user's own: what a formula in a scene document may say, and what it becomes.
//
//   formula    = { name "=" expression ";" } expression
//   expression = or [ "?" expression ":" expression ]         both are computed, one is taken
//   or         = and { "||" and }          and = comparison { "&&" comparison }
//   comparison = sum [ ("<" | "<=" | ">" | ">=" | "==" | "!=") sum ]     true is 1, false 0; what is not 0 is true
//   sum        = product { ("+" | "-") product }
//   product    = sign { ("*" | "/") sign }
//   sign       = ("-" | "+" | "!") sign | power
//   power      = primary [ "^" sign ]                         -2^2 is -4, 2^3^2 is 2^9
//   primary    = number | name | name "(" expression { "," expression } ")" | "(" expression ")"
//
// Names that are given: kFormulaInputs; pi. Functions: kFormulaFunctions. The octaves of a noise are a plain number.
// There is nothing else: no loops, no calls of one's own, nothing outside of the numbers that are given. What it costs
// is known when it has been read (limits::kMaxFormula...).
//
// Every step gives a number, a float: what has none (0 / 0, the root of a negative number) gives 0, and what is beyond
// +-1e30 gives that. So nothing that a formula says is an error once it has been read, and the figures are the same on
// every machine: of the elementary functions those of core/base/exact_math.h are taken.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace awan {

// What a formula is given for a place, in the order of their slots.
enum class FormulaInput : std::uint8_t {
    kX,
    kY,
    kZ,
    kHeight,
    kTime,
    kSeed,
    kDensity,
    kPrimitives,
    kTurbulence
};
struct FormulaName {
    const char* name;
    const char* says;
};
inline constexpr FormulaName kFormulaInputs[] = {
    {"x", "where it is in the cloud's own coordinates, units"},
    {"y", "the same"},
    {"z", "the same"},
    {"height", "0 at the bottom of the primitives, 1 at their top"},
    {"time", "the scene's, seconds"},
    {"seed", "from 0 to 1, another one for each of the cloud's seeds"},
    {"density", "what the model has there"},
    {"mdens", "of the primitives alone, there where the turbulence has moved the place"},
    {"turb", "the turbulence there"},
};
inline constexpr int kFormulaInputCount = 9;

enum class FormulaOp : std::uint8_t {
    // Puts `value`, or what stands in slot `slot`, on the stack; takes from it into the slot.
    kNumber,
    kSlot,
    kKeep,
    // Of one.
    kNegate,
    kNot,
    kAbs,
    kFloor,
    kFract,
    kSign,
    kSqrt,
    kExp,
    kLog,
    kSin,
    kCos,
    // Of two.
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kPower,
    kMod,
    kMin,
    kMax,
    kStep,
    kLess,
    kLessEqual,
    kEqual,
    kNotEqual,
    kAnd,
    kOr,
    // Of three.
    kSelect,
    kClamp,
    kMix,
    kSmoothstep,
    kLength,
    kNoise,
    // `slot`: octaves.
    kTurbulence,
    kFbm,
    kPrimitives,
};

struct FormulaFunction {
    const char* name;
    FormulaOp op;
    // How many values it takes; `more`: or more of them. Of a noise with octaves these are one more, the last.
    int takes;
    bool more;
    const char* says;
};
inline constexpr FormulaFunction kFormulaFunctions[] = {
    {"abs", FormulaOp::kAbs, 1, false, "|a|"},
    {"floor", FormulaOp::kFloor, 1, false, "the largest whole number <= a"},
    {"fract", FormulaOp::kFract, 1, false, "a - floor(a)"},
    {"sign", FormulaOp::kSign, 1, false, "-1, 0 or 1"},
    {"sqrt", FormulaOp::kSqrt, 1, false, "square root"},
    {"exp", FormulaOp::kExp, 1, false, "e^a"},
    {"log", FormulaOp::kLog, 1, false, "natural logarithm"},
    {"sin", FormulaOp::kSin, 1, false, "of radians"},
    {"cos", FormulaOp::kCos, 1, false, "of radians"},
    {"mod", FormulaOp::kMod, 2, false, "a - b floor(a / b)"},
    {"min", FormulaOp::kMin, 2, true, "the least"},
    {"max", FormulaOp::kMax, 2, true, "the largest"},
    {"step", FormulaOp::kStep, 2, false, "1 where b >= a, else 0"},
    {"select", FormulaOp::kSelect, 3, false, "b where a is not 0, else c"},
    {"clamp", FormulaOp::kClamp, 3, false, "a, at least b, at most c"},
    {"mix", FormulaOp::kMix, 3, false, "a + c (b - a)"},
    {"smoothstep", FormulaOp::kSmoothstep, 3, false,
     "0 where c <= a, 1 where c >= b, soft between"},
    {"length", FormulaOp::kLength, 3, false, "sqrt(a^2 + b^2 + c^2)"},
    {"noise", FormulaOp::kNoise, 3, false, "gradient noise, about -1 to 1, with bumps 1 wide"},
    {"turbulence", FormulaOp::kTurbulence, 4, false,
     "d octaves of |noise|, each half the size and half as strong"},
    {"fbm", FormulaOp::kFbm, 4, false, "the same of noise itself"},
    {"primitives", FormulaOp::kPrimitives, 3, false, "the primitives' density at another place"},
};

struct FormulaStep {
    FormulaOp op = FormulaOp::kNumber;
    std::uint8_t slot = 0;
    float value = 0;
};

// A formula as steps on a stack of values, which holds one at the end.
struct Formula {
    std::vector<FormulaStep> steps;
    // The most values on the stack at once.
    int values = 0;
    // Inputs, then names of its own.
    int slots = kFormulaInputCount;

    // Whether it asks for an input.
    bool asks_for(FormulaInput input) const;
};

// Errors (kInvalidScene, at `pointer`): what is wrong, where ("line 1, column 7"), and what was expected.
Result<Formula> parse_formula(std::string_view text, const std::string& pointer);

}  // namespace awan
