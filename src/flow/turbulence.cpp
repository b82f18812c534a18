#include "flow/turbulence.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"

namespace livebed::flow {

using base::Field;
using base::for_each_item;
using base::square;
using base::vector_loop;

namespace {

bool has_wall_function(Wall wall) { return wall == Wall::rough || wall == Wall::smooth; }

constexpr double omega_floor = epsilon_floor / (launder_spalding.c_mu * k_floor);

/// Distance of every cell from floor, lid and pipe, as far as they are walls and not planes of symmetry [m].
Field distance_from_walls(const Mesh& m, const Boundary& b) {
  Field distance(m.nx, m.ny, 2, m.length() + m.height());
  const double smallest =
      1e-3 * std::min(*std::min_element(m.dx_.begin(), m.dx_.end()), *std::min_element(m.dy_.begin(), m.dy_.end()));
  const bool pipe = m.has_pipe() && m.pipe.wall != Wall::slip;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      double& y = distance(i, j);
      if (b.floor != Wall::slip) y = m.centre_y(j);
      if (b.top != Wall::slip) y = std::min(y, m.height() - m.centre_y(j));
      if (pipe && m.wall_length(i, j) > 0)
        y = m.wall_distance(i, j);
      else if (pipe)
        y = std::min(y, m.wall_distance(i, j));
      y = std::max(y, smallest);  // inside the pipe, where nothing is solved
    }
  return distance;
}

}  // namespace

Turbulence::Turbulence(const Mesh& m, const Boundary& b, const Params& params) : law_(closure_law(params.closure)) {
  if (params.closure == Closure::laminar) return;
  const bool with_omega = std::holds_alternative<KOmegaSst>(law_);
  const Field f(m.nx, m.ny);
  strain_ = gain_ = decay_ = f;
  next_k_ = next_e_ = f;
  if (with_omega) omega_ = cross_ = blend_ = f;
  distance_ = distance_from_walls(m, b);
  inlet_k_ = b.inlet_k;
  inlet_e_ = b.inlet_epsilon;
  if (with_omega)
    for (std::size_t j = 0; j < inlet_e_.size(); ++j) inlet_e_[j] /= launder_spalding.c_mu * inlet_k_[j];

  // k-epsilon needs a wall function to touch a wall; k-omega reaches down to any.
  const auto touches = [&](Wall wall) { return with_omega ? wall != Wall::slip : has_wall_function(wall); };
  std::vector<FixedCell> solid;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      if (m.volume(i, j) <= 0)
        solid.push_back({i, j, 0.0});
      else if (m.wall_length(i, j) > 0 && touches(m.pipe.wall))
        walls_.push_back({i, j, WallCell::pipe, m.pipe.wall, m.wall_distance(i, j), m.wall_length(i, j)});
      else if (j == 0 && touches(b.floor))
        walls_.push_back({i, j, WallCell::floor, b.floor, 0.5 * m.dy(j), m.dx(i)});
      else if (j == m.ny - 1 && touches(b.top))
        walls_.push_back({i, j, WallCell::lid, b.top, 0.5 * m.dy(j), m.dx(i)});
    }
  for (const WallCell& cell : walls_) {
    if (!with_omega) fixed_k_.push_back({cell.i, cell.j, k_floor});
    fixed_e_.push_back({cell.i, cell.j, epsilon_floor});
  }
  for (FixedCell cell : solid) {
    cell.value = k_floor;
    fixed_k_.push_back(cell);
    cell.value = with_omega ? omega_floor : epsilon_floor;
    fixed_e_.push_back(cell);
  }
}

double Turbulence::shear_velocity(const WallCell& a, const State& s, const Workspace& w) {
  const double u = 0.5 * (s.u(a.i, a.j) + s.u(a.i + 1, a.j)), v = 0.5 * (s.v(a.i, a.j) + s.v(a.i, a.j + 1));
  switch (a.where) {
    case WallCell::pipe:
      return std::sqrt(w.wall_c(a.i, a.j) / a.length * std::hypot(u, v));
    case WallCell::floor:
      return std::sqrt(w.floor_c[a.i] * std::abs(u));
    case WallCell::lid:
      return std::sqrt(w.top_c[a.i] * std::abs(u));
  }
  return 0;
}

