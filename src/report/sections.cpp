#include "report/sections.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/curves.hpp"
#include "base/math.hpp"
#include "report/chart.hpp"
#include "report/references.hpp"

namespace livebed::report {

namespace {

constexpr const char* blue = "#2a78c2";
constexpr const char* orange = "#d9732e";
constexpr const char* green = "#3a9a5b";
constexpr const char* grey = "#8a8f98";
constexpr const char* mao = "#c22f4a";

std::string base64(const std::string& bytes) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 3; ++k)
      triple = triple << 8 | (n + k < bytes.size() ? static_cast<std::uint8_t>(bytes[n + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += n + k > bytes.size() ? '=' : letters[triple >> (18 - 6 * k) & 63];
  }
  return out;
}

std::vector<double> divided(std::vector<double> values, double by) {
  for (double& v : values) v /= by;
  return values;
}

/// A number of summary.json, or nothing.
std::optional<double> number(const RunFolder& run, const std::string& key) {
  if (!run.summary.contains(key) || !run.summary[key].is_number()) return {};
  return run.summary[key].get<double>();
}

std::string card(const std::string& name, const std::string& value, const std::string& note = "") {
  return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span><small>{}</small></div>", value, name, note);
}

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min {:.0f} s", std::floor(seconds / 60), std::fmod(seconds, 60));
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string walls_note(const RunFolder& run) {
  if (!run.summary.contains("walls") || !run.summary["walls"].is_object()) return "";
  std::string note;
  for (const auto& [name, seconds] : run.summary["walls"].items())
    if (seconds.is_number())
      note += fmt::format("{}{} {}", note.empty() ? "" : ", ", name.substr(0, name.rfind("_s")), duration(seconds));
  return note;
}

/// How near a curve is to measured points, in words; empty when none of them lies inside it.
std::string nearness(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& x_measured,
                     const std::vector<double>& y_measured) {
  const auto c = base::compare(x, y, x_measured, y_measured, 0);
  if (!c) return "";
  return fmt::format("{} points: rms {:.3f}, mean {:+.3f}, Brier skill {:.2f}", c->points, c->rms, c->bias, c->skill);
}

/// The fit S_eq (1 - exp(-t/T)) in words.
std::string fit_note(const RunFolder& run) {
  if (!run.summary.contains("fit") || !run.summary["fit"].is_object()) return "";
  const auto& fit = run.summary["fit"];
  for (const char* key : {"S_eq_over_D", "error_S_eq", "T_s", "error_T_s"})
    if (!fit.contains(key) || !fit[key].is_number()) return "";
  return fmt::format("fit {:.3f} ± {:.3f}, T = {:.3g} ± {:.1g} s", fit["S_eq_over_D"].get<double>(),
                     fit["error_S_eq"].get<double>(), fit["T_s"].get<double>(), fit["error_T_s"].get<double>());
}

}  // namespace

std::string head_section(const RunFolder& run) {
  std::string cards;
  double last_time = 0;
  std::optional<double> S, under, theta;
  if (run.series) {
    last_time = run.series->column("time_s").back();
    S = run.series->column("S_over_D").back();
    under = run.series->column("depth_under_pipe_over_D").back();
    theta = run.series->column("theta_measured").back();
  }
  if (const auto v = number(run, "scour_depth_over_D")) S = v;
  if (const auto v = number(run, "depth_under_pipe_over_D")) under = v;
  if (const auto v = number(run, "theta_measured")) theta = v;

  if (S && run.pipe)
    cards += card("S/D", fmt::format("{:.3f}", *S), "largest depth within one D of the pipe; Mao measured 0.91");
  if (under && run.pipe) cards += card("depth under the pipe / D", fmt::format("{:.3f}", *under));
  if (!run.summary.is_null() && run.pipe) {
    const auto S_eq = number(run, "S_eq_over_D"), T = number(run, "T_s");
    cards += card("equilibrium S/D", S_eq ? fmt::format("{:.3f}", *S_eq) : "not reached", fit_note(run));
    cards += card("time scale of S(t)", T ? fmt::format("{:.3g} s", *T) : "not reached",
                  run.time_scale ? fmt::format("formula {:.3g} s", *run.time_scale) : "");
  }
  if (theta)
    cards += card("theta measured", fmt::format("{:.3f}", *theta),
                  run.theta > 0 ? fmt::format("nominal {:.3f}", run.theta) : "");
  if (run.series)
    cards += card("simulated", fmt::format("{:.3g} s", last_time),
                  run.time_scale ? fmt::format("t/T = {:.2f}", last_time / *run.time_scale) : "");
  if (const auto v = number(run, "wall_s")) cards += card("wall time", duration(*v), walls_note(run));
  if (const auto v = number(run, "grain_steps_per_second"))
    cards += card("grain-steps a second", fmt::format("{:.3g} million", *v / 1e6));
  if (const auto v = number(run, "flow_ms_per_step")) cards += card("a flow step", fmt::format("{:.3g} ms", *v));
  if (const auto v = number(run, "grains")) cards += card("grains", fmt::format("{:.0f}", *v));
  if (const auto v = number(run, "cells")) cards += card("cells", fmt::format("{:.0f}", *v));
  if (const auto v = number(run, "peak_memory_MB")) cards += card("peak memory", fmt::format("{:.0f} MB", *v));

  std::string out = fmt::format("<header><h1>{}</h1>", escaped(run.title));
  const auto text = [&](const char* key) {
    return run.summary.contains(key) ? run.summary[key] : nlohmann::ordered_json();
  };
  std::string origin;
  for (const char* key : {"commit", "case_hash", "seed"})
    if (const auto value = text(key); !value.is_null())
      origin += fmt::format("{}{} {}", origin.empty() ? "" : " · ", std::string(key) == "case_hash" ? "case" : key,
                            escaped(value.is_string() ? value.get<std::string>() : value.dump()));
  out += fmt::format("<p class=\"origin\">{}</p></header>", origin);
  if (!run.missing.empty()) {
    out += "<div class=\"missing\"><b>Not everything is here</b><ul>";
    for (const std::string& sentence : run.missing) out += "<li>" + escaped(sentence) + "</li>";
    out += "</ul></div>";
  }
  return out + "<div class=\"cards\">" + cards + "</div>";
}

std::string snapshot_section(const RunFolder& run, const std::vector<Stage>& shown) {
  if (shown.empty()) return "";
  std::vector<std::pair<Snapshot, SnapshotOptions>> loaded;
  double water = 0, grains = 0;  // one scale for all pictures
  for (const Stage& stage : shown) {
    loaded.push_back(load_stage(run, stage));
    water = std::max(water, largest_water_speed(loaded.back().first));
    grains = std::max(grains, largest_grain_speed(loaded.back().first));
  }
  std::string out =
      "<section><h2>The bed</h2><p>Speed of the water behind, grains coloured by their speed; white: the bed line, "
      "light blue: "
      "the original bed. Stages at the t/T of the paper's Fig. 11.</p>";
  for (auto& [snapshot, options] : loaded) {
    options.water_speed = water;
    options.grain_speed = grains;
    out += fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escaped(options.title),
                       base64(draw(snapshot, options).png()));
  }
  return out + "</section>";
}

