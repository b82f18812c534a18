#pragma once
#include <string>
#include <vector>

#include "base/field.hpp"

/// The pressure systems of real steps, for comparing solvers: sum over faces c_f (p_cell - p_neighbour) + c_boundary
/// p_cell = b.
namespace livebed::bench {

struct System {
  std::string name;
  int nx = 0, ny = 0;
  double aspect = 0;  ///< largest ratio of a cell's sides [-]
  base::Field c_x, c_y, c_boundary, b;
  base::Field guess;                    ///< what the step starts the solve from
  std::vector<double> x, y;             ///< faces of the grid [m]
  std::vector<double> openness;         ///< mean coefficient factor of a row: 1 without grains [-]
  std::vector<double> openness_across;  ///< of the faces below a row

  /// Sum of a cell's coefficients; 0 in solid cells, which belong to no equation.
  double diagonal(int i, int j) const;
  /// Norm of b - A p over that of b.
  double relative_residual(const base::Field& p) const;
};

/// Box of 30 D x 3.5 D with a cut pipe at e/D 0.3.  stretch: largest over smallest row height, 1 = equal cells; the
/// columns then grow away from the pipe by the same ratio from cell to cell.  grains: coefficients of 0.4-0.6 in the
/// lower half of the box, as a void fraction makes them.
struct Choice {
  std::string name;
  int nx = 0, ny = 0;
  double stretch = 1;
  bool grains = false;
};

/// b is what one step of the flow asks for: A times the change of pressure in the step, the flow having been developed
/// on a coarse grid; guess the change in the step before, as the flow takes it.
System make_system(const Choice& choice);

/// 80 x 100 cells of 50 mm x 0.5 mm, no pipe: aspect ratio 100; b from a current that is not free of divergence.
System make_thin_system();

}  // namespace livebed::bench
