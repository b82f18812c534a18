#include "grains/measures.hpp"

#include <algorithm>
#include <cmath>

#include "base/sphere.hpp"

namespace livebed::grains {

using base::square;

double mean_speed(const State& s) {
  double sum = 0;
  for (int i = 0; i < s.count(); ++i) sum += std::hypot(s.u[i], s.v[i]);
  return s.count() > 0 ? sum / s.count() : 0;
}

double max_speed(const State& s) {
  double most = 0;
  for (int i = 0; i < s.count(); ++i) most = std::max(most, std::hypot(s.u[i], s.v[i]));
  return most;
}

double kinetic_energy(const Params& p, const State& s) {
  double sum = 0;
  for (int i = 0; i < s.count(); ++i) {
    const double spin = 0.5 * s.diameter[i] * s.omega[i];
    sum += 0.5 * mass(p, s.diameter[i]) * (square(s.u[i]) + square(s.v[i]) + inertia_factor(p.inertia) * square(spin));
  }
  return sum;
}

base::Vec2 momentum(const Params& p, const State& s) {
  base::Vec2 sum;
  for (int i = 0; i < s.count(); ++i) sum = sum + mass(p, s.diameter[i]) * base::Vec2{s.u[i], s.v[i]};
  return sum;
}

base::Vec2 fluid_impulse(const State& s) {
  base::Vec2 sum;
  for (int i = 0; i < s.count(); ++i) sum = sum + base::Vec2{s.impulse_x[i], s.impulse_y[i]};
  return sum;
}

double solids_flux(const Params& p, const State& s) {
  double sum = 0;
  for (int i = 0; i < s.count(); ++i) sum += base::sphere_volume(s.diameter[i]) * s.u[i];
  return sum / (p.length * p.diameter);
}

double bed_height(const State& s) {
  double volume = 0, moment = 0;
  for (int i = 0; i < s.count(); ++i) {
    volume += base::sphere_volume(s.diameter[i]);
    moment += base::sphere_volume(s.diameter[i]) * s.y[i];
  }
  return volume > 0 ? 2 * moment / volume : 0;
}

double solid_thickness(const Params& p, const State& s) {
  double area = 0;
  for (int i = 0; i < s.count(); ++i) area += base::sphere_area(s.diameter[i]);
  return area / p.length;
}

Fractions packing_fractions(const Params& p, const State& s, double low, double high) {
  // Of a circle of radius r the part below a height h above its centre.
  const auto area_below = [](double r, double h) {
    h = std::clamp(h, -r, r);
    return r * r * std::acos(-h / r) + h * std::sqrt((r - h) * (r + h));
  };
  double area = 0, volume = 0;
  for (int i = 0; i < s.count(); ++i) {
    const double r = 0.5 * s.diameter[i];
    area += area_below(r, high - s.y[i]) - area_below(r, low - s.y[i]);
    volume += base::sphere_volume_below(r, high - s.y[i]) - base::sphere_volume_below(r, low - s.y[i]);
  }
  const double plane = p.length * (high - low);
  return {area / plane, volume / (plane * p.diameter)};
}

double highest_grain(const State& s, double length, double x, double half_width) {
  double top = 0;
  for (int i = 0; i < s.count(); ++i) {
    if (std::abs(nearest_image(s.x[i] - x, length)) <= half_width) top = std::max(top, s.y[i] + 0.5 * s.diameter[i]);
  }
  return top;
}

ContactMeasures measure_contacts(const Bed& bed) {
  const State& s = bed.state;
  const Params& p = bed.params;
  ContactMeasures result;
  std::int64_t touching = 0;
  double sum = 0, largest = 0;
  for (int i = 0; i < s.count(); ++i) {
    for (const int j : neighbours_of(s, bed.contacts, i)) {
      const double dx = nearest_image(s.x[j] - s.x[i], period(p)), dy = s.y[j] - s.y[i];
      const double overlap = 0.5 * p.gamma * (s.diameter[i] + s.diameter[j]) - std::sqrt(dx * dx + dy * dy);
      if (overlap <= 0) continue;
      ++touching;
      sum += overlap;
      largest = std::max(largest, overlap);
    }
  }
  result.per_grain = s.count() > 0 ? static_cast<double>(touching) / s.count() : 0;
  result.largest_overlap = largest / p.diameter;
  result.mean_overlap = touching > 0 ? sum / static_cast<double>(touching) / p.diameter : 0;
  result.largest_force = p.stiffness * largest;
  return result;
}

}  // namespace livebed::grains
