#include "coupling/exchange.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/loops.hpp"
#include "base/math.hpp"
#include "coupling/forces.hpp"

namespace livebed::coupling {

using base::Field;
using base::for_each_item;
using base::vector_loop;

namespace {

DragLaw make_drag(const Params& p) {
  const SingleGrain single{p.drag_curve, p.drag_viscous, p.drag_infinity};
  switch (p.drag) {
    case Drag::di_felice:
      return DiFeliceDrag{single};
    case Drag::gidaspow:
      return GidaspowDrag{single};
    case Drag::rong:
      return RongDrag{single};
    case Drag::paper:
      break;
  }
  return PaperDrag{single};
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

/// values[first, last) <- their mean.
void level(double* values, int first, int last) {
  const double mean = base::vector_sum(first, last, [&](int i) { return values[i]; }) / (last - first);
  std::fill(values + first, values + last, mean);
}

/// Calls body(k) for every grain of a list, on all threads.
template <class Body>
void over_grains(const std::vector<int>& which, Body&& body) {
  constexpr int block = 1024;
  const int count = static_cast<int>(which.size());
  for_each_item(0, (count + block - 1) / block, [&](int b) {
    for (int m = b * block; m < std::min(count, (b + 1) * block); ++m) body(which[m]);
  });
}

/// Row j of the volumes of `at` [m3], water alone, slab included.
class Volumes {
public:
  Volumes(const flow::Staggering& at, int j, double slab)
      : open_(at.open_volume.row(j)), width_(at.width.data() + 2), height_(slab * at.height[j + 2]) {}
  double operator[](int i) const { return height_ * open_[i] * width_[i]; }

private:
  const double *open_, *width_;
  double height_;
};

}  // namespace

Coupler::Coupler(const Params& params, const flow::Solver& flow, const Materials& materials)
    : params_(params),
      materials_(materials),
      drag_(make_drag(params)),
      uniform_(flow.params().current.profile == flow::Profile::recycled),
      nx_(flow.mesh().nx),
      ny_(flow.mesh().ny),
      y_(flow.mesh().y.begin() + 1, flow.mesh().y.end()),
      reach_(params.kernel * materials.grain_diameter),
      slab_(materials.grain_diameter),
      density_(flow.params().density),
      viscosity_(materials.viscosity),
      owed_u_(nx_, ny_),
      owed_v_(nx_, ny_) {
  const flow::Mesh& m = flow.mesh();
  const flow::Staggering centres = flow::Staggering::centres(m);
  at_.u = Transfer(flow::Staggering::west_faces(m), m.aperture_x, 1, nx_ - 1, reach_);
  at_.v = Transfer(flow::Staggering::south_faces(m), m.aperture_y, 0, nx_ - 1, reach_);
  at_.c = Transfer(centres, m.volume, 0, nx_ - 1, reach_);
  still_ = StillGrains(nx_, ny_, materials.grains, materials.grain_diameter);
  if (params.dispersion != Dispersion::none) eddies_ = Eddies(materials.grains, materials.seed);
  for (grains::Array* a :
       {&eddy_k_, &eddy_epsilon_, &gust_k_, &gust_time_, &gust_slope_x_, &gust_slope_y_, &eddy_u_, &eddy_v_, &slope_x_,
        &slope_y_, &rate_x_, &rate_y_, &vorticity_, &given_x_, &given_y_, &before_u_, &before_v_})
    a->assign(materials.grains, 0.0);
  voidage_.assign(materials.grains, 1.0);
  volume_c_ = Field(nx_, ny_);
  for (int j = 0; j < ny_; ++j)
    for (int i = 0; i < nx_; ++i) volume_c_(i, j) = slab_ * centres.volume(i, j);
  gusts_ = Gusts(nx_, ny_);
  room_ = EddyRoom(nx_, ny_, params.room_power, slab_);
  for (Field* f : {&voids_, &slope_u_, &slope_v_, &gust_slope_u_, &gust_slope_v_, &rate_u_, &rate_v_, &curl_})
    *f = Field(nx_, ny_);
}

void Coupler::locate(const grains::State& g) {
  moving_.clear();
  for (int k = 0; k < g.count(); ++k)
    if (!is_still(g, k)) moving_.push_back(k);
  at_.locate(g.x, g.y, moving_);
  located_ = true;
}

void Coupler::let_leave(grains::State& g, const std::vector<int>& leaving) {
  still_.let_leave(g, at_, leaving);
  located_ = voids_filled_ = false;
}

template <class Rests>
void Coupler::settle(grains::State& g, double exposed, Rests&& rests) {
  // What is asked of a grain in the step in which it wakes; of those asleep it is zero, as after a load.
  for (const int k : still_.step(g, at_, exposed, rests)) before_u_[g.id[k]] = g.u[k], before_v_[g.id[k]] = g.v[k];
  if (still_.changed()) located_ = voids_filled_ = false;
}

void Coupler::hold(grains::State& g) {
  if (params_.mode == Mode::two_way) settle(g, 0, [](int) { return true; });
}

void Coupler::let_go(grains::State& g) {
  still_.begin(g);
  located_ = voids_filled_ = false;
}

int Coupler::rows_with_grains(const grains::State& g) const {
  if (g.count() == 0) return 0;
  const double top = reach_ + base::vector_largest(0, g.count(), 0.0, [&](int k) { return g.y[k]; });
  // A volume of v reaches half a row further down than its row.
  return std::min(ny_, static_cast<int>(std::lower_bound(y_.begin(), y_.end(), top) - y_.begin()) + 2);
}

double Coupler::response_time(const grains::State& g, int k) const {
  const double inertia = materials_.grain_density + materials_.added_mass * density_;
  return inertia * base::sphere_volume(g.diameter[k]) / g.fluid.beta[k];
}

double Coupler::step_limit(const grains::State& g) const {
  double least = std::numeric_limits<double>::infinity();
  if (params_.voidage == Voidage::off || params_.mode != Mode::two_way) return least;
  const auto may_move = [&](int k) {
    if (!is_still(g, k)) least = std::min(least, response_time(g, k));
  };
  if (located_) {
    std::for_each(moving_.begin(), moving_.end(), may_move);
  } else {
    for (int k = 0; k < g.count(); ++k) may_move(k);
  }
  return step_over_response * least;
}

void Coupler::fill_voids(const grains::State& g, flow::Solver& flow, double interval) {
  if (params_.voidage == Voidage::off && params_.drag == Drag::paper && params_.turbulence == Turbulence::untouched &&
      params_.dispersion != Dispersion::attached)
    return;
  voids_filled_ = true;
  voids_ = still_.solid;
  add_volumes(g, voids_);
  to_fractions(voids_);
  for_each_item(0, ny_, [&](int j) {
    double* e = voids_.row(j);
    if (uniform_) level(e, 0, nx_);
    vector_loop(0, nx_, [&](int i) { e[i] = std::clamp(1.0 - e[i], voidage_least, 1.0); });
  });
  at_.c.gather(voids_, voidage_);
  if (params_.voidage == Voidage::on && params_.mode == Mode::two_way) pass_room(flow, interval);
}

void Coupler::pass_room(flow::Solver& flow, double interval) {
  const Field& known = flow.state.voidage;
  const bool moves = known.nx() > 0 && interval > 0;
  if (moves)
    for_each_item(0, ny_, [&](int j) {
      const double* before = known.row(j);
      double* e = voids_.row(j);
      vector_loop(0, nx_, [&](int i) { e[i] = before[i] + share_passed * (e[i] - before[i]); });
    });
  flow.set_voidage(voids_, moves ? interval : 0.0,
                   uniform_ ? 0.0 : std::max(materials_.ends, reach_ + materials_.grain_diameter));
}

void Coupler::feel_eddies(grains::State& g, const flow::Solver& flow, double dt) {
  const flow::State& s = flow.state;
  const double* per_hx = flow.at_c().per_hx.data() + 2;
  const auto slopes_of = [&](const Field& energy, Field& slope_u, Field& slope_v) {
    for_each_item(0, top_, [&](int j) {
      const double *k = energy.row(j), *below = energy.row(std::max(j - 1, 0)), per_hy = flow.at_c().per_hy[j + 2];
      double *along_x = slope_u.row(j), *along_y = slope_v.row(j);
      vector_loop(1, nx_, [&](int i) { along_x[i] = (std::sqrt(k[i]) - std::sqrt(k[i - 1])) * per_hx[i]; });
      vector_loop(0, nx_, [&](int i) { along_y[i] = (std::sqrt(k[i]) - std::sqrt(below[i])) * per_hy; });
    });
  };
  slopes_of(s.k, slope_u_, slope_v_);
  const bool attached = params_.dispersion == Dispersion::attached;
  if (attached) {
    gusts_.fill(flow.mesh(), s, room_.packed, top_, params_.dispersion_time, viscosity_);
    slopes_of(gusts_.k, gust_slope_u_, gust_slope_v_);
    at_.c.gather(std::array<const Field*, 2>{&gusts_.k, &gusts_.time}, {&gust_k_, &gust_time_});
    at_.u.gather(std::array<const Field*, 3>{&s.u, &slope_u_, &gust_slope_u_}, {&g.fluid.u, &slope_x_, &gust_slope_x_});
    at_.v.gather(std::array<const Field*, 3>{&s.v, &slope_v_, &gust_slope_v_}, {&g.fluid.v, &slope_y_, &gust_slope_y_});
  } else {
    at_.u.gather(std::array<const Field*, 2>{&s.u, &slope_u_}, {&g.fluid.u, &slope_x_});
    at_.v.gather(std::array<const Field*, 2>{&s.v, &slope_v_}, {&g.fluid.v, &slope_y_});
  }
  eddies_.begin_step();
  const double energy = params_.dispersion_energy, size = std::sqrt(energy);
  over_grains(moving_, [&](int k) {
    const base::Vec2 water{g.fluid.u[k], g.fluid.v[k]};
    const double speed = base::norm(water),
                 time = Eddies::life_time(params_.dispersion_time, eddy_k_[k], eddy_epsilon_[k], viscosity_);
    const base::Vec2 stream = speed > 0 ? (1.0 / speed) * water : base::Vec2{1, 0};
    const Eddies::Eddy across{energy * eddy_k_[k], {size * slope_x_[k], size * slope_y_[k]}, time};
    const Eddies::Eddy along =
        attached ? Eddies::Eddy{energy * gust_k_[k], {size * gust_slope_x_[k], size * gust_slope_y_[k]}, gust_time_[k]}
                 : across;
    const base::Vec2 felt = eddies_.advance(g.id[k], dt, stream, along, across, response_time(g, k));
    eddy_u_[k] = felt.x, eddy_v_[k] = felt.y;
  });
}

void Coupler::load_eddies(const grains::State& g, flow::Load& load) {
  // 2 beta (1 - t) k a grain of volume-averaged k-epsilon, t the share of an eddy's motion that the grain follows.
  at_.c.scatter(std::array{&load.damping}, [&](int k) {
    const double followed =
        share_followed(params_.turbulence_inertia, response_time(g, k), eddy_k_[k] / eddy_epsilon_[k]);
    return std::array{still_.damps[g.id[k]] = 2.0 * g.fluid.beta[k] * (1.0 - followed)};
  });
  for_each_item(0, load.top, [&](int j) {
    double* rate = load.damping.row(j);
    const double* still = still_.damping.row(j);
    vector_loop(0, nx_, [&](int i) { rate[i] += still[i]; });
  });
}

void Coupler::load_flow(grains::State& g, flow::Solver& flow, double dt, bool held) {
  if (params_.mode == Mode::none) return;
  flow::State& s = flow.state;
  flow::Load& load = s.load;
  const bool may_have_left = !located_;
  if (!located_) locate(g);
  if (!voids_filled_) fill_voids(g, flow, held ? 0.0 : dt);  // held, they leave no room and take none
  const int before = load.top;
  top_ = rows_with_grains(g);
  const bool damped = params_.turbulence == Turbulence::damped, bounded = params_.turbulence != Turbulence::untouched,
             walks = params_.dispersion != Dispersion::none;
  if (bounded || params_.dispersion == Dispersion::attached) room_.average(flow.mesh(), voids_, top_);
  if (damped || walks) at_.c.gather(std::array<const Field*, 2>{&s.k, &s.epsilon}, {&eddy_k_, &eddy_epsilon_});
  if (walks && !held) {
    feel_eddies(g, flow, dt);
  } else {
    at_.u.gather(s.u, g.fluid.u);
    at_.v.gather(s.v, g.fluid.v);
  }
  const double moving = held ? 0.0 : 1.0;
  std::visit(
      [&](const auto& drag) {
        over_grains(moving_, [&](int k) {
          const double slip_x = g.fluid.u[k] + eddy_u_[k] - moving * g.u[k],
                       slip_y = g.fluid.v[k] + eddy_v_[k] - moving * g.v[k];
          g.fluid.beta[k] =
              drag({std::sqrt(slip_x * slip_x + slip_y * slip_y), g.diameter[k], density_, viscosity_, voidage_[k]});
        });
      },
      drag_);
  if (params_.mode == Mode::one_way) return;

  // What is owed to rows that the grains have left is handed over in one more step; from the topmost row, where hardly
  // anything can be, only grains that leave the bed are gone so fast.
  load.top = std::max(top_, may_have_left ? before : before - 1);
  for (Field* f : {&load.beta_u, &load.beta_v, &load.force_u, &load.force_v, &load.damping, &load.room})
    for (int j = 0; j < std::max(before, load.top); ++j) std::fill(f->row(j), f->row(j) + nx_ + 1, 0.0);
  if (held || params_.exchange == Exchange::implicit) {
    at_.u.scatter(std::array{&load.beta_u, &load.force_u}, [&](int k) {
      return std::array{g.fluid.beta[k], moving * g.fluid.beta[k] * (g.u[k] - eddy_u_[k])};
    });
    at_.v.scatter(std::array{&load.beta_v, &load.force_v}, [&](int k) {
      return std::array{g.fluid.beta[k], moving * g.fluid.beta[k] * (g.v[k] - eddy_v_[k])};
    });
  }
  const bool swings = params_.voidage == Voidage::on;
  const auto per_volume = [&](const flow::Staggering& at, Field& owed, const Field& still, Field& beta, Field& force) {
    for_each_item(0, load.top, [&](int j) {
      const Volumes v(at, j, slab_);
      const double passed = swings && j < top_ ? share_passed : 1.0, kept = 1.0 - passed, rate = passed / dt;
      const double* at_rest = still.row(j);
      double *o = owed.row(j), *b = beta.row(j), *f = force.row(j);
      vector_loop(0, nx_, [&](int i) {
        const double inverse = v[i] > 0 ? 1.0 / v[i] : 0.0;
        b[i] = (b[i] + at_rest[i]) * inverse;
        f[i] = (f[i] + o[i] * rate) * inverse;
        o[i] *= kept;
      });
      if (uniform_) level(b, at.i0, nx_), level(f, at.i0, nx_);
      b[nx_] = b[nx_ - 1], f[nx_] = f[nx_ - 1];  // the outlet face feels what its neighbour feels
    });
  };
  per_volume(flow.at_u(), owed_u_, still_.beta_u, load.beta_u, load.force_u);
  per_volume(flow.at_v(), owed_v_, still_.beta_v, load.beta_v, load.force_v);
  if (!bounded) return;
  room_.fill(flow.mesh(), top_, load.room);
  if (damped) load_eddies(g, load);
  for_each_item(0, load.top, [&](int j) {
    const Volumes v(flow.at_c(), j, slab_ * density_);
    double* rate = load.damping.row(j);
    if (uniform_) level(rate, 0, nx_);
    vector_loop(0, nx_, [&](int i) { rate[i] = v[i] > 0 ? rate[i] / v[i] : 0.0; });
  });
}

void Coupler::feel_water(const flow::Solver& flow, grains::State& g, double dt) {
  const flow::State& s = flow.state;
  const flow::Staggering& at_c = flow.at_c();
  const flow::Mesh& m = flow.mesh();
  const double *per_hx = at_c.per_hx.data() + 2, per_dt = 1.0 / dt;
  const bool voids = params_.voidage == Voidage::on, added = params_.added_mass == AddedMass::relative,
             lift = params_.lift == Lift::saffman_mei;
  for_each_item(0, top_, [&](int j) {
    const double *p = s.p.row(j), *below = s.p.row(j - 1), per_hy = at_c.per_hy[j + 2];
    if (voids) {
      double *along_x = slope_u_.row(j), *along_y = slope_v_.row(j);
      const double *open_x = m.aperture_x.row(j), *open_y = m.aperture_y.row(j);
      vector_loop(1, nx_, [&](int i) { along_x[i] = open_x[i] > sliver ? (p[i] - p[i - 1]) * per_hx[i] : 0.0; });
      vector_loop(0, nx_, [&](int i) { along_y[i] = open_y[i] > sliver ? (p[i] - below[i]) * per_hy : 0.0; });
    }
    if (added) {
      const double *u = s.u.row(j), *u_old = s.u_old.row(j), *cu = s.convection_u.row(j);
      const double *v = s.v.row(j), *v_old = s.v_old.row(j), *cv = s.convection_v.row(j);
      double *of_u = rate_u_.row(j), *of_v = rate_v_.row(j);
      vector_loop(0, nx_, [&](int i) {
        of_u[i] = (u[i] - u_old[i]) * per_dt - cu[i];
        of_v[i] = (v[i] - v_old[i]) * per_dt - cv[i];
      });
    }
    if (lift) {
      const double *u_above = s.u.row(j + 1), *u_below = s.u.row(j - 1);
      const double *v = s.v.row(j), *v_above = s.v.row(j + 1);
      const double across_y = 0.5 / (1.0 / at_c.per_hy[j + 2] + 1.0 / at_c.per_hy[j + 3]);
      double* curl = curl_.row(j);
      vector_loop(0, nx_, [&](int i) {
        const double dvdx =
            0.5 * (v[i + 1] + v_above[i + 1] - v[i - 1] - v_above[i - 1]) / (1.0 / per_hx[i] + 1.0 / per_hx[i + 1]);
        curl[i] = dvdx - across_y * (u_above[i] + u_above[i + 1] - u_below[i] - u_below[i + 1]);
      });
    }
  });
  if (voids) {
    at_.u.gather(std::array<const Field*, 2>{&s.u, &slope_u_}, {&g.fluid.u, &slope_x_});
    at_.v.gather(std::array<const Field*, 2>{&s.v, &slope_v_}, {&g.fluid.v, &slope_y_});
  } else {
    at_.u.gather(s.u, g.fluid.u);
    at_.v.gather(s.v, g.fluid.v);
  }
  if (added) {
    at_.u.gather(rate_u_, rate_x_);
    at_.v.gather(rate_v_, rate_y_);
  }
  if (lift) at_.c.gather(curl_, vorticity_);

  over_grains(moving_, [&](int k) {
    const double volume = base::sphere_volume(g.diameter[k]);
    const int id = g.id[k];
    base::Vec2 force = voids ? base::Vec2{-volume * slope_x_[k], -volume * slope_y_[k]} : base::Vec2{};
    given_x_[id] = force.x, given_y_[id] = force.y;
    before_u_[id] = g.u[k], before_v_[id] = g.v[k];
    if (added) force = force + (materials_.added_mass * density_ * volume) * base::Vec2{rate_x_[k], rate_y_[k]};
    if (lift) {
      const base::Vec2 slip{g.fluid.u[k] - g.u[k], g.fluid.v[k] - g.v[k]};
      const double scale =
          saffman_mei_lift(base::norm(slip), std::abs(vorticity_[k]), g.diameter[k], density_, viscosity_);
      force = force + (scale * vorticity_[k]) * base::Vec2{slip.y, -slip.x};
    }
    g.fluid.fx[k] = force.x, g.fluid.fy[k] = force.y;
    g.fluid.u[k] += eddy_u_[k], g.fluid.v[k] += eddy_v_[k];
  });
}

void Coupler::push_grains(const flow::Solver& flow, grains::State& g, double dt) {
  constexpr int block = 4096;
  for_each_item(0, (g.count() + block - 1) / block, [&](int b) {
    const int end = std::min(g.count(), (b + 1) * block);
    std::fill(g.impulse_x.begin() + b * block, g.impulse_x.begin() + end, 0.0);
    std::fill(g.impulse_y.begin() + b * block, g.impulse_y.begin() + end, 0.0);
  });
  if (params_.mode == Mode::none) return;
  feel_water(flow, g, dt);
}

void Coupler::collect(grains::State& g, const flow::Solver& flow, double dt) {
  located_ = voids_filled_ = false;  // the grains have moved
  if (params_.mode != Mode::two_way) return;
  const flow::State& s = flow.state;
  ledger_.to_grains.x += given_to_still(still_.beta_u, s.u, dt);
  ledger_.to_grains.y += given_to_still(still_.beta_v, s.v, dt);
  const std::vector<int>& woken = still_.wake(g, at_);
  locate(g);
  const double relative = params_.added_mass == AddedMass::relative ? materials_.added_mass * density_ : 0.0;
  const bool implicit = params_.exchange == Exchange::implicit;
  const auto one = [&](Transfer& to, const flow::Staggering& at, const grains::Array& impulse,
                       const grains::Array& speed, const grains::Array& felt, const grains::Array& given,
                       const grains::Array& before, const Field& velocity, const Field& beta, const Field& force,
                       double& to_flow, double& to_grains, double& carried, Field& owed) {
    for (int j = 0; j < s.load.top; ++j) {
      const Volumes v(at, j, slab_);
      const double *u = velocity.row(j), *b = beta.row(j), *f = force.row(j);
      to_flow += base::vector_sum(0, nx_, [&](int i) { return dt * (f[i] - b[i] * u[i]) * v[i]; });
    }
    const auto received = [&](int k) {
      const int id = g.id[k];
      return impulse[k] - dt * given[id] - relative * base::sphere_volume(g.diameter[k]) * (speed[k] - before[id]);
    };
    // The flow has taken beta (U - u_p) where each part of a grain is, with the water that is there; owed is only what
    // the grain's own motion during the step made of it.
    const auto anticipated = [&](int k) { return implicit ? dt * g.fluid.beta[k] * (felt[k] - before[g.id[k]]) : 0.0; };
    to.scatter(std::array{&owed}, [&](int k) { return std::array{anticipated(k) - received(k)}; });
    for (const int k : moving_) to_grains += received(k);
    for (const int k : woken) to_grains -= anticipated(k);  // is in given_to_still
    carried = total(owed);
  };
  one(at_.u, flow.at_u(), g.impulse_x, g.u, g.fluid.u, given_x_, before_u_, s.u, s.load.beta_u, s.load.force_u,
      ledger_.to_flow.x, ledger_.to_grains.x, ledger_.carried.x, owed_u_);
  one(at_.v, flow.at_v(), g.impulse_y, g.v, g.fluid.v, given_y_, before_v_, s.v, s.load.beta_v, s.load.force_v,
      ledger_.to_flow.y, ledger_.to_grains.y, ledger_.carried.y, owed_v_);
  const double exposed = params_.dispersion == Dispersion::none ? 0.0 : gust_depth;
  if (!g.sleep.asleep.empty()) settle(g, exposed, [&](int k) { return g.sleep.asleep[k] != 0; });
}

double Coupler::given_to_still(const Field& beta, const Field& velocity, double dt) const {
  double sum = 0;
  for (int j = 0; j < ny_; ++j) {
    const double *b = beta.row(j), *u = velocity.row(j);
    sum += base::vector_sum(0, nx_, [&](int i) { return dt * b[i] * u[i]; });
  }
  return sum;
}

void Coupler::to_fractions(Field& volumes) const {
  for_each_item(0, ny_, [&](int j) {
    const double* v = volume_c_.row(j);
    double* f = volumes.row(j);
    vector_loop(0, nx_, [&](int i) { f[i] = v[i] > 0 ? f[i] / v[i] : 0.0; });
  });
}

void Coupler::solid_fraction(const grains::State& g, Field& fraction) {
  std::vector<int> all(g.count());
  std::iota(all.begin(), all.end(), 0);
  at_.c.locate(g.x, g.y, all);
  located_ = false;
  fraction.fill(0.0);
  add_volumes(g, fraction);
  to_fractions(fraction);
}

void Coupler::add_volumes(const grains::State& g, Field& volumes) const {
  at_.c.scatter(std::array{&volumes}, [&](int k) { return std::array{base::sphere_volume(g.diameter[k])}; });
}

}  // namespace livebed::coupling
