#include "core/generate/implicit/formula_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/exact_math.h"
#include "core/scene/limits.h"

namespace awan::implicit {
namespace {

using lanes::all;
using lanes::Floats;
using lanes::Vec;

constexpr float kMost = 1e30F;
// Of doubles: more than that, and a float yet.
constexpr double kLarge = 1e31;

// What has no number is 0, what is beyond either end is that end.
AWAN_INLINE Floats tidy(const Floats& x) {
    return lanes::clamp(x == x ? x : Floats{}, -kMost, kMost);
}

// One after the other in double: the same bits on every machine.
template <typename Of>
AWAN_INLINE Floats one_by_one(const Floats& a, const Floats& b, const Of& of) {
    Floats result{};
    for (int lane = 0; lane < lanes::kCount; ++lane) {
        const double value = of(static_cast<double>(a[lane]), static_cast<double>(b[lane]));
        result[lane] = static_cast<float>(std::clamp(value, -kLarge, kLarge));
    }
    return result;
}

// The largest whole number <= x, of any number: from 2^23 on all are whole.
AWAN_INLINE Floats floor_of(const Floats& x) {
    constexpr float kWhole = 8388608.0F;
    const Floats near = lanes::to_floats(lanes::floor_int(lanes::clamp(x, -kWhole, kWhole)));
    return lanes::abs(x) < kWhole ? near : x;
}

AWAN_INLINE Floats truth(const lanes::Ints& is) {
    return is ? all(1.0F) : Floats{};
}

AWAN_INLINE Floats smooth(const Floats& low, const Floats& high, const Floats& x) {
    const Floats t = lanes::clamp(tidy((x - low) / (high - low)), 0, 1);
    const Floats soft = t * t * (3.0F - 2.0F * t);
    // Where the two ends are one it is a step.
    return low == high ? truth(x >= low) : soft;
}

AWAN_INLINE Octaves first_of(const Octaves& octaves, int count) {
    Octaves some = octaves;
    some.count = std::min(count, octaves.count);
    return some;
}

AWAN_INLINE Floats brownian(const Octaves& octaves, int count, const Vec& p) {
    Floats sum{};
    for (int o = 0; o < std::min(count, octaves.count); ++o) {
        const auto i = static_cast<std::size_t>(o);
        const float f = octaves.frequency[i];
        sum += octaves.weight[i] * noise(octaves.lattice[i], {p.x * f, p.y * f, p.z * f});
    }
    return sum;
}

AWAN_INLINE Floats primitives_at(const PreparedFormula& f, const Element* elements, const Vec& p) {
    const float inverse = 1 / f.unit;
    const Vec at{(p.x - f.middle.x) * inverse, (p.y - f.middle.y) * inverse,
                 (p.z - f.middle.z) * inverse};
    return macro_density(elements, f.every.data(), static_cast<int>(f.every.size()), at);
}

AWAN_INLINE Floats of_one(FormulaOp op, const Floats& a) {
    switch (op) {
        case FormulaOp::kNegate:
            return -a;
        case FormulaOp::kNot:
            return truth(a == 0.0F);
        case FormulaOp::kAbs:
            return lanes::abs(a);
        case FormulaOp::kFloor:
            return floor_of(a);
        case FormulaOp::kFract:
            return a - floor_of(a);
        case FormulaOp::kSign:
            return truth(a > 0.0F) - truth(a < 0.0F);
        case FormulaOp::kSqrt:
            // Of less than 0 there is none.
            return lanes::sqrt(lanes::max(a, Floats{}));
        case FormulaOp::kExp:
            return one_by_one(a, a, [](double x, double) { return exact::exp(x); });
        case FormulaOp::kLog:
            return one_by_one(a, a, [](double x, double) { return x < 0 ? 0 : exact::log(x); });
        case FormulaOp::kSin:
            return one_by_one(a, a, [](double x, double) { return exact::sin(x); });
        default:
            return one_by_one(a, a, [](double x, double) { return exact::cos(x); });
    }
}

AWAN_INLINE Floats of_two(FormulaOp op, const Floats& a, const Floats& b) {
    switch (op) {
        case FormulaOp::kAdd:
            return a + b;
        case FormulaOp::kSubtract:
            return a - b;
        case FormulaOp::kMultiply:
            return a * b;
        case FormulaOp::kDivide:
            return a / b;
        case FormulaOp::kPower:
            return one_by_one(a, b, [](double x, double y) { return exact::pow(x, y); });
        case FormulaOp::kMod:
            return a - b * floor_of(tidy(a / b));
        case FormulaOp::kMin:
            return lanes::min(a, b);
        case FormulaOp::kMax:
            return lanes::max(a, b);
        case FormulaOp::kStep:
            return truth(b >= a);
        case FormulaOp::kLess:
            return truth(a < b);
        case FormulaOp::kLessEqual:
            return truth(a <= b);
        case FormulaOp::kEqual:
            return truth(a == b);
        case FormulaOp::kNotEqual:
            return truth(a != b);
        case FormulaOp::kAnd:
            return truth((a != 0.0F) & (b != 0.0F));
        default:
            return truth((a != 0.0F) | (b != 0.0F));
    }
}

AWAN_INLINE Floats of_three(const PreparedFormula& f, const Element* elements,
                            const FormulaStep& step, const Floats& a, const Floats& b,
                            const Floats& c) {
    switch (step.op) {
        case FormulaOp::kSelect:
            return a != 0.0F ? b : c;
        case FormulaOp::kClamp:
            return lanes::min(lanes::max(a, b), c);
        case FormulaOp::kMix:
            return a + c * (b - a);
        case FormulaOp::kSmoothstep:
            return smooth(a, b, c);
        case FormulaOp::kLength:
            return one_by_one(
                one_by_one(a, b, [](double x, double y) { return std::sqrt(x * x + y * y); }), c,
                [](double x, double y) { return std::sqrt(x * x + y * y); });
        case FormulaOp::kTurbulence:
            return turbulence(first_of(f.octaves, step.slot), {a, b, c});
        case FormulaOp::kPrimitives:
            return primitives_at(f, elements, {a, b, c});
        // kFbm, and kNoise, which has one octave.
        default:
            return brownian(f.octaves, step.slot, {a, b, c});
    }
}

AWAN_INLINE Floats loaded(const float* from) {
    Floats x;
    std::memcpy(&x, from, sizeof x);
    return x;
}

// What stands in the inputs' slots.
AWAN_INLINE void put_inputs(const PreparedFormula& f, const FormulaPlaces& at, Floats* slots) {
    const auto slot = [&](FormulaInput input) __attribute__((always_inline))->Floats& {
        return slots[static_cast<int>(input)];
    };
    const Floats y = loaded(at.y);
    slot(FormulaInput::kX) = loaded(at.x) * f.unit + f.middle.x;
    slot(FormulaInput::kY) = y * f.unit + f.middle.y;
    slot(FormulaInput::kZ) = loaded(at.z) * f.unit + f.middle.z;
    slot(FormulaInput::kHeight) = lanes::clamp((y - f.floor) * f.slope, 0, 1);
    slot(FormulaInput::kTime) = all(f.time);
    slot(FormulaInput::kSeed) = all(f.seed);
    slot(FormulaInput::kDensity) = loaded(at.density);
    slot(FormulaInput::kPrimitives) = loaded(at.primitives);
    slot(FormulaInput::kTurbulence) = loaded(at.turbulence);
}

// The steps one after the other; their number, and what stands on the stack, parse_formula() has bounded.
AWAN_INLINE void run_formula_steps_body(const PreparedFormula& f, const Element* elements,
                                        const FormulaPlaces& at, float* out) {
    Floats slots[kFormulaInputCount + limits::kMaxFormulaNames];
    // The first two are there so that nothing that takes three reaches below, as a compiler sees it.
    Floats stack[limits::kMaxFormulaValues + 3];
    for (Floats& value : stack) value = Floats{};
    put_inputs(f, at, slots);
    std::size_t top = 2;
    for (const FormulaStep& step : f.formula.steps) {
        if (step.op == FormulaOp::kNumber) {
            stack[++top] = all(step.value);
        } else if (step.op == FormulaOp::kSlot) {
            stack[++top] = slots[step.slot];
        } else if (step.op == FormulaOp::kKeep) {
            slots[step.slot] = stack[top--];
        } else if (step.op <= FormulaOp::kCos) {
            stack[top] = tidy(of_one(step.op, stack[top]));
        } else if (step.op <= FormulaOp::kOr) {
            stack[top - 1] = tidy(of_two(step.op, stack[top - 1], stack[top]));
            --top;
        } else {
            stack[top - 2] =
                tidy(of_three(f, elements, step, stack[top - 2], stack[top - 1], stack[top]));
            top -= 2;
        }
    }
    const Floats result =
        lanes::clamp(stack[top], 0, static_cast<float>(limits::kMaxImplicitDensity));
    std::memcpy(out, &result, sizeof result);
}
AWAN_KERNEL(void, run_formula_steps,
            (const PreparedFormula& f, const Element* elements, const FormulaPlaces& at,
             float* out),
            (f, elements, at, out))

}  // namespace

void run_formula(const PreparedFormula& formula, const Element* elements,
                 const FormulaPlaces& places, float* out) {
    run_formula_steps(formula, elements, places, out);
}

}  // namespace awan::implicit
