#pragma once
#include "flow/advance.hpp"
#include "validate/result.hpp"

namespace livebed::validate {

/// Steady flow in a square cavity of side 1 under a lid of speed 1, on n x n equal cells (n even), and its differences
/// from the tables of Ghia, Ghia and Shin (1982).  Throws Fault (diverged) when it does not get steady.
struct CavityRun {
  std::vector<double> y, u, u_ghia;  ///< along the vertical centre line
  std::vector<double> x, v, v_ghia;  ///< along the horizontal centre line
  double worst = 0;                  ///< largest difference over all points [lid speed]
  double seconds = 0;                ///< wall time
};
CavityRun run_cavity(int reynolds, int n);

Result cavity(const Tell& tell);

}  // namespace livebed::validate
