#include "validate/cylinder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "flow/momentum_balance.hpp"
#include "io/table.hpp"
#include "validate/picture.hpp"
#include "validate/references.hpp"

namespace livebed::validate {

namespace {

constexpr double sheds_above = 46;  ///< Reynolds number of the first instability
constexpr double box_half = 1.5;    ///< [D]

flow::Params params(const CylinderSetup& c) {
  flow::Params p;
  p.density = 1;
  p.viscosity = 1 / c.reynolds;
  p.closure = flow::Closure::laminar;
  p.floor = flow::Wall::slip;
  p.max_step = 1;
  p.mesh.length = 2 * c.half + 10;
  p.mesh.height = 2 * c.half;
  p.mesh.cell_x = p.mesh.cell_y = 1.0 / c.cells;
  p.mesh.growth = c.growth;
  p.mesh.fine_x_from = c.half - 0.8;
  p.mesh.fine_x_to = c.half + (c.reynolds > sheds_above ? 2.5 : 1.5);
  p.mesh.fine_y_from = c.half - 0.8;
  p.mesh.fine_y_to = c.half + 0.8;
  p.pipe.present = true;
  p.pipe.diameter = 1;
  p.pipe.x = c.half + c.shift / c.cells;
  p.pipe.y = c.half + 0.7 * c.shift / c.cells;
  p.pipe.wall = flow::Wall::no_slip;
  p.current.profile = flow::Profile::uniform;
  p.current.mean_speed = 1;
  return p;
}

/// Distance from the rear point to where the flow on the axis turns forward [D]; 0 when it never goes back.
double bubble_length(const flow::Solver& flow) {
  const flow::Mesh& m = flow.mesh();
  const double axis = m.pipe.y, rear = m.pipe.x + 0.5 * m.pipe.diameter;
  int j = 0;
  while (m.centre_y(j) < axis) ++j;
  const double f = (axis - m.centre_y(j - 1)) / m.dy_face(j);
  const auto u = [&](int i) { return (1 - f) * flow.state.u(i, j - 1) + f * flow.state.u(i, j); };
  for (int i = 0; i < m.nx; ++i)
    if (m.x[i] > rear && u(i) < 0 && u(i + 1) >= 0) return m.x[i] - u(i) / (u(i + 1) - u(i)) * m.dx(i) - rear;
  return 0;
}

/// Sets or clears a push across the stream behind the cylinder.
void push(flow::Solver& flow, double force) {
  const flow::Mesh& m = flow.mesh();
  flow.state.load.top = m.ny;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i)
      if (std::hypot(m.centre_x(i) - m.pipe.x - 1, m.y[j] - m.pipe.y) < 0.5) flow.state.load.force_v(i, j) = force;
}

/// Times at which the lift goes up through 0, from time `from` on.
std::vector<double> upward_crossings(const CylinderRun& run, double from) {
  std::vector<double> times;
  for (std::size_t k = 1; k < run.t.size(); ++k)
    if (run.t[k - 1] > from && run.lift[k - 1] < 0 && run.lift[k] >= 0)
      times.push_back(run.t[k] - run.lift[k] / (run.lift[k] - run.lift[k - 1]) * (run.t[k] - run.t[k - 1]));
  return times;
}

/// Row of data/cylinder_laminar.csv.  The file has words, so it is searched by line.
void set_target(Row& row, const std::string& begins) {
  const std::size_t at = cylinder_laminar.find("\n" + begins + ",");
  if (at == std::string_view::npos) base::fail(base::Exit::internal, "no row {} in data/cylinder_laminar.csv", begins);
  const std::string rest(cylinder_laminar.substr(at + 2 + begins.size(), 40));
  std::size_t used = 0;
  row.low = std::stod(rest, &used);
  row.high = std::stod(rest.substr(used + 1));
  row.reference = "data/cylinder_laminar.csv: " + begins;
}

}  // namespace

std::string CylinderSetup::text() const {
  return fmt::format(
      "free cylinder, Re {}, {} cells a diameter, grid growing by {} outside, inlet and sides {} D away, outlet {} D, "
      "centre "
      "{} cells off the grid, laminar, bounded convection, Courant 0.8, t = {} D/U",
      reynolds, cells, growth, half, half + 10, shift, end);
}

