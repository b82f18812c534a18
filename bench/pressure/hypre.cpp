#include <HYPRE.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <HYPRE_struct_ls.h>

#include "base/fault.hpp"
#include "solvers.hpp"

namespace livebed::bench {

using base::Field;

namespace {

void check(const char* what, HYPRE_Int iterations, double relative, double tolerance) {
  if (!(relative <= tolerance))
    base::fail(base::Exit::diverged, "{}: residual {:.2g} after {} iterations", what, relative, iterations);
}

/// Rows of solid cells read p = 0.
double diagonal_of_row(const System& s, int i, int j) {
  const double d = s.diagonal(i, j);
  return d > 0 ? d : 1.0;
}

template <class Value>
std::vector<double> listed(const System& s, Value value) {
  std::vector<double> list;
  list.reserve(static_cast<std::size_t>(s.nx) * s.ny);
  for (int j = 0; j < s.ny; ++j)
    for (int i = 0; i < s.nx; ++i) list.push_back(value(i, j));
  return list;
}

void spread(const System& s, const std::vector<double>& list, Field& p) {
  for (int j = 0; j < s.ny; ++j)
    for (int i = 0; i < s.nx; ++i) p(i, j) = list[static_cast<std::size_t>(j) * s.nx + i];
}

enum class Cycle { pfmg, smg };

class Structured : public LinearSolver {
public:
  Structured(const System& s, Cycle cycle) : s_(s), cycle_(cycle) {
    const MPI_Comm one = MPI_COMM_WORLD;
    HYPRE_StructGridCreate(one, 2, &grid_);
    upper_[0] = s.nx - 1, upper_[1] = s.ny - 1;
    HYPRE_StructGridSetExtents(grid_, lower_, upper_);
    HYPRE_StructGridAssemble(grid_);
    // Symmetric: the diagonal and the east and north neighbours.
    HYPRE_StructStencilCreate(2, 3, &stencil_);
    HYPRE_Int offsets[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    for (HYPRE_Int k = 0; k < 3; ++k) HYPRE_StructStencilSetElement(stencil_, k, offsets[k]);
    HYPRE_StructMatrixCreate(one, grid_, stencil_, &a_);
    HYPRE_StructMatrixSetSymmetric(a_, 1);
    HYPRE_StructMatrixInitialize(a_);
    const auto set = [&](HYPRE_Int k, std::vector<double> values) {
      HYPRE_StructMatrixSetBoxValues(a_, lower_, upper_, 1, &k, values.data());
    };
    set(0, listed(s, [&](int i, int j) { return diagonal_of_row(s, i, j); }));
    set(1, listed(s, [&](int i, int j) { return i + 1 < s.nx ? -s.c_x(i + 1, j) : 0.0; }));
    set(2, listed(s, [&](int i, int j) { return j + 1 < s.ny ? -s.c_y(i, j + 1) : 0.0; }));
    HYPRE_StructMatrixAssemble(a_);
    for (HYPRE_StructVector* v : {&b_, &x_}) {
      HYPRE_StructVectorCreate(one, grid_, v);
      HYPRE_StructVectorInitialize(*v);
    }
    std::vector<double> right = listed(s, [&](int i, int j) { return s.b(i, j); });
    HYPRE_StructVectorSetBoxValues(b_, lower_, upper_, right.data());
    HYPRE_StructVectorAssemble(b_);
    HYPRE_StructVectorAssemble(x_);

    HYPRE_StructPCGCreate(one, &gradients_);
    HYPRE_StructPCGSetMaxIter(gradients_, most_iterations);
    HYPRE_StructPCGSetTwoNorm(gradients_, 1);
    if (cycle == Cycle::pfmg) {
      HYPRE_StructPFMGCreate(one, &multigrid_);
      HYPRE_StructPFMGSetMaxIter(multigrid_, 1);
      HYPRE_StructPFMGSetTol(multigrid_, 0.0);
      HYPRE_StructPFMGSetZeroGuess(multigrid_);
      HYPRE_StructPFMGSetRelaxType(multigrid_, 2);  // symmetric red-black Gauss-Seidel
      HYPRE_StructPCGSetPrecond(gradients_, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, multigrid_);
    } else {
      HYPRE_StructSMGCreate(one, &multigrid_);
      HYPRE_StructSMGSetMaxIter(multigrid_, 1);
      HYPRE_StructSMGSetTol(multigrid_, 0.0);
      HYPRE_StructSMGSetZeroGuess(multigrid_);
      HYPRE_StructPCGSetPrecond(gradients_, HYPRE_StructSMGSolve, HYPRE_StructSMGSetup, multigrid_);
    }
    HYPRE_StructPCGSetup(gradients_, a_, b_, x_);
  }
  ~Structured() override {
    HYPRE_StructPCGDestroy(gradients_);
    cycle_ == Cycle::pfmg ? HYPRE_StructPFMGDestroy(multigrid_) : HYPRE_StructSMGDestroy(multigrid_);
    for (HYPRE_StructVector v : {b_, x_}) HYPRE_StructVectorDestroy(v);
    HYPRE_StructMatrixDestroy(a_);
    HYPRE_StructStencilDestroy(stencil_);
    HYPRE_StructGridDestroy(grid_);
  }
  Structured(const Structured&) = delete;
  Structured& operator=(const Structured&) = delete;

  int solve(double tolerance, Field& p) override {
    std::vector<double> list = listed(s_, [&](int i, int j) { return p(i, j); });
    HYPRE_StructVectorSetBoxValues(x_, lower_, upper_, list.data());
    HYPRE_StructPCGSetTol(gradients_, tolerance);
    HYPRE_StructPCGSolve(gradients_, a_, b_, x_);
    HYPRE_Int iterations = 0;
    double relative = 0;
    HYPRE_StructPCGGetNumIterations(gradients_, &iterations);
    HYPRE_StructPCGGetFinalRelativeResidualNorm(gradients_, &relative);
    check(cycle_ == Cycle::pfmg ? "PFMG-CG" : "SMG-CG", iterations, relative, tolerance);
    HYPRE_StructVectorGetBoxValues(x_, lower_, upper_, list.data());
    spread(s_, list, p);
    return iterations;
  }

private:
  const System& s_;
  Cycle cycle_;
  HYPRE_Int lower_[2] = {0, 0}, upper_[2] = {0, 0};
  HYPRE_StructGrid grid_ = nullptr;
  HYPRE_StructStencil stencil_ = nullptr;
  HYPRE_StructMatrix a_ = nullptr;
  HYPRE_StructVector b_ = nullptr, x_ = nullptr;
  HYPRE_StructSolver gradients_ = nullptr, multigrid_ = nullptr;
};

class Boomer : public LinearSolver {
public:
  explicit Boomer(const System& s) : s_(s) {
    const MPI_Comm one = MPI_COMM_WORLD;
    const HYPRE_Int last = s.nx * s.ny - 1;
    HYPRE_IJMatrixCreate(one, 0, last, 0, last, &a_);
    HYPRE_IJMatrixSetObjectType(a_, HYPRE_PARCSR);
    HYPRE_IJMatrixInitialize(a_);
    for (int j = 0; j < s.ny; ++j)
      for (int i = 0; i < s.nx; ++i) {
        HYPRE_Int row = j * s.nx + i, count = 0, columns[5];
        double values[5];
        const auto entry = [&](HYPRE_Int column, double value) {
          if (value == 0) return;
          columns[count] = column;
          values[count++] = value;
        };
        entry(row, diagonal_of_row(s, i, j));
        if (i > 0) entry(row - 1, -s.c_x(i, j));
        if (i + 1 < s.nx) entry(row + 1, -s.c_x(i + 1, j));
        if (j > 0) entry(row - s.nx, -s.c_y(i, j));
        if (j + 1 < s.ny) entry(row + s.nx, -s.c_y(i, j + 1));
        HYPRE_IJMatrixSetValues(a_, 1, &count, &row, columns, values);
      }
    HYPRE_IJMatrixAssemble(a_);
    HYPRE_IJMatrixGetObject(a_, reinterpret_cast<void**>(&matrix_));
    const auto vector = [&](HYPRE_IJVector& v, HYPRE_ParVector& object, const std::vector<double>& values) {
      HYPRE_IJVectorCreate(one, 0, last, &v);
      HYPRE_IJVectorSetObjectType(v, HYPRE_PARCSR);
      HYPRE_IJVectorInitialize(v);
      HYPRE_IJVectorSetValues(v, last + 1, nullptr, values.data());
      HYPRE_IJVectorAssemble(v);
      HYPRE_IJVectorGetObject(v, reinterpret_cast<void**>(&object));
    };
    vector(b_, right_, listed(s, [&](int i, int j) { return s.b(i, j); }));
    vector(x_, solution_, listed(s, [](int, int) { return 0.0; }));

    HYPRE_ParCSRPCGCreate(one, &gradients_);
    HYPRE_PCGSetMaxIter(gradients_, most_iterations);
    HYPRE_PCGSetTwoNorm(gradients_, 1);
    HYPRE_BoomerAMGCreate(&multigrid_);
    HYPRE_BoomerAMGSetMaxIter(multigrid_, 1);
    HYPRE_BoomerAMGSetTol(multigrid_, 0.0);
    HYPRE_BoomerAMGSetRelaxType(multigrid_, 6);  // symmetric Gauss-Seidel
    HYPRE_PCGSetPrecond(gradients_, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
                        reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), multigrid_);
    HYPRE_ParCSRPCGSetup(gradients_, matrix_, right_, solution_);
  }
  ~Boomer() override {
    HYPRE_ParCSRPCGDestroy(gradients_);
    HYPRE_BoomerAMGDestroy(multigrid_);
    for (HYPRE_IJVector v : {b_, x_}) HYPRE_IJVectorDestroy(v);
    HYPRE_IJMatrixDestroy(a_);
  }
  Boomer(const Boomer&) = delete;
  Boomer& operator=(const Boomer&) = delete;

