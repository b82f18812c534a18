#include <HYPRE_utilities.h>
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fmt/format.h>
#include <mpi.h>

#include "base/fault.hpp"
#include "base/version.hpp"
#include "solvers.hpp"

/// Time and iterations of pressure solvers on the systems of real steps, as a Markdown table on standard output.
/// Arguments: --own for the program's own solver alone; parts of names, only grids whose name holds one of them are
/// measured.
namespace {

using namespace livebed;
using namespace livebed::bench;

/// Processor time, which other programs lengthen less than the wall's: everything here runs on one core.
double milliseconds_since(std::clock_t start) {
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Solves as often as fit into half a second, 3 to 50 times, less often when one takes longer than that: iterations and
/// the median of the times.
std::string measure(const System& system, LinearSolver& solver, double tolerance) {
  base::Field p = system.guess;
  std::vector<double> times;
  int iterations = 0;
  try {
    iterations = solver.solve(tolerance, p);
    const std::clock_t start = std::clock();
    while (times.empty() || (times.size() < 3 && milliseconds_since(start) < 2000) ||
           (times.size() < 50 && milliseconds_since(start) < 500)) {
      p = system.guess;
      const std::clock_t begin = std::clock();
      solver.solve(tolerance, p);
      times.push_back(milliseconds_since(begin));
    }
  } catch (const base::Fault& fault) {
    fmt::print(stderr, "{}: {}\n", system.name, fault.what());
    return "fails";
  }
  // A hair for the rounding of residuals that recursions carry along.
  if (const double left = system.relative_residual(p); left > 1.01 * tolerance)
    fmt::print(stderr, "{}: true residual {:.3g} for tolerance {:.1g}\n", system.name, left, tolerance);
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return fmt::format("{} / {:.3g}", iterations, times[times.size() / 2]);
}

void print_rows(const System& system, bool own_alone) {
  std::vector<Method> methods = {{"own multigrid", make_own}};
  if (!own_alone)
    methods.insert(methods.end(), {{"separable, direct", make_separable},
                                   {"hypre PFMG", make_pfmg},
                                   {"hypre SMG", make_smg},
                                   {"hypre BoomerAMG", make_boomer}});
  for (const Method& method : methods) {
    const std::clock_t start = std::clock();
    const std::unique_ptr<LinearSolver> solver = method.make(system);
    const double set_up = milliseconds_since(start);
    const std::string loose = measure(system, *solver, 1e-3), tight = measure(system, *solver, 1e-6);
    fmt::print("| {} | {} x {} | {:.0f} | {} | {:.3g} | {} | {} |\n", system.name, system.nx, system.ny, system.aspect,
               method.name, set_up, loose, tight);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const char* blas = std::getenv("OPENBLAS_NUM_THREADS");
  if (!blas || std::strcmp(blas, "1") != 0) {
    fmt::print(stderr, "set OPENBLAS_NUM_THREADS=1 and OMP_NUM_THREADS=1: all are compared on one core\n");
    return static_cast<int>(base::Exit::command_line);
  }
  const bool own_alone = argc > 1 && std::strcmp(argv[1], "--own") == 0;
  const std::vector<std::string> parts(argv + (own_alone ? 2 : 1), argv + argc);
  const auto wanted = [&](const std::string& name) {
    return parts.empty() || std::any_of(parts.begin(), parts.end(),
                                        [&](const std::string& part) { return name.find(part) != name.npos; });
  };
  MPI_Init(&argc, &argv);
  HYPRE_Init();
  try {
    fmt::print("Commit {}, {}; iterations / milliseconds of a solve (processor time, median).\n\n", base::commit(),
               base::compiler());
    fmt::print("| grid | cells | aspect | CG with | set-up, ms | to 1e-3 | to 1e-6 |\n|---|---|---|---|---|---|---|\n");
    struct Size {
      const char* name;
      int nx, ny;
    };
    for (const Size& size : {Size{"16k", 304, 52}, {"50k", 540, 94}, {"390k", 1500, 260}, {"1.6M", 3040, 526}})
      for (const Choice& kind :
           {Choice{"equal", 0, 0, 1, false}, {"1:10, grains", 0, 0, 10, true}, {"1:50, grains", 0, 0, 50, true}}) {
        Choice choice = kind;
        choice.name = fmt::format("{}, {}", size.name, kind.name);
        choice.nx = size.nx, choice.ny = size.ny;
        if (wanted(choice.name)) print_rows(make_system(choice), own_alone);
      }
    if (wanted("no pipe")) print_rows(make_thin_system(), own_alone);
  } catch (const base::Fault& fault) {
    fmt::print(stderr, "{}\n", fault.what());
    return static_cast<int>(fault.code());
  }
  HYPRE_Finalize();
  MPI_Finalize();
  return 0;
}
