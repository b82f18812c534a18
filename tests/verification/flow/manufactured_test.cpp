#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "flow/constants.hpp"
#include "flow/transport.hpp"
#include "laminar.hpp"

/// Manufactured solutions: sources make a given field an exact solution; errors on three grids tell the order.
namespace livebed::flow {
namespace {

using base::square;
using Function = std::function<double(double x, double y)>;

/// Derivatives of closed forms by central differences: good to about 1e-8, far below any error measured here.
constexpr double h = 1e-4;
Function ddx(Function f) {
  return [f](double x, double y) { return (f(x + h, y) - f(x - h, y)) / (2 * h); };
}
Function ddy(Function f) {
  return [f](double x, double y) { return (f(x, y + h) - f(x, y - h)) / (2 * h); };
}

constexpr double pi = 3.14159265358979323846;

/// Order from the errors on two grids or with two steps, the finer with half the width.
double order(const char* name, double coarse, double middle, double fine) {
  std::printf("%s: %.3e %.3e %.3e, orders %.3f %.3f\n", name, coarse, middle, fine, std::log2(coarse / middle),
              std::log2(middle / fine));
  return std::log2(middle / fine);
}

Params closed_box(int n, double stretch) {
  Params p = laminar(pi, pi, n, n, 0.02);
  p.density = 1;
  if (stretch > 0) {
    p.mesh.growth = 1 + stretch * p.mesh.cell_x;
    p.mesh.fine_x_from = 0.5, p.mesh.fine_x_to = 1.0, p.mesh.fine_y_from = 0.5, p.mesh.fine_y_to = 1.0;
  }
  return p;
}
Boundary slip_walls() {
  Boundary b;
  b.inlet = b.outlet = false;
  b.floor = b.top = Wall::slip;
  return b;
}

/// k and epsilon in a cellular flow u = sin x cos y, v = - cos x sin y (times a slowly changing factor), whose walls
/// are planes of symmetry for them too.
struct ManufacturedTurbulence {
  Convection scheme = Convection::bounded;
  double stretch = 0, voids = 0;  ///< void fraction 1 - voids (1 + cos x cos y)/2

  static double k(double x, double y, double t) {
    return 0.1 * (1 + 0.3 * std::cos(x) * std::cos(y) * std::cos(2 * t) + 0.1 * std::cos(2 * x));
  }
  double e(double x, double y, double t) const {
    return dissipation * (1 + 0.3 * std::cos(x) * std::cos(2 * y) * std::sin(t + 1) + 0.1 * std::cos(y));
  }
  double dissipation = 0.1, speed = 0.05,
         nu = 0.1;  ///< so slow that diffusion and sources, not the limiter at extrema, rule the error
  double strength(double t) const { return speed * (1 + 0.5 * std::sin(2 * t)); }
  double voidage(double x, double y) const { return 1 - 0.5 * voids * (1 + std::cos(x) * std::cos(y)); }

  /// Velocity whose voidage-weighted flux is free of divergence.
  double u(double x, double y, double t) const { return strength(t) * std::sin(x) * std::cos(y) / voidage(x, y); }
  double v(double x, double y, double t) const { return -strength(t) * std::cos(x) * std::sin(y) / voidage(x, y); }

  /// What makes k, e exact at one time.
  struct Sources {
    Function k, e;
  };
  Sources sources(double t) const {
    const KEpsilon c = launder_spalding;
    const Function fk = [t](double x, double y) { return k(x, y, t); };
    const Function fe = [this, t](double x, double y) { return e(x, y, t); };
    const Function fu = [this, t](double x, double y) { return u(x, y, t); };
    const Function fv = [this, t](double x, double y) { return v(x, y, t); };
    const Function nut = [fk, fe, c](double x, double y) { return c.c_mu * square(fk(x, y)) / fe(x, y); };
    const auto transport = [=, this](Function f, double sigma) -> Function {
      const auto gamma = [=, this](double x, double y) { return voidage(x, y) * (nu + nut(x, y) / sigma); };
      const Function flux_x = [=](double x, double y) { return gamma(x, y) * ddx(f)(x, y); };
      const Function flux_y = [=](double x, double y) { return gamma(x, y) * ddy(f)(x, y); };
      return [=, this](double x, double y) {
        return fu(x, y) * ddx(f)(x, y) + fv(x, y) * ddy(f)(x, y) -
               (ddx(flux_x)(x, y) + ddy(flux_y)(x, y)) / voidage(x, y);
      };
    };
    const Function production = [=](double x, double y) {
      return nut(x, y) * strain_squared(ddx(fu)(x, y), ddy(fv)(x, y), ddy(fu)(x, y) + ddx(fv)(x, y));
    };
    const auto in_time = [t](auto f) -> Function {
      return [=](double x, double y) { return (f(x, y, t + h) - f(x, y, t - h)) / (2 * h); };
    };
    const Function carried_k = transport(fk, c.sigma_k), carried_e = transport(fe, c.sigma_epsilon);
    const Function k_t = in_time(&ManufacturedTurbulence::k);
    const Function e_t = in_time([this](double x, double y, double at) { return e(x, y, at); });
    return {[=](double x, double y) { return k_t(x, y) + carried_k(x, y) - production(x, y) + fe(x, y); },
            [=](double x, double y) {
              return e_t(x, y) + carried_e(x, y) - fe(x, y) / fk(x, y) * (c.c1 * production(x, y) - c.c2 * fe(x, y));
            }};
  }

