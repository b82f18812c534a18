#pragma once
#include <vector>

#include "flow/closures.hpp"
#include "flow/momentum.hpp"

namespace livebed::flow {

/// A cell whose value is given, not solved.
struct FixedCell {
  int i, j;
  double value;
};

/// One transport equation, ready for an algorithm to advance:
///   dc/dt + div(u c) = div(diffusivity grad c) + gain - decay c.
struct ScalarEquation {
  base::Field& value;                   ///< c at the old time
  base::Field& next;                    ///< receives c at the new time; never the same field
  const base::Field &gain, &decay;      ///< [c/s], [1/s]; decay >= 0
  const Conductance& conductance;       ///< of the faces
  const std::vector<double>& inlet;     ///< c at the inlet, one value a row
  const std::vector<FixedCell>& fixed;  ///< solid cells, and cells at walls with wall function
  double floor;                         ///< least value
};

/// The closure of a case: turns its law into transport equations and eddy viscosity.  The state always holds k and
/// epsilon; omega lives within a step only (omega = epsilon/(Cmu k)).  A step is
///   prepare;  advance k_equation;  advance second_equation;  complete.
class Turbulence {
public:
  Turbulence(const Mesh& mesh, const Boundary& boundary, const Params& params);

  /// Strain of the present velocity, omega and the blending of the law.
  void prepare(const Mesh& mesh, const Boundary& boundary, const Params& params, State& s);
  ScalarEquation k_equation(const Mesh& mesh, const Params& params, const Staggering& at, State& s, Workspace& w);
  ScalarEquation second_equation(const Mesh& mesh, const Params& params, const Staggering& at, State& s, Workspace& w);
  /// Takes over what the equations received: k, epsilon and nut of the state.
  void complete(const Mesh& mesh, const Params& params, State& s);

  /// nut <- k, epsilon and the velocity, of a state that no step has made.
  void start(const Mesh& mesh, const Boundary& boundary, const Params& params, State& s);

private:
  /// A cell at floor, lid or pipe.
  struct WallCell {
    int i, j;
    enum Where { floor, lid, pipe } where;
    Wall wall;
    double y, length;  ///< distance of its centre from the wall, length of the wall in it [m]
  };
  static double shear_velocity(const WallCell& cell, const State& s, const Workspace& w);
  template <class Rate, class Diffusion>
  void evaluate(const Mesh& mesh, const Params& params, const Staggering& at, const State& s, const base::Field& second,
                Workspace& w, Rate rate, Diffusion diffusion);
  template <class Law>
  void update_eddy_viscosity(const Law& law, const Mesh& mesh, const Params& params, const base::Field& second,
                             State& s);

  ClosureLaw law_;
  std::vector<WallCell> walls_;
  std::vector<FixedCell> fixed_k_, fixed_e_;  ///< the cells of walls_ first where the law sets them, then solid ones
  std::vector<double> inlet_k_, inlet_e_;
  base::Field distance_;               ///< of cells from the nearest wall [m]
  base::Field strain_;                 ///< S^2 [1/s2]
  base::Field omega_, cross_, blend_;  ///< of omega closures
  base::Field gain_, decay_, next_k_, next_e_;
};

}  // namespace livebed::flow
