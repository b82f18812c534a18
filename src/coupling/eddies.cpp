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

/// Slower eddies move no grain [m/s]; deep in the bed they are not looked at.
constexpr double sigma_least = 1e-4;

/// In (0, 1].
double unit(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 1.0) * 0x1.0p-53; }

}  // namespace

base::Vec2 Eddies::advance(int id, double dt, const Eddy& e) {
  if (e.sigma < sigma_least) return {};
  // Two independent normal numbers (Box and Muller 1958).
  const std::uint64_t here =
      mixed(seed_ ^ mixed(static_cast<std::uint64_t>(steps_) ^ mixed(static_cast<std::uint64_t>(id))));
  const double radius = std::sqrt(-2.0 * std::log(unit(here))), angle = 2.0 * base::pi * unit(mixed(here));
  const double kept = std::exp(-dt / e.time), noise = std::sqrt(1.0 - kept * kept);
  const double drift = (1.0 - kept) * e.time / (1.0 + e.stokes);
  z_x_[id] = kept * z_x_[id] + drift * e.gradient_x + noise * radius * std::cos(angle);
  z_y_[id] = kept * z_y_[id] + drift * e.gradient_y + noise * radius * std::sin(angle);
  return {e.sigma * z_x_[id], e.sigma * z_y_[id]};
}

}  // namespace livebed::coupling
