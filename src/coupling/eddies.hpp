#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/vec2.hpp"

namespace livebed::coupling {

/// The eddies that a RANS flow does not show, as each grain meets them: a velocity u' added to that of the water, for
/// the direction of the stream and the one across it
///   u' = sigma z,  dz = -z dt/T_L + grad(sigma)/(1 + St) dt + sqrt(2/T_L) dW,
/// with one z each.  Near a bed the motion along the stream is three times as energetic as that across it: sigma^2 =
/// 1.11 k and 0.34 k (Nezu and Nakagawa 1993, Turbulence in Open-Channel Flows: 2.30, 1.27 and 1.63 u* along, across
/// and sideways).  T_L = C_T k/epsilon, but no eddy is shorter than viscosity lets it be: at a smooth wall T_L = 10
/// nu/u*^2 (Kallio and Reeks 1989, Int. J. Multiphase Flow 15, 433), which is 4.5 sqrt(nu/epsilon) there. The gradient
/// keeps grains from gathering where the turbulence is weak (Bocksell and Loth 2006, Int. J. Multiphase Flow 32, 1234,
/// Eq. 14).  The noise depends on the seed, the grain and the number of the step alone, so it is the same for any
/// number of threads and after any restart.
class Eddies {
public:
  Eddies() = default;
  Eddies(int grains, std::uint64_t seed) : z_along_(grains, 0.0), z_across_(grains, 0.0), seed_(seed) {}

  static constexpr double energy_along = 1.11, energy_across = 0.34;  ///< sigma^2 over k [-]
  static constexpr double viscous_time = 4.5;                         ///< least T_L over sqrt(nu/epsilon) [-]

  /// The eddies that move the water in one direction.
  struct Eddy {
    double k;          ///< [m2/s2]
    base::Vec2 slope;  ///< gradient of sqrt(k) [1/s]
    double time;       ///< T_L [s]
  };
  /// T_L [s]; C_T [-], k [m2/s2], epsilon [m2/s3], nu [m2/s].
  static double life_time(double C_T, double k, double epsilon, double nu) {
    return std::max(C_T * k / epsilon, viscous_time * std::sqrt(nu / epsilon));
  }
  /// Comes before the grains of each step.
  void begin_step() { ++steps_; }
  /// The fluctuation u' [m/s] that grain `id` feels in a step of dt [s] in water that streams in the direction of a
  /// unit vector, along it and across it; response: of the grain [s].  Different grains may be asked about at once.
  base::Vec2 advance(int id, double dt, base::Vec2 stream, const Eddy& along, const Eddy& across, double response);

  /// What a checkpoint must hold.
  template <class Self, class Visit>
  static void each_part(Self& self, Visit&& visit) {
    visit("z_along", self.z_along_), visit("z_across", self.z_across_), visit("steps", self.steps_);
  }

private:
  std::vector<double> z_along_, z_across_;  ///< by id
  std::int64_t steps_ = 0;
  std::uint64_t seed_ = 0;
};

}  // namespace livebed::coupling
