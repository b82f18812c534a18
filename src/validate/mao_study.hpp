#pragma once
#include "validate/mao_runs.hpp"
#include "validate/result.hpp"

namespace livebed::validate {

/// Why the hole is as it is: cases/mao with grains of 0.7 mm, seed 1, followed to 25 s of Mao's clock, with the grid,
/// the steps or one part of the model changed at a time.  Kept and gone on with as the runs of `mao`.
/// Its runs; the first is the case itself.
Experiment study_of_mao();
Result mao_study(const Only& only, const Tell& tell);

}  // namespace livebed::validate
