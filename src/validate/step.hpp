#pragma once
#include <array>
#include <string>
#include <vector>

#include "flow/advance.hpp"
#include "validate/result.hpp"

/// Backward-facing step of Driver and Seegmiller (1985), AIAA J. 23, 163: Re_H 36000, expansion 8 H to 9 H.  Lengths in
/// the height of the step H, speeds in Uref, the speed in mid-channel 4 H before the step.
namespace livebed::validate {

inline constexpr double step_reynolds = 36000;                         ///< Uref H / nu
inline constexpr std::array<double, 4> step_sections = {1, 4, 6, 10};  ///< [H]

/// Flow in a column of water, from the wall of the step's top up.
struct StepInlet {
  std::vector<double> u, k, epsilon;  ///< one value a row
};

/// Channel of height 8 H with a uniform inlet and the rows that the step's grid has above it: its boundary layers grow
/// until the lower one is as thick as the measured one 4 H before the step.  Throws Fault (diverged) when they do not.
struct StepApproach {
  std::vector<double> y;          ///< heights of the rows above the step's top
  StepInlet at_minus_4, at_step;  ///< where the layer is as thick as measured, and 4 H further down
  double friction = 0;            ///< Cf at the first
  double from_inlet = 0;          ///< distance of the first from the inlet
};

struct StepSetup {
  flow::Closure closure = flow::Closure::k_epsilon;
  int cells = 24;        ///< a step height, along it and at most across
  double upstream = 4;   ///< length of channel before the step [H]; 0 = the inlet stands in the step's face
  bool friction = true;  ///< of the step's top
  double first_row = 0;  ///< height of the rows at floor and step [H], growing away from them; 0 = all rows are equal
  std::string text() const;
};

StepApproach approach_step(const StepSetup& setup);

struct StepRun {
  double reattachment = 0;
  std::vector<double> x, cf, cp;  ///< on the floor
  std::vector<double> y;
  std::array<std::vector<double>, step_sections.size()> u;
  double seconds = 0;
};
/// Marches to the steady state.  Throws Fault (diverged) when there is none.
StepRun run_step(const StepSetup& setup, const StepInlet& inlet);

/// Integral of u/U (1 - u/U) over the measured heights 1.1 H to 3.2 H, straight between them and to 0 on the wall [H].
double momentum_thickness(const std::vector<double>& y, const std::vector<double>& u);

/// Each closure with wall functions on equal rows.
Result step(const Tell& tell);
/// SST on rows that resolve the walls, as it is published.
Result step_walls(const Tell& tell);

}  // namespace livebed::validate
