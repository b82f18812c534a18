#include "validate/design_chart.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "base/approach.hpp"
#include "base/fault.hpp"
#include "base/sediment.hpp"
#include "case/check.hpp"
#include "case/expected.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"
#include "io/table.hpp"
#include "run/execute.hpp"
#include "validate/picture.hpp"
#include "validate/references.hpp"
#include "validate/run_table.hpp"
#include "validate/scour_runs.hpp"

namespace livebed::validate {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double scatter = 0.2;           ///< of experiments in S/D, one standard deviation (Sumer and Fredsoe 2002)
constexpr double length_over_T = 6;       ///< of a run; a current that comes up late is followed as much longer
constexpr double opened = 0.2;            ///< S/D from which on there is a tunnel whose growth has a time scale
constexpr double rise_over_T = 4 / 11.5;  ///< of the current, as in cases/mao; never faster than the bed bears
constexpr unsigned seeds = 2;
constexpr const char* exponent_row = "exponent";
const std::vector<double> gaps = {0, 0.1, 0.3, 0.5, 1.0};          ///< e/D, at theta_of_gaps
const std::vector<double> currents = {0.1, 0.2, 0.33, 0.45, 0.6};  ///< theta, at e/D = 0
constexpr double theta_of_gaps = 0.33;
const std::vector<std::string> colours = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e"};

/// What a chart takes from a run.
struct Point {
  unsigned number = 0, seed = 0;  ///< of the run
  double gap = 0, theta = 0;
  double end = 0;         ///< of it over T
  double T = 0;           ///< by the formula [s]
  double S = 0;           ///< S/D, mean of the last 2 T
  double change = 0;      ///< of it from the first to the second of them
  double fitted_T = nan;  ///< of S - S_eq ~ exp(-t/T) since the current is full [s]
};

/// cases/mao with grains of 2 mm; all pipes among fine cells.  Times follow T and the passage of the water.
casefile::Case case_of(double gap, double theta, unsigned seed) {
  std::vector<std::string> keys = {"grains.diameter=2 mm",
                                   "mesh.cell_y=1.2 mm",
                                   "mesh.fine_y_to=0.212",
                                   "bed.pieces=1",
                                   "time.grain_step=4e-5",
                                   fmt::format("pipe.gap_ratio={}", gap),
                                   fmt::format("current.theta={}", theta),
                                   fmt::format("bed.seed={}", seed)};
  const casefile::Case at = casefile::read_text(mao_case, "design-chart", keys);
  const double T = at.time_scale, passage = at.flow.mesh.length / at.flow.current.mean_speed;
  const double rise = std::max(rise_over_T * T, casefile::least_rise(at));
  keys.push_back(fmt::format("time.end={:.4g}", length_over_T * T + rise - rise_over_T * T));
  keys.push_back(fmt::format("current.rise={:.4g}", rise));
  keys.push_back(fmt::format("time.spin_up={:.4g}", 4 * passage));
  keys.push_back(fmt::format("output.series_every={:.4g}", 0.01 * T));
  keys.push_back(fmt::format("output.bed_every={:.4g}", 0.05 * T));
  keys.push_back(fmt::format("output.fields_every={:.4g}", T));
  return casefile::read_text(mao_case, "design-chart", keys);
}

Point point_of(const Scour& run, unsigned number, double gap, double theta) {
  Point p{number, run.seed, gap, theta};
  p.T = run.resolved.time_scale;
  const double end = run.t.back();
  p.end = end / p.T;
  p.S = mean_depth(run, end - 2 * p.T, end);
  p.change = mean_depth(run, end - p.T, end) - mean_depth(run, end - 2 * p.T, end - p.T);
  if (p.S < opened) return p;
  const double full = run.resolved.flow.current.rise, S = mean_depth(run, full - 0.05 * p.T, full + 0.05 * p.T);
  std::vector<double> since, deeper;
  for (std::size_t n = 0; n < run.t.size(); ++n)
    if (run.t[n] >= full) since.push_back(run.t[n] - full), deeper.push_back(run.depth[n] - S);
  if (const auto fit = base::fit_approach(since, deeper)) p.fitted_T = fit->T;
  return p;
}

/// Exponent of T* over theta by least squares of the logarithms; NaN with fewer than three currents.
double exponent_of_time(const std::vector<Point>& points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& p : points) {
    if (p.gap != 0 || !(p.fitted_T > 0)) continue;
    const double X = std::log(p.theta), Y = std::log(p.fitted_T);
    n += 1, x += X, y += Y, xx += X * X, xy += X * Y;
  }
  const double spread = n * xx - x * x;
  return n > 2 && spread > 0 ? (n * xy - x * y) / spread : nan;
}

