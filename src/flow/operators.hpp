#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
#include <vector>

#include "base/field.hpp"
#include "base/loops.hpp"
#include "base/shared_rows.hpp"
#include "flow/mesh.hpp"
#include "flow/params.hpp"
#include "flow/schemes.hpp"
#include "flow/staggering.hpp"

/// The finite-volume operators that u, v, k and epsilon share.
///
/// A step works on blocks of rows: what a row needs on its way from velocity to right-hand side lives in rows of
/// scratch that stay in the second cache, and the fields pass through memory once.
namespace livebed::flow {

/// Scratch of each thread: rows as long as those of the fields.
class RowScratch {
public:
  RowScratch() = default;
  explicit RowScratch(const Mesh& mesh) : nx_(mesh.nx), ny_(mesh.ny) {}
  /// Makes room for all threads; before a loop that takes rows.
  void fit() {
    while (static_cast<int>(of_thread_.size()) < base::threads()) of_thread_.emplace_back(nx_, rows_a_thread);
  }

  /// Rows that one thread takes for one block, given back all together.
  class Rows {
  public:
    explicit Rows(base::Field& field) : field_(&field) {}
    double* take() { return field_->row(next_++); }

  private:
    base::Field* field_;
    int next_ = 0;
  };
  Rows rows() { return Rows(of_thread_[base::thread_index()]); }

  /// Rows in a block: as many as keep its scratch in the second cache.
  int block() const { return nx_ <= 2000 ? 16 : 8; }
  /// Calls body(ja, jb) for blocks of the rows [j0, j1), on all threads.  The blocks depend on the grid alone.
  template <class Body>
  void over_blocks(int j0, int j1, Body&& body) {
    fit();
    const int size = block();
    base::for_each_item(0, (ny_ + size - 1) / size, [&](int k) {
      const int ja = std::max(j0, k * size), jb = std::min(j1, (k + 1) * size);
      if (ja < jb) body(ja, jb);
    });
  }

private:
  static constexpr int rows_a_thread = 96;
  int nx_ = 0, ny_ = 0;
  std::vector<base::Field> of_thread_;
};

/// A velocity between two levels: now + ahead x (now - before).  It carries everything.
struct Carrier {
  const base::Field &u, &v, &u_before, &v_before;
  double ahead = 0;  ///< [-]
};

/// Rows of the carrying velocity with their ghosts, eight at a time.
class CarrierRows {
public:
  CarrierRows(const Mesh& mesh, const Carrier& carrier, RowScratch::Rows& scratch) : nx_(mesh.nx), carrier_(carrier) {
    for (int k = 0; k < kept; ++k) u_[k] = scratch.take(), v_[k] = scratch.take();
  }
  /// Rows first to last, and those after them as they are asked for.
  void start(int first) { next_ = first; }
  void reach(int j) {
    for (; next_ <= j; ++next_) {
      const double *u = carrier_.u.row(next_), *v = carrier_.v.row(next_);
      const double *ub = carrier_.u_before.row(next_), *vb = carrier_.v_before.row(next_);
      double *to_u = u_[slot(next_)], *to_v = v_[slot(next_)];
      const double ahead = carrier_.ahead;
      base::vector_loop(-2, nx_ + 2, [&](int i) {
        to_u[i] = u[i] + ahead * (u[i] - ub[i]);
        to_v[i] = v[i] + ahead * (v[i] - vb[i]);
      });
    }
  }
  const double* u(int j) const { return u_[slot(j)]; }
  const double* v(int j) const { return v_[slot(j)]; }

private:
  static constexpr int kept = 8;
  static int slot(int j) { return (j + kept) % kept; }
  int nx_, next_ = 0;
  Carrier carrier_;
  std::array<double*, kept> u_{}, v_{};
};

/// What is carried, and what the face values know of its change in time.
struct Carried {
  const Staggering& at;
  const base::Field& value;
  const base::Field& before;      ///< one step ago
  const base::Field& convection;  ///< its rate of change by convection in that step [1/s]
  double per_last_step = 0;       ///< 1 / that step [1/s]; 0 = nothing known
  double dt = 0;                  ///< the face values are centred in the step to come [s]; 0 = taken as they are
  bool positive = false;          ///< only believed changes of it count (believed_change)
  const base::Field& nut;         ///< with nu: diffusivity at cell centres (hybrid scheme)
  double nu = 0;
  double courant = std::numeric_limits<double>::infinity();  ///< of all directions, of what is carried explicitly [-]
};

/// Rate of change by convection, row after row upwards: - sum over faces of flux x face value, over the inertia [1/s].
/// Rows of the carrier must reach two rows above the row in hand.
///
/// Where the flow along y passes more of a cell in a step than `courant` leaves it beside the flow along x, only that
/// much of it goes through the scheme.  The rest is carried upwind, and the sweep down the columns makes that part
/// implicit (Shchepetkin 2015, Ocean Modelling 91, 38): a few low cells need not hold up all others.
template <class Scheme>
class ConvectionRows {
public:
  ConvectionRows(const base::SharedRows& face_x, const base::SharedRows& face_y, CarrierRows& carrier,
                 const Carried& carried, RowScratch::Rows& scratch)
      : face_x_(face_x), face_y_(face_y), carrier_(carrier), q_(carried) {
    for (double** row : {&west_, &south_, &north_, &across_x_, &across_y_below_, &across_y_}) *row = scratch.take();
    if (!splits()) return;
    for (double*& row : passed_x_) row = scratch.take();
    for (double*& row : implicit_) row = scratch.take();
  }

