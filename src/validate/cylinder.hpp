#pragma once
#include <string>
#include <vector>

#include "flow/advance.hpp"
#include "validate/result.hpp"

namespace livebed::validate {

/// A cylinder of diameter 1 in a laminar stream of speed 1 between frictionless sides.
struct CylinderSetup {
  double reynolds = 40;
  int cells = 40;        ///< a diameter, near the cylinder
  double half = 30;      ///< distance from the centre to inlet and sides [D]; the outlet is 10 D further
  double growth = 1.08;  ///< from cell to cell outside the fine window
  double end = 60;       ///< [D / speed]
  double shift = 0.137;  ///< of the centre from the grid's lines, in fine cells; 0 keeps the flow symmetric
  std::string text() const;
};

struct CylinderRun {
  int nx = 0, ny = 0;
  std::vector<double> t, drag, lift;  ///< force coefficients in time
  double cd = 0;                      ///< mean over the last shedding periods; at the end in steady flow
  double cd_box = 0;                  ///< the same from the momentum of a box round the cylinder
  double cl_rms = 0;                  ///< over whole periods
  double strouhal = 0;                ///< 0 when nothing sheds
  double bubble = 0;                  ///< length behind the rear point at the end [D]
  double seconds = 0;
};

/// Above Re 46 a short push across the stream starts the shedding; averages begin at half the time.
CylinderRun run_cylinder(const CylinderSetup& setup);

Result cylinder(const Tell& tell);

}  // namespace livebed::validate
