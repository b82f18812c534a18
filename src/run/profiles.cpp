#include "run/profiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/curves.hpp"
#include "base/sphere.hpp"
#include "grains/forces.hpp"

namespace livebed::run {

namespace {

/// Sums of the grains, one a layer; all times the length of the steps.
enum Layer { solid, solid_u, solid_v, solid_uv, solid_vv, contact_xy, contact_yy, layer_sums };
/// Sums of the water, one a row of cells.
enum Row { water, water_u, water_v, water_uv, sheared, water_shear, water_k, row_sums };

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Length of a stretch that lies outside of the pipe, mean over a layer.
double open_length(const flow::PipeParams& pipe, double x_from, double x_to, double low, double high) {
  constexpr int lines = 32;
  if (!pipe.present) return x_to - x_from;
  double sum = 0;
  for (int n = 0; n < lines; ++n) {
    const double y = low + (n + 0.5) * (high - low) / lines - pipe.y;
    const double half = std::sqrt(std::max(0.0, base::square(0.5 * pipe.diameter) - y * y));
    const double inside = std::min(x_to, pipe.x + half) - std::max(x_from, pipe.x - half);
    sum += (x_to - x_from - std::max(0.0, inside)) / lines;
  }
  return sum;
}

}  // namespace

const std::vector<std::string>& profile_columns() {
  static const std::vector<std::string> columns = {"from_s",
                                                   "to_s",
                                                   "y_m",
                                                   "solid_fraction",
                                                   "grain_u_m_s",
                                                   "grain_v_m_s",
                                                   "fluid_u_m_s",
                                                   "fluid_v_m_s",
                                                   "solids_flux_m_s",
                                                   "granular_shear_Pa",
                                                   "granular_pressure_Pa",
                                                   "fluid_shear_Pa",
                                                   "fluid_resolved_shear_Pa",
                                                   "k_m2_s2"};
  return columns;
}

Profiles::Profiles(const casefile::Case& c)
    : x_from_(c.output.profiles_x_from),
      x_to_(c.output.profiles_x_to > 0 ? c.output.profiles_x_to : c.flow.mesh.length),
      cell_(c.output.profiles_cell > 0 ? c.output.profiles_cell : 0.25 * c.grains.diameter),
      slab_(c.grains.diameter),
      density_(c.grains.density),
      every_(c.output.profiles_every),
      first_(c.output.profiles_from),
      layers_(static_cast<int>(std::ceil(c.flow.mesh.height / cell_ - 1e-9))) {
  for (int l = 0; l < layers_; ++l)
    open_.push_back(open_length(c.flow.pipe, x_from_, x_to_, l * cell_, (l + 1) * cell_));
  sums_.layers.assign(static_cast<std::size_t>(layer_sums) * layers_, 0.0);
  sums_.from = first_;
}

void Profiles::restore(const Sums& sums) {
  sums_ = sums;
  rows_ = static_cast<int>(sums.rows.size()) / row_sums;
}

bool Profiles::add(const Simulation& sim) {
  if (sums_.rows.empty()) {
    rows_ = sim.flow().mesh().ny;
    sums_.rows.assign(static_cast<std::size_t>(row_sums) * rows_, 0.0);
  }
  const double dt = sim.time() - std::max(sums_.seen, sums_.from);
  sums_.seen = sim.time();
  if (dt <= 0) return false;
  if (sim.bed().state.count() > 0) {
    add_grains(sim.bed(), dt);
    add_contacts(sim.bed(), dt);
  }
  add_water(sim, dt);
  constexpr double round_off = 1e-9;
  return sums_.seen >= first_ + (static_cast<double>(sums_.windows) + 1 - round_off) * every_;
}

template <class Visit>
void Profiles::spread(double low, double high, Visit&& visit) const {
  const int first = std::clamp(static_cast<int>(low / cell_), 0, layers_ - 1);
  const int last = std::clamp(static_cast<int>(high / cell_), 0, layers_ - 1);
  for (int l = first; l <= last; ++l) visit(l);
}

void Profiles::add_grains(const grains::Bed& bed, double dt) {
  const grains::State& s = bed.state;
  for (int i = 0; i < s.count(); ++i) {
    if (!within(s.x[i])) continue;
    const double r = 0.5 * s.diameter[i], y = s.y[i], u = s.u[i], v = s.v[i];
    spread(y - r, y + r, [&](int l) {
      const double part =
          dt * (base::sphere_volume_below(r, (l + 1) * cell_ - y) - base::sphere_volume_below(r, l * cell_ - y));
      layer(solid, l) += part;
      layer(solid_u, l) += part * u;
      layer(solid_v, l) += part * v;
      layer(solid_uv, l) += part * u * v;
      layer(solid_vv, l) += part * v * v;
    });
  }
}

void Profiles::add_contacts(const grains::Bed& bed, double dt) {
  const grains::State& s = bed.state;
  const double length = bed.params.length;
  grains::visit_contacts(bed, [&](const grains::TouchingPair& pair) {
    if (pair.j < 0) return;  // what floor and pipe carry is no stress within the layers
    double middle = s.x[pair.i] + 0.5 * pair.branch.x;
    middle -= length * std::floor(middle / length);
    if (!within(middle)) return;
    const base::Vec2 force = pair.force();
    const double y = s.y[pair.i], other = y + pair.branch.y, low = std::min(y, other), high = std::max(y, other);
    spread(low, high, [&](int l) {
      const double inside = std::min(high, (l + 1) * cell_) - std::max(low, l * cell_);
      const double share = dt * (high > low ? std::clamp(inside / (high - low), 0.0, 1.0) : 1.0);
      layer(contact_xy, l) += share * force.x * pair.branch.y;
      layer(contact_yy, l) += share * force.y * pair.branch.y;
    });
  });
}

void Profiles::add_water(const Simulation& sim, double dt) {
  const flow::Mesh& m = sim.flow().mesh();
  const flow::State& s = sim.flow().state;
  const flow::Params& p = sim.resolved().flow;
  const bool voids = s.voidage.nx() > 0;
  const auto centre_u = [&](int i, int j) { return 0.5 * (s.u(i, j) + s.u(i + 1, j)); };
  const auto centre_v = [&](int i, int j) { return 0.5 * (s.v(i, j) + s.v(i, j + 1)); };
  for (int j = 0; j < m.ny; ++j) {
    const int below = std::max(j - 1, 0), above = std::min(j + 1, m.ny - 1);
    for (int i = 0; i < m.nx; ++i) {
      const double width = std::min(m.x[i + 1], x_to_) - std::max(m.x[i], x_from_), open = m.volume(i, j);
      if (width <= 0 || open == 0) continue;
      const double share = dt * width * open, u = centre_u(i, j), v = centre_v(i, j);
      row(water, j) += share;
      row(water_u, j) += share * u;
      row(water_v, j) += share * v;
      row(water_uv, j) += share * u * v;
      row(water_k, j) += share * s.k(i, j);
      if (open < 1) continue;
      const int west = std::max(i - 1, 0), east = std::min(i + 1, m.nx - 1);
      const double shear = (centre_u(i, above) - centre_u(i, below)) / (m.centre_y(above) - m.centre_y(below)) +
                           (centre_v(east, j) - centre_v(west, j)) / (m.centre_x(east) - m.centre_x(west));
      row(sheared, j) += share;
      row(water_shear, j) += share * (voids ? s.voidage(i, j) : 1.0) * p.density * (p.viscosity + s.nut(i, j)) * shear;
    }
  }
}

std::vector<std::vector<double>> Profiles::take(const Simulation& sim) {
  const flow::Mesh& m = sim.flow().mesh();
  const double time = sums_.seen - sums_.from, rho = sim.resolved().flow.density;
  // Of the rows of cells with water in the stretch, to be read between them.
  std::vector<double> y, u, v, resolved, k, y_sheared, shear;
  for (int j = 0; j < rows_; ++j) {
    const double open = row(water, j);
    if (open > 0) {
      y.push_back(m.centre_y(j));
      u.push_back(row(water_u, j) / open);
      v.push_back(row(water_v, j) / open);
      resolved.push_back(-rho * (row(water_uv, j) / open - u.back() * v.back()));
      k.push_back(row(water_k, j) / open);
    }
    if (row(sheared, j) > 0) {
      y_sheared.push_back(m.centre_y(j));
      shear.push_back(row(water_shear, j) / row(sheared, j));
    }
  }
  const auto at = [](const std::vector<double>& where, const std::vector<double>& values, double height) {
    return where.empty() ? nan : base::interpolate(where, values, height);
  };
  std::vector<std::vector<double>> table;
  for (int l = 0; l < layers_; ++l) {
    const double height = (l + 0.5) * cell_, volume = time * open_[l] * cell_ * slab_;
    const double grains = layer(solid, l), mean_u = layer(solid_u, l) / grains, mean_v = layer(solid_v, l) / grains;
    const bool there = grains > 0, open = volume > 0;
    // Per volume: contacts, and the motion of grains about their mean.
    const double moving_xy = there ? density_ * (layer(solid_uv, l) - grains * mean_u * mean_v) : 0;
    const double moving_yy = there ? density_ * (layer(solid_vv, l) - grains * mean_v * mean_v) : 0;
    table.push_back({sums_.from, sums_.seen, height, open ? grains / volume : nan, there ? mean_u : nan,
                     there ? mean_v : nan, open ? at(y, u, height) : nan, open ? at(y, v, height) : nan,
                     open ? layer(solid_u, l) / volume : nan, open ? (layer(contact_xy, l) - moving_xy) / volume : nan,
                     open ? -(layer(contact_yy, l) - moving_yy) / volume : nan,
                     open ? at(y_sheared, shear, height) : nan, open ? at(y, resolved, height) : nan,
                     open ? at(y, k, height) : nan});
  }
  std::fill(sums_.layers.begin(), sums_.layers.end(), 0.0);
  std::fill(sums_.rows.begin(), sums_.rows.end(), 0.0);
  sums_.from = sums_.seen;
  ++sums_.windows;
  return table;
}

}  // namespace livebed::run
