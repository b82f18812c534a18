#include "flow/operators.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "flow/momentum.hpp"

namespace livebed::flow {
namespace {

Mesh graded_mesh() {
  MeshParams grid;
  grid.length = 1, grid.height = 0.7, grid.cell_x = 0.02, grid.cell_y = 0.03, grid.growth = 1.1;
  grid.fine_x_from = 0.3, grid.fine_x_to = 0.5, grid.fine_y_from = 0.1, grid.fine_y_to = 0.3;
  PipeParams pipe;
  pipe.present = false;
  return make_mesh(grid, pipe);
}

/// Every node of a place, ghosts included, from f(x, y).
template <class F>
base::Field sample(const Mesh& m, const Staggering& at, F&& f) {
  base::Field out(m.nx, m.ny);
  for (int j = -1; j <= m.ny; ++j)
    for (int i = -1; i <= m.nx; ++i) {
      const double x = at.shift_x ? (i < 0 ? -m.x[1] : m.x[i]) : m.centre_x(i);
      const double y = at.shift_y ? (j < 0 ? -m.y[1] : m.y[j]) : m.centre_y(j);
      out(i, j) = f(x, y);
    }
  for (int i = -2; i < m.nx + 2; ++i) out(i, -2) = out(i, -1), out(i, m.ny + 1) = out(i, m.ny);
  for (int j = -2; j < m.ny + 2; ++j) out(-2, j) = out(-1, j), out(m.nx + 1, j) = out(m.nx, j);
  return out;
}

/// Convection of phi on all its unknowns [1/s]; apertures as given.
base::Field convect(const Mesh& m, const Staggering& at, Convection scheme, const base::Field& flow_u,
                    const base::Field& flow_v, const base::Field& phi, double nu, double dt, const base::Field& face_x,
                    const base::Field& face_y, double courant = std::numeric_limits<double>::infinity(),
                    base::Field* implicit = nullptr) {
  base::Field out(m.nx, m.ny), zero(m.nx, m.ny);
  const base::SharedRows open_x(face_x), open_y(face_y);
  RowScratch scratch(m);
  with_scheme(scheme, [&](auto kind) {
    scratch.over_blocks(at.j0, at.j1, [&](int ja, int jb) {
      RowScratch::Rows rows = scratch.rows();
      CarrierRows carrier(m, {flow_u, flow_v, flow_u, flow_v, 0.0}, rows);
      ConvectionRows<decltype(kind)> convection(open_x, open_y, carrier,
                                                {at, phi, phi, zero, 0.0, dt, false, zero, nu, courant}, rows);
      carrier.start(ja - 2);
      convection.start(ja);
      for (int j = ja; j < jb; ++j) {
        convection.next(out.row(j));
        for (const int face : {j, j + 1})
          if (const double* row = implicit ? convection.implicit_y(face) : nullptr)
            std::copy(row + at.i0, row + at.i1, implicit->row(face) + at.i0);
      }
    });
  });
  return out;
}

/// The same in a uniform flow.
base::Field convect(const Mesh& m, const Staggering& at, Convection scheme, double u, double v, const base::Field& phi,
                    double nu, double dt, const base::Field& face_x, const base::Field& face_y,
                    double courant = std::numeric_limits<double>::infinity(), base::Field* implicit = nullptr) {
  return convect(m, at, scheme, base::Field(m.nx, m.ny, 2, u), base::Field(m.nx, m.ny, 2, v), phi, nu, dt, face_x,
                 face_y, courant, implicit);
}

class Convect : public ::testing::TestWithParam<std::tuple<Convection, int, double, double>> {};

TEST_P(Convect, a_line_is_carried_exactly) {
  const auto [scheme, place, u, v] = GetParam();
  const Mesh m = graded_mesh();
  const Staggering at = place == 0   ? Staggering::centres(m)
                        : place == 1 ? Staggering::west_faces(m)
                                     : Staggering::south_faces(m);
  const base::Field phi = sample(m, at, [](double x, double y) { return 3 + 2 * x - 5 * y; });
  // Diffusivity so large that hybrid is central.
  const base::Field out = convect(m, at, scheme, u, v, phi, 1.0, 1e-3, m.aperture_x, m.aperture_y);
  const double exact = -(2 * u - 5 * v);
  // Faces between unequal cells are not in the middle of the nodes: central weights and slopes know that.
  for (int j = at.j0 + 2; j < at.j1 - 2; ++j)
    for (int i = at.i0 + 2; i < at.i1 - 2; ++i) ASSERT_NEAR(out(i, j), exact, 1e-9) << i << "," << j;
}

INSTANTIATE_TEST_SUITE_P(places, Convect,
                         ::testing::Combine(::testing::Values(Convection::bounded, Convection::hybrid),
                                            ::testing::Values(0, 1, 2), ::testing::Values(0.8, -0.8),
                                            ::testing::Values(0.3, -0.3)));

TEST(convect, moves_but_never_makes) {
  // Sum over all volumes = what passes the rim.
  const Mesh m = graded_mesh();
  const Staggering at = Staggering::centres(m);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(0, 1);
  base::Field phi(m.nx, m.ny);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) phi(i, j) = value(random);
  base::Field face_x = m.aperture_x, face_y = m.aperture_y;  // of a closed box
  for (int j = -2; j < m.ny + 2; ++j) face_x(0, j) = face_x(m.nx, j) = 0;
  for (int i = -2; i < m.nx + 2; ++i) face_y(i, 0) = face_y(i, m.ny) = 0;
  for (Convection scheme : {Convection::bounded, Convection::hybrid}) {
    const base::Field out = convect(m, at, scheme, 1, -0.5, phi, 0, 1e-3, face_x, face_y);
    double sum = 0, size = 0;
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) {
        const double through = out(i, j) * at.inertia(i, j);
        sum += through, size += std::abs(through);
      }
    EXPECT_GT(size, 0.1);
    EXPECT_LT(std::abs(sum), 1e-13 * size);
  }
}

