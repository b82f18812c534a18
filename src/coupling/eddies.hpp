#pragma once
#include <cstdint>
#include <vector>

#include "base/vec2.hpp"

namespace livebed::coupling {

/// The eddies that a RANS flow does not show, as each grain meets them: a velocity u' added to that of the water,
///   u' = sigma z,  sigma = sqrt(2 k/3),  dz = -z dt/T_L + grad(sigma)/(1 + St) dt + sqrt(2/T_L) dW,
/// one z for each direction, T_L = C_T k/epsilon.  The gradient keeps grains from gathering where the turbulence is
/// weak (Bocksell and Loth 2006, Int. J. Multiphase Flow 32, 1234, Eq. 14).  The noise depends on the seed, the grain
/// and the number of the step alone, so it is the same for any number of threads and after any restart.
class Eddies {
public:
  Eddies() = default;
  Eddies(int grains, std::uint64_t seed) : z_x_(grains, 0.0), z_y_(grains, 0.0), seed_(seed) {}

  /// What a grain's surroundings say: sigma [m/s], its gradient [1/s], T_L [s], St [-].
  struct Eddy {
    double sigma, gradient_x, gradient_y, time, stokes;
  };
  /// Comes before the grains of each step.
  void begin_step() { ++steps_; }
  /// The fluctuation u' [m/s] that grain `id` feels in a step of dt [s].  Different grains may be asked about at once.
  base::Vec2 advance(int id, double dt, const Eddy& e);

  /// What a checkpoint must hold.
  template <class Self, class Visit>
  static void each_part(Self& self, Visit&& visit) {
    visit("z_x", self.z_x_), visit("z_y", self.z_y_), visit("steps", self.steps_);
  }

private:
  std::vector<double> z_x_, z_y_;  ///< by id
  std::int64_t steps_ = 0;
  std::uint64_t seed_ = 0;
};

}  // namespace livebed::coupling
