#pragma once
#include <vector>

#include "base/field.hpp"
#include "flow/staggering.hpp"

namespace livebed::flow {

/// Five-point linear systems of the implicit algorithm, for corrections c to a present value x:
///   centre c - west c_west - east c_east - south c_south - north c_north = rhs.
/// Couplings are positive, so line Gauss-Seidel converges; what lies outside the unknowns is known and has c = 0.
struct LineSystem {
  base::Field west, east, south, north, centre, rhs;
  base::Field correction, slope;
  LineSystem() = default;
  explicit LineSystem(const Mesh& mesh);

  /// Makes unknown (i,j) say c = value.
  void fix(int i, int j, double value);
};

/// correction <- `sweeps` rounds of line Gauss-Seidel from 0: even rows, odd rows, even columns, odd columns; lines of
/// one colour do not touch one another, so the result is the same for any number of threads.
void sweep_lines(const Staggering& at, int sweeps, LineSystem& a);

/// Residual of the present value x as OpenFOAM scales it: sum |rhs| over sum (|A x - A m| + |rhs + A x - A m|), m the
/// mean of x.  Fixed unknowns do not count.
double scaled_residual(const Staggering& at, const LineSystem& a, const base::Field& x, std::vector<double>& scratch);

}  // namespace livebed::flow
