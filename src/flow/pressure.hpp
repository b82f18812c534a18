#pragma once
#include <vector>

#include "base/field.hpp"
#include "flow/multigrid.hpp"

namespace livebed::flow {

/// What a solve did.
struct SolveReport {
  int iterations = 0;
  double before = 0, after = 0;  ///< Euclidean norm of the residual with the first guess and at the end
  double relative() const { return before > 0 ? after / before : 0; }
};

/// Solves  sum over faces c_f (p_cell - p_neighbour) + c_boundary p_cell = b.  Residuals are in double precision;
/// corrections come from conjugate gradients with multigrid in single precision, repeated until the residual is small
/// enough (iterative refinement).  Where single precision does not get far, because the solution is a long wave along x
/// that is huge beside its own differences, the mean of each column is solved for in double precision first.  Cells
/// without any open face keep 0.  Without a boundary coefficient the pressure floats: b must then sum to 0 (its mean is
/// taken out) and the solution has mean 0.
class PressureSolver {
public:
  PressureSolver() = default;
  PressureSolver(int nx, int ny);

  /// c_x(i,j), c_y(i,j): coefficients of the west and south faces, i = 1..nx-1, j = 1..ny-1; c_boundary(i,j): of faces
  /// where p is held at 0.
  void set_coefficients(const base::Field& c_x, const base::Field& c_y, const base::Field& c_boundary);

  /// p holds the first guess and receives the solution.  Stops when the residual falls below tolerance x norm(b);
  /// throws Fault (diverged) when that is not reached in `most` iterations.
  SolveReport solve(base::Field& p, const base::Field& b, double tolerance, int most);

private:
  double residual(const base::Field& p, const base::Field& b);  ///< r <- b - A p; its norm
  void remove_mean(base::Field& a);
  /// p += the function of x alone that takes the sum over each column out of r (Galerkin).
  void correct_columns(base::Field& p);

  int nx_ = 0, ny_ = 0;
  bool floating_ = false;
  double fluid_cells_ = 0;
  base::Field c_x_, c_y_, c_boundary_, r_;
  std::vector<int> first_;  ///< row whose coefficients are read for each: the first of equal ones
  Multigrid multigrid_;
  std::vector<double> column_, column_x_, column_boundary_, slope_;  ///< sums over columns
  std::vector<double> partial_;
};

}  // namespace livebed::flow
