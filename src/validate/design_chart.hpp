#pragma once
#include "validate/result.hpp"

namespace livebed::validate {

/// Where its runs are kept, from the working folder: e<gap>-theta<theta>-seed<k>, each a run folder.
inline constexpr const char* kept_chart = "runs/validate/design-chart";

/// What an engineer reads off a chart: depth of the hole and its time scale over the gap of the pipe and the strength
/// of the current, from runs of cases/mao with grains of 2 mm, against the formulas of base/sediment.hpp.  Runs are
/// kept and gone on with as those of `mao`; what there is so far is told.  Throws Fault as `mao` does.
Result design_chart(const Only& only, const Tell& tell);

}  // namespace livebed::validate
