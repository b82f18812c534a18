#include "validate/mao_runs.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/curves.hpp"
#include "base/fault.hpp"
#include "base/math.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"
#include "io/table.hpp"
#include "report/references.hpp"
#include "run/execute.hpp"
#include "validate/picture.hpp"
#include "validate/references.hpp"
#include "validate/run_table.hpp"
#include "validate/scour_runs.hpp"

namespace livebed::validate {

namespace {

constexpr double plateau_of_mao = 0.91;
constexpr double end_of_mao = 37;  // of his record [s]
const std::vector<std::string> colours = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b",
                                          "#e377c2", "#7f7f7f", "#bcbd22", "#17becf", "#000080", "#ff00ff"};

/// A run that has been made.
struct Made {
  const MaoRun& run;
  Scour scour;
};

/// Time-weighted rms of the difference to a reference over [from, to] in its own times; NaN where the run is shorter.
double depth_rms(const Scour& s, double unit, const std::vector<double>& t, const std::vector<double>& depth,
                 double from, double to) {
  if (s.t.back() / unit < to) return std::nan("");
  constexpr int samples = 1000;
  double sum = 0;
  for (int n = 0; n < samples; ++n) {
    const double at = from + (n + 0.5) * (to - from) / samples;
    sum += base::square(base::interpolate(s.t, s.depth, at * unit) - base::interpolate(t, depth, at)) / samples;
  }
  return std::sqrt(sum);
}

/// Points of a reference table at a time.
struct Profile {
  std::vector<double> x, y;
};
Profile profile_of_mao(double t) {
  const io::Table table = io::parse_table(report::mao_profiles, "mao1986_livebed_profiles.csv");
  const std::vector<double>&at = table.column("t_s"), &x = table.column("x_D"), &y = table.column("y_bed_D");
  Profile p;
  for (std::size_t n = 0; n < at.size(); ++n)
    if (at[n] == t) p.x.push_back(x[n]), p.y.push_back(y[n]);
  return p;
}

/// S/D in time and the bed lines of all runs, as they are in the files.
struct Tables {
  RunTable depths, lines;
};

/// every: seconds of the run from one bed line to the next.
void add_to_tables(const Made& made, double every, Tables& tables) {
  const Scour& s = made.scour;
  const unsigned number = made.run.number;
  std::string depths, lines;
  for (std::size_t n = 0; n < s.t.size(); ++n) depths += fmt::format("{},{:.4f},{:.5f}\n", number, s.t[n], s.depth[n]);
  for (int k = 0; k * every <= s.t_lines.back() + 1e-6; ++k) {
    const std::vector<double>& line = line_at(s, k * every);
    // Lines are sampled at half a grain; every fifth tells as much.
    for (std::size_t n = 0; n < s.x.size(); n += 5)
      lines += fmt::format("{},{:.5g},{:.4f},{:.4f}\n", number, k * every, s.x[n], line[n]);
  }
  const std::string told = made.run.says.empty() ? run_told(s) : fmt::format("{}; {}", made.run.says, run_told(s));
  tables.depths.add(number, told, std::move(depths));
  tables.lines.add(number, told, std::move(lines));
}

/// One run's part of two columns; where a third is at a value, if one is given.
struct Points {
  std::vector<double> x, y;
};
Points points_of(const io::Table& t, unsigned run, const char* x, const char* y, const char* where = nullptr,
                 double value = 0) {
  const std::vector<double>&runs = t.columns.front(), &xs = t.column(x), &ys = t.column(y);
  Points p;
  for (std::size_t n = 0; n < runs.size(); ++n)
    if (runs[n] == run && (where == nullptr || std::abs(t.column(where)[n] / value - 1) < 1e-3))
      p.x.push_back(xs[n]), p.y.push_back(ys[n]);
  return p;
}

std::vector<Picture> draw(const Experiment& e, const Tables& tables, double unit) {
  const io::Table measured = io::parse_table(report::mao_depth, "mao1986_livebed_depth.csv");
  const io::Table two_phase = io::parse_table(sedfoam_depth, "sedfoam_kepsilon_livebed_depth.csv");
  const std::string depths = tables.depths.text(), lines = tables.lines.text();
  const io::Table depth_table = io::parse_table(depths, e.name + "-depth.csv"),
                  line_table = io::parse_table(lines, e.name + "-profiles.csv");
  const auto each_run = [&](auto&& draw_one) {
    for (const MaoRun& run : e.runs)
      if (tables.depths.has(run.number)) draw_one(run.number, run.curve, colours[(run.number - 1) % colours.size()]);
  };

  report::Chart chart{{e.scaled ? "t scaled by T [s]" : "t [s]", 0, 40}, {"S/D", 0, 1.1}, {}};
  chart.curves.push_back({"Mao (1986)", "#000000", measured.column("t_s"), measured.column("S_over_D"), true});
  chart.curves.push_back(
      {"two-phase k-epsilon (sedFoam)", "#999999", two_phase.column("t_s"), two_phase.column("S_over_D"), false, true});
  each_run([&](unsigned run, const std::string& name, const std::string& colour) {
    Points p = points_of(depth_table, run, "t_s", "S_over_D");
    for (double& t : p.x) t /= unit;
    chart.curves.push_back({name, colour, std::move(p.x), std::move(p.y)});
  });
  std::vector<Panel> panels_of;
  for (double at : report::mao_profile_times) {
    report::Chart bed{{"x/D", -4, 7}, {"y/D", -1.2, 0.8}, {}};
    const Profile p = profile_of_mao(at);
    bed.curves.push_back({"Mao (1986)", "#000000", p.x, p.y, true});
    each_run([&](unsigned run, const std::string& name, const std::string& colour) {
      Points line = points_of(line_table, run, "x_D", "y_bed_D", "t_s", at * unit);
      if (!line.x.empty()) bed.curves.push_back({name, colour, std::move(line.x), std::move(line.y)});
    });
    panels_of.push_back({fmt::format("{} s", at), bed});
  }
  return {{e.name + "-depth.svg", picture(chart)},
          {e.name + "-profiles.svg", panels(panels_of, 1)},
          {e.name + "-depth.csv", depths},
          {e.name + "-profiles.csv", lines}};
}

}  // namespace

