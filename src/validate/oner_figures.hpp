#pragma once
#include "validate/pipe_current.hpp"

/// Figures of currents past a pipe, as the paper numbers them.
namespace livebed::validate {

struct Drawn {
  std::string label, colour;
  const PipeRun* run;
  double gap_ratio;
  bool dashed = false;
};

std::string figure_profiles(const std::vector<Drawn>& runs);          ///< Fig. 3: mean U at the sections
std::string figure_mean_streamlines(const std::vector<Drawn>& runs);  ///< Fig. 4: one panel a run
std::string figure_snapshots(const Drawn& run);                       ///< Fig. 5
std::string figure_velocity(const std::vector<Drawn>& runs);          ///< Fig. 6: one panel a run
/// Fig. 7: one panel a list of runs, with the far-field value of the first; viscous: Eq. 13 instead of the wall
/// function.
struct ShearPanel {
  std::string title;
  std::vector<Drawn> runs;
  bool viscous = false;
};
std::string figure_bed_shear(const std::vector<ShearPanel>& lists);
std::string figure_spectra(const std::vector<Drawn>& runs);  ///< Fig. 8: one panel a run

}  // namespace livebed::validate
