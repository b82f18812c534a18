#include "flow/turbulence.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"

namespace livebed::flow {

using base::Field;
using base::for_each_item;
using base::SharedRows;
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

/// 1 where eddies may be, 0 inside the pipe and where the layers that leave it are still laminar.
Field eddying_cells(const Mesh& m) {
  Field eddying(m.nx, m.ny, 2, 1.0);
  const double laminar = m.pipe.layer == PipeLayer::laminar ? transition_distance * m.pipe.diameter : 0.0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i)
      if (m.volume(i, j) <= 0 || (m.has_pipe() && m.wall_distance(i, j) < laminar)) eddying(i, j) = 0;
  return eddying;
}

}  // namespace

Turbulence::Turbulence(const Mesh& m, const Boundary& b, const Params& params) : law_(closure_law(params)) {
  if (params.closure == Closure::laminar) return;
  const Field f(m.nx, m.ny);
  strain_ = nut_ = f;
  if (with_omega()) omega_ = omega_old_ = cross_ = blend_ = f;
  open_x_ = SharedRows(m.aperture_x), open_y_ = SharedRows(m.aperture_y), eddying_ = SharedRows(eddying_cells(m));
  distance_ = distance_from_walls(m, b);
  set_inlet(b);

  // k-epsilon needs a wall function to touch a wall; k-omega reaches down to any.
  const auto touches = [&](Wall wall) { return with_omega() ? wall != Wall::slip : has_wall_function(wall); };
  const Staggering at = Staggering::centres(m);
  const double least_e = second_floor();
  for (int j = 0; j < m.ny; ++j) {
    for (FixedCells* fixed : {&fixed_k_, &fixed_e_}) fixed->first.push_back(static_cast<int>(fixed->cells.size()));
    for (int i = 0; i < m.nx; ++i) {
      const auto place = [&](WallPlace::Where where, Wall wall, double y, double length) {
        walls_.push_back({i, j, where, wall, y, length, 1.0 / at.inertia(i, j)});
        fixed_k_.of_wall.push_back(static_cast<int>(fixed_k_.cells.size()));
        fixed_e_.of_wall.push_back(static_cast<int>(fixed_e_.cells.size()));
        if (!with_omega()) fixed_k_.cells.push_back({i, j, k_floor});
        fixed_e_.cells.push_back({i, j, least_e});
      };
      if (m.volume(i, j) <= 0) {
        fixed_k_.cells.push_back({i, j, k_floor});
        fixed_e_.cells.push_back({i, j, least_e});
      } else if (m.wall_length(i, j) > 0 && touches(m.pipe.wall)) {
        place(WallPlace::pipe, m.pipe.wall, m.wall_distance(i, j), m.wall_length(i, j));
      } else if (j == 0 && touches(b.floor)) {
        place(WallPlace::floor, b.floor, 0.5 * m.dy(j), m.dx(i));
      } else if (j == m.ny - 1 && touches(b.top)) {
        place(WallPlace::lid, b.top, 0.5 * m.dy(j), m.dx(i));
      }
    }
  }
  for (FixedCells* fixed : {&fixed_k_, &fixed_e_}) {
    fixed->first.push_back(static_cast<int>(fixed->cells.size()));
    Field factor(m.nx, m.ny, 2, 1.0);
    for (const FixedCell& cell : fixed->cells) factor(cell.i, cell.j) = fixed_row;
    (fixed == &fixed_k_ ? factor_k_ : factor_e_) = SharedRows(factor);
  }
}

void Turbulence::set_inlet(const Boundary& b) {
  inlet_k_ = b.inlet_k;
  inlet_e_ = b.inlet_epsilon;
  if (with_omega())
    for (std::size_t j = 0; j < inlet_e_.size(); ++j) inlet_e_[j] /= launder_spalding.c_mu * inlet_k_[j];
}

double Turbulence::second_floor() const { return with_omega() ? omega_floor : epsilon_floor; }

double Turbulence::shear_velocity(const WallPlace& a, const State& s, const Workspace& w) {
  const double u = 0.5 * (s.u(a.i, a.j) + s.u(a.i + 1, a.j)), v = 0.5 * (s.v(a.i, a.j) + s.v(a.i, a.j + 1));
  switch (a.where) {
    case WallPlace::pipe:
      return std::sqrt(w.wall_c(a.i, a.j) / a.length * std::hypot(u, v));
    case WallPlace::floor:
      return std::sqrt(w.floor_c[a.i] * std::abs(u));
    case WallPlace::lid:
      return std::sqrt(w.top_c[a.i] * std::abs(u));
  }
  return 0;
}

