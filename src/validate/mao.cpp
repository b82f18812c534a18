#include "validate/mao.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/curves.hpp"
#include "base/fault.hpp"
#include "base/math.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"
#include "io/file.hpp"
#include "io/table.hpp"
#include "report/references.hpp"
#include "run/execute.hpp"
#include "validate/picture.hpp"
#include "validate/references.hpp"
#include "validate/scour_runs.hpp"
#include "validate/seed_table.hpp"

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

/// S/D in time and the bed lines of all seeds, as they are in the files.
struct Tables {
  SeedTable depths{"S/D in time; each seed with the commit and the hash of its resolved case", "seed,t_s,S_over_D"};
  SeedTable lines;
};

/// every: seconds of the run from one bed line to the next.
void add_to_tables(const Scour& s, double every, Tables& tables) {
  std::string depths, lines;
  for (std::size_t n = 0; n < s.t.size(); ++n) depths += fmt::format("{},{:.4f},{:.5f}\n", s.seed, s.t[n], s.depth[n]);
  for (int k = 0; k * every <= s.t_lines.back() + 1e-6; ++k) {
    const std::vector<double>& line = line_at(s, k * every);
    // Lines are sampled at half a grain; every fifth tells as much.
    for (std::size_t n = 0; n < s.x.size(); n += 5)
      lines += fmt::format("{},{:.5g},{:.4f},{:.4f}\n", s.seed, k * every, s.x[n], line[n]);
  }
  tables.depths.add(s.seed, run_told(s), std::move(depths));
  tables.lines.add(s.seed, run_told(s), std::move(lines));
}

/// One seed's part of two columns; where a third is at a value, if one is given.
struct Points {
  std::vector<double> x, y;
};
Points points_of(const io::Table& t, unsigned seed, const char* x, const char* y, const char* where = nullptr,
                 double value = 0) {
  const std::vector<double>&seeds = t.column("seed"), &xs = t.column(x), &ys = t.column(y);
  Points p;
  for (std::size_t n = 0; n < seeds.size(); ++n)
    if (seeds[n] == seed && (where == nullptr || std::abs(t.column(where)[n] / value - 1) < 1e-3))
      p.x.push_back(xs[n]), p.y.push_back(ys[n]);
  return p;
}

std::vector<Picture> draw(const Experiment& e, const Tables& tables, double unit) {
  const io::Table measured = io::parse_table(report::mao_depth, "mao1986_livebed_depth.csv");
  const io::Table two_phase = io::parse_table(sedfoam_depth, "sedfoam_kepsilon_livebed_depth.csv");
  const std::string depths = tables.depths.text(), lines = tables.lines.text();
  const io::Table depth_table = io::parse_table(depths, e.name + "-depth.csv"),
                  line_table = io::parse_table(lines, e.name + "-profiles.csv");
  const auto each_seed = [&](auto&& draw_one) {
    for (unsigned seed = 1; seed <= e.ends.size(); ++seed)
      if (tables.depths.has(seed))
        draw_one(seed, fmt::format("Livebed, seed {}", seed), colours[(seed - 1) % colours.size()]);
  };

  report::Chart chart{{e.scaled ? "t scaled by T [s]" : "t [s]", 0, 40}, {"S/D", 0, 1.1}, {}};
  chart.curves.push_back({"Mao (1986)", "#000000", measured.column("t_s"), measured.column("S_over_D"), true});
  chart.curves.push_back(
      {"two-phase k-epsilon (sedFoam)", "#999999", two_phase.column("t_s"), two_phase.column("S_over_D"), false, true});
  each_seed([&](unsigned seed, const std::string& name, const std::string& colour) {
    Points p = points_of(depth_table, seed, "t_s", "S_over_D");
    for (double& t : p.x) t /= unit;
    chart.curves.push_back({name, colour, std::move(p.x), std::move(p.y)});
  });
  std::vector<Panel> panels_of;
  for (double at : report::mao_profile_times) {
    report::Chart bed{{"x/D", -4, 7}, {"y/D", -1.2, 0.8}, {}};
    const Profile p = profile_of_mao(at);
    bed.curves.push_back({"Mao (1986)", "#000000", p.x, p.y, true});
    each_seed([&](unsigned seed, const std::string& name, const std::string& colour) {
      Points line = points_of(line_table, seed, "x_D", "y_bed_D", "t_s", at * unit);
      if (!line.x.empty()) bed.curves.push_back({name, colour, std::move(line.x), std::move(line.y)});
    });
    panels_of.push_back({fmt::format("{} s", at), bed});
  }
  return {{e.name + "-depth.svg", picture(chart)},
          {e.name + "-profiles.svg", panels(panels_of, 1)},
          {e.name + "-depth.csv", depths},
          {e.name + "-profiles.csv", lines}};
}

