#pragma once
#include "validate/pipe_current.hpp"

namespace livebed::validate {

/// Finished runs stay here, below the folder the program is started in; a run that is there is not repeated.
inline constexpr const char* kept_runs = "runs/validate/oner";

/// Figures 3-8 of the paper on 540 x 94 cells: each closure and gap in the paper's box, 3.5 D deep.
Result oner(const Tell& tell);

/// What sets the Strouhal number: the depth of the experiment, 12 D, and single changes of profile, scheme and grid.
Result oner_depth(const Tell& tell);

/// A laminar boundary layer on the pipe beside the wall function's turbulent one: every gap, and the experiment's
/// depth.
Result oner_layer(const Tell& tell);

/// The paper's grid, 1500 x 260, beside the usual one: the paper's closure at e/D 0.3, at 0, and the other closures at
/// both.
Result oner_fine(const Tell& tell);
Result oner_fine_bed(const Tell& tell);
Result oner_fine_closures(const Tell& tell);
Result oner_fine_bed_closures(const Tell& tell);

}  // namespace livebed::validate