  /// The row that comes next.
  void start(int j) {
    half_changes(j - 1, across_x_, across_y_below_);
    half_changes(j, across_x_, across_y_);
    south_fluxes(j, across_y_below_, across_y_, south_);
    j_ = j;
  }

  /// The next row into out.
  void next(double* out) {
    const Staggering& at = q_.at;
    west_fluxes(j_);
    std::swap(across_y_below_, across_y_);
    half_changes(j_ + 1, across_x_, across_y_);
    south_fluxes(j_ + 1, across_y_below_, across_y_, north_);
    const double *per_inertia = at.per_inertia.row(j_), *per_width = at.per_width.data() + 2;
    const double per_height = at.per_height[j_ + 2];
    const double *west = west_, *south = south_, *north = north_;
    base::vector_loop(at.i0, at.i1, [&](int i) {
      out[i] = per_inertia[i] * (per_width[i] * (west[i] - west[i + 1]) + per_height * (south[i] - north[i]));
    });
    std::swap(south_, north_);
    ++j_;
  }

  /// What of the flow through the south faces of row j over their width is left to an implicit sweep [m/s], for the
  /// rows between the one in hand and two above it; null: nothing.
  const double* implicit_y(int j) const { return is_implicit_[j % 4] ? implicit_[j % 4] : nullptr; }

private:
  bool splits() const { return q_.dt > 0 && std::isfinite(q_.courant); }