  /// Relative rms errors of k and epsilon after `end` on n x n cells with steps of dt.
  double error(int n, double dt, double end) const {
    Params p = closed_box(n, stretch);
    p.viscosity = nu;
    p.closure = Closure::k_epsilon;
    p.convection = scheme;
    const Mesh whole = make_mesh(p.mesh, p.pipe);
    base::Field voids_left(whole.nx, whole.ny);
    for (int j = 0; j < whole.ny; ++j)
      for (int i = 0; i < whole.nx; ++i) voids_left(i, j) = voidage(whole.centre_x(i), whole.centre_y(j));
    const Mesh m = fill_with_voids(whole, voids_left);
    const Boundary b = slip_walls();
    const Staggering at = Staggering::centres(m);
    Workspace w(m);
    Turbulence turbulence(m, b, p);
    Solver maker(p, m, b);
    State s = maker.state;
    const auto fill = [&](base::Field& to, auto f, double t) {
      for (int j = 0; j < m.ny; ++j)
        for (int i = 0; i < m.nx; ++i) to(i, j) = f(m.centre_x(i), m.centre_y(j), t);
    };
    const auto e_at = [&](double x, double y, double t) { return e(x, y, t); };
    fill(s.k, &k, 0), fill(s.epsilon, e_at, 0), fill(s.k_old, &k, -dt), fill(s.epsilon_old, e_at, -dt);
    s.step = dt;
    base::Field source_k(m.nx, m.ny), source_e(m.nx, m.ny);
    const int steps = static_cast<int>(std::lround(end / dt));
    for (int step = 0; step < steps; ++step) {
      const double middle = (step + 0.5) * dt;
      for (int j = 0; j < m.ny; ++j)
        for (int i = 0; i < m.nx; ++i) {
          s.u(i, j) = u(m.x[i], m.centre_y(j), middle);
          s.v(i, j) = v(m.centre_x(i), m.y[j], middle);
        }
      fill_velocity_ghosts(m, b, s.u, s.v);
      const Sources exact = sources(middle);
      for (int j = 0; j < m.ny; ++j)
        for (int i = 0; i < m.nx; ++i) {
          source_k(i, j) = exact.k(m.centre_x(i), m.centre_y(j));
          source_e(i, j) = exact.e(m.centre_x(i), m.centre_y(j));
        }
      turbulence.set_sources(&source_k, &source_e);
      evaluate_walls(m, b, p, s, w);
      advance_turbulence(m, b, p, at, dt, turbulence, s, w);
    }
    double sum = 0, size = 0;
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) {
        const double area = m.dx(i) * m.dy(j), x = m.centre_x(i), y = m.centre_y(j), t = steps * dt;
        sum += area * (square(s.k(i, j) / k(x, y, t) - 1) + square(s.epsilon(i, j) / e(x, y, t) - 1));
        size += area;
      }
    return std::sqrt(sum / size);
  }
};

TEST(manufactured_turbulence, order_two_in_space_and_time) {
  for (double voids : {0.0, 0.6})
    for (double stretch : {0.0, 0.7}) {
      ManufacturedTurbulence c;
      c.stretch = stretch, c.voids = voids;
      const double p = order(voids > 0 ? "k-epsilon among voids" : "k-epsilon", c.error(32, 0.02, 0.2),
                             c.error(64, 0.01, 0.2), c.error(128, 0.005, 0.2));
      EXPECT_GT(p, 1.9) << voids << " " << stretch;
      EXPECT_LT(p, 2.1) << voids << " " << stretch;
    }
}

TEST(manufactured_turbulence, order_one_where_hybrid_is_upwind) {
  ManufacturedTurbulence c;
  c.scheme = Convection::hybrid;
  c.dissipation = 2, c.speed = 3, c.nu = 1e-6;
  const double p =
      order("k-epsilon, hybrid", c.error(32, 0.004, 0.1), c.error(64, 0.002, 0.1), c.error(128, 0.001, 0.1));
  EXPECT_GT(p, 0.9);
  EXPECT_LT(p, 1.1);
}

/// Steady laminar flow through voids of 1 - 0.6 (1 + cos x cos y)/2 in a box of slip walls, driven by a force.
double error_among_voids(int n, double stretch) {
  Params p = closed_box(n, stretch);
  p.viscosity = 0.05;
  p.pressure_tolerance = 1e-4;
  const double nu = p.viscosity;
  const Function voidage = [](double x, double y) { return 1 - 0.3 * (1 + std::cos(x) * std::cos(y)); };
  const Function u = [voidage](double x, double y) { return std::sin(x) * std::cos(y) / voidage(x, y); };
  const Function v = [voidage](double x, double y) { return -std::cos(x) * std::sin(y) / voidage(x, y); };
  const Function pressure = [](double x, double y) { return std::cos(x) * std::cos(2 * y); };
  const Function xx = [=](double x, double y) { return 2 * nu * voidage(x, y) * ddx(u)(x, y); };
  const Function yy = [=](double x, double y) { return 2 * nu * voidage(x, y) * ddy(v)(x, y); };
  const Function xy = [=](double x, double y) { return nu * voidage(x, y) * (ddy(u)(x, y) + ddx(v)(x, y)); };
  const auto balance = [=](const Function& c, const Function& slope, const Function& s_x, const Function& s_y) {
    return [=](double x, double y) {
      return u(x, y) * ddx(c)(x, y) + v(x, y) * ddy(c)(x, y) + slope(x, y) -
             (ddx(s_x)(x, y) + ddy(s_y)(x, y)) / voidage(x, y);
    };
  };
  const Function force_u = balance(u, ddx(pressure), xx, xy), force_v = balance(v, ddy(pressure), xy, yy);

  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, slip_walls());
  base::Field field(m.nx, m.ny), exact_u(m.nx, m.ny), exact_v(m.nx, m.ny);
  State& s = flow.state;
  s.load.top = m.ny;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      field(i, j) = voidage(m.centre_x(i), m.centre_y(j));
      s.u(i, j) = exact_u(i, j) = u(m.x[i], m.centre_y(j));
      s.v(i, j) = exact_v(i, j) = v(m.centre_x(i), m.y[j]);
      s.p(i, j) = pressure(m.centre_x(i), m.centre_y(j));
      s.load.force_u(i, j) = force_u(m.x[i], m.centre_y(j));
      s.load.force_v(i, j) = force_v(m.centre_x(i), m.y[j]);
    }
  flow.set_voidage(field, 0);
  fill_velocity_ghosts(m, flow.boundary(), s.u, s.v);
  s.u_old = s.u, s.v_old = s.v;
  const double dt = 0.2 / n;  // steps shrink with the cells, so that one order tells of both
  while (s.time < 1.0 - 0.5 * dt) flow.advance(dt);
  return distance(m, s.u, s.v, exact_u, exact_v);
}

