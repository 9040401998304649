// The times of a scene that belong together.
#pragma once

#include <cstdint>

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// Frames 0 .. frames-1 of a scene, the first at `from`, the last at `to`, evenly between.
struct Sequence {
    double from = 0;
    double to = 1;
    std::uint64_t frames = 1;
};

inline constexpr Field kSequenceFields[] = {
    field<&Sequence::from>({.name = "from",
                            .wanted = "a number (seconds)",
                            .range = within(limits::kMaxTime),
                            .unit = "seconds",
                            .says = "Seconds, of the first frame."}),
    field<&Sequence::to>({.name = "to",
                          .wanted = "a number (seconds)",
                          .range = within(limits::kMaxTime),
                          .required = true,
                          .unit = "seconds",
                          .says = "Seconds, of the last frame."}),
    field<&Sequence::frames>({.name = "frames",
                              .wanted = "an integer >= 1",
                              .counts = count_from_to(1, limits::kMaxFrames),
                              .required = true,
                              .says = "How many, evenly from the first to the last."}),
};
static_assert(covers<Sequence>(kSequenceFields));

inline constexpr Table kSequenceTable{.name = "Sequence",
                                      .says = "Frames of a scene, evenly between two times.",
                                      .fields = kSequenceFields,
                                      .standard = standard_of<Sequence>};
template <>
inline const Table& table_of<Sequence>() {
    return kSequenceTable;
}

}  // namespace awan