  /// Half-step changes of the nodes of row j by all but the flow across x faces, and by all but that across y faces.
  void half_changes(int j, double* across_x, double* across_y) {
    const Staggering& at = q_.at;
    const int sx = at.shift_x, sy = at.shift_y;
    carrier_.reach(j + 1);
    if (splits()) {
      const double *ua = carrier_.u(j - sy) - sx, *ub = carrier_.u(j), *per_width = at.per_width.data() + 2, dt = q_.dt;
      double* passed = passed_x_[(j + 2) % 2];
      base::vector_loop(at.i0, at.i1, [&](int i) {
        passed[i] = 0.25 * std::abs(ua[i] + ub[i] + ua[i + 1] + ub[i + 1]) * dt * per_width[i];
      });
    }
    if (q_.dt == 0) {
      base::vector_loop(at.i0 - 1, at.i1 + 1, [&](int i) { across_x[i] = across_y[i] = 0.0; });
      return;
    }
    const double *p = q_.value.row(j), *below = q_.value.row(j - 1), *above = q_.value.row(j + 1),
                 *before = q_.before.row(j), *convection = q_.convection.row(j);
    const double *ua = carrier_.u(j - sy) - sx, *ub = carrier_.u(j), *va = carrier_.v(j - sy) - sx, *vb = carrier_.v(j),
                 *vc = carrier_.v(j - sy + 1) - sx, *vd = carrier_.v(j + 1);
    const double* per_hx = at.per_hx.data() + 2;
    const double per_below = at.per_hy[j + 2], per_above = at.per_hy[j + 3];
    const double half = 0.5 * q_.dt, per_last = q_.per_last_step;
    const auto change = [&](int i, double alone) {
      const double u = 0.25 * (ua[i] + ub[i] + ua[i + 1] + ub[i + 1]);
      const double v = 0.25 * (va[i] + vb[i] + vc[i] + vd[i]);
      const double slope_x = u > 0 ? (p[i] - p[i - 1]) * per_hx[i] : (p[i + 1] - p[i]) * per_hx[i + 1];
      const double slope_y = v > 0 ? (p[i] - below[i]) * per_below : (above[i] - p[i]) * per_above;
      across_x[i] = alone - half * v * slope_y;
      across_y[i] = alone - half * u * slope_x;
    };
    const auto run = [&](auto alone) {
      base::vector_loop(at.i0, at.i1,
                        [&](int i) { change(i, alone(half * (per_last * (p[i] - before[i]) - convection[i]), i)); });
    };
    // What lies outside is given by what lies inside: running ahead of itself it would feed back without bound.
    change(at.i0 - 1, 0.0), change(at.i1, 0.0);
    if (j < at.j0 || j >= at.j1)
      run([](double, int) { return 0.0; });
    else if (q_.positive)
      run([&](double alone, int i) { return believed_change(alone, p[i]); });
    else
      run([](double alone, int) { return alone; });
  }

  void west_fluxes(int j) {
    const Staggering& at = q_.at;
    const int sx = at.shift_x, sy = at.shift_y;
    const double *p = q_.value.row(j), *nut = q_.nut.row(j), *change = across_x_;
    const double *ua = carrier_.u(j - sy) - sx, *ub = carrier_.u(j);
    const double *open_a = face_x_.row(j - sy) - sx, *open_b = face_x_.row(j);
    const double *hx = at.hx.data() + 2, *per_hx = at.per_hx.data() + 2, *before = at.to_west.data() + 2,
                 *after = at.from_west.data() + 2;
    const double share_a = at.share_y_before[j + 2], share_b = at.share_y[j + 2], dt = q_.dt, nu = q_.nu;
    double* west = west_;
    const auto run = [&](auto flux, auto speed) {
      base::vector_loop(at.i0, at.i1 + 1, [&](int i) {
        const Stencil4 s{p[i - 2],      p[i - 1],  p[i],          p[i + 1],  hx[i],
                         per_hx[i - 1], per_hx[i], per_hx[i + 1], before[i], after[i]};
        west[i] = flux(i) * Scheme::face(s, speed(i), dt, change[i - 1], change[i], nu + 0.5 * (nut[i - 1] + nut[i]));
      });
    };
    if (face_x_.is_one(j - sy) && face_x_.is_one(j))
      run([&](int i) { return share_a * ua[i] + share_b * ub[i]; }, [&](int i) { return 0.5 * (ua[i] + ub[i]); });
    else
      run([&](int i) { return share_a * ua[i] * open_a[i] + share_b * ub[i] * open_b[i]; },
          [&](int i) {
            return speed_of(share_a * ua[i] * open_a[i] + share_b * ub[i] * open_b[i],
                            share_a * open_a[i] + share_b * open_b[i]);
          });
  }