const std::vector<std::string>& keys_of_07mm() {
  static const std::vector<std::string> keys = {"grains.diameter=0.7 mm", "mesh.cell_y=0.42 mm",   "bed.pieces=3",
                                                "time.grain_step=1.4e-5", "time.spin_up=2",        "time.end=13.75",
                                                "current.rise=1.475",     "grains.precision=mixed"};
  return keys;
}

Result hold_against_mao(const Experiment& e, const Only& only, const Tell& tell) {
  for (unsigned number : only.runs)
    if (std::none_of(e.runs.begin(), e.runs.end(), [&](const MaoRun& run) { return run.number == number; }))
      base::fail(base::Exit::command_line, "{} has no run {}; its {}s are 1 to {}", e.name, number, e.column,
                 e.runs.back().number);
  run::obey_signals();
  Result result;
  std::vector<std::string> labels;
  for (const MaoRun& run : e.runs)
    if (only.makes(run.number)) labels.push_back(run.label);
  if (!only.runs.empty()) keep_rows(only.folder / (e.name + ".json"), labels, result);
  std::vector<Made> all;
  for (const MaoRun& run : e.runs) {
    if (!only.makes(run.number)) continue;
    const casefile::Case c = casefile::read_text(e.text, e.name, run.keys);
    const std::string folder = fmt::format("{}/{}-{}{}", kept_scours, e.name, e.column, run.number);
    if (auto kept = scour(c, folder, tell))
      all.push_back({run, std::move(*kept)});
    else if (run::stop_signal() == 0)
      result.rows.push_back(missing(run.label));
  }
  if (all.empty()) base::fail(base::Exit::signal, "stopped before the grains of any run of {} were let go", e.name);
  const io::Table measured = io::parse_table(report::mao_depth, "mao1986_livebed_depth.csv");
  const double scale = all.front().scour.resolved.time_scale / report::mao_time_scale;
  const double unit = e.scaled ? scale : 1.0;  // of the run's time over the experiment's
  const char* when = e.scaled ? "t (scaled to T) " : "";

  const auto add = [&](const Made& made, const std::string& what, double value, const std::string& unit_of, double low,
                       double high, const std::string& reference) {
    const Scour& s = made.scour;
    if (!std::isfinite(value) && s.t.back() < end_of_mao * unit) return;  // not so far yet, or not meant to go so far
    Row row{fmt::format("{}: {}", made.run.label, what), value, unit_of};
    // With enlarged grains and a time that is scaled the numbers are told, not judged.
    if (std::isfinite(value) && !e.scaled) row.low = low, row.high = high;
    row.reference = reference;
    row.setup = fmt::format("case {}, seed {}, {:.1f} s", casefile::hash(s.resolved), s.seed, s.t.back());
    row.seconds = s.wall, row.commit = s.commit;
    tell(fmt::format("{}: {:.4g} {}", row.name, value, unit_of));
    result.rows.push_back(row);
  };
  const double none = std::nan("");
  for (const Made& made : all) {
    const Scour& s = made.scour;
    const std::vector<double>&t = measured.column("t_s"), &depth = measured.column("S_over_D");
    add(made, fmt::format("{}rms of S/D over 1 to 37 s", when), depth_rms(s, unit, t, depth, 1, 37), "-", 0, 0.07,
        "Mao (1986), 42 points; a two-phase k-epsilon model: 0.104");
    add(made, fmt::format("{}rms of S/D over 1 to 12 s", when), depth_rms(s, unit, t, depth, 1, 12), "-", none, none,
        "Mao (1986)");
    add(made, fmt::format("{}rms of S/D over 1 to 25 s", when), depth_rms(s, unit, t, depth, 1, 25), "-", none, none,
        "Mao (1986)");
    const auto mean = [&](double from, double to) {  // of runs that have come so far
      return s.t.back() > 0.99 * to * unit ? mean_depth(s, from * unit, to * unit) : none;
    };
    for (const auto& [from, to] : {std::pair{11, 13}, {23, 26}})
      add(made, fmt::format("{}mean S/D over {} to {} s", when, from, to), mean(from, to), "-", none, none,
          fmt::format("Mao (1986): {:.2f}", base::interpolate(t, depth, 0.5 * (from + to))));
    add(made, fmt::format("{}mean S/D over 30 to 37 s", when), mean(30, end_of_mao), "-", plateau_of_mao - 0.1,
        plateau_of_mao + 0.1, "Mao (1986): plateau 0.91");
    add(made, fmt::format("{}time to 63 % of Mao's plateau, mean over a second", when),
        first_time(s, (1 - std::exp(-1.0)) * plateau_of_mao, unit) / unit, "s", 11.06 * 0.85, 11.06 * 1.15,
        "Mao (1986): 11.06 s");
    for (double at : report::mao_profile_times) {
      if (s.t.back() < at * unit) continue;
      const Profile p = profile_of_mao(at);
      const auto c = base::compare(s.x, line_at(s, at * unit), p.x, p.y, 0.0);
      if (!c) continue;
      add(made, fmt::format("Brier skill score of the bed at {} s against the flat bed", at), c->skill, "-", 0.8, 1,
          "Mao (1986)");
      add(made, fmt::format("rms of the bed at {} s", at), c->rms, "D", none, none, "Mao (1986)");
    }
    add(made, "wall time", s.wall / 3600, "h", none, none, "");
  }

  Tables tables{.depths{fmt::format("S/D in time; each {} with the commit and the hash of its resolved case", e.column),
                        e.column + ",t_s,S_over_D"},
                .lines{fmt::format("bed lines over the original bed every {:.5g} s; x from the pipe's centre", unit),
                       e.column + ",t_s,x_D,y_bed_D"}};
  for (const Made& made : all) add_to_tables(made, unit, tables);
  if (!only.runs.empty()) {
    tables.depths.keep(only.folder / (e.name + "-depth.csv"));
    tables.lines.keep(only.folder / (e.name + "-profiles.csv"));
  }
  result.pictures = draw(e, tables, unit);
  return result;
}

}  // namespace livebed::validate