/// Points and courses of all runs, as they are in the files.
struct Tables {
  RunTable points{
      "live-bed scour under a pipe of 5 cm, grains of 2 mm; S/D: mean of the last 2 T; T by the formula of "
      "Fredsoe, Sumer and Arnskov (1992); T_fit: of S - S_eq ~ exp(-t/T) since the current is full",
      "run,e_over_D,theta,seed,end_over_T,S_over_D,change_over_D,T_s,T_fit_s"};
  RunTable courses{"S/D in time, means of a twentieth of T", "run,e_over_D,theta,seed,t_over_T,S_over_D"};

  void add(const Point& p, const Scour& run) {
    points.add(p.number, run_told(run),
               fmt::format("{},{},{},{},{:.3g},{:.4f},{:.4f},{:.4g},{:.4g}\n", p.number, p.gap, p.theta, p.seed, p.end,
                           p.S, p.change, p.T, p.fitted_T));
    std::string course;
    for (double t = 0; t <= run.t.back(); t += 0.05 * p.T)
      course += fmt::format("{},{},{},{},{:.2f},{:.4f}\n", p.number, p.gap, p.theta, p.seed, t / p.T,
                            mean_depth(run, t - 0.025 * p.T, t + 0.025 * p.T));
    courses.add(p.number, run_told(run), std::move(course));
  }
};

std::vector<Point> points_of(const io::Table& t) {
  std::vector<Point> points;
  for (std::size_t n = 0; n < t.rows(); ++n) {
    const auto at = [&](const char* column) { return t.column(column)[n]; };
    points.push_back({static_cast<unsigned>(at("run")), static_cast<unsigned>(at("seed")), at("e_over_D"), at("theta"),
                      at("end_over_T"), at("T_s"), at("S_over_D"), at("change_over_D"), at("T_fit_s")});
  }
  return points;
}

/// Steps from `from` to `to`.
std::vector<double> line(double from, double to, int steps = 60) {
  std::vector<double> x;
  for (int n = 0; n <= steps; ++n) x.push_back(from + (to - from) * n / steps);
  return x;
}

/// A formula with the scatter of experiments, and the runs as points.
report::Chart depth_chart(report::Axis x, const std::vector<double>& at, const std::vector<double>& formula) {
  report::Chart chart{std::move(x), {"S/D at the end", 0, 1.2}, {}};
  report::Band band{"one standard deviation of experiments", "#dddddd", at, {}, {}};
  for (double S : formula) band.low.push_back(S - scatter), band.high.push_back(S + scatter);
  chart.bands.push_back(band);
  chart.curves.push_back({"formula", "#000000", at, formula});
  return chart;
}

void add_points(report::Chart& chart, const std::vector<Point>& points, const std::vector<double>& x,
                const std::vector<double>& y) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    report::Curve dots{fmt::format("Livebed, seed {}", seed), colours[seed - 1], {}, {}, true};
    for (std::size_t n = 0; n < points.size(); ++n)
      if (points[n].seed == seed) dots.x.push_back(x[n]), dots.y.push_back(y[n]);
    chart.curves.push_back(std::move(dots));
  }
}

std::string figure_of(const std::vector<Point>& all, const io::Table& courses) {
  std::vector<Point> by_gap, by_current;
  for (const Point& p : all) {
    if (p.theta == theta_of_gaps) by_gap.push_back(p);
    if (p.gap == 0) by_current.push_back(p);
  }
  const auto values = [](const std::vector<Point>& of, double Point::*what) {
    std::vector<double> y;
    for (const Point& p : of) y.push_back(p.*what);
    return y;
  };
  std::vector<double> e = line(0, 1.2), S_of_e, theta = line(0.08, 0.7), law, S_of_theta;
  for (double g : e) S_of_e.push_back(base::equilibrium_depth(std::max(g, 1e-9))->over_D);
  for (double t : theta) {
    S_of_theta.push_back(base::equilibrium_depth(0)->over_D);
    law.push_back(std::pow(t, -5.0 / 3) / 50);
  }
  report::Chart gap_chart = depth_chart({"e/D", 0, 1.2}, e, S_of_e);
  add_points(gap_chart, by_gap, values(by_gap, &Point::gap), values(by_gap, &Point::S));
  report::Chart current_chart = depth_chart({"theta", 0, 0.7}, theta, S_of_theta);
  add_points(current_chart, by_current, values(by_current, &Point::theta), values(by_current, &Point::S));

  report::Chart time_chart{{"theta", 0, 0.7}, {"T*", nan, nan, true}, {}};
  time_chart.curves.push_back({"theta^(-5/3)/50", "#000000", theta, law});
  std::vector<double> T_star;
  for (const Point& p : by_current) T_star.push_back(p.fitted_T / p.T * std::pow(p.theta, -5.0 / 3) / 50);
  add_points(time_chart, by_current, values(by_current, &Point::theta), T_star);

  constexpr double longest = length_over_T + 2;
  report::Chart course{{"t/T", 0, longest}, {"S/D", 0, 1.2}, {}};
  course.curves.push_back({"0.6 (1 - exp(-t/T))", "#000000", line(0, longest), {}});
  for (double t : course.curves.front().x) course.curves.front().y.push_back(0.6 * (1 - std::exp(-t)));
  for (const Point& p : by_current) {
    if (p.seed != 1) continue;
    const auto n = std::find(currents.begin(), currents.end(), p.theta) - currents.begin();
    report::Curve curve{fmt::format("theta {}", p.theta), colours[n], {}, {}};
    for (std::size_t k = 0; k < courses.rows(); ++k)
      if (courses.column("run")[k] == p.number) {
        curve.x.push_back(courses.column("t_over_T")[k]);
        curve.y.push_back(courses.column("S_over_D")[k]);
      }
    course.curves.push_back(std::move(curve));
  }
  return panels({{"depth over gap, theta 0.33", gap_chart},
                 {"depth over current, e/D 0", current_chart},
                 {"time scale over current, e/D 0", time_chart},
                 {"course of the depth, e/D 0, seed 1", course}},
                2);
}

}  // namespace

