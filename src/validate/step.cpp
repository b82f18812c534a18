#include "validate/step.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "base/curves.hpp"
#include "base/fault.hpp"
#include "base/math.hpp"
#include "flow/constants.hpp"
#include "io/table.hpp"
#include "validate/picture.hpp"
#include "validate/references.hpp"

namespace livebed::validate {

using base::square;

namespace {

constexpr double channel_height = 8, development = 160;  ///< [H]
constexpr double behind = 40;                            ///< length behind the step [H]
constexpr double lid_row = 8;                            ///< height of the row at the lid over those at floor and step
constexpr double inlet_k = 1e-3, inlet_nut_over_nu = 5;  ///< of the uniform stream; gone long before the step

/// A column of the measured profiles.
struct Measured {
  std::vector<double> y, u;
};
Measured measured_profile(double x) {
  const io::Table table = io::parse_table(step_profiles, "data/bfs_driver_seegmiller_profiles.csv");
  Measured m;
  for (std::size_t k = 0; k < table.rows(); ++k)
    if (table.column("x_over_H")[k] == x)
      m.y.push_back(table.column("y_over_H")[k]), m.u.push_back(table.column("u")[k]);
  return m;
}

flow::Params params(flow::Closure closure) {
  flow::Params p;
  p.density = 1;
  p.viscosity = 1 / step_reynolds;
  p.closure = closure;
  p.floor = flow::Wall::smooth;
  p.max_step = 1;
  p.pipe.present = false;
  return p;
}

/// Faces from 0 to length: cells of the height `first`, each `row_growth` times the one before up to the largest, all
/// scaled to fill the length.
std::vector<double> graded(double length, double first, double largest) {
  constexpr double row_growth = 1.15;
  std::vector<double> faces{0.0};
  for (double height = first; faces.back() < length; height = std::min(height * row_growth, largest))
    faces.push_back(faces.back() + height);
  const double scale = length / faces.back();
  for (double& y : faces) y *= scale;
  return faces;
}

/// Appends faces that run from the last one to `end` [H], graded towards the last one or, downwards, towards the end.
void append(std::vector<double>& y, double end, bool downwards, double first, double largest) {
  const double start = y.back(), length = end - start;
  const std::vector<double> faces = graded(length, first, largest);
  const std::size_t n = faces.size() - 1;
  for (std::size_t k = 1; k <= n; ++k) y.push_back(k == n ? end : downwards ? end - faces[n - k] : start + faces[k]);
}

/// Rows of the channel above the step, from its top (0) to the lid.
std::vector<double> rows_above(const StepSetup& s) {
  const double h = 1.0 / s.cells;
  if (s.first_row == 0) return flow::stretched_faces(channel_height, h, 1, 0, 0);
  std::vector<double> y{0.0};
  append(y, 1.5, false, s.first_row, h);
  append(y, channel_height, true, lid_row * s.first_row, 2 * h);
  return y;
}

/// Rows from the floor to the lid; the step's top lies on a face.
std::vector<double> rows_of(const StepSetup& s) {
  const double h = 1.0 / s.cells;
  if (s.first_row == 0) return flow::stretched_faces(channel_height + 1, h, 1, 0, 0);
  std::vector<double> y{0.0};
  append(y, 0.5, false, s.first_row, h);
  append(y, 1.0, true, s.first_row, h);
  const std::vector<double> above = rows_above(s);
  for (std::size_t k = 1; k < above.size(); ++k) y.push_back(1 + above[k]);
  return y;
}

/// Closes the corner x < length, y < 1.  With friction its top is a wall; the walls that the flow knows besides floor
/// and lid belong to a pipe, so the top is the crown of a very large one.  The face of the step has no friction.
void cut_step(flow::Mesh& m, double length, bool friction) {
  constexpr double radius = 1e6;  // the crown is flat to 1e-5
  if (friction) {
    m.pipe.present = true;
    m.pipe.diameter = 2 * radius;
    m.pipe.x = 0.5 * length, m.pipe.y = 1 - radius;
    m.pipe.wall = flow::Wall::smooth;
  }
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      const double ahead = m.centre_x(i) - length, above = m.centre_y(j) - 1;
      m.wall_distance(i, j) = std::hypot(std::max(ahead, 0.0), std::max(above, 0.0));
      if (ahead > 0) continue;
      if (above < 0) {
        m.volume(i, j) = 0;
        m.aperture_x(i, j) = m.aperture_x(i + 1, j) = m.aperture_y(i, j) = m.aperture_y(i, j + 1) = 0;
      } else if (friction && m.volume(i, j - 1) == 0) {
        m.wall_length(i, j) = m.dx(i);
      }
    }
}

/// Last place on the floor, no further than 15 H, where backward flow ends; 0 when there is none.
double reattachment(const std::vector<double>& x, const std::vector<double>& cf) {
  double at = 0;
  for (std::size_t k = 1; k < x.size() && x[k] < 15; ++k)
    if (cf[k - 1] < 0 && cf[k] >= 0) at = x[k] - cf[k] / (cf[k] - cf[k - 1]) * (x[k] - x[k - 1]);
  return at;
}

/// Friction coefficient on the floor of every column.
std::vector<double> friction(const flow::Solver& flow) {
  std::vector<double> cf;
  const flow::State& s = flow.state;
  for (int i = 0; i < flow.mesh().nx; ++i)
    cf.push_back(std::copysign(2 * square(flow.floor_shear_velocity(i)), s.u(i, 0) + s.u(i + 1, 0)));
  return cf;
}

}  // namespace