std::string depth_section(const RunFolder& run) {
  if (!run.series || !run.pipe) return "";
  const std::vector<double>& t = run.series->column("time_s");
  const std::vector<double>& S = run.series->column("S_over_D");
  const io::Table measured = io::parse_table(mao_depth, "data/mao1986_livebed_depth.csv");
  const std::vector<double>& t_mao = measured.column("t_s");
  const std::vector<double>& S_mao = measured.column("S_over_D");

  Chart in_time{{"t [s]"}, {"S/D"}, {}};
  in_time.curves = {{"this run", blue, t, S},
                    {"under the pipe's centre", orange, t, run.series->column("depth_under_pipe_over_D"), false, true},
                    {"Mao (1986), 0.36 mm sand", mao, t_mao, S_mao, true}};
  std::string out = "<section><h2>Scour depth</h2><div class=\"row\"><div>" + svg(in_time) + "</div>";
  if (run.time_scale) {
    Chart in_scale{{"t/T"}, {"S/D"}, {}};
    in_scale.curves = {
        {"this run", blue, divided(t, *run.time_scale), S},
        {fmt::format("Mao (1986), T = {} s", mao_time_scale), mao, divided(t_mao, mao_time_scale), S_mao, true}};
    const std::string near = nearness(in_scale.curves[0].x, S, in_scale.curves[1].x, S_mao);
    out += "<div>" + svg(in_scale) + (near.empty() ? "" : "<p>This run against Mao's " + near + ".</p>") + "</div>";
  }
  out +=
      "</div><p>Mao: D = 0.05 m, theta = 0.33, e/D = 0, digitised second-hand (about 0.02 in S/D; his profiles are up "
      "to 0.1 D deeper at equal times).";
  out += " Brier skill: 1 is perfect, 0 no better than a bed that never moves.";
  if (run.time_scale)
    out += fmt::format(
        " T = D²/√(g(s−1)d³) θ^(−5/3)/50: {:.3g} s here. Coarser grains dig faster, so only the right chart compares "
        "runs with another grain.",
        *run.time_scale);
  return out + "</p></section>";
}