  int solve(double tolerance, Field& p) override {
    std::vector<double> list = listed(s_, [&](int i, int j) { return p(i, j); });
    HYPRE_IJVectorSetValues(x_, static_cast<HYPRE_Int>(list.size()), nullptr, list.data());
    HYPRE_PCGSetTol(gradients_, tolerance);
    HYPRE_ParCSRPCGSolve(gradients_, matrix_, right_, solution_);
    HYPRE_Int iterations = 0;
    double relative = 0;
    HYPRE_PCGGetNumIterations(gradients_, &iterations);
    HYPRE_PCGGetFinalRelativeResidualNorm(gradients_, &relative);
    check("BoomerAMG-CG", iterations, relative, tolerance);
    HYPRE_IJVectorGetValues(x_, static_cast<HYPRE_Int>(list.size()), nullptr, list.data());
    spread(s_, list, p);
    return iterations;
  }

private:
  const System& s_;
  HYPRE_IJMatrix a_ = nullptr;
  HYPRE_IJVector b_ = nullptr, x_ = nullptr;
  HYPRE_ParCSRMatrix matrix_ = nullptr;
  HYPRE_ParVector right_ = nullptr, solution_ = nullptr;
  HYPRE_Solver gradients_ = nullptr, multigrid_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_pfmg(const System& system) {
  return std::make_unique<Structured>(system, Cycle::pfmg);
}
std::unique_ptr<LinearSolver> make_smg(const System& system) {
  return std::make_unique<Structured>(system, Cycle::smg);
}
std::unique_ptr<LinearSolver> make_boomer(const System& system) { return std::make_unique<Boomer>(system); }

}  // namespace livebed::bench
