#include "validate/mao.hpp"

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
#include "validate/scour_runs.hpp"

namespace livebed::validate {

namespace {

constexpr double plateau_of_mao = 0.91;
const std::vector<std::string> colours = {"#1f77b4", "#d62728", "#2ca02c"};

struct Experiment {
  std::string name;       ///< of folders and files
  std::string_view text;  ///< the case
  /// Of each seed, from 1 on [s]; 0: the case's own.  Those that end early tell how far seeds spread: they are made in
  /// mixed precision, which differs from double less than seeds do and takes a quarter less time.
  std::vector<double> ends;
  bool scaled = false;              ///< times count as t/T
  std::vector<std::string> keys{};  ///< what differs from the case
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

std::string csv_of_depths(const std::vector<Scour>& all) {
  std::string text = "# S/D in time; each seed with the commit and the hash of its resolved case\n" + runs_told(all);
  text += "seed,t_s,S_over_D\n";
  for (const Scour& s : all)
    for (std::size_t n = 0; n < s.t.size(); ++n) text += fmt::format("{},{:.4f},{:.5f}\n", s.seed, s.t[n], s.depth[n]);
  return text;
}

/// Bed lines `every` so many seconds of the run.
std::string csv_of_profiles(const std::vector<Scour>& all, double every) {
  std::string text =
      fmt::format("# bed lines over the original bed every {:.5g} s; x from the pipe's centre\n", every) +
      runs_told(all);
  text += "seed,t_s,x_D,y_bed_D\n";
  for (const Scour& s : all)
    for (int k = 0; k * every <= s.t_lines.back() + 1e-6; ++k) {
      const std::vector<double>& line = line_at(s, k * every);
      // Lines are sampled at half a grain; every fifth tells as much.
      for (std::size_t n = 0; n < s.x.size(); n += 5)
        text += fmt::format("{},{:.5g},{:.4f},{:.4f}\n", s.seed, k * every, s.x[n], line[n]);
    }
  return text;
}

Result hold_against_mao(const Experiment& e, const Tell& tell) {
  run::obey_signals();
  Result result;
  std::vector<Scour> all;
  for (unsigned seed = 1; seed <= e.ends.size(); ++seed) {
    std::vector<std::string> keys = e.keys;
    keys.push_back(fmt::format("bed.seed={}", seed));
    if (e.ends[seed - 1] > 0) {
      keys.push_back(fmt::format("time.end={}", e.ends[seed - 1]));
      keys.push_back("grains.precision=mixed");
    }
    const casefile::Case c = casefile::read_text(e.text, e.name, keys);
    const std::string folder = fmt::format("{}/{}-seed{}", kept_scours, e.name, seed);
    if (auto kept = scour(c, folder, tell))
      all.push_back(std::move(*kept));
    else if (run::stop_signal() == 0)
      result.rows.push_back(missing(fmt::format("{} seed {}", e.name, seed)));
  }
  if (all.empty()) base::fail(base::Exit::signal, "stopped before the grains of any seed of {} were let go", e.name);
  const io::Table measured = io::parse_table(report::mao_depth, "mao1986_livebed_depth.csv");
  const io::Table two_phase = io::parse_table(sedfoam_depth, "sedfoam_kepsilon_livebed_depth.csv");
  const double scale = all.front().resolved.time_scale / report::mao_time_scale;
  const double unit = e.scaled ? scale : 1.0;  // of the run's time over the experiment's
  const char* when = e.scaled ? "t (scaled to T) " : "";

  const auto add = [&](const Scour& s, const std::string& what, double value, const std::string& unit_of, double low,
                       double high, const std::string& reference) {
    Row row{fmt::format("{} seed {}: {}", e.name, s.seed, what), value, unit_of};
    // With enlarged grains and a time that is scaled the numbers are told, not judged.
    if (std::isfinite(value) && !e.scaled) row.low = low, row.high = high;
    row.reference = reference;
    row.setup = fmt::format("case {}, seed {}, {:.1f} s", casefile::hash(s.resolved), s.seed, s.t.back());
    row.seconds = s.wall, row.commit = s.commit;
    tell(fmt::format("{}: {:.4g} {}", row.name, value, unit_of));
    result.rows.push_back(row);
  };
  const double none = std::nan("");
  for (const Scour& s : all) {
    const std::vector<double>&t = measured.column("t_s"), &depth = measured.column("S_over_D");
    add(s, fmt::format("{}rms of S/D over 1 to 37 s", when), depth_rms(s, unit, t, depth, 1, 37), "-", 0, 0.07,
        "Mao (1986), 42 points; a two-phase k-epsilon model: 0.104");
    add(s, fmt::format("{}rms of S/D over 1 to 12 s", when), depth_rms(s, unit, t, depth, 1, 12), "-", none, none,
        "Mao (1986)");
    add(s, fmt::format("{}mean S/D over 30 to 37 s", when), mean_depth(s, 30 * unit, 37 * unit), "-",
        plateau_of_mao - 0.1, plateau_of_mao + 0.1, "Mao (1986): plateau 0.91");
    add(s, fmt::format("{}time to 63 % of Mao's plateau", when),
        first_time(s, (1 - std::exp(-1.0)) * plateau_of_mao) / unit, "s", 11.06 * 0.85, 11.06 * 1.15,
        "Mao (1986): 11.06 s");
    for (double at : report::mao_profile_times) {
      if (s.t.back() < at * unit) continue;
      const Profile p = profile_of_mao(at);
      const auto c = base::compare(s.x, line_at(s, at * unit), p.x, p.y, 0.0);
      if (!c) continue;
      add(s, fmt::format("Brier skill score of the bed at {} s against the flat bed", at), c->skill, "-", 0.8, 1,
          "Mao (1986)");
      add(s, fmt::format("rms of the bed at {} s", at), c->rms, "D", none, none, "Mao (1986)");
    }
    add(s, "wall time", s.wall / 3600, "h", none, none, "");
  }

  report::Chart chart{{e.scaled ? "t scaled by T [s]" : "t [s]", 0, 40}, {"S/D", 0, 1.1}, {}};
  chart.curves.push_back({"Mao (1986)", "#000000", measured.column("t_s"), measured.column("S_over_D"), true});
  chart.curves.push_back(
      {"two-phase k-epsilon (sedFoam)", "#999999", two_phase.column("t_s"), two_phase.column("S_over_D"), false, true});
  for (const Scour& s : all) {
    report::Curve curve{fmt::format("Livebed, seed {}", s.seed), colours[(s.seed - 1) % colours.size()], {}, s.depth};
    for (double t : s.t) curve.x.push_back(t / unit);
    chart.curves.push_back(std::move(curve));
  }
  result.pictures.push_back({e.name + "-depth.svg", picture(chart)});
  std::vector<Panel> panels_of;
  for (double at : report::mao_profile_times) {
    report::Chart bed{{"x/D", -4, 7}, {"y/D", -1.2, 0.8}, {}};
    const Profile p = profile_of_mao(at);
    bed.curves.push_back({"Mao (1986)", "#000000", p.x, p.y, true});
    for (const Scour& s : all)
      if (s.t.back() >= at * unit)
        bed.curves.push_back({fmt::format("Livebed, seed {}", s.seed), colours[(s.seed - 1) % colours.size()], s.x,
                              line_at(s, at * unit)});
    panels_of.push_back({fmt::format("{} s", at), bed});
  }
  result.pictures.push_back({e.name + "-profiles.svg", panels(panels_of, 1)});
  result.pictures.push_back({e.name + "-depth.csv", csv_of_depths(all)});
  result.pictures.push_back({e.name + "-profiles.csv", csv_of_profiles(all, unit)});
  return result;
}

/// cases/mao with other grains and the times of its course scaled with T.
Experiment other_grains(std::string name, std::vector<std::string> keys, int seeds) {
  return {std::move(name), mao_case, std::vector<double>(seeds, 0.0), true, std::move(keys)};
}

}  // namespace

Result mao(const Tell& tell) { return hold_against_mao({"mao", mao_case, {0, 12, 12}}, tell); }
Result mao_07mm(const Tell& tell) {
  return hold_against_mao(
      other_grains("mao-0.7mm",
                   {"grains.diameter=0.7 mm", "mesh.cell_y=0.42 mm", "bed.pieces=3", "time.grain_step=1.4e-5",
                    "time.spin_up=2", "time.end=13.7", "current.rise=1.475"},
                   3),
      tell);
}
Result mao_1mm(const Tell& tell) {
  return hold_against_mao(
      other_grains("mao-1mm",
                   {"grains.diameter=1 mm", "mesh.cell_y=0.6 mm", "bed.pieces=1", "time.grain_step=2e-5",
                    "time.spin_up=1.5", "time.end=8.1", "current.rise=0.86"},
                   3),
      tell);
}
Result mao_2mm(const Tell& tell) {
  return hold_against_mao(
      other_grains("mao-2mm-livebed",
                   {"grains.diameter=2 mm", "mesh.cell_y=1.2 mm", "bed.pieces=1", "time.grain_step=4e-5",
                    "time.spin_up=1.5", "time.end=2.85", "current.rise=0.307"},
                   3),
      tell);
}
Result mao_paper(const Tell& tell) { return hold_against_mao({"mao-2mm", mao_paper_case, {0, 0, 0}, true}, tell); }

}  // namespace livebed::validate
