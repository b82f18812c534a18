#include "flow/pressure.hpp"
#include "solvers.hpp"

namespace livebed::bench {

namespace {

class Own : public LinearSolver {
public:
  explicit Own(const System& system) : system_(system), solver_(system.nx, system.ny) {
    solver_.set_coefficients(system.c_x, system.c_y, system.c_boundary);
  }
  int solve(double tolerance, base::Field& p) override {
    return solver_.solve(p, system_.b, tolerance, most_iterations).iterations;
  }

private:
  const System& system_;
  flow::PressureSolver solver_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_own(const System& system) { return std::make_unique<Own>(system); }

}  // namespace livebed::bench