std::string profile_section(const RunFolder& run) {
  if (!run.bed || !run.pipe) return "";
  const double D = run.pipe->diameter, level = run.original_level();
  const auto in_D = [&](const BedLine& line, const char* name, const char* colour, bool dashed) {
    Curve curve{name, colour, {}, {}, false, dashed};
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      curve.x.push_back((line.x[i] - run.pipe->x) / D);
      curve.y.push_back((line.y[i] - level) / D);
    }
    return curve;
  };
  const Curve circle = [&] {
    Curve c{"", grey, {}, {}};
    for (int n = 0; n <= 72; ++n) {
      c.x.push_back(0.5 * std::cos(2 * base::pi * n / 72));
      c.y.push_back((run.pipe->y - level) / D + 0.5 * std::sin(2 * base::pi * n / 72));
    }
    return c;
  }();
  std::string charts;
  const double last = run.bed->time.back();
  const io::Table table = io::parse_table(mao_profiles, "data/mao1986_livebed_profiles.csv");
  for (double t_mao : {11.0, 25.0}) {
    if (!run.time_scale) break;
    const double t = t_mao / mao_time_scale * *run.time_scale;
    if (t > 1.02 * last) continue;
    Curve dots{fmt::format("Mao (1986), {:.0f} s", t_mao), mao, {}, {}, true};
    for (std::size_t n = 0; n < table.rows(); ++n)
      if (table.column("t_s")[n] == t_mao) {
        dots.x.push_back(table.column("x_D")[n]);
        dots.y.push_back(table.column("y_bed_D")[n]);
      }
    const BedLine line = run.bed->nearest(t);
    const Curve computed = in_D(line, "this run", blue, false);
    Chart chart{{"x/D", -4, 6.5}, {"y/D", -1.4, 1.2}, {circle, computed, dots}};
    chart.equal_scales = true;
    chart.width = 590;
    charts += fmt::format("<div><h3>t/T = {:.2f}, t = {:.3g} s</h3>{}<p>{}</p></div>", t_mao / mao_time_scale,
                          line.time, svg(chart), nearness(computed.x, computed.y, dots.x, dots.y));
  }
  Chart ends{{"x/D"},
             {"y/D"},
             {circle, in_D(run.bed->nearest(0), "at the start", grey, true),
              in_D(run.bed->nearest(last), "now", blue, false)}};
  ends.equal_scales = true;
  ends.width = 1180;
  charts += fmt::format("<div><h3>Whole length, t = {:.3g} s</h3>{}</div>", last, svg(ends));
  return "<section><h2>Bed line</h2><div class=\"row\">" + charts + "</div></section>";
}

std::string series_section(const RunFolder& run) {
  if (!run.series) return "";
  const io::Table& series = *run.series;
  struct Line {
    const char *column, *name, *colour;
  };
  std::string charts;
  const auto add = [&](const char* title, Axis y, std::initializer_list<Line> lines) {
    Chart chart{{"t [s]"}, std::move(y), {}, 385, 230};
    for (const Line& line : lines)
      if (series.has(line.column))
        chart.curves.push_back({line.name, line.colour, series.column("time_s"), series.column(line.column)});
    if (!chart.curves.empty()) charts += fmt::format("<div><h3>{}</h3>{}</div>", title, svg(chart));
  };
  const double no = std::nan("");
  if (run.pipe) {
    add("Force on the pipe", {"[N/m]"}, {{"drag_N_m", "drag", blue}, {"lift_N_m", "lift", orange}});
    add("Hole and mound", {"[D]"},
        {{"hole_width_over_D", "width of the hole", blue},
         {"mound_height_over_D", "height of the mound", orange},
         {"mound_x_over_D", "place of the mound", green}});
  }
  add("Grain flux", {"q [m²/s]"}, {{"grain_flux_m2_s", "", blue}});
  add("Shields parameter", {"theta"}, {{"theta_measured", "measured", blue}});
  add("Grain speed", {"[m/s]"}, {{"grain_mean_speed_m_s", "mean", blue}, {"grain_max_speed_m_s", "largest", orange}});
  add("Mass residual", {"residual", no, no, true}, {{"mass_residual", "", blue}});
  add("Momentum in x", {"[N s]"},
      {{"fluid_momentum_x_N_s", "fluid", blue}, {"grain_momentum_x_N_s", "grains", orange}});
  add("Impulse not yet handed over", {"[N s]"}, {{"impulse_error_N_s", "", blue}});
  add("Flow step", {"[s]"}, {{"flow_step_s", "", blue}});
  add("Courant number", {"[-]"}, {{"courant", "", blue}});
  add("Pressure iterations", {"[-]"}, {{"pressure_iterations", "", blue}});
  add("Contacts a grain", {"[-]"}, {{"contacts_per_grain", "", blue}});
  add("Largest overlap", {"overlap / d"}, {{"overlap_max_over_d", "", blue}});
  return "<section><h2>Time series</h2><div class=\"row\">" + charts + "</div></section>";
}

std::string case_section(const RunFolder& run) {
  std::string out = "<section><h2>What was run</h2>";
  const auto fold = [&](const char* title, const std::string& text) {
    if (!text.empty())
      out += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>", title, escaped(text));
  };
  fold("The resolved case", run.case_text);
  if (!run.summary.is_null()) fold("summary.json", run.summary.dump(2));
  fold("The end of the log", run.log_end);
  return out + "</section>";
}

}  // namespace livebed::report