void Turbulence::set_walls(const Params& params, const State& s, const Workspace& w) {
  const double nu = params.viscosity;
  const bool sst = params.closure == Closure::k_omega_sst;
  for (std::size_t n = 0; n < walls_.size(); ++n) {
    WallPlace& a = walls_[n];
    const double u_star = shear_velocity(a, s, w);
    double& e = fixed_e_.cells[fixed_e_.of_wall[n]].value;
    if (with_omega()) {
      e = (sst ? KOmegaSst::wall_omega : KOmega::wall_omega)(u_star, a.y, nu, a.wall != Wall::rough);
      // The stress u*^2 does its work on the slope u*^2/(nu + nut) at every distance; k is 0 on a smooth wall.
      const double nut = nut_(a.i, a.j);
      a.gain = nut * square(u_star * u_star / (nu + nut));
      a.decay = a.wall != Wall::rough ? nu * a.length / a.y * a.per_inertia : 0.0;
    } else {
      e = wall_epsilon(u_star, a.y, nu, params.wall_damping);
      fixed_k_.cells[fixed_k_.of_wall[n]].value = wall_k(u_star);
    }
  }
}

namespace {

/// A quantity that stays positive, centred in the step to come by what it did in the last one.
double centred(double now, double before, double ahead) { return now + believed_change(ahead * (now - before), now); }

}  // namespace

void Turbulence::prepare(const Mesh& m, const Boundary& b, const Params& params, double ahead, State& s,
                         const Workspace& w) {
  ahead_ = ahead;
  const double nu = params.viscosity, most = nut_over_nu_most * nu;
  if (with_omega()) {
    for_each_item(0, m.ny, [&](int j) {
      const double *k = s.k.row(j), *e = s.epsilon.row(j), *ko = s.k_old.row(j), *eo = s.epsilon_old.row(j);
      double *omega = omega_.row(j), *old = omega_old_.row(j);
      vector_loop(0, m.nx, [&](int i) {
        omega[i] = e[i] / (launder_spalding.c_mu * k[i]);
        old[i] = eo[i] / (launder_spalding.c_mu * ko[i]);
      });
    });
    fill_scalar_ghosts(m, b.inlet ? &inlet_e_ : nullptr, omega_);
  } else {
    fill_scalar_ghosts(m, b.inlet ? &inlet_e_ : nullptr, s.epsilon);
  }
  fill_scalar_ghosts(m, b.inlet ? &inlet_k_ : nullptr, s.k);

  const Field &second_now = second(s), &second_before = second_old(s);
  std::visit(
      [&](const auto& law) {
        for_each_item(0, m.ny, [&](int j) {
          const double *u = s.u.row(j), *ub = s.u.row(j - 1), *ua = s.u.row(j + 1), *v = s.v.row(j),
                       *va = s.v.row(j + 1);
          const double *per_dx = w.per_dx.data() + 2, *per_hx = w.per_dx_face.data() + 2;
          const double per_dy = 1.0 / m.dy(j), per_below = 1.0 / m.dy_face(j), per_above = 1.0 / m.dy_face(j + 1);
          const double *k = s.k.row(j), *ko = s.k_old.row(j), *e = second_now.row(j), *eo = second_before.row(j);
          const double *eddying = eddying_.row(j), *y = distance_.row(j);
          double *strain = strain_.row(j), *nut = nut_.row(j);
          vector_loop(0, m.nx, [&](int i) {
            const double dudx = (u[i + 1] - u[i]) * per_dx[i], dvdy = (va[i] - v[i]) * per_dy;
            const double uc = u[i] + u[i + 1], vc = v[i] + va[i];
            const double dudy = 0.25 * ((ua[i] + ua[i + 1] - uc) * per_above + (uc - ub[i] - ub[i + 1]) * per_below);
            const double dvdx =
                0.25 * ((v[i + 1] + va[i + 1] - vc) * per_hx[i + 1] + (vc - v[i - 1] - va[i - 1]) * per_hx[i]);
            strain[i] = strain_squared(dudx, dvdy, dudy + dvdx);
            const double kc = centred(k[i], ko[i], ahead), ec = centred(e[i], eo[i], ahead);
            nut[i] = eddying[i] > 0 ? std::min(law.eddy_viscosity(kc, ec, strain[i], y[i], nu), most) : 0.0;
          });
        });
      },
      law_);
  fill_scalar_ghosts(m, nullptr, nut_);
  set_walls(params, s, w);
  std::visit(
      [&](const auto& law) {
        if constexpr (std::decay_t<decltype(law)>::transports_omega) fill_blend(m, params, law, s, w);
      },
      law_);
}

