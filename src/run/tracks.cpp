#include "run/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/fault.hpp"
#include "case/ids.hpp"
#include "grains/forces.hpp"

namespace livebed::run {

namespace {

/// Where the grain of each id is in the storage; -1: it is not in the bed.
std::vector<int> places_of(const grains::Bed& bed) {
  const grains::State& s = bed.state;
  std::vector<int> places(static_cast<std::size_t>(bed.params.count), -1);
  for (int i = 0; i < s.count(); ++i) places[s.id[i]] = i;
  return places;
}

}  // namespace

const std::vector<std::string>& track_columns() {
  static const std::vector<std::string> columns = {"time_s",    "id",          "x_m",        "y_m",
                                                   "u_m_s",     "v_m_s",       "omega_1_s",  "fluid_x_N",
                                                   "fluid_y_N", "contact_x_N", "contact_y_N"};
  return columns;
}

std::vector<std::int32_t> choose_tracks(const Simulation& sim, double level) {
  const casefile::Case& c = sim.resolved();
  const grains::State& s = sim.bed().state;
  const std::vector<int> asked = casefile::read_ids(c.output.track_ids).ids;
  std::vector<std::int32_t> ids(asked.begin(), asked.end());
  for (const std::int32_t id : ids)
    if (id >= s.count())
      base::fail(base::Exit::invalid_case, "output.track_ids names grain {}; there are the grains 0 to {}", id,
                 s.count() - 1);
  if (ids.empty()) {
    const double x = c.flow.pipe.present ? c.flow.pipe.x : 0.5 * c.flow.mesh.length;
    const auto distance = [&](int i) {
      return std::hypot(grains::nearest_image(s.x[i] - x, grains::period(sim.bed().params)), s.y[i] - level);
    };
    std::vector<int> order(static_cast<std::size_t>(s.count()));
    std::iota(order.begin(), order.end(), 0);
    const auto many = std::min<std::ptrdiff_t>(c.output.tracks, s.count());
    std::partial_sort(order.begin(), order.begin() + many, order.end(),
                      [&](int a, int b) { return distance(a) < distance(b); });
    for (std::ptrdiff_t n = 0; n < many; ++n) ids.push_back(s.id[order[n]]);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<std::vector<double>> track_rows(const Simulation& sim, const std::vector<std::int32_t>& ids) {
  const grains::State& s = sim.bed().state;
  const grains::FluidForce& water = s.fluid;
  const std::vector<int> places = places_of(sim.bed());
  const std::vector<base::Vec2> contact = grains::contact_forces(sim.bed());
  std::vector<std::vector<double>> rows;
  for (const std::int32_t id : ids) {
    const int i = places[id];
    if (i < 0) continue;  // outside until it comes in again
    rows.push_back({sim.time(), static_cast<double>(id), s.x[i], s.y[i], s.u[i], s.v[i], s.omega[i],
                    water.fx[i] + water.beta[i] * (water.u[i] - s.u[i]),
                    water.fy[i] + water.beta[i] * (water.v[i] - s.v[i]), contact[i].x, contact[i].y});
  }
  return rows;
}

io::Points contact_lines(const Simulation& sim) {
  const grains::State& s = sim.bed().state;
  io::Points lines;
  lines.time = sim.time();
  lines.shape = io::Shape::pairs;
  lines.lines = {{"ids", 2, io::Store::int32, {}},
                 {"normal", 1, io::Store::float32, {}},
                 {"tangential", 1, io::Store::float32, {}},
                 {"overlap", 1, io::Store::float32, {}}};
  grains::visit_contacts(sim.bed(), [&](const grains::TouchingPair& pair) {
    lines.x.insert(lines.x.end(), {s.x[pair.i], s.x[pair.i] + pair.branch.x});
    lines.y.insert(lines.y.end(), {s.y[pair.i], s.y[pair.i] + pair.branch.y});
    const double other = pair.j >= 0 ? s.id[pair.j] : pair.j;
    lines.lines[0].values.insert(lines.lines[0].values.end(), {static_cast<double>(s.id[pair.i]), other});
    lines.lines[1].values.push_back(pair.normal);
    lines.lines[2].values.push_back(pair.tangential);
    lines.lines[3].values.push_back(pair.overlap);
  });
  return lines;
}

}  // namespace livebed::run