void Turbulence::prepare(const Mesh& m, const Boundary& b, const Params& params, State& s) {
  for_each_item(0, m.ny, [&](int j) {
    const double *u = s.u.row(j), *ub = s.u.row(j - 1), *ua = s.u.row(j + 1), *v = s.v.row(j), *va = s.v.row(j + 1);
    const double *dx = m.dx_.data() + 2, *hx = m.dx_face_.data() + 2;
    const double dy = m.dy(j), h_below = m.dy_face(j), h_above = m.dy_face(j + 1);
    double* strain = strain_.row(j);
    vector_loop(0, m.nx, [&](int i) {
      const double dudx = (u[i + 1] - u[i]) / dx[i], dvdy = (va[i] - v[i]) / dy;
      const double uc = u[i] + u[i + 1], vc = v[i] + va[i];
      const double dudy = 0.25 * ((ua[i] + ua[i + 1] - uc) / h_above + (uc - ub[i] - ub[i + 1]) / h_below);
      const double dvdx = 0.25 * ((v[i + 1] + va[i + 1] - vc) / hx[i + 1] + (vc - v[i - 1] - va[i - 1]) / hx[i]);
      strain[i] = strain_squared(dudx, dvdy, dudy + dvdx);
    });
  });
  const KOmegaSst* sst = std::get_if<KOmegaSst>(&law_);
  if (!sst) return;
  for_each_item(0, m.ny, [&](int j) {
    const double *k = s.k.row(j), *e = s.epsilon.row(j);
    double* omega = omega_.row(j);
    vector_loop(0, m.nx, [&](int i) { omega[i] = e[i] / (launder_spalding.c_mu * k[i]); });
  });
  fill_scalar_ghosts(m, b.inlet ? &inlet_k_ : nullptr, s.k);
  fill_scalar_ghosts(m, b.inlet ? &inlet_e_ : nullptr, omega_);
  const double nu = params.viscosity;
  for_each_item(0, m.ny, [&](int j) {
    const double *k = s.k.row(j), *kb = s.k.row(j - 1), *ka = s.k.row(j + 1);
    const double *o = omega_.row(j), *ob = omega_.row(j - 1), *oa = omega_.row(j + 1);
    const double *ax = m.aperture_x.row(j), *ay = m.aperture_y.row(j), *ay_above = m.aperture_y.row(j + 1);
    const double *hx = m.dx_face_.data() + 2, *y = distance_.row(j), *strain = strain_.row(j), *nut = s.nut.row(j);
    const double h_below = m.dy_face(j), h_above = m.dy_face(j + 1);
    double *cross = cross_.row(j), *blend = blend_.row(j);
    vector_loop(0, m.nx, [&](int i) {
      // Closed faces have no slope.
      const double west = ax[i] / hx[i], east = ax[i + 1] / hx[i + 1];
      const double south = ay[i] / h_below, north = ay_above[i] / h_above;
      const double dkdx = west * (k[i] - k[i - 1]) + east * (k[i + 1] - k[i]);
      const double dkdy = south * (k[i] - kb[i]) + north * (ka[i] - k[i]);
      const double dodx = west * (o[i] - o[i - 1]) + east * (o[i + 1] - o[i]);
      const double dody = south * (o[i] - ob[i]) + north * (oa[i] - o[i]);
      cross[i] = 0.25 * (dkdx * dodx + dkdy * dody);
      blend[i] = sst->blend({k[i], o[i], nut[i], strain[i], cross[i], 0.0}, y[i], nu);
    });
  });
  fill_scalar_ghosts(m, nullptr, blend_);
}

template <class Rate, class Diffusion>
void Turbulence::evaluate(const Mesh& m, const Params& params, const Staggering& at, const State& s,
                          const Field& second, Workspace& w, Rate rate, Diffusion diffusion) {
  // Laws without omega read neither cross nor blend: any field may stand for them.
  const Field &cross_field = omega_.nx() > 0 ? cross_ : strain_, &blend_field = omega_.nx() > 0 ? blend_ : strain_;
  const double nu = params.viscosity;
  Conductance& g = w.conductance;
  for_each_item(0, m.ny + 1, [&](int j) {
    const double *nut = s.nut.row(j), *nut_below = s.nut.row(j - 1), *ax = at.area_x.row(j), *ay = at.area_y.row(j);
    const double *blend = blend_field.row(j), *blend_below = blend_field.row(j - 1), *hx = at.hx.data() + 2;
    double *gx = g.x.row(j), *gy = g.y.row(j);
    const double inverse_hy = j > 0 && j < m.ny ? 1.0 / at.hy[j + 2] : 0.0;
    vector_loop(0, m.nx + 1, [&](int i) {
      const double here = nut[i] * diffusion(blend[i]);
      gx[i] = (nu + 0.5 * (nut[i - 1] * diffusion(blend[i - 1]) + here)) * ax[i] / hx[i];
      gy[i] = (nu + 0.5 * (nut_below[i] * diffusion(blend_below[i]) + here)) * ay[i] * inverse_hy;
    });
    gx[0] = gx[m.nx] = 0;
    if (j == m.ny) return;
    const double *k = s.k.row(j), *e = second.row(j), *strain = strain_.row(j), *cross = cross_field.row(j);
    double *gain = gain_.row(j), *decay = decay_.row(j);
    vector_loop(0, m.nx, [&](int i) {
      const Rates r = rate(Local{k[i], e[i], nut[i], strain[i], cross[i], blend[i]});
      gain[i] = r.gain;
      decay[i] = r.decay;
    });
  });
}