double momentum_thickness(const std::vector<double>& y, const std::vector<double>& u) {
  const Measured data = measured_profile(-4);
  const double edge = base::interpolate(y, u, 0.5 * channel_height);
  double thickness = 0, before = 0, y_before = 1;
  for (const double height : data.y) {
    if (height > 3.2) break;
    const double share = base::interpolate(y, u, height - 1) / edge, deficit = share * (1 - share);
    thickness += 0.5 * (deficit + before) * (height - y_before);
    before = deficit, y_before = height;
  }
  return thickness;
}

StepApproach approach_step(const StepSetup& setup) {
  const flow::Params p = params(setup.closure);
  const flow::Mesh mesh = flow::make_mesh(flow::stretched_faces(development, 1, 1, 0, 0), rows_above(setup), p.pipe);
  flow::Boundary b;
  b.floor = b.top = flow::Wall::smooth;
  b.inlet_u.assign(mesh.ny, 1.0);
  b.inlet_k.assign(mesh.ny, inlet_k);
  b.inlet_epsilon.assign(mesh.ny, flow::launder_spalding.c_mu * square(inlet_k) / (inlet_nut_over_nu * p.viscosity));
  flow::Solver flow(p, mesh, b);
  flow.start();
  while (flow.state.time < 3 * development) flow.advance(flow.step_limit());

  // The measured layer's thickness by the same sum.
  const Measured data = measured_profile(-4);
  std::vector<double> above_step;
  for (double y : data.y) above_step.push_back(y - 1);
  const double wanted = momentum_thickness(above_step, data.u);
  const std::vector<double> y(mesh.yc.begin() + 2, mesh.yc.end() - 2);
  const flow::State& s = flow.state;
  // Values at distance x from the inlet.
  const auto column = [&](double x) {
    StepInlet c;
    const int i = static_cast<int>(x);
    const double f = x - i;
    for (int j = 0; j < mesh.ny; ++j) {
      c.u.push_back((1 - f) * s.u(i, j) + f * s.u(i + 1, j));
      const int a = static_cast<int>(x - 0.5);
      const double g = x - 0.5 - a;
      c.k.push_back((1 - g) * s.k(a, j) + g * s.k(a + 1, j));
      c.epsilon.push_back((1 - g) * s.epsilon(a, j) + g * s.epsilon(a + 1, j));
    }
    return c;
  };
  double from = 5, thickness = momentum_thickness(y, column(from).u);
  constexpr double stride = 0.25;
  while (thickness < wanted) {
    from += stride;
    if (from > development - 10)
      base::fail(base::Exit::diverged, "the layer before the step is {:.3f} H thick after {} H, wanted {:.3f} H",
                 thickness, from, wanted);
    thickness = momentum_thickness(y, column(from).u);
  }
  StepApproach approach{y, column(from), column(from + 4), 0, from};
  const double reference = base::interpolate(y, approach.at_minus_4.u, 0.5 * channel_height);
  approach.friction = friction(flow)[static_cast<std::size_t>(from)] / square(reference);
  for (StepInlet* c : {&approach.at_minus_4, &approach.at_step})
    for (int j = 0; j < mesh.ny; ++j)
      c->u[j] /= reference, c->k[j] /= square(reference), c->epsilon[j] /= base::cube(reference);
  return approach;
}

std::string StepSetup::text() const {
  return fmt::format(
      "step of 1 H in a channel of 8 H, Re_H {}, {} cells a step height, {}, growing by 1.05 in x from 8 H on, outlet "
      "{} H "
      "behind the step, {}; smooth walls, bounded convection, Courant 0.8, marched until the reattachment stands to "
      "0.1 % "
      "in 20 H/Uref",
      step_reynolds, cells,
      first_row > 0 ? fmt::format("rows of {} H at floor and step, growing", first_row) : "equal rows", behind,
      upstream > 0 ? fmt::format("inlet {} H before it, its top {}", upstream, friction ? "smooth" : "without friction")
                   : "inlet in its face");
}

