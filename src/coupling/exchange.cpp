#include "coupling/exchange.hpp"

#include <cmath>

#include "base/loops.hpp"
#include "base/math.hpp"

namespace livebed::coupling {

using base::Field;
using base::for_each_item;
using base::vector_loop;

namespace {

PaperDrag make_drag(const Params& params) { return PaperDrag{params.drag_infinity}; }

Field slab_volume(const flow::Mesh& m, const flow::Staggering& at, double slab) {
  Field v(m.nx, m.ny);
  for (int j = 0; j <= m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i) v(i, j) = slab * at.volume(i, j);
  return v;
}

/// Sum of a field over the unknowns, row by row in order.
double total(const Field& f) {
  double sum = 0;
  for (int j = 0; j < f.ny(); ++j) {
    const double* row = f.row(j);
    sum += base::vector_sum(0, f.nx(), [&](int i) { return row[i]; });
  }
  return sum;
}

}  // namespace

Coupler::Coupler(const Params& params, const flow::Mesh& mesh, const flow::Staggering& at_u,
                 const flow::Staggering& at_v, double grain_diameter, double density, double viscosity)
    : params_(params),
      drag_(make_drag(params)),
      nx_(mesh.nx),
      ny_(mesh.ny),
      y_(mesh.y.begin() + 1, mesh.y.end()),
      reach_(params.kernel * grain_diameter),
      slab_(grain_diameter),
      density_(density),
      viscosity_(viscosity),
      volume_u_(slab_volume(mesh, at_u, slab_)),
      volume_v_(slab_volume(mesh, at_v, slab_)),
      at_u_(at_u, mesh.aperture_x, 1, mesh.nx - 1, params.kernel * grain_diameter),
      at_v_(at_v, mesh.aperture_y, 0, mesh.nx - 1, params.kernel * grain_diameter),
      owed_u_(mesh.nx, mesh.ny),
      owed_v_(mesh.nx, mesh.ny) {
  const flow::Staggering at_c = flow::Staggering::centres(mesh);
  volume_c_ = slab_volume(mesh, at_c, slab_);
  at_c_ = Transfer(at_c, mesh.volume, 0, mesh.nx - 1, params.kernel * grain_diameter);
}

void Coupler::locate(const grains::State& g) {
  at_u_.locate(g);
  at_v_.locate(g);
  located_ = true;
}

int Coupler::rows_with_grains(const grains::State& g) const {
  if (g.count() == 0) return 0;
  const double top = *std::max_element(g.y.begin(), g.y.begin() + g.count()) + reach_;
  // A volume of v reaches half a row further down than its row.
  return std::min(ny_, static_cast<int>(std::lower_bound(y_.begin(), y_.end(), top) - y_.begin()) + 2);
}

void Coupler::load_flow(grains::State& g, flow::State& s, double dt, bool held) {
  if (params_.mode == Mode::none) return;
  if (!located_) locate(g);
  at_u_.gather(s.u, g.fluid.u);
  at_v_.gather(s.v, g.fluid.v);
  const double moving = held ? 0.0 : 1.0;
  std::visit(
      [&](const auto& drag) {
        vector_loop(0, g.count(), [&](int k) {
          const double slip_x = g.fluid.u[k] - moving * g.u[k], slip_y = g.fluid.v[k] - moving * g.v[k];
          g.fluid.beta[k] = drag(std::sqrt(slip_x * slip_x + slip_y * slip_y), g.diameter[k], density_, viscosity_);
        });
      },
      drag_);
  if (params_.mode == Mode::one_way) return;

  flow::Load& load = s.load;
  load.top = rows_with_grains(g);
  for (Field* f : {&load.beta_u, &load.beta_v, &load.force_u, &load.force_v}) f->fill(0.0);
  const bool implicit = held || params_.exchange == Exchange::implicit;
  if (implicit) {
    at_u_.scatter(std::array{&load.beta_u, &load.force_u}, [&](int k) {
      return std::array{g.fluid.beta[k], moving * g.fluid.beta[k] * g.u[k]};
    });
    at_v_.scatter(std::array{&load.beta_v, &load.force_v}, [&](int k) {
      return std::array{g.fluid.beta[k], moving * g.fluid.beta[k] * g.v[k]};
    });
  }
  const auto per_volume = [&](const Field& volume, const Field& owed, Field& beta, Field& force) {
    for_each_item(0, load.top, [&](int j) {
      const double *v = volume.row(j), *o = owed.row(j);
      double *b = beta.row(j), *f = force.row(j);
      vector_loop(0, nx_, [&](int i) {
        const double inverse = v[i] > 0 ? 1.0 / v[i] : 0.0;
        b[i] *= inverse;
        f[i] = (f[i] + o[i] / dt) * inverse;
      });
      b[nx_] = b[nx_ - 1], f[nx_] = f[nx_ - 1];  // the outlet face feels what its neighbour feels
    });
  };
  per_volume(volume_u_, owed_u_, load.beta_u, load.force_u);
  per_volume(volume_v_, owed_v_, load.beta_v, load.force_v);
}

void Coupler::push_grains(const flow::State& s, grains::State& g) {
  std::fill(g.impulse_x.begin(), g.impulse_x.end(), 0.0);
  std::fill(g.impulse_y.begin(), g.impulse_y.end(), 0.0);
  if (params_.mode == Mode::none) return;
  at_u_.gather(s.u, g.fluid.u);
  at_v_.gather(s.v, g.fluid.v);
}

void Coupler::collect(const grains::State& g, const flow::State& s, double dt) {
  located_ = false;  // the grains have moved
  if (params_.mode != Mode::two_way) return;
  locate(g);
  const auto one = [&](Transfer& at, const grains::Array& impulse, const Field& volume, const Field& velocity,
                       const Field& beta, const Field& force, Field& owed, double& to_grains, double& to_flow,
                       double& carried) {
    // owed <- owed - taken by the flow - given to the grains
    double taken = 0;
    for (int j = 0; j < ny_; ++j) {
      const double *v = volume.row(j), *u = velocity.row(j), *b = beta.row(j), *f = force.row(j);
      double* o = owed.row(j);
      taken += base::vector_sum(0, nx_, [&](int i) { return dt * (f[i] - b[i] * u[i]) * v[i]; });
      vector_loop(0, nx_, [&](int i) { o[i] -= dt * (f[i] - b[i] * u[i]) * v[i]; });
    }
    at.scatter(std::array{&owed}, [&](int k) { return std::array{-impulse[k]}; });
    to_flow += taken;
    for (int k = 0; k < g.count(); ++k) to_grains += impulse[k];
    carried = total(owed);
  };
  one(at_u_, g.impulse_x, volume_u_, s.u, s.load.beta_u, s.load.force_u, owed_u_, ledger_.to_grains.x,
      ledger_.to_flow.x, ledger_.carried.x);
  one(at_v_, g.impulse_y, volume_v_, s.v, s.load.beta_v, s.load.force_v, owed_v_, ledger_.to_grains.y,
      ledger_.to_flow.y, ledger_.carried.y);
}

void Coupler::solid_fraction(const grains::State& g, Field& fraction) {
  fraction.fill(0.0);
  at_c_.locate(g);
  at_c_.scatter(std::array{&fraction}, [&](int k) { return std::array{base::sphere_volume(g.diameter[k])}; });
  for_each_item(0, ny_, [&](int j) {
    const double* v = volume_c_.row(j);
    double* f = fraction.row(j);
    vector_loop(0, nx_, [&](int i) { f[i] = v[i] > 0 ? f[i] / v[i] : 0.0; });
  });
}

}  // namespace livebed::coupling
