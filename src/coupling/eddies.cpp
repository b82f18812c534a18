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

base::Vec2 Eddies::advance(int id, double dt, base::Vec2 stream, const Eddy& along, const Eddy& across,
                           double response) {
  const double root_along = std::sqrt(along.k), root_across = std::sqrt(across.k);
  if (std::max(root_along, root_across) < root_least) return {};
  // Two independent normal numbers (Box and Muller 1958).
  const std::uint64_t here =
      mixed(seed_ ^ mixed(static_cast<std::uint64_t>(steps_) ^ mixed(static_cast<std::uint64_t>(id))));
  const double radius = std::sqrt(-2.0 * std::log(unit(here))), angle = 2.0 * base::pi * unit(mixed(here));
  const auto one = [&](double& z, const Eddy& e, double root, double energy, double slope, double normal) {
    const double size = std::sqrt(energy);
    const double kept = std::exp(-dt / e.time), noise = std::sqrt(1.0 - kept * kept);
    const double drift = (1.0 - kept) * e.time / (1.0 + response / e.time);
    z = kept * z + drift * size * slope + noise * radius * normal;
    return size * root * z;
  };
  const base::Vec2 s = stream;
  const double u =
      one(z_along_[id], along, root_along, energy_along, along.slope.x * s.x + along.slope.y * s.y, std::cos(angle));
  const double v = one(z_across_[id], across, root_across, energy_across, across.slope.y * s.x - across.slope.x * s.y,
                       std::sin(angle));
  return {u * s.x - v * s.y, u * s.y + v * s.x};
}

}  // namespace livebed::coupling
