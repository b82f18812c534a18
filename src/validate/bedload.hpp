#pragma once
#include "validate/result.hpp"

namespace livebed::validate {

/// Where finished runs over a flat bed are kept, from the working folder.
inline constexpr const char* kept_flat_beds = "runs/validate/bedload";

/// What the model is calibrated by, and nothing else: the slope of a heap, the fall of a grain, and the sand that a
/// current carries over a flat bed, from the threshold of motion to sheet flow, 2 mm and 0.36 mm sand.
Result bedload(const Tell& tell);

/// Velocity and solid fraction of the sheet flow of Revil-Baudard et al. (2015), PMMA grains of 3 mm.
Result sheet_flow(const Tell& tell);

}  // namespace livebed::validate