Result design_chart(const Only& only, const Tell& tell) {
  struct Wanted {
    unsigned seed;
    double gap, theta;
    std::string label() const { return fmt::format("e/D {}, theta {}, seed {}", gap, theta, seed); }
  };
  std::vector<Wanted> runs;  // numbered from 1 on
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    for (double gap : gaps) runs.push_back({seed, gap, theta_of_gaps});
    for (double theta : currents)
      if (theta != theta_of_gaps) runs.push_back({seed, 0, theta});
  }
  for (unsigned number : only.runs)
    if (number < 1 || number > runs.size())
      base::fail(base::Exit::command_line, "design-chart has no run {}; its runs are 1 to {}", number, runs.size());
  run::obey_signals();
  Result result;
  Tables tables;
  if (!only.runs.empty()) {
    std::vector<std::string> labels = {exponent_row};
    for (unsigned number : only.runs) labels.push_back(runs[number - 1].label());
    keep_rows(only.folder / "design-chart.json", labels, result);
  }
  bool any = false;
  for (unsigned number = 1; number <= runs.size(); ++number) {
    if (!only.makes(number)) continue;
    const auto& [seed, gap, theta] = runs[number - 1];
    const std::string folder = fmt::format("{}/e{}-theta{}-seed{}", kept_chart, gap, theta, seed);
    const auto run = scour(case_of(gap, theta, seed), folder, tell);
    if (!run) {
      if (run::stop_signal() == 0) result.rows.push_back(missing(runs[number - 1].label()));
      continue;
    }
    any = true;
    const Point p = point_of(*run, number, gap, theta);
    tables.add(p, *run);
    const auto add = [&](const std::string& what, double value, const std::string& unit, double low, double high,
                         const std::string& reference) {
      Row row{fmt::format("{}: {}", runs[number - 1].label(), what), value, unit};
      row.low = low, row.high = high, row.reference = reference;
      row.setup = fmt::format("case {}, {:.2f} T", casefile::hash(run->resolved), p.end);
      row.seconds = run->wall, row.commit = run->commit;
      tell(fmt::format("{}: {:.4g} {}", row.name, value, unit));
      result.rows.push_back(row);
    };
    const base::EquilibriumDepth wanted = *base::equilibrium_depth(gap);
    // Judged only where the run has come to its end; the scatter is that of experiments where the pipe touches.
    const bool ended = run->t.back() > 0.99 * run->resolved.time.end;
    add("S/D over the last 2 T", p.S, "-", ended ? wanted.over_D - scatter : nan, ended ? wanted.over_D + scatter : nan,
        fmt::format("{} ({})", wanted.formula, wanted.source));
    add("change within them", p.change, "-", nan, nan, "");
    add("fitted T over the formula's", p.fitted_T / p.T, "-", nan, nan, "Fredsoe, Sumer and Arnskov (1992)");
  }
  if (!any) base::fail(base::Exit::signal, "stopped before the grains of any run were let go");
  if (!only.runs.empty()) {
    tables.points.keep(only.folder / "design-chart.csv");
    tables.courses.keep(only.folder / "design-chart-course.csv");
  }
  const std::string table = tables.points.text(), course = tables.courses.text();
  const std::vector<Point> points = points_of(io::parse_table(table, "design-chart.csv"));
  Row exponent{fmt::format("{}: T* over theta, e/D 0", exponent_row), exponent_of_time(points), "-"};
  exponent.reference = "-5/3: Fredsoe, Sumer and Arnskov (1992)";
  tell(fmt::format("{}: {:.3g}", exponent.name, exponent.value));
  result.rows.push_back(exponent);
  result.pictures = {{"design-chart.svg", figure_of(points, io::parse_table(course, "design-chart-course.csv"))},
                     {"design-chart.csv", table},
                     {"design-chart-course.csv", course}};
  return result;
}

}  // namespace livebed::validate
