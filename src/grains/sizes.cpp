#include "grains/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/fault.hpp"
#include "grains/laws.hpp"

namespace livebed::grains {

using base::cube;
using base::Exit;
using base::fail;
using base::square;

namespace {

/// A stretch of the curve on which the passing share grows with the logarithm of the diameter.
struct Stretch {
  double from, to;        ///< [m]
  double passing, share;  ///< what passes at its lower end, and the mass inside [-]
  double growth() const { return std::log(to / from); }
  /// Integral of dP / d^power from its lower end to a diameter inside: number of grains (3), their area (1), but for
  /// constant factors.
  double moment(double diameter, int power) const {
    return share / growth() * (std::pow(from, -power) - std::pow(diameter, -power)) / power;
  }
};

/// The whole curve from nothing to everything.
std::vector<Stretch> stretches(const Grading& points) {
  const auto beyond = [](const SievePoint& near, const SievePoint& far, double passing) {
    const double slope = std::log(far.diameter / near.diameter) / (far.passing - near.passing);
    return SievePoint{near.diameter * std::exp(slope * (passing - near.passing)), passing};
  };
  Grading all = points;
  const std::size_t n = points.size();
  if (points[0].passing > 0) all.insert(all.begin(), beyond(points[0], points[1], 0));
  if (points[n - 1].passing < 1) all.push_back(beyond(points[n - 1], points[n - 2], 1));
  std::vector<Stretch> result;
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    result.push_back({all[k].diameter, all[k + 1].diameter, all[k].passing, all[k + 1].passing - all[k].passing});
  }
  return result;
}

/// What passes at the diameter than which the fraction `finer` of the number of all grains is finer.
double passing_of_number(const std::vector<Stretch>& curve, double all, double finer) {
  double number = finer * all;
  for (const Stretch& s : curve) {
    const double here = s.moment(s.to, 3);
    if (number > here && &s != &curve.back()) {
      number -= here;
      continue;
    }
    const double inverse_cube = std::pow(s.from, -3) - 3 * number * s.growth() / s.share;
    const double diameter = inverse_cube > std::pow(s.to, -3) ? 1 / std::cbrt(inverse_cube) : s.to;
    return s.passing + s.share * std::log(diameter / s.from) / s.growth();
  }
  return 1;
}

double number_of_all(const std::vector<Stretch>& curve) {
  double sum = 0;
  for (const Stretch& s : curve) sum += s.moment(s.to, 3);
  return sum;
}

}  // namespace

void check_grading(const Grading& points) {
  const auto refuse = [](const std::string& why) { fail(Exit::invalid_case, "the grading of the grains: {}", why); };
  if (points.size() < 2) refuse(fmt::format("{} points do not make a curve; give at least two", points.size()));
  for (const SievePoint& p : points) {
    if (!(p.diameter > 0)) refuse(fmt::format("a sieve of {} m; sieves are wider than 0", p.diameter));
    if (!(p.passing >= 0 && p.passing <= 1)) {
      refuse(fmt::format("a share of {} passes {} m; it lies in [0, 1]", p.passing, p.diameter));
    }
  }
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const SievePoint &a = points[k], &b = points[k + 1];
    if (b.diameter > a.diameter && b.passing > a.passing) continue;
    refuse(fmt::format("{} m, {} passing, comes after {} m, {} passing; both must rise from point to point", b.diameter,
                       b.passing, a.diameter, a.passing));
  }
  const double smallest = diameter_at(points, 0), largest = diameter_at(points, 1);
  if (largest > widest_grading * smallest) {
    refuse(
        fmt::format("the largest grain, {:.3g} m, is {:.3g} times the smallest, {:.3g} m; at most {} times are "
                    "allowed: cells and lists are made for the largest, the slab for the median; make the tails "
                    "shorter",
                    largest, largest / smallest, smallest, widest_grading));
  }
}

double diameter_at(const Grading& grading, double passing) {
  const std::vector<Stretch> curve = stretches(grading);
  const auto above =
      std::find_if(curve.begin(), curve.end() - 1, [&](const Stretch& s) { return passing <= s.passing + s.share; });
  return above->from * std::exp((passing - above->passing) / above->share * above->growth());
}

double passing_at(const Grading& grading, double diameter) {
  const std::vector<Stretch> curve = stretches(grading);
  if (diameter <= curve.front().from) return 0;
  if (diameter >= curve.back().to) return 1;
  const auto s = std::find_if(curve.begin(), curve.end() - 1, [&](const Stretch& one) { return diameter <= one.to; });
  return s->passing + s->share * std::log(diameter / s->from) / s->growth();
}

double smallest_diameter(const Params& p) {
  return p.grading.empty() ? p.diameter * (1 - p.spread) : diameter_at(p.grading, 0);
}

double largest_diameter(const Params& p) {
  return p.grading.empty() ? p.diameter * (1 + p.spread) : diameter_at(p.grading, 1);
}

double mean_power(const Params& p, int power) {
  if (p.grading.empty()) {
    // Of 1 + spread x for x even over (-1, 1): all odd powers of x have the mean zero.
    return std::pow(p.diameter, power) * (1 + (power == 2 ? 1.0 / 3 : 1.0) * square(p.spread));
  }
  const std::vector<Stretch> curve = stretches(p.grading);
  double sum = 0;
  for (const Stretch& s : curve) sum += power == 3 ? s.share : s.moment(s.to, 3 - power);
  return sum / number_of_all(curve);
}

std::vector<double> sample_diameters(const Params& p) {
  const int n = p.count;
  std::vector<double> diameters(n);
  if (p.grading.empty()) {
    for (int i = 0; i < n; ++i) diameters[i] = p.diameter * (1 + p.spread * ((2.0 * i + 1) / n - 1));
  } else {
    const std::vector<Stretch> curve = stretches(p.grading);
    const double all = number_of_all(curve), mean_cube = mean_power(p, 3);
    double before = 0;
    for (int i = 0; i < n; ++i) {
      const double passing = i + 1 < n ? passing_of_number(curve, all, (i + 1.0) / n) : 1.0;
      diameters[i] = std::cbrt(mean_cube * n * (passing - before));
      before = passing;
    }
  }
  if (p.spread == 0 && p.grading.empty()) return diameters;
  std::mt19937_64 generator(p.seed);
  // By hand: std::shuffle differs between libraries.
  for (int i = n - 1; i > 0; --i) std::swap(diameters[i], diameters[generator() % static_cast<std::uint64_t>(i + 1)]);
  return diameters;
}

double static_overlap(const Params& p, double height) {
  const double weight_of_unit_size = mass(p, 1) * submerged_gravity(p);  // of a grain of 1 m; times d^3
  const double pressed = height * weight_of_unit_size * mean_power(p, 3) / mean_power(p, 2) * largest_diameter(p);
  return pressed / (p.stiffness * p.diameter);
}

}  // namespace livebed::grains