  void south_fluxes(int j, const double* change_below, const double* change, double* flux) {
    const Staggering& at = q_.at;
    const int sx = at.shift_x, sy = at.shift_y;
    const double *mm = q_.value.row(j - 2), *m = q_.value.row(j - 1), *p = q_.value.row(j), *pp = q_.value.row(j + 1);
    const double *va = carrier_.v(j - sy) - sx, *vb = carrier_.v(j);
    const double *open_a = face_y_.row(j - sy) - sx, *open_b = face_y_.row(j);
    const double *nut_below = q_.nut.row(j - 1), *nut = q_.nut.row(j);
    const double *share_a = at.share_x_before.data() + 2, *share_b = at.share_x.data() + 2;
    const double h = at.hy[j + 2], per_mm = at.per_hy[j + 1], per_h = at.per_hy[j + 2], per_pp = at.per_hy[j + 3];
    const double before = at.to_south[j + 2], after = at.from_south[j + 2], dt = q_.dt, nu = q_.nu;
    const auto face = [&](int i, double v) {
      const Stencil4 s{mm[i], m[i], p[i], pp[i], h, per_mm, per_h, per_pp, before, after};
      return Scheme::face(s, v, dt, change_below[i], change[i], nu + 0.5 * (nut_below[i] + nut[i]));
    };
    const auto run = [&](auto through, auto speed) {
      const bool split = splits() && exceeds(j, speed);
      if (splits()) is_implicit_[j % 4] = split;
      if (!split) {
        base::vector_loop(at.i0, at.i1, [&](int i) { flux[i] = through(i) * face(i, speed(i)); });
        return;
      }
      double* rest = implicit_[j % 4];
      base::vector_loop(at.i0, at.i1, [&](int i) {
        const double v = speed(i), most = most_explicit(i, j);
        const double borne = std::clamp(v, -most, most), all = through(i);
        const double explicitly = borne == v ? all : all * (borne / v);
        rest[i] = all - explicitly;
        flux[i] = explicitly * face(i, borne) + rest[i] * (v > 0 ? m[i] : p[i]);
      });
    };
    if (face_y_.is_one(j - sy) && face_y_.is_one(j))
      run([&](int i) { return share_a[i] * va[i] + share_b[i] * vb[i]; }, [&](int i) { return 0.5 * (va[i] + vb[i]); });
    else
      run([&](int i) { return share_a[i] * va[i] * open_a[i] + share_b[i] * vb[i] * open_b[i]; },
          [&](int i) {
            return speed_of(share_a[i] * va[i] * open_a[i] + share_b[i] * vb[i] * open_b[i],
                            share_a[i] * open_a[i] + share_b[i] * open_b[i]);
          });
  }

  /// Mean speed through the open part of a face that is halves of two [m/s].  It has the sign of what passes: where one
  /// half is a slit with a stream the other way, the plain mean of both may not, and the value from downstream would
  /// feed the stream without bound.
  static double speed_of(double through, double open) { return open > 0 ? through / open : 0.0; }

  /// Speed that the scheme bears at a south face of row j beside what passes along x [m/s].
  double most_explicit(int i, int j) const {
    const double h = std::min(q_.at.height[j + 1], q_.at.height[j + 2]);
    const double passed = std::max(passed_x_[0][i], passed_x_[1][i]);
    return std::max(0.0, q_.courant - passed) * h / q_.dt;
  }

  template <class Speed>
  bool exceeds(int j, Speed&& speed) const {
    return base::vector_largest(q_.at.i0, q_.at.i1, 0.0,
                                [&](int i) { return std::abs(speed(i)) - most_explicit(i, j); }) > 0;
  }

