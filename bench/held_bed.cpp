#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "base/sediment.hpp"
#include "case/read.hpp"
#include "flow/constants.hpp"
#include "grains/ends.hpp"
#include "io/file.hpp"
#include "io/table.hpp"
#include "run/checkpoint.hpp"
#include "run/simulation.hpp"

/// The water alone, started anew over the bed that a run has reached, or over a bed of that sand with another shape:
/// does the pipe shed there, with another closure or grid, and how hard does the water pull at the sand?  Prints time
/// [s], drag and lift on the pipe [N/m]; with --along what it does along the bed, in means over the second half of the
/// time.
namespace {

using namespace livebed;

/// Sand that moves faster is taken away [m/s]: it would stand in the water like posts.
constexpr double at_rest = 0.05;
/// A bed of another shape is the lower part of the run's, up to this share of its thickness, and once more on top.
constexpr double lower_part = 0.6;
constexpr double between = 0.6;   ///< room left below the sand on top [d], or its grains would overlap those below
constexpr double look_at = 0.01;  ///< height above the bed where the water is looked at [m]

/// The bed at rest, without the grains at these places of its storage.
grains::Bed without(grains::Bed bed, const std::vector<int>& out) {
  grains::State& s = bed.state;
  std::fill(s.sleep.asleep.begin(), s.sleep.asleep.end(), 0);  // who sleeps cannot leave
  for (grains::Array* motion : {&s.u, &s.v, &s.omega}) std::fill(motion->begin(), motion->end(), 0.0);
  grains::exchange_grains(bed, out, {});
  return bed;
}

/// The bed at rest without what moved.
grains::Bed hold(grains::Bed bed) {
  const grains::State& s = bed.state;
  std::vector<int> out;
  for (int i = 0; i < s.count(); ++i)
    if (std::hypot(s.u[i], s.v[i]) > at_rest) out.push_back(i);
  return without(std::move(bed), out);
}

/// Height of a bed over its first level, both over D; zero outside of what is known.
struct Line {
  std::vector<double> x, y;
  double at(double x_over_D) const {
    if (x.empty() || x_over_D <= x.front() || x_over_D >= x.back()) return 0;
    const std::size_t n = std::upper_bound(x.begin(), x.end(), x_over_D) - x.begin();
    return y[n - 1] + (x_over_D - x[n - 1]) / (x[n] - x[n - 1]) * (y[n] - y[n - 1]);
  }
};

/// Those points of a table with columns t_s, x_D and y_bed_D that are of one time.
Line read_line(const std::string& path, double time) {
  const io::Table table = io::parse_table(io::read_file(path), path);
  std::vector<std::pair<double, double>> points;
  for (std::size_t n = 0; n < table.column("t_s").size(); ++n)
    if (table.column("t_s")[n] == time) points.emplace_back(table.column("x_D")[n], table.column("y_bed_D")[n]);
  if (points.empty()) base::fail(base::Exit::invalid_case, "{} has no line at t_s = {}", path, time);
  std::sort(points.begin(), points.end());
  Line line;
  for (const auto& [x, y] : points) line.x.push_back(x), line.y.push_back(y);
  return line;
}

double height(const Line& line, const casefile::Case& c, double x) {
  const double D = c.flow.pipe.diameter;
  return c.bed_thickness + D * line.at((x - c.flow.pipe.x) / D);
}

/// Sand of the run in a bed with this surface.
grains::Bed shape(grains::Bed bed, const casefile::Case& c, const Line& line) {
  grains::State& s = bed.state;
  const double part = lower_part * c.bed_thickness, up = part + between * c.grains.diameter;
  std::vector<std::pair<double, double>> places;
  std::vector<int> taken;
  for (int i = 0; i < s.count(); ++i) {
    if (s.y[i] >= part)
      taken.push_back(i);
    else if (s.y[i] + up < height(line, c, s.x[i]))
      places.emplace_back(s.x[i], s.y[i] + up);
  }
  if (places.size() > taken.size())
    base::fail(base::Exit::invalid_case, "this bed takes {} grains above {} m, the run has {}; take one with more sand",
               places.size(), part, taken.size());
  for (std::size_t n = 0; n < places.size(); ++n) s.x[taken[n]] = places[n].first, s.y[taken[n]] = places[n].second;
  taken.erase(taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(places.size()));
  return without(std::move(bed), taken);
}

/// Means over time along the bed, look_at above it.
class Along {
public:
  Along(const Line& line, const casefile::Case& c, const flow::Mesh& m)
      : case_(c), mesh_(m), z0_(c.flow.current.roughness / 30) {
    for (std::vector<double>* sum : {&u_, &uu_, &k_, &phi_}) sum->assign(m.nx, 0.0);
    for (int i = 0; i < m.nx; ++i) {
      const double y = height(line, c, m.centre_x(i)) + look_at;
      int j = 0;
      while (j + 2 < m.ny && m.centre_y(j + 1) < y) ++j;
      row_.push_back(j), share_.push_back((y - m.centre_y(j)) / m.dy_face(j + 1));
      bed_.push_back(line.at((m.centre_x(i) - c.flow.pipe.x) / c.flow.pipe.diameter));
    }
  }
  void add(const flow::State& s, double dt) {
    time_ += dt;
    for (int i = 0; i < mesh_.nx; ++i) {
      const auto at = [&](auto&& value) { return (1 - share_[i]) * value(row_[i]) + share_[i] * value(row_[i] + 1); };
      const double u = at([&](int j) { return 0.5 * (s.u(i, j) + s.u(i + 1, j)); });
      u_[i] += dt * u, uu_[i] += dt * u * u, k_[i] += dt * at([&](int j) { return s.k(i, j); });
      phi_[i] += dt * std::copysign(base::meyer_peter_mueller(shields(u)), u);
    }
  }
  void write(const std::string& path) const {
    std::string text = "x_D,y_bed_D,u_m_s,u_rms_m_s,k_m2_s2,theta,Phi\n";
    for (int i = 0; i < mesh_.nx; ++i) {
      const double u = u_[i] / time_, rms = std::sqrt(std::max(0.0, uu_[i] / time_ - u * u));
      text += fmt::format("{:.4f},{:.4f},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}\n",
                          (mesh_.centre_x(i) - case_.flow.pipe.x) / case_.flow.pipe.diameter, bed_[i], u, rms,
                          k_[i] / time_, std::copysign(shields(u), u), phi_[i] / time_);
    }
    io::write_atomically(path, text);
  }

private:
  /// By the log law of a rough bed.
  double shields(double u) const {
    const double u_star = u * flow::kappa / std::log(look_at / z0_);
    return u_star * u_star /
           ((case_.grains.density / case_.flow.density - 1) * case_.grains.gravity * case_.grains.diameter);
  }
  const casefile::Case& case_;
  const flow::Mesh& mesh_;
  double z0_, time_ = 0;
  std::vector<int> row_;
  std::vector<double> share_, bed_, u_, uu_, k_, phi_;
};

/// Lets the sand go and tells every 0.1 s where it is: its area in strips of 0.1 D.
void let_go(run::Simulation& sim, const casefile::Case& c, double seconds, const std::string& path) {
  const double D = c.flow.pipe.diameter, strip = 0.1 * D;
  const int strips = static_cast<int>(c.flow.mesh.length / strip);
  std::string text = "time_s";
  for (int n = 0; n < strips; ++n) text += fmt::format(",{:.4g}", ((n + 0.5) * strip - c.flow.pipe.x) / D);
  text += '\n';
  sim.release();
  const double start = sim.flow().state.time;
  for (double next = 0, time = 0;; time = sim.flow().state.time - start) {
    if (time >= next) {
      std::vector<double> area(strips, 0.0);
      const grains::State& g = sim.bed().state;
      for (int i = 0; i < g.count(); ++i)
        area[std::clamp(static_cast<int>(g.x[i] / strip), 0, strips - 1)] +=
            base::sphere_volume(g.diameter[i]) / c.grains.diameter;
      text += fmt::format("{:.4f}", time);
      for (double a : area) text += fmt::format(",{:.6g}", a);
      text += '\n';
      next += 0.1;
      io::write_atomically(path, text);
    }
    if (time >= seconds) return;
    sim.step();
  }
}

struct Wish {
  std::string run, line, along, sand;
  double line_time = 11, seconds = 2, free = 1, every = 0.005;
  std::vector<std::string> overrides;
};

void go(const Wish& wish) {
  const auto saved = run::list_checkpoints(wish.run);
  if (saved.empty()) base::fail(base::Exit::input_output, "{} has no checkpoint; give the folder of a run", wish.run);
  const run::Restored restored = run::load_checkpoint(saved.back());
  const casefile::Case c = casefile::read_case(wish.run + "/case.resolved.toml", wish.overrides);
  const Line line = wish.line.empty() ? Line{} : read_line(wish.line, wish.line_time);
  const grains::Bed& bed = restored.sim.bed();
  run::Simulation sim(c, wish.line.empty() ? hold(bed) : shape(bed, c, line));
  Along along(line, c, sim.flow().mesh());
  const double start = sim.flow().state.time;
  std::puts("time_s,drag_N_m,lift_N_m");
  for (double next = 0, before = 0; before < wish.seconds;) {
    sim.spin_up_step();
    const double time = sim.flow().state.time - start;
    if (time > 0.5 * wish.seconds) along.add(sim.flow().state, time - before);
    before = time;
    if (time < next) continue;
    const base::Vec2 force = sim.last_report().pipe_force;
    std::printf("%.5f,%.6g,%.6g\n", time, force.x, force.y);
    next += wish.every;
  }
  if (!wish.along.empty()) along.write(wish.along);
  if (!wish.sand.empty()) let_go(sim, c, wish.free, wish.sand);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("the water alone over a bed that is held");
  Wish wish;
  app.add_option("RUN", wish.run, "folder of a run")->required();
  auto* line = app.add_option("--line", wish.line, "its sand in a bed of this shape: a table with t_s, x_D, y_bed_D");
  app.add_option("--line-time", wish.line_time, "whose line of the table [s]")->capture_default_str()->needs(line);
  app.add_option("--along", wish.along, "file for what the water does 1 cm above that shape, as CSV")->needs(line);
  auto* sand = app.add_option("--sand", wish.sand, "then let the sand go: file for where it is, as CSV")->needs(line);
  app.add_option("--free", wish.free, "how long it is free [s]")->capture_default_str()->needs(sand);
  app.add_option("--seconds", wish.seconds, "how long")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--every", wish.every, "[s] between two lines")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--set", wish.overrides,
                 "override a key of the run's case: --set flow.closure=k_omega_sst (repeatable)");
  CLI11_PARSE(app, argc, argv);
  try {
    go(wish);
  } catch (const base::Fault& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return static_cast<int>(fault.code());
  }
}