ScalarEquation Turbulence::k_equation(const Mesh& m, const Params& params, const Staggering& at, State& s,
                                      Workspace& w) {
  std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        evaluate(
            m, params, at, s, Law::transports_omega ? omega_ : s.epsilon, w, [&](const Local& a) { return law.k(a); },
            [&](double blend) { return law.diffusion_k(blend); });
        for (std::size_t n = 0; n < walls_.size(); ++n) {
          const WallCell& a = walls_[n];
          const double u_star = shear_velocity(a, s, w);
          if constexpr (Law::transports_omega) {
            // The stress u*^2 does its work on the slope u*^2/(nu + nut) at every distance; k is 0 on a smooth wall.
            const double nut = s.nut(a.i, a.j), nu = params.viscosity;
            gain_(a.i, a.j) = nut * square(u_star * u_star / (nu + nut));
            if (a.wall != Wall::rough) decay_(a.i, a.j) += nu * a.length / (a.y * at.inertia(a.i, a.j));
          } else {
            fixed_k_[n].value = wall_k(u_star);
          }
        }
      },
      law_);
  return {s.k, next_k_, gain_, decay_, w.conductance, inlet_k_, fixed_k_, k_floor};
}

ScalarEquation Turbulence::second_equation(const Mesh& m, const Params& params, const Staggering& at, State& s,
                                           Workspace& w) {
  std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        evaluate(
            m, params, at, s, Law::transports_omega ? omega_ : s.epsilon, w, [&](const Local& a) { return law.e(a); },
            [&](double blend) { return law.diffusion_e(blend); });
        for (std::size_t n = 0; n < walls_.size(); ++n) {
          const WallCell& a = walls_[n];
          const double u_star = shear_velocity(a, s, w), nu = params.viscosity;
          fixed_e_[n].value = Law::transports_omega ? KOmegaSst::wall_omega(u_star, a.y, nu, a.wall != Wall::rough)
                                                    : wall_epsilon(u_star, a.y, nu);
        }
      },
      law_);
  const bool with_omega = std::holds_alternative<KOmegaSst>(law_);
  return {with_omega ? omega_ : s.epsilon,         next_e_, gain_, decay_, w.conductance, inlet_e_, fixed_e_,
          with_omega ? omega_floor : epsilon_floor};
}

template <class Law>
void Turbulence::update_eddy_viscosity(const Law& law, const Mesh& m, const Params& params, const Field& second,
                                       State& s) {
  const double nu = params.viscosity, most = nut_over_nu_most * nu;
  for_each_item(0, m.ny, [&](int j) {
    const double *k = s.k.row(j), *e = second.row(j), *volume = m.volume.row(j), *strain = strain_.row(j),
                 *y = distance_.row(j);
    double* nut = s.nut.row(j);
    vector_loop(0, m.nx, [&](int i) {
      nut[i] = volume[i] > 0 ? std::min(law.eddy_viscosity(k[i], e[i], strain[i], y[i], nu), most) : 0.0;
    });
  });
  fill_scalar_ghosts(m, nullptr, s.nut);
}

void Turbulence::complete(const Mesh& m, const Params& params, State& s) {
  s.k.swap(next_k_);
  std::visit(
      [&](const auto& law) {
        if constexpr (std::decay_t<decltype(law)>::transports_omega) {
          omega_.swap(next_e_);
          update_eddy_viscosity(law, m, params, omega_, s);
          for_each_item(0, m.ny, [&](int j) {
            const double *k = s.k.row(j), *omega = omega_.row(j);
            double* e = s.epsilon.row(j);
            vector_loop(0, m.nx,
                        [&](int i) { e[i] = std::max(launder_spalding.c_mu * k[i] * omega[i], epsilon_floor); });
          });
        } else {
          s.epsilon.swap(next_e_);
          update_eddy_viscosity(law, m, params, s.epsilon, s);
        }
      },
      law_);
}

void Turbulence::start(const Mesh& m, const Boundary& b, const Params& params, State& s) {
  prepare(m, b, params, s);
  std::visit(
      [&](const auto& law) {
        constexpr bool with_omega = std::decay_t<decltype(law)>::transports_omega;
        update_eddy_viscosity(law, m, params, with_omega ? omega_ : s.epsilon, s);
      },
      law_);
}

}  // namespace livebed::flow