  const base::SharedRows &face_x_, &face_y_;
  CarrierRows& carrier_;
  Carried q_;
  std::array<double*, 2> passed_x_{};  ///< Courant numbers along x of the rows beside the face
  std::array<double*, 4> implicit_{};
  std::array<bool, 4> is_implicit_{};
  double *west_ = nullptr, *south_ = nullptr, *north_ = nullptr, *across_x_ = nullptr, *across_y_below_ = nullptr,
         *across_y_ = nullptr;
  int j_ = 0;
};

/// What of the flow the schemes carry explicitly, as a Courant number of all directions [-]; infinite: all of it, for
/// the step is chosen so that they can.
inline double explicit_courant(const Params& p) {
  return p.courant_y > 0 ? p.courant : std::numeric_limits<double>::infinity();
}

/// Calls body(Scheme{}) with the convection scheme of a case.
template <class Body>
void with_scheme(Convection scheme, Body&& body) {
  if (scheme == Convection::hybrid)
    body(Hybrid{});
  else
    body(Bounded{});
}

/// Share of a diffusive flux that is taken at the new time: one half (second order in time) while a step spreads less
/// than the node's own distance, number = dt diffusivity / h^2 <= 1; more beyond, so that no step oscillates.
inline double implicit_share(double number) { return number <= 1.0 ? 0.5 : 1.0 - 0.5 / number; }

/// k <- dt x implicit share x k for entries [i0, i1) of a row of exchange velocities, k = diffusivity x opening / h
/// [m/s]; per_h(i) = 1/h [1/m].  half: the number is known to be at most 1 everywhere.
template <class PerH>
void keep_implicit_part(int i0, int i1, double dt, bool half, PerH per_h, double* k) {
  if (half || base::vector_largest(i0, i1, 0.0, [&](int i) { return k[i] * per_h(i); }) * dt <= 1.0)
    base::vector_loop(i0, i1, [&](int i) { k[i] *= 0.5 * dt; });
  else
    base::vector_loop(i0, i1, [&](int i) { k[i] *= dt * implicit_share(dt * k[i] * per_h(i)); });
}

/// Whether the diffusion number of rows [ja, jb) of a quantity is at most 1 whatever the direction, with the
/// diffusivity factor x (nu + nut), factor at most 2.
inline bool spreads_little(const Staggering& at, const base::Field& nut, double nu, double dt, int ja, int jb) {
  double most = 0, per_h = 0;
  for (double per : at.per_hx) per_h = std::max(per_h, per);
  for (int j = ja - 1; j <= jb; ++j) {
    const double* row = nut.row(j);
    most = base::vector_largest(-1, nut.nx() + 1, most, [&](int i) { return row[i]; });
    per_h = std::max(per_h, at.per_hy[j + 2]);
  }
  constexpr double widest = 2.0;  // openings are drawn closer by at most this
  return 2.0 * widest * (nu + most) * per_h * per_h * dt <= 1.0;
}

/// One row of unknowns d along x, solved in place:
///   (factor + w + e) d - w d_west - e d_east = d_given,   w = k_west / width / inertia, e = k_east / width / inertia,
/// with k from keep_implicit_part [m].  What lies outside the unknowns is 0.
struct RowSystem {
  const double *factor, *per_inertia, *k;
  double *d, *slope;  ///< slope is scratch
};
/// Several rows side by side: the recurrence runs along each, so vectors run across them.
void solve_rows(const Staggering& at, const RowSystem* rows, int count);

/// Scratch of `solve_columns`, one piece for each thread.
class ColumnScratch {
public:
  static constexpr int columns = 64;
  ColumnScratch() = default;
  explicit ColumnScratch(const Mesh& mesh) : ny_(mesh.ny) {}
  void fit() {
    while (static_cast<int>(of_thread_.size()) < base::threads())
      of_thread_.emplace_back(static_cast<std::size_t>(pieces) * columns * (ny_ + 1));
  }
  /// Piece n of the calling thread: rows of 64 values, from row 0 on.
  double* piece(int n) {
    return of_thread_[base::thread_index()].data() + static_cast<std::size_t>(n) * columns * (ny_ + 1);
  }

private:
  static constexpr int pieces = 4;
  int ny_ = 0;
  std::vector<base::AlignedVector<double>> of_thread_;
};

/// How far ahead of a walk down columns its rows are asked for.
inline constexpr int rows_ahead = 16;

/// Convection along y that is left to the columns: what ConvectionRows::implicit_y tells, times dt [m], row by row.
class ImplicitConvection {
public:
  ImplicitConvection() = default;
  explicit ImplicitConvection(const Mesh& mesh)
      : rows_(mesh.nx, mesh.ny), any_(mesh.ny + 1, 0), nothing_(mesh.nx, 0.0) {}

