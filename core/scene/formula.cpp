#include "core/scene/formula.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "core/scene/checks.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

static_assert(std::size(kFormulaInputs) == kFormulaInputCount);

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool begins_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// Recursive descent, bounded by how deep it may go. Every function returns whether all is well; what is wrong first is
// kept.
class Parser {
  public:
    explicit Parser(std::string_view text) : text_(text) { skip(); }

    bool formula() {
        while (is_assignment())
            if (!assignment()) return false;
        if (!expression()) return false;
        take(";");
        if (at_ < text_.size()) return fail("expected an operator or the end");
        return true;
    }

    Formula result;

    std::string complaint() const {
        const std::string_view before = text_.substr(0, wrong_at_);
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t begin = before.rfind('\n');
        const std::size_t column =
            begin == std::string_view::npos ? before.size() + 1 : before.size() - begin;
        return "line " + std::to_string(line) + ", column " + std::to_string(column) + ": " +
               wrong_;
    }

  private:
    // --- text

    void skip() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    }
    bool take(std::string_view sign) {
        if (!text_.substr(at_).starts_with(sign)) return false;
        at_ += sign.size();
        skip();
        return true;
    }
    std::string_view name_here() const {
        std::size_t end = at_;
        if (end < text_.size() && begins_name(text_[end]))
            while (end < text_.size() && (begins_name(text_[end]) || is_digit(text_[end]))) ++end;
        return text_.substr(at_, end - at_);
    }
    std::string found() const {
        if (at_ >= text_.size()) return "the end";
        const std::string_view name = name_here();
        if (!name.empty()) return '`' + std::string(name.substr(0, 40)) + '`';
        const char c = text_[at_];
        if (c < ' ' || c > '~') return "a character that no formula has";
        return std::string("`") + c + '`';
    }
    bool fail(const std::string& what) { return fail_at(at_, what + ", not " + found()); }
    bool fail_at(std::size_t at, const std::string& what) {
        wrong_ = what;
        wrong_at_ = at;
        return false;
    }

    // --- what it becomes

    // `takes` values become one.
    bool add(FormulaOp op, int takes, int slot = 0, float value = 0) {
        if (static_cast<int>(result.steps.size()) == limits::kMaxFormulaSteps)
            return fail_at(
                at_, "this is more than " + std::to_string(limits::kMaxFormulaSteps) + " steps");
        result.steps.push_back({op, static_cast<std::uint8_t>(slot), value});
        held_ += 1 - takes;
        result.values = std::max(result.values, held_);
        if (held_ > limits::kMaxFormulaValues)
            return fail_at(at_, "this holds more than " +
                                    std::to_string(limits::kMaxFormulaValues) + " values at once");
        return true;
    }

    // --- grammar

    bool is_assignment() const {
        const std::string_view name = name_here();
        std::size_t next = at_ + name.size();
        while (next < text_.size() && is_blank(text_[next])) ++next;
        return !name.empty() && text_.substr(next).starts_with('=') &&
               !text_.substr(next).starts_with("==");
    }

    bool assignment() {
        const std::string_view name = name_here();
        if (is_taken(name))
            return fail_at(at_, "`" + std::string(name.substr(0, 40)) + "` is a name already");
        if (static_cast<int>(names_.size()) == limits::kMaxFormulaNames)
            return fail_at(
                at_, "this is more than " + std::to_string(limits::kMaxFormulaNames) + " names");
        at_ += name.size();
        skip();
        take("=");
        if (!expression()) return false;
        if (!add(FormulaOp::kKeep, 1, result.slots)) return false;
        --held_;
        names_.push_back(name);
        ++result.slots;
        if (!take(";")) return fail("expected `;` and then the next value");
        return true;
    }

    bool is_taken(std::string_view name) const {
        return name == "pi" || slot_of(name) || function_of(name) != nullptr;
    }
    std::optional<int> slot_of(std::string_view name) const {
        for (int i = 0; i < kFormulaInputCount; ++i)
            if (name == kFormulaInputs[i].name) return i;
        const auto found = std::find(names_.begin(), names_.end(), name);
        if (found == names_.end()) return std::nullopt;
        return kFormulaInputCount + static_cast<int>(found - names_.begin());
    }
    static const FormulaFunction* function_of(std::string_view name) {
        for (const FormulaFunction& function : kFormulaFunctions)
            if (name == function.name) return &function;
        return nullptr;
    }

    bool expression() {
        if (++depth_ > limits::kMaxFormulaDepth)
            return fail_at(at_,
                           "this goes deeper than " + std::to_string(limits::kMaxFormulaDepth));
        if (!either()) return false;
        if (take("?")) {
            if (!expression()) return false;
            if (!take(":")) return fail("expected `:` and what holds otherwise");
            if (!expression() || !add(FormulaOp::kSelect, 3)) return false;
        }
        --depth_;
        return true;
    }

    bool either() {
        if (!both()) return false;
        while (take("||"))
            if (!both() || !add(FormulaOp::kOr, 2)) return false;
        return true;
    }

    bool both() {
        if (!comparison()) return false;
        while (take("&&"))
            if (!comparison() || !add(FormulaOp::kAnd, 2)) return false;
        return true;
    }

    bool comparison() {
        if (!sum()) return false;
        if (take("<=")) return sum() && add(FormulaOp::kLessEqual, 2);
        if (take(">=")) return sum() && add(FormulaOp::kLess, 2) && add(FormulaOp::kNot, 1);
        if (take("==")) return sum() && add(FormulaOp::kEqual, 2);
        if (take("!=")) return sum() && add(FormulaOp::kNotEqual, 2);
        if (take("<")) return sum() && add(FormulaOp::kLess, 2);
        if (take(">")) return sum() && add(FormulaOp::kLessEqual, 2) && add(FormulaOp::kNot, 1);
        return true;
    }

    bool sum() {
        if (!product()) return false;
        while (true) {
            if (take("+")) {
                if (!product() || !add(FormulaOp::kAdd, 2)) return false;
            } else if (take("-")) {
                if (!product() || !add(FormulaOp::kSubtract, 2)) return false;
            } else {
                return true;
            }
        }
    }

    bool product() {
        if (!sign()) return false;
        while (true) {
            if (take("*")) {
                if (!sign() || !add(FormulaOp::kMultiply, 2)) return false;
            } else if (take("/")) {
                if (!sign() || !add(FormulaOp::kDivide, 2)) return false;
            } else {
                return true;
            }
        }
    }

    bool sign() {
        if (++depth_ > limits::kMaxFormulaDepth)
            return fail_at(at_,
                           "this goes deeper than " + std::to_string(limits::kMaxFormulaDepth));
        bool fine = false;
        const std::string_view rest = text_.substr(at_);
        if (take("-"))
            fine = sign() && add(FormulaOp::kNegate, 1);
        else if (rest.starts_with('!') && !rest.starts_with("!=") && take("!"))
            fine = sign() && add(FormulaOp::kNot, 1);
        else if (take("+"))
            fine = sign();
        else
            fine = power();
        --depth_;
        return fine;
    }

    bool power() {
        if (!primary()) return false;
        if (take("^")) return sign() && add(FormulaOp::kPower, 2);
        return true;
    }

    bool primary() {
        if (take("(")) {
            if (!expression()) return false;
            return take(")") || fail("expected `)`");
        }
        if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) {
            float value = 0;
            return number(value) && add(FormulaOp::kNumber, 0, 0, value);
        }
        const std::string_view name = name_here();
        if (name.empty()) return fail("expected a number, a name, a function or `(`");
        const std::size_t begin = at_;
        at_ += name.size();
        skip();
        if (take("(")) return call(name, begin);
        if (name == "pi")
            return add(FormulaOp::kNumber, 0, 0, static_cast<float>(std::numbers::pi));
        if (const auto slot = slot_of(name)) return add(FormulaOp::kSlot, 0, *slot);
        return fail_at(begin, "there is no `" + std::string(name.substr(0, 40)) + "`; there are " +
                                  known_names());
    }

    bool number(float& value) {
        double read = 0;
        const char* const begin = text_.data() + at_;
        const char* const end = text_.data() + text_.size();
        const auto [next, failed] = std::from_chars(begin, end, read);
        if (failed == std::errc::invalid_argument) return fail("expected a number");
        if (failed == std::errc::result_out_of_range || std::abs(read) > 1e30)
            return fail_at(at_, "a number must be at most 1e30");
        if (next != end && (begins_name(*next) || *next == '.')) {
            at_ += static_cast<std::size_t>(next - begin);
            return fail("expected an operator");
        }
        value = static_cast<float>(read);
        at_ += static_cast<std::size_t>(next - begin);
        skip();
        return true;
    }

    // After the name and its bracket.
    bool call(std::string_view name, std::size_t begin) {
        const FormulaFunction* const f = function_of(name);
        if (f == nullptr)
            return fail_at(begin, "there is no function `" + std::string(name.substr(0, 40)) +
                                      "`; there are " + known_functions());
        const bool octaves = f->op == FormulaOp::kTurbulence || f->op == FormulaOp::kFbm;
        const int values = octaves ? f->takes - 1 : f->takes;
        int given = 0;
        do {
            if (given == values && !f->more) {
                if (!octaves) return wrong_count(*f, begin);
                break;
            }
            if (!expression()) return false;
            // Of more than two each is taken in as it comes.
            if (++given > 2 && f->more && !add(f->op, 2)) return false;
        } while (take(","));
        int count = 1;
        if (octaves) {
            if (given < values) return wrong_count(*f, begin);
            const std::size_t here = at_;
            float wanted = 0;
            if (at_ >= text_.size() || !is_digit(text_[at_]))
                return fail("expected the octaves, a whole number from 1 to 10");
            if (!number(wanted)) return false;
            if (!(wanted >= 1 && wanted <= 10) || wanted != std::floor(wanted))
                return fail_at(here, "octaves must be a whole number from 1 to 10");
            count = static_cast<int>(wanted);
        }
        if (given < values) return wrong_count(*f, begin);
        if (!take(")")) return fail("expected `,` or `)`");
        return add_call(*f, begin, count);
    }

    bool add_call(const FormulaFunction& f, std::size_t begin, int count) {
        if (octaves_of(f.op)) octaves_ += count;
        if (octaves_ > limits::kMaxFormulaOctaves)
            return fail_at(begin, "all noise together may have " +
                                      std::to_string(limits::kMaxFormulaOctaves) + " octaves");
        if (f.op == FormulaOp::kPrimitives && ++primitives_ > limits::kMaxFormulaPrimitives)
            return fail_at(begin, "primitives may be asked for " +
                                      std::to_string(limits::kMaxFormulaPrimitives) + " times");
        if (f.more) return add(f.op, 2);
        const int values = octaves_of(f.op) && f.op != FormulaOp::kNoise ? f.takes - 1 : f.takes;
        return add(f.op, values, count);
    }
    static bool octaves_of(FormulaOp op) {
        return op == FormulaOp::kNoise || op == FormulaOp::kTurbulence || op == FormulaOp::kFbm;
    }

    bool wrong_count(const FormulaFunction& f, std::size_t begin) {
        return fail_at(begin, std::string("`") + f.name + "` takes " + std::to_string(f.takes) +
                                  (f.more         ? " or more values"
                                   : f.takes == 1 ? " value"
                                                  : " values"));
    }

    std::string known_names() const {
        std::string all;
        for (const FormulaName& input : kFormulaInputs) all += std::string(input.name) + ", ";
        for (const std::string_view name : names_) all += std::string(name.substr(0, 40)) + ", ";
        return all + "pi";
    }
    static std::string known_functions() {
        std::string all;
        for (const FormulaFunction& f : kFormulaFunctions)
            all += (all.empty() ? "" : ", ") + std::string(f.name);
        return all;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
    int held_ = 0;
    int octaves_ = 0;
    int primitives_ = 0;
    std::vector<std::string_view> names_;
    std::string wrong_;
    std::size_t wrong_at_ = 0;
};

}  // namespace

bool Formula::asks_for(FormulaInput input) const {
    return std::any_of(steps.begin(), steps.end(), [&](const FormulaStep& step) {
        return step.op == FormulaOp::kSlot && step.slot == static_cast<std::uint8_t>(input);
    });
}

Result<Formula> parse_formula(std::string_view text, const std::string& pointer) {
    if (text.size() > limits::kMaxFormulaBytes)
        return invalid(
            pointer, "must be at most " + std::to_string(limits::kMaxFormulaBytes) + " bytes long");
    Parser parser(text);
    if (parser.formula()) return std::move(parser.result);
    return invalid(pointer, parser.complaint());
}

}  // namespace awan