// Beside a pipe: a stream that turns aside before a slit, out of which a thin and faster one comes the other way. Their
// plain mean has the sign of the thin one; the value from there would make the first grow without end.
TEST(convect, takes_what_comes_from_upstream_though_a_slit_streams_against_it) {
  MeshParams grid;
  grid.length = 1, grid.height = 1, grid.cell_x = grid.cell_y = 0.025;
  PipeParams no_pipe;
  no_pipe.present = false;
  const Mesh m = make_mesh(grid, no_pipe);
  constexpr int i = 20, j = 10;
  constexpr double wide = 0.5, slit = 0.001, stream = 2, thin = -4, h = 0.025;
  for (Convection scheme : {Convection::bounded, Convection::hybrid})
    for (double sense : {1.0, -1.0})
      for (bool along_x : {false, true}) {
        const Staggering at = along_x ? Staggering::west_faces(m) : Staggering::south_faces(m);
        base::Field u(m.nx, m.ny), v(m.nx, m.ny), phi(m.nx, m.ny), face_x = m.aperture_x, face_y = m.aperture_y;
        base::Field &flow = along_x ? u : v, &face = along_x ? face_x : face_y;
        const int next_i = along_x ? i + static_cast<int>(sense) : i,
                  next_j = along_x ? j : j + static_cast<int>(sense);
        flow(i, j) = sense * stream, face(i, j) = wide;
        flow(next_i, next_j) = sense * thin, face(next_i, next_j) = slit;
        for (int b = -2; b < m.ny + 2; ++b)
          for (int a = -2; a < m.nx + 2; ++a) phi(a, b) = sense * (along_x ? a - i : b - j) > 0 ? 5 : 1;
        const base::Field out = convect(m, at, scheme, u, v, phi, 0, 1e-6, face_x, face_y);
        // In comes half of the stream with 1, out goes half of both with 1.
        const double in = 0.5 * stream * wide, through = 0.5 * (stream * wide + thin * slit);
        EXPECT_NEAR(out(i, j), (in - through) / h, 1e-9) << along_x << sense;
        // Beyond: what comes with 1, and out of the slit's far half, where all is 5, 5 comes in.
        EXPECT_NEAR(out(next_i, next_j), (through * 1 - 0.5 * thin * slit * 5) / h, 1e-9) << along_x << sense;
      }
}

TEST(convect, leaves_along_y_what_exceeds_the_courant_number) {
  const Mesh m = graded_mesh();
  const double u = 0.4, v = -0.9, dt = 0.02, courant = 0.7;
  for (const Staggering& at : {Staggering::centres(m), Staggering::west_faces(m), Staggering::south_faces(m)}) {
    // What is the same everywhere stays so; what is linear is carried upwind.
    base::Field implicit(m.nx, m.ny);
    const base::Field flat = sample(m, at, [](double, double) { return 3.0; });
    const base::Field out =
        convect(m, at, Convection::bounded, u, v, flat, 0, dt, m.aperture_x, m.aperture_y, courant, &implicit);
    int left = 0;
    for (int j = at.j0 + 2; j < at.j1 - 2; ++j)
      for (int i = at.i0 + 2; i < at.i1 - 2; ++i) {
        ASSERT_NEAR(out(i, j), 0.0, 1e-12) << i << "," << j;
        const double passed = u * dt / at.width[i + 2], h = std::min(at.height[j + 1], at.height[j + 2]);
        const double borne = std::min(-v, std::max(0.0, courant - passed) * h / dt);
        ASSERT_NEAR(implicit(i, j), v + borne, 1e-12) << i << "," << j;
        left += implicit(i, j) < 0;
      }
    EXPECT_GT(left, 100);
    const base::Field up = sample(m, at, [](double, double y) { return 5 * y; });
    base::Field all(m.nx, m.ny);
    const base::Field upwind =
        convect(m, at, Convection::bounded, 0, v, up, 0, dt, m.aperture_x, m.aperture_y, 1e-9, &all);
    for (int j = at.j0 + 2; j < at.j1 - 2; ++j) {
      const double expected = -v * 5 * at.hy[j + 3] / at.height[j + 2];  // from above, over the distance of the nodes
      ASSERT_NEAR(upwind(at.i0 + 3, j), expected, 1e-6 * expected) << j;
    }
  }
}

