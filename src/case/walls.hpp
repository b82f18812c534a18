#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "grains/params.hpp"

namespace livebed::casefile {

/// Walls as a case file writes them: points "x y" [m] with commas between, lines with semicolons between:
/// "0.1 0.3, 0.1 0; 0.2 0.1, 0.3 0.2".  On bad text the lines are empty and fault says what is wrong.
struct WallsRead {
  std::vector<grains::Polyline> lines;
  std::string fault;
};
WallsRead read_walls(std::string_view text);

}  // namespace livebed::casefile