TEST(manufactured_voids, order_two_of_momentum_and_mass) {
  for (double stretch : {0.0, 0.3}) {
    const double p = order("flow among voids", error_among_voids(32, stretch), error_among_voids(64, stretch),
                           error_among_voids(128, stretch));
    EXPECT_GT(p, 1.9) << stretch;
    EXPECT_LT(p, 2.1) << stretch;
  }
}

TEST(voidage, that_shrinks_drives_the_water_out) {
  Params p = laminar(1, 0.2, 40, 8, 1e-6);
  Boundary b = slip_walls();
  b.outlet = true;
  Solver flow(p, make_mesh(p.mesh, p.pipe), b);
  const Mesh& m = flow.mesh();
  const double dt = 0.01, rate = -0.5;
  double voidage = 0.9;
  flow.set_voidage(base::Field(m.nx, m.ny, 2, voidage), 0);
  for (int step = 0; step < 20; ++step) {
    voidage += rate * dt;
    flow.set_voidage(base::Field(m.nx, m.ny, 2, voidage), dt);
    flow.advance(dt);
    for (int i = 0; i <= m.nx; ++i) ASSERT_NEAR(flow.state.u(i, 3), -rate * m.x[i] / voidage, 1e-7) << step << " " << i;
  }
}

TEST(voidage, out_of_range_is_refused) {
  Params p = laminar(1, 0.2, 40, 8, 1e-6);
  const Mesh m = make_mesh(p.mesh, p.pipe);
  for (double value : {0.0, -0.1, 1.2, std::nan("")}) {
    base::Field voidage(m.nx, m.ny, 2, 1.0);
    voidage(3, 2) = value;
    EXPECT_THROW(fill_with_voids(m, voidage), base::Fault) << value;
  }
}

}  // namespace
}  // namespace livebed::flow