  /// Row j of faces <- dt x those of the quantity at `at`; null: nothing.
  void keep(const Staggering& at, int j, double dt, const double* implicit) {
    any_[j] = implicit != nullptr;
    if (!implicit) return;
    double* row = rows_.row(j);
    base::vector_loop(at.i0, at.i1, [&](int i) { row[i] = dt * implicit[i]; });
  }
  /// Whether there is anything in the columns [ia, ib) of `at`.
  bool any(const Staggering& at, int ia, int ib) const {
    for (int j = at.j0; j <= at.j1; ++j)
      if (any_[j] && base::vector_largest(ia, ib, 0.0, [row = rows_.row(j)](int i) { return std::abs(row[i]); }) > 0)
        return true;
    return false;
  }
  const double* row(int j) const { return any_[j] ? rows_.row(j) : nothing_.data(); }

private:
  base::Field rows_;
  std::vector<char> any_;
  std::vector<double> nothing_;
};

/// Columns [ia, ib) along y, at most 64, solved into `d` (rows of 64 values):
///   (factor + s + n + o) d - (s + i_south) d_south - (n + i_north) d_north = factor x given,
/// s = k_south / height / inertia, n = k_north / ..., with k(j)[i] from keep_implicit_part [m]; o and i likewise, what
/// `convection` carries out of the volume through both faces and in from either neighbour; none: `convection` is
/// nullptr.  What lies outside the unknowns is 0.
template <class K, class Convection>
void solve_columns(const Staggering& at, const base::SharedRows& factor, const base::Field& given, int ia, int ib,
                   K&& k, Convection convection, double* d, double* slope) {
  constexpr int wide = ColumnScratch::columns;
  const int n = ib - ia;
  for (int j = at.j0; j < at.j1; ++j) {
    const double *south_k = k(j) + ia, *north_k = k(j + 1) + ia, *f = factor.row(j) + ia;
    const double *per_inertia = at.per_inertia.row(j) + ia, *g = given.row(j) + ia;
    const double per_height = at.per_height[j + 2], has_below = j > at.j0 ? 1.0 : 0.0;
    double *here = d + j * wide, *s = slope + j * wide;
    const double* below = j > at.j0 ? here - wide : here;
    const double* s_below = j > at.j0 ? s - wide : s;
    if (j + rows_ahead < at.j1) base::fetch_ahead(given.row(j + rows_ahead), ia, ib);
    const auto run = [&](auto through_south, auto through_north) {
      base::vector_loop(0, n, [&](int i) {
        const double scale = per_height * per_inertia[i];
        const double south = scale * south_k[i], north = scale * north_k[i];
        const auto [in_south, out_south] = through_south(i, scale);
        const auto [out_north, in_north] = through_north(i, scale);
        const double from_south = has_below * (south + in_south);
        const double pivot = 1.0 / (f[i] + south + north + out_south + out_north - from_south * s_below[i]);
        s[i] = (north + in_north) * pivot;
        here[i] = (f[i] * g[i] + from_south * below[i]) * pivot;
      });
    };
    struct UpDown {
      double up, down;
    };
    if constexpr (std::is_null_pointer_v<Convection>) {
      const auto nothing = [](int, double) { return UpDown{0.0, 0.0}; };
      run(nothing, nothing);
    } else {
      const auto through = [ia](const double* row) {
        return [row = row + ia](int i, double scale) {
          return UpDown{scale * std::max(row[i], 0.0), scale * std::max(-row[i], 0.0)};
        };
      };
      run(through(convection->row(j)), through(convection->row(j + 1)));
    }
  }
  for (int j = at.j1 - 2; j >= at.j0; --j) {
    double* here = d + j * wide;
    const double *s = slope + j * wide, *above = here + wide;
    base::vector_loop(0, n, [&](int i) { here[i] += s[i] * above[i]; });
  }
}

/// Calls body(convection) with what the columns [ia, ib) are to carry, nullptr when that is nothing.
template <class Body>
void with_implicit(const ImplicitConvection& convection, const Staggering& at, int ia, int ib, Body&& body) {
  if (convection.any(at, ia, ib))
    body(&convection);
  else
    body(nullptr);
}

/// Calls body(ia, ib) for blocks of the columns of `at`, on all threads.
template <class Body>
void over_columns(const Staggering& at, ColumnScratch& scratch, Body&& body) {
  scratch.fit();
  constexpr int wide = ColumnScratch::columns;
  base::for_each_item(0, (at.i1 - at.i0 + wide - 1) / wide, [&](int k) {
    const int ia = at.i0 + k * wide;
    body(ia, std::min(at.i1, ia + wide));
  });
}

}  // namespace livebed::flow
