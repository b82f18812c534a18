#pragma once
#include <vector>

#include "flow/closures.hpp"
#include "flow/momentum.hpp"

namespace livebed::flow {

/// The closure of a case: what its law says of every cell, row by row, for an algorithm to advance
///   dc/dt + div(u c) = div(diffusivity grad c) + gain - decay c,   decay >= 0,
/// with c = k or the second quantity e.  The state always holds k and epsilon; omega lives within a step only (omega =
/// epsilon/(Cmu k)).  A step is
///   prepare;  advance both;  store.
class Turbulence {
public:
  Turbulence(const Mesh& mesh, const Boundary& boundary, const Params& params);

  /// Strain of the present velocity, eddy viscosity, omega and the blending of the law, all `ahead` of the present k
  /// and epsilon by that share of the last step; values of the wall cells.  Fills the ghosts of k and e.
  void prepare(const Mesh& mesh, const Boundary& boundary, const Params& params, double ahead, State& s,
               const Workspace& w);

  /// Takes k and the second quantity at the inlet.
  void set_inlet(const Boundary& boundary);

  /// nut <- k, epsilon and the velocity, of a state that no step has made.
  void start(const Mesh& mesh, const Boundary& boundary, const Params& params, State& s, const Workspace& w);

  /// Adds given sources to the equations of k [m2/s3] and of the second quantity [its unit/s]; null for none.  The
  /// fields must live as long as they are used.
  void set_sources(const base::Field* of_k, const base::Field* of_e) { source_k_ = of_k, source_e_ = of_e; }

  bool with_omega() const {
    return std::visit([](const auto& law) { return std::decay_t<decltype(law)>::transports_omega; }, law_);
  }
  const base::Field& second(const State& s) const { return with_omega() ? omega_ : s.epsilon; }
  const base::Field& second_old(const State& s) const { return with_omega() ? omega_old_ : s.epsilon_old; }
  double second_floor() const;
  /// Eddy viscosity centred in the step to come.
  const base::Field& nut() const { return nut_; }
  /// fixed_row in cells whose value is given, 1 elsewhere.
  const base::SharedRows& factor(bool of_k) const { return of_k ? factor_k_ : factor_e_; }

  /// Rates of row j of both equations.
  struct RowRates {
    double *gain_k, *decay_k, *gain_e, *decay_e;
  };
  void fill_rates(const Mesh& mesh, int j, const State& s, const RowRates& to) const;
  /// k <- exchange across the west faces of row j, diffusivity x opening / distance [m/s].
  void fill_exchange_x(const Mesh& mesh, const Params& params, const Staggering& at, bool of_k, int j, double* k) const;
  /// The same across south faces, for cells ia <= i < ib; k[i - ia].
  void fill_exchange_y(const Mesh& mesh, const Params& params, const Staggering& at, bool of_k, int j, int ia, int ib,
                       double* k) const;
  /// Calls set(i, value) for every cell of row j whose value is given.
  template <class Set>
  void fixed_cells(bool of_k, int j, Set&& set) const {
    const FixedCells& fixed = of_k ? fixed_k_ : fixed_e_;
    for (int n = fixed.first[j]; n < fixed.first[j + 1]; ++n) set(fixed.cells[n].i, fixed.cells[n].value);
  }
  /// Takes k and e of cells ia <= i < ib of row j: k, epsilon and nut of that piece of the new state.
  void store(const Params& params, int j, int ia, int ib, const double* k, const double* e, double* to_k,
             double* to_epsilon, double* to_nut) const;

private:
  /// A cell at floor, lid or pipe.
  struct WallPlace {
    int i, j;
    enum Where { floor, lid, pipe } where;
    Wall wall;
    double y, length;            ///< distance of its centre from the wall, length of the wall in it [m]
    double per_inertia;          ///< 1 / inertia of the cell [1/m2]
    double gain = 0, decay = 0;  ///< of k, where k-omega solves it at walls: all its gain, and decay besides the law's
  };
  struct FixedCell {
    int i, j;
    double value;
  };
  /// Cells whose value is given, not solved, row by row.
  struct FixedCells {
    std::vector<FixedCell> cells;
    std::vector<int> first;    ///< of each row
    std::vector<int> of_wall;  ///< index of the cell of each place at a wall
  };
  static double shear_velocity(const WallPlace& place, const State& s, const Workspace& w);
  /// What grains do to row j: they take k, and no eddy in a pore is larger than the pore.
  void add_grains(int j, const State& s, const RowRates& to) const;
  template <class Fill>
  void with_diffusion(bool of_k, Fill&& fill) const;
  void set_walls(const Params& params, const State& s, const Workspace& w);
  /// Fills cross_ and blend_.
  template <class Law>
  void fill_blend(const Mesh& mesh, const Params& params, const Law& law, const State& s, const Workspace& w);

  ClosureLaw law_;
  std::vector<WallPlace> walls_;
  FixedCells fixed_k_, fixed_e_;
  base::SharedRows factor_k_, factor_e_;
  std::vector<double> inlet_k_, inlet_e_;
  base::SharedRows open_x_, open_y_, eddying_;
  base::Field distance_;                           ///< of cells from the nearest wall [m]
  base::Field strain_;                             ///< S^2 [1/s2]
  base::Field nut_;                                ///< centred in the step to come [m2/s]
  base::Field omega_, omega_old_, cross_, blend_;  ///< of omega closures (Local)
  const base::Field *source_k_ = nullptr, *source_e_ = nullptr;
  double ahead_ = 0;
};

}  // namespace livebed::flow