TEST(convect, is_the_same_to_the_bit_where_nothing_exceeds) {
  const Mesh m = graded_mesh();
  const Staggering at = Staggering::centres(m);
  const base::Field phi = sample(m, at, [](double x, double y) { return std::sin(9 * x) * std::cos(7 * y); });
  base::Field implicit(m.nx, m.ny);
  const base::Field all = convect(m, at, Convection::bounded, 0.5, 0.4, phi, 0, 0.01, m.aperture_x, m.aperture_y);
  const base::Field part =
      convect(m, at, Convection::bounded, 0.5, 0.4, phi, 0, 0.01, m.aperture_x, m.aperture_y, 0.8, &implicit);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      ASSERT_EQ(all(i, j), part(i, j));
      ASSERT_EQ(implicit(i, j), 0.0);
    }
}

TEST(solve_columns, carries_upwards_and_downwards) {
  MeshParams grid;
  grid.length = 0.96, grid.height = 0.3, grid.cell_x = 0.01, grid.cell_y = 0.015;
  PipeParams pipe;
  pipe.present = false;
  const Mesh m = make_mesh(grid, pipe);
  const Staggering at = Staggering::centres(m);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> value(0, 1);
  base::Field k(m.nx, m.ny), given(m.nx, m.ny), d(m.nx, m.ny), through(m.nx, m.ny);
  const base::SharedRows ones(base::Field(m.nx, m.ny, 2, 1.0));
  ImplicitConvection convection(m);
  for (int j = 0; j <= m.ny; ++j) {
    for (int i = 0; i < m.nx; ++i) {
      k(i, j) = 0.1 * value(random);
      // Some rows and, below, some blocks of columns have none.
      through(i, j) = j == 0 || j == m.ny || j % 3 == 0 || i >= 64 ? 0.0 : value(random) - 0.5;
      if (j < m.ny) given(i, j) = value(random) - 0.5;
    }
    convection.keep(at, j, 1.0, j == 0 || j == m.ny || j % 3 == 0 ? nullptr : through.row(j));
  }
  ColumnScratch scratch(m);
  int with = 0, without = 0;
  over_columns(at, scratch, [&](int ia, int ib) {
    double* column = scratch.piece(0);
    with_implicit(convection, at, ia, ib, [&](auto carried) {
      ++(std::is_null_pointer_v<decltype(carried)> ? without : with);
      solve_columns(
          at, ones, given, ia, ib, [&](int j) { return k.row(j); }, carried, column, scratch.piece(1));
    });
    for (int j = 0; j < m.ny; ++j)
      for (int i = ia; i < ib; ++i) d(i, j) = column[j * ColumnScratch::columns + i - ia];
  });
  EXPECT_GT(with, 0);
  EXPECT_GT(without, 0) << "the mesh has " << m.nx << " columns";
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      const auto flux = [&](int face) {  // of d through a south face: diffusion and upwind convection
        const double below = face > 0 ? d(i, face - 1) : 0.0, above = face < m.ny ? d(i, face) : 0.0;
        const bool inner = face > 0 && face < m.ny;
        const double spread = inner ? k(i, face) * (below - above) : k(i, face) * (face == 0 ? -above : below);
        return spread + through(i, face) * (through(i, face) > 0 ? below : above);
      };
      const double balance = d(i, j) - (flux(j) - flux(j + 1)) / at.inertia_(i, j) / at.height[j + 2];
      ASSERT_NEAR(balance, given(i, j), 1e-11) << i << "," << j;
    }
}