template <class Law>
void Turbulence::fill_blend(const Mesh& m, const Params& params, const Law& law, const State& s, const Workspace& w) {
  const double nu = params.viscosity;
  for_each_item(0, m.ny, [&](int j) {
    const double *k = s.k.row(j), *kb = s.k.row(j - 1), *ka = s.k.row(j + 1);
    const double *o = omega_.row(j), *ob = omega_.row(j - 1), *oa = omega_.row(j + 1);
    const double *ax = open_x_.row(j), *ay = open_y_.row(j), *ay_above = open_y_.row(j + 1);
    const double *per_hx = w.per_dx_face.data() + 2, *y = distance_.row(j), *strain = strain_.row(j),
                 *nut = nut_.row(j);
    const double per_below = 1.0 / m.dy_face(j), per_above = 1.0 / m.dy_face(j + 1);
    double *cross = cross_.row(j), *blend = blend_.row(j);
    vector_loop(0, m.nx, [&](int i) {
      // Closed faces have no slope.
      const double west = ax[i] * per_hx[i], east = ax[i + 1] * per_hx[i + 1];
      const double south = ay[i] * per_below, north = ay_above[i] * per_above;
      const double dkdx = west * (k[i] - k[i - 1]) + east * (k[i + 1] - k[i]);
      const double dkdy = south * (k[i] - kb[i]) + north * (ka[i] - k[i]);
      const double dodx = west * (o[i] - o[i - 1]) + east * (o[i + 1] - o[i]);
      const double dody = south * (o[i] - ob[i]) + north * (oa[i] - o[i]);
      cross[i] = 0.25 * (dkdx * dodx + dkdy * dody);
      blend[i] = law.blend({k[i], o[i], nut[i], strain[i], cross[i], 0.0}, y[i], nu);
    });
  });
  fill_scalar_ghosts(m, nullptr, blend_);
}

void Turbulence::fill_rates(const Mesh& m, int j, const State& s, const RowRates& to) const {
  const double *k = s.k.row(j), *ko = s.k_old.row(j), *e = second(s).row(j), *eo = second_old(s).row(j);
  const double *nut = nut_.row(j), *strain = strain_.row(j), ahead = ahead_;
  std::visit(
      [&](const auto& law) {
        const auto fill = [&](auto cross, auto blend) {
          vector_loop(0, m.nx, [&](int i) {
            const Local a{
                centred(k[i], ko[i], ahead), centred(e[i], eo[i], ahead), nut[i], strain[i], cross(i), blend(i)};
            const Rates of_k = law.k(a), of_e = law.e(a);
            to.gain_k[i] = of_k.gain, to.decay_k[i] = of_k.decay;
            to.gain_e[i] = of_e.gain, to.decay_e[i] = of_e.decay;
          });
        };
        if constexpr (std::decay_t<decltype(law)>::transports_omega) {
          const double *cross = cross_.row(j), *blend = blend_.row(j);
          fill([cross](int i) { return cross[i]; }, [blend](int i) { return blend[i]; });
        } else {
          fill([](int) { return 0.0; }, [](int) { return 0.0; });
        }
      },
      law_);
  const auto add = [&](const Field* source, double* gain) {
    if (!source) return;
    const double* given = source->row(j);
    vector_loop(0, m.nx, [&](int i) { gain[i] += given[i]; });
  };
  add(source_k_, to.gain_k), add(source_e_, to.gain_e);
  if (j < s.load.top) add_grains(j, s, to);
  if (!with_omega()) return;
  const auto before = [](const WallPlace& a, int row) { return a.j < row; };
  for (auto a = std::lower_bound(walls_.begin(), walls_.end(), j, before); a != walls_.end() && a->j == j; ++a)
    to.gain_k[a->i] = a->gain, to.decay_k[a->i] += a->decay;
}

