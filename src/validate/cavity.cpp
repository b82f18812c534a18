#include "validate/cavity.hpp"

#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "base/fault.hpp"
#include "io/table.hpp"
#include "validate/picture.hpp"
#include "validate/references.hpp"

namespace livebed::validate {

namespace {

constexpr double steady = 2e-5;           ///< largest acceleration that counts as none [lid speed^2 / side]
constexpr double longest = 200;           ///< [side / lid speed]
constexpr double lid_speed_share = 0.01;  ///< target of the worst difference

/// Linear between the two nodes that `at` lies between; node -1 and node n mirror the walls.
template <class Node, class Value>
double interpolate(double at, int n, Node&& node, Value&& value) {
  int k = 0;
  while (k < n && node(k) < at) ++k;
  const double f = (at - node(k - 1)) / (node(k) - node(k - 1));
  return (1 - f) * value(k - 1) + f * value(k);
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

}  // namespace

CavityRun run_cavity(int reynolds, int n) {
  const auto start = std::chrono::steady_clock::now();
  flow::Params p;
  p.density = 1;
  p.viscosity = 1.0 / reynolds;
  p.closure = flow::Closure::laminar;
  p.max_step = 0.05;
  p.mesh.length = p.mesh.height = 1;
  p.mesh.cell_x = p.mesh.cell_y = 1.0 / n;
  p.pipe.present = false;
  flow::Boundary b;
  b.inlet = b.outlet = false;
  b.west = b.east = b.floor = b.top = flow::Wall::no_slip;
  b.top_speed = 1;
  flow::Solver flow(p, flow::make_mesh(p.mesh, p.pipe), b);
  flow.start();
  const flow::Mesh& m = flow.mesh();
  const flow::State& s = flow.state;
  double change = 1;
  while (change > steady) {
    if (s.time > longest)
      base::fail(base::Exit::diverged, "cavity, Re {}: still changes by {:.2g} after t = {}", reynolds, change, s.time);
    const double dt = flow.step_limit();
    flow.advance(dt);
    change = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) change = std::max(change, std::abs(s.u(i, j) - s.u_old(i, j)) / dt);
  }
  CavityRun run;
  const std::string column = fmt::format("Re{}", reynolds);
  const auto compare = [&](const io::Table& table, const std::string& place, const std::string& speed, auto&& found,
                           std::vector<double>& at, std::vector<double>& ours, std::vector<double>& theirs) {
    at = table.column(place), theirs = table.column(speed + column);
    for (std::size_t k = 0; k < at.size(); ++k) {
      ours.push_back(found(at[k]));
      run.worst = std::max(run.worst, std::abs(ours[k] - theirs[k]));
    }
  };
  // The ghost rows make the walls the middle between two nodes.
  compare(
      io::parse_table(ghia_u, "data/ghia1982_cavity_u.csv"), "y", "u_",
      [&](double y) {
        return interpolate(
            y, n, [&](int j) { return m.centre_y(j); }, [&](int j) { return s.u(n / 2, j); });
      },
      run.y, run.u, run.u_ghia);
  compare(
      io::parse_table(ghia_v, "data/ghia1982_cavity_v.csv"), "x", "v_",
      [&](double x) {
        return interpolate(
            x, n, [&](int i) { return m.centre_x(i); }, [&](int i) { return s.v(i, n / 2); });
      },
      run.x, run.v, run.v_ghia);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

Result cavity(const Tell& tell) {
  Result result;
  report::Chart along_y{{"u / lid speed"}, {"y"}, {}, 420, 420}, along_x{{"x"}, {"v / lid speed"}, {}, 560, 320};
  const std::vector<std::string> colours = {"#1f77b4", "#d62728"};
  int k = 0;
  for (int reynolds : {100, 1000}) {
    CavityRun coarse;
    for (int n : {64, 128}) {
      const CavityRun run = run_cavity(reynolds, n);
      Row row{fmt::format("Re {}, {} x {}: largest difference on the centre lines", reynolds, n, n), run.worst,
              "lid speed"};
      if (n == 128) row.low = 0, row.high = lid_speed_share;
      row.reference = "Ghia, Ghia and Shin (1982), Tables I and II";
      row.setup = fmt::format(
          "square cavity, Re {}, {} x {} equal cells, laminar, bounded convection, Courant 0.8, steady to {}", reynolds,
          n, n, steady);
      row.seconds = run.seconds;
      tell(fmt::format("{}: {:.4f} ({:.0f} s)", row.name, row.value, row.seconds));
      result.rows.push_back(row);
      if (n != 128) {
        coarse = run;
        continue;
      }
      Row change{fmt::format("Re {}: largest change at those points from 64 x 64 to 128 x 128 cells", reynolds),
                 std::max(largest_difference(run.u, coarse.u), largest_difference(run.v, coarse.v)), "lid speed"};
      change.setup = row.setup;
      result.rows.push_back(change);
      along_y.curves.push_back({fmt::format("Re {}", reynolds), colours[k], run.u, run.y});
      along_y.curves.push_back({"Ghia et al.", colours[k], run.u_ghia, run.y, true});
      along_x.curves.push_back({fmt::format("Re {}", reynolds), colours[k], run.x, run.v});
      along_x.curves.push_back({"Ghia et al.", colours[k], run.x, run.v_ghia, true});
      ++k;
    }
  }
  result.pictures = {{"cavity_u.svg", picture(along_y)}, {"cavity_v.svg", picture(along_x)}};
  return result;
}

}  // namespace livebed::validate