TEST(solve_rows, inverts_its_own_matrices) {
  const Mesh m = graded_mesh();
  const Staggering at = Staggering::west_faces(m);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(0, 1);
  base::Field factor(m.nx, m.ny, 2, 1.0), k(m.nx, m.ny), given(m.nx, m.ny), slope(m.nx, m.ny);
  for (int j = 0; j <= m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i) {
      k(i, j) = 0.1 * value(random);
      if (i < m.nx && j < m.ny) factor(i, j) = 1 + value(random), given(i, j) = value(random) - 0.5;
    }
  for (bool along_x : {true, false}) {
    base::Field phi = given;
    if (along_x) {
      std::vector<RowSystem> rows;  // so many that they do not fill the last group
      for (int j = at.j0; j < at.j1; ++j)
        rows.push_back({factor.row(j), at.per_inertia.row(j), k.row(j), phi.row(j), slope.row(j)});
      solve_rows(at, rows.data(), static_cast<int>(rows.size()));
    } else {
      ColumnScratch scratch(m);
      const base::SharedRows factor_rows(factor);
      over_columns(at, scratch, [&](int ia, int ib) {
        double* d = scratch.piece(0);
        solve_columns(
            at, factor_rows, given, ia, ib, [&](int j) { return k.row(j); }, nullptr, d, scratch.piece(1));
        for (int j = at.j0; j < at.j1; ++j)
          for (int i = ia; i < ib; ++i) phi(i, j) = d[j * ColumnScratch::columns + i - ia];
      });
    }
    for (int j = at.j0; j < at.j1; ++j)
      for (int i = at.i0; i < at.i1; ++i) {
        const double scale = (along_x ? at.per_width[i + 2] : at.per_height[j + 2]) / at.inertia_(i, j);
        const double before = scale * k(i, j), after = scale * (along_x ? k(i + 1, j) : k(i, j + 1));
        const bool first = along_x ? i == at.i0 : j == at.j0, last = along_x ? i == at.i1 - 1 : j == at.j1 - 1;
        const double left = first ? 0 : along_x ? phi(i - 1, j) : phi(i, j - 1);
        const double right = last ? 0 : along_x ? phi(i + 1, j) : phi(i, j + 1);
        const double expected = along_x ? given(i, j) : factor(i, j) * given(i, j);
        ASSERT_NEAR((factor(i, j) + before + after) * phi(i, j) - before * left - after * right, expected, 1e-12)
            << i << "," << j;
      }
  }
}

TEST(keep_implicit_part, is_half_of_small_and_nearly_all_of_large_exchanges) {
  std::vector<double> k{1e-4, 2e-4, 1e-4, 50.0};
  keep_implicit_part(
      0, 2, 0.1, true, [](int) { return 100.0; }, k.data());
  EXPECT_DOUBLE_EQ(k[0], 0.5 * 0.1 * 1e-4);
  keep_implicit_part(
      2, 4, 0.1, false, [](int) { return 100.0; }, k.data());
  EXPECT_DOUBLE_EQ(k[2], 0.5 * 0.1 * 1e-4);
  EXPECT_DOUBLE_EQ(k[3], 0.1 * 50.0 * (1 - 0.5 / 500.0));
}

TEST(spreads_little, is_sure_before_it_says_so) {
  const Mesh m = graded_mesh();
  const Staggering at = Staggering::centres(m);
  base::Field nut(m.nx, m.ny);
  const double nu = 1e-3, narrow = 0.02;  // the smallest cell
  EXPECT_TRUE(spreads_little(at, nut, nu, 0.2 * narrow * narrow / nu, 0, m.ny));
  EXPECT_FALSE(spreads_little(at, nut, nu, 1.1 * narrow * narrow / nu, 0, m.ny));
  nut(5, 4) = 9e-3;
  EXPECT_FALSE(spreads_little(at, nut, nu, 0.2 * narrow * narrow / nu, 0, m.ny));
  EXPECT_TRUE(spreads_little(at, nut, nu, 0.2 * narrow * narrow / nu, 8, m.ny));
}

TEST(carrier, goes_half_a_step_ahead_of_the_last_two_levels) {
  const Mesh m = graded_mesh();
  State s;
  const base::Field f(m.nx, m.ny);
  s.u = s.v = s.u_old = s.v_old = f;
  s.u.fill(3), s.u_old.fill(1), s.v.fill(-1), s.v_old.fill(-2);
  s.step = 0.1;
  RowScratch scratch(m);
  scratch.fit();
  for (const auto& [step, u, v] : {std::tuple{0.1, 5.0, 0.0}, {0.0, 3.0, -1.0}}) {  // the first step knows one level
    s.step = step;
    RowScratch::Rows rows = scratch.rows();
    CarrierRows carrier(m, centred_carrier(s, 0.2), rows);  // twice the step before: ahead by the whole difference
    carrier.start(2);
    carrier.reach(4);
    EXPECT_NEAR(carrier.u(4)[3], u, 1e-14);
    EXPECT_NEAR(carrier.v(3)[-1], v, 1e-14);
  }
}

}  // namespace
}  // namespace livebed::flow