StepRun run_step(const StepSetup& setup, const StepInlet& inlet) {
  const auto start = std::chrono::steady_clock::now();
  constexpr double look_every = 20, longest = 800, changes_less = 1e-3;
  flow::Params p = params(setup.closure);
  flow::Mesh mesh =
      flow::make_mesh(flow::stretched_faces(setup.upstream + behind, 1.0 / setup.cells, 1.05, 0, setup.upstream + 8),
                      rows_of(setup), p.pipe);
  cut_step(mesh, setup.upstream, setup.friction);
  flow::Boundary b;
  b.floor = b.top = flow::Wall::smooth;
  const int closed = mesh.ny - static_cast<int>(inlet.u.size());
  const auto above_step = [&](const std::vector<double>& values, double below) {
    std::vector<double> all(closed, below);
    all.insert(all.end(), values.begin(), values.end());
    return all;
  };
  b.inlet_u = above_step(inlet.u, 0.0);
  b.inlet_k = above_step(inlet.k, flow::k_floor);
  b.inlet_epsilon = above_step(inlet.epsilon, flow::epsilon_floor);
  flow::Solver flow(p, mesh, b);
  flow.start();

  StepRun run;
  int face = 0;  // first column behind the step
  while (mesh.centre_x(face) < setup.upstream) ++face;
  for (int i = face; i < mesh.nx; ++i) run.x.push_back(mesh.centre_x(i) - setup.upstream);
  double before = -1, check = look_every;
  while (true) {
    flow.advance(flow.step_limit());
    if (flow.state.time < check) continue;
    check += look_every;
    run.cf = friction(flow);
    run.cf.erase(run.cf.begin(), run.cf.begin() + face);
    run.reattachment = reattachment(run.x, run.cf);
    if (flow.state.time > 3 * behind && std::abs(run.reattachment - before) < changes_less * run.reattachment) break;
    if (flow.state.time > longest)
      base::fail(base::Exit::diverged, "step, {} cells: the reattachment still moves from {:.3f} to {:.3f} H",
                 setup.cells, before, run.reattachment);
    before = run.reattachment;
  }
  for (int i = face; i < mesh.nx; ++i) run.cp.push_back(2 * flow.state.p(i, 0));
  const double end = run.cp.back();
  for (double& cp : run.cp) cp -= end;
  for (int j = 0; j < mesh.ny; ++j) {
    run.y.push_back(mesh.centre_y(j));
    for (std::size_t k = 0; k < step_sections.size(); ++k) {
      const double x = step_sections[k] + setup.upstream;
      const auto i = static_cast<int>(std::upper_bound(mesh.x.begin(), mesh.x.end(), x) - mesh.x.begin()) - 1;
      const double f = (x - mesh.x[i]) / mesh.dx(i);
      run.u[k].push_back((1 - f) * flow.state.u(i, j) + f * flow.state.u(i + 1, j));
    }
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

namespace {

struct Model {
  const char* name;
  flow::Closure closure;
  const char* colour;
  double first_row;
  double low, high;
  const char* published;
};
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr const char* published_sst =
    "6.50 (SSTm) and 6.35 (SST-V), NASA Turbulence Modeling Resource; measured 6.26 +- 0.10";

/// Each model on two grids, cells a step height; targets and profiles are those of the finer one.  inlets: what the
/// place of the inlet costs on the coarser one, too.
Result run_models(const std::vector<Model>& models, int coarse, int finest, bool inlets, const std::string& figures,
                  const Tell& tell) {
  const io::Table cf = io::parse_table(step_friction, "data/bfs_driver_seegmiller_cf.csv"),
                  cp = io::parse_table(step_pressure, "data/bfs_driver_seegmiller_cp.csv");
  Result result;
  report::Chart chart_cf{{"x/H", -1, 25}, {"1000 Cf on the floor"}, {}},
      chart_cp{{"x/H", -1, 25}, {"Cp on the floor"}, {}};
  std::vector<Panel> profiles;
  std::vector<double> cf_1000;
  for (double c : cf.column("cf")) cf_1000.push_back(1000 * c);
  chart_cf.curves.push_back({"Driver and Seegmiller (1985)", "#000000", cf.column("x_over_H"), cf_1000, true});
  chart_cp.curves.push_back(
      {"Driver and Seegmiller (1985)", "#000000", cp.column("x_over_H"), cp.column("cp_shifted"), true});
  for (double x : step_sections) {
    const Measured data = measured_profile(x);
    profiles.push_back({fmt::format("x/H = {}", x), {{"U/Uref", -0.3, 1.1}, {"y/H", 0, 3}, {}, 300, 320}});
    profiles.back().chart.curves.push_back({"Driver and Seegmiller (1985)", "#000000", data.u, data.y, true});
  }
  for (const Model& model : models) {
    const auto add = [&](const std::string& what, double value, const std::string& unit, const std::string& reference,
                         const std::string& setup, double seconds) -> Row& {
      Row row{fmt::format("{}: {}", model.name, what), value, unit};
      row.reference = reference, row.setup = setup, row.seconds = seconds;
      tell(fmt::format("{}: {:.5g}", row.name, value));
      result.rows.push_back(row);
      return result.rows.back();
    };
    for (int cells : {coarse, finest}) {
      StepSetup setup{model.closure, cells};
      setup.first_row = model.first_row;
      const StepApproach approach = approach_step(setup);
      const StepRun run = run_step(setup, approach.at_minus_4);
      const auto told = [&](const std::string& what, double value, const std::string& unit,
                            const std::string& reference) -> Row& {
        return add(fmt::format("{}, {} cells a step height", what, cells), value, unit, reference, setup.text(),
                   run.seconds);
      };
      Row& place = told("reattachment", run.reattachment, "H", model.published);
      if (cells == finest) place.low = model.low, place.high = model.high;
      if (cells != finest && !inlets) continue;
      if (cells != finest) {
        // What the place of the inlet costs.
        const StepSetup in_face{model.closure, cells, 0}, frictionless{model.closure, cells, 2, false};
        const StepRun face = run_step(in_face, approach.at_step), slip = run_step(frictionless, approach.at_step);
        add(fmt::format("reattachment with the inlet in the step's face, {} cells a step height", cells),
            face.reattachment, "H", "", in_face.text(), face.seconds);
        add(fmt::format("reattachment with 2 H of frictionless top, {} cells a step height", cells), slip.reattachment,
            "H", "", frictionless.text(), slip.seconds);
        continue;
      }
      told("Cf 4 H before the step", approach.friction, "-", "measured 0.00288 +- 0.0002");
      const Measured before = measured_profile(-4);
      std::vector<double> above_step;
      for (double y : approach.y) above_step.push_back(1 + y);
      told("rms difference of U at x/H = -4",
           base::compare(above_step, approach.at_minus_4.u, before.y, before.u, 0)->rms, "Uref",
           "Driver and Seegmiller (1985)");
      told("length of channel that makes the measured boundary layer", approach.from_inlet, "H", "");
      told("smallest Cf behind the step", *std::min_element(run.cf.begin(), run.cf.end()), "-",
           "measured -0.00102 +- 0.00016");
      for (std::size_t k = 0; k < step_sections.size(); ++k) {
        const Measured data = measured_profile(step_sections[k]);
        told(fmt::format("rms difference of U at x/H = {}", step_sections[k]),
             base::compare(run.y, run.u[k], data.y, data.u, 0)->rms, "Uref", "Driver and Seegmiller (1985)");
        profiles[k].chart.curves.push_back({model.name, model.colour, run.u[k], run.y});
      }
      told("rms difference of Cp on the floor",
           base::compare(run.x, run.cp, cp.column("x_over_H"), cp.column("cp_shifted"), 0)->rms, "-",
           "Driver and Seegmiller (1985)");
      std::vector<double> ours;
      for (double c : run.cf) ours.push_back(1000 * c);
      chart_cf.curves.push_back({model.name, model.colour, run.x, ours});
      chart_cp.curves.push_back({model.name, model.colour, run.x, run.cp});
    }
  }
  result.pictures = {{figures + "_cf.svg", picture(chart_cf)},
                     {figures + "_cp.svg", picture(chart_cp)},
                     {figures + "_profiles.svg", panels(profiles, 2)}};
  return result;
}

}  // namespace

Result step(const Tell& tell) {
  const std::vector<Model> models = {
      {"k-epsilon", flow::Closure::k_epsilon, "#1f77b4", 0, 4.9, 5.6,
       "4.9 to 5.6 usual with wall functions (not checked in a source); measured 6.26 +- 0.10"},
      {"k-epsilon, realizable", flow::Closure::k_epsilon_realizable, "#2ca02c", 0, none, none,
       "no published value known; measured 6.26 +- 0.10"},
      {"k-omega SST", flow::Closure::k_omega_sst, "#d62728", 0, 6.35, 6.65, published_sst},
      {"k-omega of 2006", flow::Closure::k_omega, "#9467bd", 0, none, none,
       "no published value known; measured 6.26 +- 0.10"}};
  return run_models(models, 16, 24, true, "step", tell);
}

Result step_walls(const Tell& tell) {
  constexpr double first_row = 0.0015;  // y+ 1 in the middle of the first rows before the step
  return run_models(
      {{"k-omega SST, walls resolved", flow::Closure::k_omega_sst, "#d62728", first_row, 6.35, 6.65, published_sst}},
      12, 16, false, "step_walls", tell);
}

}  // namespace livebed::validate
