#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "systems.hpp"

/// Solvers of a pressure system under one interface.
namespace livebed::bench {

class LinearSolver {
public:
  virtual ~LinearSolver() = default;
  /// p holds the first guess and receives the solution, whose residual's norm is below tolerance times that of b.
  /// Returns the iterations.
  virtual int solve(double tolerance, base::Field& p) = 0;
};

/// How a solver is called and made; making it is its set-up.
struct Method {
  std::string name;
  std::function<std::unique_ptr<LinearSolver>(const System&)> make;
};

/// flow::PressureSolver.
std::unique_ptr<LinearSolver> make_own(const System& system);
/// Conjugate gradients preconditioned by the direct solve of the separable operator on the same grid: no pipe, the mean
/// coefficient of each row.
std::unique_ptr<LinearSolver> make_separable(const System& system);
/// Conjugate gradients of hypre with one cycle of PFMG (red-black Gauss-Seidel), SMG or BoomerAMG.
std::unique_ptr<LinearSolver> make_pfmg(const System& system);
std::unique_ptr<LinearSolver> make_smg(const System& system);
std::unique_ptr<LinearSolver> make_boomer(const System& system);

/// Most iterations before a solver counts as failed.
inline constexpr int most_iterations = 500;

}  // namespace livebed::bench
