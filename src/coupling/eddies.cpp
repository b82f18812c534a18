#include "coupling/eddies.hpp"

#include <cmath>

#include "base/math.hpp"

namespace livebed::coupling {

namespace {

/// Mixes 64 bits so that neighbouring inputs have nothing in common: SplitMix64, Steele, Lea and Flood (2014).
std::uint64_t mixed(std::uint64_t a) {
  a += 0x9e3779b97f4a7c15u;
  a = (a ^ (a >> 30)) * 0xbf58476d1ce4e5b9u;
  a = (a ^ (a >> 27)) * 0x94d049bb133111ebu;
  return a ^ (a >> 31);
}

/// Slower eddies move no grain, sqrt(k) [m/s]; deep in the bed they are not looked at.
constexpr double root_least = 1e-4;

/// In (0, 1].
double unit(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 1.0) * 0x1.0p-53; }

}  // namespace

base::Vec2 Eddies::advance(int id, double dt, const Eddy& e) {
  const double root = std::sqrt(e.k);
  if (root < root_least) return {};
  // Two independent normal numbers (Box and Muller 1958).
  const std::uint64_t here =
      mixed(seed_ ^ mixed(static_cast<std::uint64_t>(steps_) ^ mixed(static_cast<std::uint64_t>(id))));
  const double radius = std::sqrt(-2.0 * std::log(unit(here))), angle = 2.0 * base::pi * unit(mixed(here));
  const double kept = std::exp(-dt / e.time), noise = std::sqrt(1.0 - kept * kept);
  const double drift = (1.0 - kept) * e.time / (1.0 + e.response / e.time);
  const auto one = [&](double& z, double energy, double slope, double normal) {
    const double size = std::sqrt(energy);
    z = kept * z + drift * size * slope + noise * radius * normal;
    return size * root * z;
  };
  const base::Vec2 s = e.stream;
  const double along = one(z_along_[id], energy_along, e.slope.x * s.x + e.slope.y * s.y, std::cos(angle));
  const double across = one(z_across_[id], energy_across, e.slope.y * s.x - e.slope.x * s.y, std::sin(angle));
  return {along * s.x - across * s.y, along * s.y + across * s.x};
}

}  // namespace livebed::coupling