CylinderRun run_cylinder(const CylinderSetup& setup) {
  const auto start = std::chrono::steady_clock::now();
  const flow::Params p = params(setup);
  const flow::Mesh mesh = flow::make_mesh(p.mesh, p.pipe);
  flow::Solver flow(p, mesh, flow::make_boundary(mesh, p));
  flow.start();
  const flow::Box box = flow::box_around_pipe(mesh, box_half);
  const bool sheds = setup.reynolds > sheds_above;
  CylinderRun run;
  run.nx = mesh.nx, run.ny = mesh.ny;
  std::vector<double> in_box, through_box;
  if (sheds) push(flow, 0.3);
  while (flow.state.time < setup.end) {
    const flow::StepReport step = flow.advance(flow.step_limit());
    if (sheds && flow.state.time > 3 && run.t.back() <= 3) push(flow, 0.0);
    run.t.push_back(flow.state.time);
    run.drag.push_back(2 * step.pipe_force.x);
    run.lift.push_back(2 * step.pipe_force.y);
    through_box.push_back(2 * flow::momentum_inflow(p, mesh, flow.state, box).x);
    in_box.push_back(2 * flow::momentum_inside(p, mesh, flow.state, box).x);
  }
  const std::size_t last = run.t.size() - 1;
  run.bubble = bubble_length(flow);
  run.cd = run.drag[last];
  run.cd_box = through_box[last] - (in_box[last] - in_box[last - 1]) / (run.t[last] - run.t[last - 1]);
  const std::vector<double> crossings = upward_crossings(run, 0.5 * setup.end);
  if (sheds && crossings.size() > 2) {
    const double from = crossings.front(), to = crossings.back();
    run.strouhal = static_cast<double>(crossings.size() - 1) / (to - from);
    double time = 0, drag = 0, lift = 0, lift_2 = 0, through = 0;
    std::size_t first = 0, k = 1;
    for (; k < run.t.size(); ++k) {
      if (run.t[k] <= from) first = k;
      if (run.t[k] <= from || run.t[k] > to) continue;
      const double dt = run.t[k] - run.t[k - 1];
      time += dt, drag += dt * run.drag[k], lift += dt * run.lift[k], lift_2 += dt * base::square(run.lift[k]);
      through += dt * through_box[k];
    }
    std::size_t end = first;
    while (end + 1 < run.t.size() && run.t[end + 1] <= to) ++end;
    run.cd = drag / time;
    run.cl_rms = std::sqrt(lift_2 / time - base::square(lift / time));
    run.cd_box = (through - (in_box[end] - in_box[first])) / time;
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

Result cylinder(const Tell& tell) {
  Result result;
  report::Chart history{{"t U / D"}, {"lift coefficient, Re 100"}, {}};
  struct Plan {
    CylinderSetup setup;
    bool judged;
    const char* colour;
  };
  std::vector<Plan> plans;
  for (double re : {20.0, 40.0, 100.0}) {
    const double end = re > sheds_above ? 130 : 70;
    plans.push_back({{re, 20, 30, 1.08, end}, false, "#7f7f7f"});
    if (re > 20) plans.push_back({{re, 40, 15, 1.08, end}, false, "#ff7f0e"});
    plans.push_back({{re, 40, 30, 1.08, end}, true, "#1f77b4"});
  }
  for (const Plan& plan : plans) {
    const CylinderSetup& c = plan.setup;
    const CylinderRun run = run_cylinder(c);
    const std::string where = fmt::format("Re {}, {} cells a diameter, sides {} D away", c.reynolds, c.cells, c.half);
    const auto add = [&](const std::string& what, double value, const std::string& unit, const std::string& target) {
      Row row{where + ": " + what, value, unit};
      row.setup = fmt::format("{}; {} x {} cells", c.text(), run.nx, run.ny), row.seconds = run.seconds;
      if (plan.judged && !target.empty()) set_target(row, target);
      tell(fmt::format("{}: {:.4f}{}", row.name, value, row.pass() ? "" : "  <- outside"));
      result.rows.push_back(row);
    };
    const bool sheds = c.reynolds > sheds_above;
    add(sheds ? "mean drag coefficient" : "drag coefficient", run.cd, "-",
        fmt::format("{},{}", c.reynolds, sheds ? "mean Cd" : "Cd"));
    add("force by the momentum of a box over force on the surface - 1", run.cd_box / run.cd - 1, "-", "");
    if (plan.judged) {
      Row& row = result.rows.back();
      row.low = -0.01, row.high = 0.01, row.reference = "the two are the same force";
    }
    if (!sheds) {
      add("length of the bubble", run.bubble, "D",
          c.reynolds == 20 ? "20,recirculation length L/D from the rear point" : "40,recirculation length L/D");
      continue;
    }
    add("Strouhal number", run.strouhal, "-", "100,St");
    add("rms lift coefficient", run.cl_rms, "-", "100,rms Cl");
    history.curves.push_back({fmt::format("{} cells, {} D", c.cells, c.half), plan.colour, run.t, run.lift});
  }
  result.pictures = {{"cylinder_lift.svg", picture(history)}};
  return result;
}

}  // namespace livebed::validate
