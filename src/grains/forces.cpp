#include "grains/forces.hpp"

#include <algorithm>
#include <cmath>

namespace livebed::grains {

namespace {

/// Where the other surface is and how it moves, seen from a grain.
struct Meeting {
  double dx, dy;            ///< to the centre of the other, or of the circle a wall is made of [m]
  double contact_distance;  ///< below which they touch [m]
  double u, v;              ///< velocity of the other relative to the grain [m/s]
  double spin;              ///< sum of the speeds of both surfaces from spin [m/s]
};

/// Calls visit when they touch.
template <class ReducedOf, class Visit>
void meet(Law form, const Contact& law, const Meeting& m, const ReducedOf& reduced, double spring, int i, int j,
          base::Vec2 branch, const Visit& visit) {
  const double d2 = m.dx * m.dx + m.dy * m.dy;
  if (!(d2 < m.contact_distance * m.contact_distance)) return;
  const double distance = std::sqrt(d2), n_x = m.dx / distance, n_y = m.dy / distance;
  const double overlap = m.contact_distance - distance;
  const double closing = -(m.u * n_x + m.v * n_y), slip = (m.v * n_x - m.u * n_y) - m.spin;
  const double eta_n = form == Law::hooke ? law.eta_n * std::sqrt(reduced().mass) : law.eta_n;
  const ContactForce<double> f = contact_force<double>(law, eta_n, overlap, closing, slip, spring);
  visit(TouchingPair{i, j, branch, {n_x, n_y}, overlap, f.normal, f.tangential});
}

template <class Visit>
void visit_pairs(const Sweep& k, const Bed& bed, int i, const Visit& visit) {
  const State& s = bed.state;
  const Contacts& c = bed.contacts;
  const int slice = i / lanes, lane = i % lanes;
  const double r = 0.5 * s.diameter[i];
  for (int row = c.first[slice]; row < c.last[slice]; ++row) {
    const std::size_t slot = static_cast<std::size_t>(row) * lanes + lane;
    const int j = c.neighbour[slot];
    if (j <= i || j >= s.count()) continue;
    const double other = 0.5 * s.diameter[j];
    const double dx = nearest_image(s.x[j] - s.x[i], k.reach.length), dy = s.y[j] - s.y[i];
    meet(
        k.law, k.pair,
        {dx, dy, k.reach.gamma * (r + other), s.u[j] - s.u[i], s.v[j] - s.v[i], s.omega[i] * r + s.omega[j] * other},
        [&] { return reduced_of_pair<double>(k.pair, r, other); }, c.spring[slot], i, j, {dx, dy}, visit);
  }
}

/// A circle that does not move; (dx, dy) to its centre, of a radius.
template <class Visit>
void visit_circle(const Sweep& k, const Contact& law, const Bed& bed, int i, int what, double dx, double dy,
                  double radius, double contact_distance, double spring, const Visit& visit) {
  const State& s = bed.state;
  const double r = 0.5 * s.diameter[i], distance = std::sqrt(dx * dx + dy * dy), share = 1 - radius / distance;
  meet(
      k.law, law, {dx, dy, contact_distance, -s.u[i], -s.v[i], s.omega[i] * r},
      [&] { return reduced_at_wall<double>(law, r); }, spring, i, what, {share * dx, share * dy}, visit);
}

template <class Visit>
void visit_floor(const Sweep& k, const Bed& bed, int i, std::size_t place, const Visit& visit) {
  const State& s = bed.state;
  const double r = 0.5 * s.diameter[i];
  if (k.floor == Floor::plane) {
    visit_circle(k, k.bottom, bed, i, the_floor, 0, -s.y[i], 0, k.reach.gamma * r,
                 bed.contacts.wall_spring[slot_floor][place], visit);
    return;
  }
  // A row of fixed grains with their tops at y = 0; one of even and one of odd number may touch.
  const double radius = 0.5 * k.reach.floor_diameter, spacing = 2 * k.floor_spacing;
  for (const int slot : {slot_floor, slot_floor_odd}) {
    const double start = (slot == slot_floor ? 0.5 : 1.5) * k.floor_spacing;
    const double dx = start + spacing * std::nearbyint((s.x[i] - start) / spacing) - s.x[i];
    visit_circle(k, k.bottom, bed, i, the_floor, dx, -radius - s.y[i], radius, k.reach.gamma * (r + radius),
                 bed.contacts.wall_spring[slot][place], visit);
  }
}

}  // namespace

void visit_contacts(const Bed& bed, const std::function<void(const TouchingPair&)>& visit) {
  const Sweep k = make_sweep(bed.params, bed.pipe, bed.state.count());
  const State& s = bed.state;
  const Contacts& c = bed.contacts;
  if (!c.built()) return;
  for (int i = 0; i < s.count(); ++i) visit_pairs(k, bed, i, visit);
  for (int i = 0; i < s.count(); ++i) {
    const int slice = i / lanes;
    if (c.wall_place[slice] < 0) continue;
    const std::size_t place = static_cast<std::size_t>(c.wall_place[slice]) * lanes + i % lanes;
    if (c.near[slice] & near_floor) visit_floor(k, bed, i, place, visit);
    if (c.near[slice] & near_pipe)
      visit_circle(k, k.pipe_wall, bed, i, the_pipe, nearest_image(k.pipe.x - s.x[i], k.reach.length),
                   k.pipe.y - s.y[i], 0.5 * k.pipe.diameter,
                   k.reach.gamma * 0.5 * s.diameter[i] + 0.5 * k.pipe.diameter, c.wall_spring[slot_pipe][place], visit);
  }
}

std::vector<base::Vec2> contact_forces(const Bed& bed) {
  std::vector<base::Vec2> sum(static_cast<std::size_t>(bed.state.count()));
  visit_contacts(bed, [&](const TouchingPair& pair) {
    sum[pair.i] = sum[pair.i] + pair.force();
    if (pair.j >= 0) sum[pair.j] = sum[pair.j] + -1.0 * pair.force();
  });
  return sum;
}

}  // namespace livebed::grains
