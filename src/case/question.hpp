#pragma once
#include <string>

#include "case/expected.hpp"

namespace livebed::casefile {

/// A question about a pipe on sand, as it is asked: "0.5 m pipe, 0.8 m/s, 0.2 mm sand".  Quartz sand in fresh water.
struct Question {
  double pipe = 0;       ///< D [m]
  double sand = 0;       ///< d of the real sand [m]
  double gap_ratio = 0;  ///< e/D [-]
  double current = 0;    ///< depth mean [m/s]; 0: theta is given
  double theta = 0;      ///< Shields parameter [-]; 0: the current is given
  double depth = 0;      ///< of the water above the bed [m]; 0: default_depth D
};
inline constexpr double default_depth = 6;  ///< over D: a pipe that takes a sixth of the water speeds it up little
/// No coarser grains than these stand for sand [d/D]: a pipe of ten grains still shows a hole, a rough one.
inline constexpr double coarsest_grain = 0.1;

Scene scene_of(const Question& question);

/// The question put to grains of diameter d [m] at the same Shields parameter: the same scene when d is that of the
/// sand.
Scene scene_of(const Question& question, double d);

/// One line: "Pipe of 50 cm, current 0.8 m/s, sand of 0.2 mm, e/D = 0".
std::string title_of(const Question& question, double d);

/// A commented case of preset "livebed" for the question, with grains of diameter d [m]: those of the sand, or larger
/// ones that keep theta; then the comments say what is kept and what is lost.  Box, cells, steps and outputs follow
/// from D and d as they do in the shipped case `mao`.
std::string case_text(const Question& question, double d);

/// Grain step of sand of diameter d [s]: 1e-5 s at 2 mm, with the root of d, so that at the same theta a hit overlaps
/// by the same share of a grain.
double grain_step_of(double d);

}  // namespace livebed::casefile
