#include <cmath>

#include "base/fault.hpp"
#include "base/loops.hpp"
#include "solvers.hpp"

extern "C" {
/// LAPACK: eigenvalues w and vectors (columns of a) of a symmetric matrix.
void dsyev_(const char* vectors, const char* triangle, const int* n, double* a, const int* lda, double* w, double* work,
            const int* size, int* info);
/// BLAS: c <- alpha op(a) op(b) + beta c, column by column.
void dgemm_(const char* op_a, const char* op_b, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc);
}

namespace livebed::bench {

using base::Field;

namespace {

class Separable : public LinearSolver {
public:
  explicit Separable(const System& s) : s_(s), nx_(s.nx), ny_(s.ny) {
    // A = T_x (x) M_y + M_x (x) T_y with T the second differences and M the widths of either direction.  With
    // T_y q = lambda M_y q and Q^T M_y Q = 1, A^-1 = Q (T_x + lambda M_x)^-1 Q^T: a tridiagonal system for each vector.
    const auto width = [](const std::vector<double>& faces, int k) { return faces[k + 1] - faces[k]; };
    std::vector<double> mass(ny_), down(ny_, 0.0);
    for (int j = 0; j < ny_; ++j) {
      mass[j] = s.openness[j] * width(s.y, j);
      if (j > 0) down[j] = s.openness_across[j] / (0.5 * (s.y[j + 1] - s.y[j - 1]));
    }
    vectors_.assign(static_cast<std::size_t>(ny_) * ny_, 0.0);
    for (int j = 0; j < ny_; ++j) {
      const double up = j + 1 < ny_ ? down[j + 1] : 0.0;
      vectors_[static_cast<std::size_t>(j) * ny_ + j] = (down[j] + up) / mass[j];
      if (j > 0) vectors_[static_cast<std::size_t>(j) * ny_ + j - 1] = -down[j] / std::sqrt(mass[j] * mass[j - 1]);
    }
    std::vector<double> lambda(ny_);
    double size_wanted = 0;
    int info = 0, size = -1;
    dsyev_("V", "U", &ny_, vectors_.data(), &ny_, lambda.data(), &size_wanted, &size, &info);
    size = static_cast<int>(size_wanted);
    std::vector<double> work(size);
    dsyev_("V", "U", &ny_, vectors_.data(), &ny_, lambda.data(), work.data(), &size, &info);
    if (info != 0) base::fail(base::Exit::internal, "dsyev: info = {}", info);
    for (int k = 0; k < ny_; ++k)
      for (int j = 0; j < ny_; ++j) vectors_[static_cast<std::size_t>(k) * ny_ + j] /= std::sqrt(mass[j]);

    // Tridiagonal systems of all vectors, factored once: entry (k, i) at i * ny + k, so that loops over k are vectors.
    west_.assign(nx_, 0.0);
    for (int i = 1; i < nx_; ++i) west_[i] = 1 / (0.5 * (s.x[i + 1] - s.x[i - 1]));
    inverse_.assign(static_cast<std::size_t>(nx_) * ny_, 0.0);
    for (int i = 0; i < nx_; ++i) {
      const double east = i + 1 < nx_ ? west_[i + 1] : 1 / (0.5 * width(s.x, i));  // p = 0 at the outlet
      for (int k = 0; k < ny_; ++k) {
        const double eliminated = i > 0 ? west_[i] * west_[i] * inverse_[index(k, i - 1)] : 0.0;
        inverse_[index(k, i)] = 1 / (west_[i] + east + std::max(lambda[k], 0.0) * width(s.x, i) - eliminated);
      }
    }
    cells_.assign(inverse_.size(), 0.0);
    modes_.assign(inverse_.size(), 0.0);
    r_ = z_ = d_ = q_ = Field(nx_, ny_);
    open_ = diagonal_ = Field(nx_, ny_);
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i) diagonal_(i, j) = s.diagonal(i, j), open_(i, j) = diagonal_(i, j) > 0 ? 1.0 : 0.0;
  }

  int solve(double tolerance, Field& p) override {
    d_.fill(0.0);
    multiply(p);
    each([&](int i, int j) { r_(i, j) = s_.b(i, j) - q_(i, j); });
    const double target = tolerance * std::sqrt(dot(s_.b, s_.b));
    if (std::sqrt(dot(r_, r_)) <= target) return 0;
    double last = 1;
    for (int n = 1; n <= most_iterations; ++n) {
      precondition();
      const double now = dot(r_, z_), beta = n > 1 ? now / last : 0.0;
      last = now;
      each([&](int i, int j) { d_(i, j) = z_(i, j) + beta * d_(i, j); });
      multiply(d_);
      const double alpha = now / dot(d_, q_);
      each([&](int i, int j) { p(i, j) += alpha * d_(i, j), r_(i, j) -= alpha * q_(i, j); });
      if (std::sqrt(dot(r_, r_)) <= target) return n;
    }
    base::fail(base::Exit::diverged, "no convergence in {} iterations", most_iterations);
  }

private:
  std::size_t index(int k, int i) const { return static_cast<std::size_t>(i) * ny_ + k; }
  template <class Body>
  void each(Body body) const {
    for (int j = 0; j < ny_; ++j) base::vector_loop(0, nx_, [&](int i) { body(i, j); });
  }
  double dot(const Field& a, const Field& b) const {
    double sum = 0;
    for (int j = 0; j < ny_; ++j) {
      const double *x = a.row(j), *y = b.row(j);
      sum += base::vector_sum(0, nx_, [&](int i) { return x[i] * y[i]; });
    }
    return sum;
  }
  /// q <- A a, in the open cells.
  void multiply(const Field& a) {
    each([&](int i, int j) {
      q_(i, j) =
          open_(i, j) * (diagonal_(i, j) * a(i, j) - s_.c_x(i, j) * a(i - 1, j) - s_.c_x(i + 1, j) * a(i + 1, j) -
                         s_.c_y(i, j) * a(i, j - 1) - s_.c_y(i, j + 1) * a(i, j + 1));
    });
  }
  /// z <- the separable operator's inverse times r, in the open cells.
  void precondition() {
    const double one = 1, zero = 0;
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i) cells_[index(j, i)] = r_(i, j);
    dgemm_("T", "N", &ny_, &nx_, &ny_, &one, vectors_.data(), &ny_, cells_.data(), &ny_, &zero, modes_.data(), &ny_);
    for (int i = 1; i < nx_; ++i)
      for (int k = 0; k < ny_; ++k)
        modes_[index(k, i)] += west_[i] * inverse_[index(k, i - 1)] * modes_[index(k, i - 1)];
    for (int k = 0; k < ny_; ++k) modes_[index(k, nx_ - 1)] *= inverse_[index(k, nx_ - 1)];
    for (int i = nx_ - 2; i >= 0; --i)
      for (int k = 0; k < ny_; ++k)
        modes_[index(k, i)] = inverse_[index(k, i)] * (modes_[index(k, i)] + west_[i + 1] * modes_[index(k, i + 1)]);
    dgemm_("N", "N", &ny_, &nx_, &ny_, &one, vectors_.data(), &ny_, modes_.data(), &ny_, &zero, cells_.data(), &ny_);
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i) z_(i, j) = open_(i, j) * cells_[index(j, i)];
  }

  const System& s_;
  int nx_, ny_;
  std::vector<double> vectors_, west_, inverse_, cells_, modes_;
  Field r_, z_, d_, q_, open_, diagonal_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_separable(const System& system) { return std::make_unique<Separable>(system); }

}  // namespace livebed::bench
