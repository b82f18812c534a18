#pragma once
#include "flow/turbulence.hpp"

namespace livebed::flow {

/// One equation of a closure, row after row upwards: the explicit balance of c = k or the second quantity.
template <class Scheme>
class ScalarRows {
public:
  ScalarRows(const Mesh& mesh, const Params& params, const Turbulence& turbulence, const Staggering& at, bool of_k,
             const State& s, CarrierRows& carrier, double lead, const Workspace& w, RowScratch::Rows& scratch);
  void start(int j);
  /// The next row, whose gain [c/s] and decay [1/s] are given: rate <- all of dc/dt now [c/s]; convection <- that part
  /// of it; kx <- exchange across west faces [m/s].
  void next(const double* gain, const double* decay, double* rate, double* convection, double* kx);
  const double* exchange_y(int j) const { return exchange_y_[j % 2]; }
  const double* implicit_y(int j) const { return convect_.implicit_y(j); }

private:
  void fill_y(int j);
  const Mesh& m_;
  const Params& params_;
  const Turbulence& turbulence_;
  const Staggering& at_;
  bool of_k_;
  const State& s_;
  const Workspace& w_;
  ConvectionRows<Scheme> convect_;
  int j_ = 0;
  std::array<double*, 2> exchange_y_{};
};

/// k, epsilon, nut <- one step of Eq. 4-7 or of the closure asked for, carried and strained by the present velocity.
/// Second order in time: what the law says is centred in the step by the last two levels, decay and diffusion are
/// half implicit.  Positive: a cell that would lose more than half its value within the step loses it implicitly
/// (Patankar 1980), and what the line systems take from a neighbour never exhausts it.
void advance_turbulence(const Mesh& mesh, const Boundary& boundary, const Params& params, const Staggering& at,
                        double dt, Turbulence& turbulence, State& s, Workspace& w);

}  // namespace livebed::flow