void Turbulence::add_grains(int j, const State& s, const RowRates& to) const {
  // omega = epsilon/(Cmu k) loses what epsilon loses beyond k.
  const double of_e = with_omega() ? grain_damping_epsilon - 1.0 : grain_damping_epsilon;
  const double *k = s.k.row(j), *e = second(s).row(j), *damping = s.load.damping.row(j), *room = s.load.room.row(j);
  const double c_mu = launder_spalding.c_mu, c_34 = std::pow(c_mu, 0.75);
  const bool omega = with_omega();
  vector_loop(0, strain_.nx(), [&](int i) {
    to.decay_k[i] += damping[i], to.decay_e[i] += of_e * damping[i];
    // What the second quantity is where the mixing length is kappa times the room.
    const double turnover = c_34 * std::sqrt(k[i]) / (kappa * (room[i] > 0 ? room[i] : 1.0));
    const double least = omega ? turnover / c_mu : turnover * k[i];
    const double rate = room[i] > 0 && e[i] < least ? breakup * turnover * (1.0 - e[i] / least) : 0.0;
    to.gain_e[i] += rate * least, to.decay_e[i] += rate;
  });
}

template <class Fill>
void Turbulence::with_diffusion(bool of_k, Fill&& fill) const {
  std::visit(
      [&](const auto& law) {
        if (of_k)
          fill([&](double blend) { return law.diffusion_k(blend); });
        else
          fill([&](double blend) { return law.diffusion_e(blend); });
      },
      law_);
}

void Turbulence::fill_exchange_x(const Mesh& m, const Params& params, const Staggering& at, bool of_k, int j,
                                 double* k) const {
  // Laws without omega do not look at the blending: any row may stand for it.
  const double *nut = nut_.row(j), *blend = (with_omega() ? blend_ : nut_).row(j);
  const double *open = at.open_x.row(j), *per_hx = at.per_hx.data() + 2, nu = params.viscosity;
  with_diffusion(of_k, [&](auto diffusion) {
    vector_loop(0, m.nx + 1, [&](int i) {
      const double mean = 0.5 * (nut[i - 1] * diffusion(blend[i - 1]) + nut[i] * diffusion(blend[i]));
      k[i] = (nu + mean) * open[i] * per_hx[i];
    });
  });
  k[0] = k[m.nx] = 0;
}

void Turbulence::fill_exchange_y(const Mesh& m, const Params& params, const Staggering& at, bool of_k, int j, int ia,
                                 int ib, double* k) const {
  const Field& blend_field = with_omega() ? blend_ : nut_;
  const double *nut = nut_.row(j), *nut_below = nut_.row(j - 1), *blend = blend_field.row(j),
               *blend_below = blend_field.row(j - 1);
  const double *open = at.open_y.row(j), nu = params.viscosity, inside = j > 0 && j < m.ny ? at.per_hy[j + 2] : 0.0;
  with_diffusion(of_k, [&](auto diffusion) {
    vector_loop(ia, ib, [&](int i) {
      const double mean = 0.5 * (nut_below[i] * diffusion(blend_below[i]) + nut[i] * diffusion(blend[i]));
      k[i - ia] = inside * (nu + mean) * open[i];
    });
  });
}

void Turbulence::store(const Params& params, int j, int ia, int ib, const double* k, const double* e, double* to_k,
                       double* to_epsilon, double* to_nut) const {
  const double *eddying = eddying_.row(j), *strain = strain_.row(j), *y = distance_.row(j);
  const double nu = params.viscosity, most = nut_over_nu_most * nu;
  std::visit(
      [&](const auto& law) {
        vector_loop(ia, ib, [&](int i) {
          const double ki = k[i - ia], ei = e[i - ia];
          const double nut = std::min(law.eddy_viscosity(ki, ei, strain[i], y[i], nu), most);
          to_k[i] = ki;
          to_epsilon[i] = std::decay_t<decltype(law)>::transports_omega
                              ? std::max(launder_spalding.c_mu * ki * ei, epsilon_floor)
                              : ei;
          to_nut[i] = eddying[i] > 0 ? nut : 0.0;
        });
      },
      law_);
}

void Turbulence::start(const Mesh& m, const Boundary& b, const Params& params, State& s, const Workspace& w) {
  s.k_old = s.k, s.epsilon_old = s.epsilon;
  prepare(m, b, params, 0.0, s, w);
  s.nut = nut_;
}

}  // namespace livebed::flow