/// The rows of seeds that are not made now, as the file in the folder has them.
void keep_rows(const Experiment& e, const Seeds& seeds, Result& result) {
  const std::filesystem::path file = seeds.folder / (e.name + ".json");
  if (!std::filesystem::exists(file)) return;
  for (Row& row : rows_of_json(io::read_file(file), file.string()))
    if (std::none_of(seeds.made.begin(), seeds.made.end(),
                     [&](unsigned seed) { return row.name.starts_with(fmt::format("{} seed {}:", e.name, seed)); }))
      result.rows.push_back(std::move(row));
}

void keep_table(const std::filesystem::path& file, SeedTable& table) {
  if (std::filesystem::exists(file)) table.keep(io::read_file(file), file.string());
}

Result hold_against_mao(const Experiment& e, const Seeds& seeds, const Tell& tell) {
  for (unsigned seed : seeds.made)
    if (seed < 1 || seed > e.ends.size())
      base::fail(base::Exit::command_line, "{} has no seed {}; its seeds are 1 to {}", e.name, seed, e.ends.size());
  run::obey_signals();
  Result result;
  if (!seeds.made.empty()) keep_rows(e, seeds, result);
  std::vector<Scour> all;
  for (unsigned seed = 1; seed <= e.ends.size(); ++seed) {
    if (!seeds.made.empty() && std::count(seeds.made.begin(), seeds.made.end(), seed) == 0) continue;
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
  const double scale = all.front().resolved.time_scale / report::mao_time_scale;
  const double unit = e.scaled ? scale : 1.0;  // of the run's time over the experiment's
  const char* when = e.scaled ? "t (scaled to T) " : "";

  const auto add = [&](const Scour& s, const std::string& what, double value, const std::string& unit_of, double low,
                       double high, const std::string& reference) {
    if (!std::isfinite(value) && s.t.back() < 37 * unit) return;  // not so far yet, or not meant to go so far
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

  Tables tables{.lines{fmt::format("bed lines over the original bed every {:.5g} s; x from the pipe's centre", unit),
                       "seed,t_s,x_D,y_bed_D"}};
  for (const Scour& s : all) add_to_tables(s, unit, tables);
  if (!seeds.made.empty()) {
    keep_table(seeds.folder / (e.name + "-depth.csv"), tables.depths);
    keep_table(seeds.folder / (e.name + "-profiles.csv"), tables.lines);
  }
  result.pictures = draw(e, tables, unit);
  return result;
}

/// cases/mao with other grains and the times of its course scaled with T.
Experiment other_grains(std::string name, std::vector<std::string> keys, int seeds) {
  return {std::move(name), mao_case, std::vector<double>(seeds, 0.0), true, std::move(keys)};
}

}  // namespace

Result mao(const Seeds& seeds, const Tell& tell) {
  return hold_against_mao({"mao", mao_case, {0, 12, 12}}, seeds, tell);
}
Result mao_07mm(const Seeds& seeds, const Tell& tell) {
  return hold_against_mao(
      other_grains("mao-0.7mm",
                   {"grains.diameter=0.7 mm", "mesh.cell_y=0.42 mm", "bed.pieces=3", "time.grain_step=1.4e-5",
                    "time.spin_up=2", "time.end=13.7", "current.rise=1.475"},
                   3),
      seeds, tell);
}
Result mao_1mm(const Seeds& seeds, const Tell& tell) {
  return hold_against_mao(
      other_grains("mao-1mm",
                   {"grains.diameter=1 mm", "mesh.cell_y=0.6 mm", "bed.pieces=1", "time.grain_step=2e-5",
                    "time.spin_up=1.5", "time.end=8.1", "current.rise=0.86"},
                   3),
      seeds, tell);
}
Result mao_2mm(const Seeds& seeds, const Tell& tell) {
  return hold_against_mao(
      other_grains("mao-2mm-livebed",
                   {"grains.diameter=2 mm", "mesh.cell_y=1.2 mm", "bed.pieces=1", "time.grain_step=4e-5",
                    "time.spin_up=1.5", "time.end=2.85", "current.rise=0.307"},
                   3),
      seeds, tell);
}
Result mao_paper(const Seeds& seeds, const Tell& tell) {
  return hold_against_mao({"mao-2mm", mao_paper_case, {0, 0, 0}, true}, seeds, tell);
}

}  // namespace livebed::validate
