// The fields of a cloud of model "automaton".
#include "core/scene/automaton.h"

#include "server/json_models.h"

namespace awan {

std::span<const Field> automaton_fields() {
    return {};
}

void write_automaton(const AutomatonCloud&, ObjectText&) {}

}  // namespace awan
