#include "report/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/curves.hpp"
#include "base/math.hpp"
#include "base/sediment.hpp"
#include "base/spectrum.hpp"
#include "report/references.hpp"

namespace livebed::report {

namespace {

using nlohmann::ordered_json;

constexpr double steady_change = 0.02, steady_window = 2;  ///< as time.equilibrium_* by default: S/D, T
constexpr double normal_95 = 1.96;

/// Mean of S over the `window` that ends at each time.
std::vector<double> smoothed(const std::vector<double>& t, const std::vector<double>& S, double window) {
  std::vector<double> means(t.size());
  double sum = 0;
  for (std::size_t n = 0, first = 0; n < t.size(); ++n) {
    sum += S[n];
    while (t[first] < t[n] - window) sum -= S[first++];
    means[n] = sum / static_cast<double>(n - first + 1);
  }
  return means;
}

/// The first time after which `holds` is true to the end of the record.
template <class Holds>
std::optional<std::size_t> for_good(std::size_t count, Holds&& holds) {
  std::size_t first = count;
  while (first > 0 && holds(first - 1)) --first;
  return first < count ? std::optional(first) : std::nullopt;
}

/// Numbers that JSON has no word for become null.
ordered_json numbers(const std::vector<double>& values) {
  ordered_json all = ordered_json::array();
  for (double v : values) all.push_back(std::isfinite(v) ? ordered_json(v) : ordered_json(nullptr));
  return all;
}

std::vector<double> scaled(std::vector<double> values, double by) {
  for (double& v : values) v *= by;
  return values;
}

ordered_json told(const char* name, const std::optional<base::Comparison>& c) {
  return {{"name", name}, {"points", c->points}, {"rms", c->rms}, {"bias", c->bias}, {"skill", c->skill}};
}

/// How near the run is to Mao's points, in t/T; empty when it is another case.
ordered_json comparisons(const RunFolder& run) {
  ordered_json all = ordered_json::array();
  if (!is_maos_case(run) || !run.series || !run.time_scale) return all;
  const double T = *run.time_scale;
  const io::Table depth = io::parse_table(mao_depth, "data/mao1986_livebed_depth.csv");
  const auto c = base::compare(scaled(run.series->column("time_s"), 1 / T), run.series->column("S_over_D"),
                               scaled(depth.column("t_s"), 1 / mao_time_scale), depth.column("S_over_D"), 0);
  if (c) all.push_back(told("S/D against Mao (1986), in t/T", c));
  if (!run.bed) return all;
  const io::Table profiles = io::parse_table(mao_profiles, "data/mao1986_livebed_profiles.csv");
  for (double at : mao_profile_times) {
    const double t = at / mao_time_scale * T;
    if (t > 1.02 * run.bed->time.back()) continue;
    std::vector<double> x, y, x_mao, y_mao;
    const BedLine line = run.bed->nearest(t);
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      x.push_back((line.x[i] - run.pipe->x) / run.pipe->diameter);
      y.push_back((line.y[i] - run.original_level()) / run.pipe->diameter);
    }
    for (std::size_t n = 0; n < profiles.rows(); ++n)
      if (profiles.column("t_s")[n] == at)
        x_mao.push_back(profiles.column("x_D")[n]), y_mao.push_back(profiles.column("y_bed_D")[n]);
    const auto p = base::compare(x, y, x_mao, y_mao, 0);
    if (p) all.push_back(told(fmt::format("bed line against Mao's at t/T = {:.2f}", at / mao_time_scale).c_str(), p));
  }
  return all;
}

ordered_json fit_of(const RunFolder& run) {
  const auto fit = base::fit_approach(run.series->column("time_s"), run.series->column("S_over_D"));
  if (!fit) return nullptr;
  const double S = normal_95 * fit->error_S_eq * fit->correlation, T = normal_95 * fit->error_T * fit->correlation;
  return {
      {"S_eq_over_D", fit->S_eq}, {"S_eq_half_width", S}, {"T_s", fit->T}, {"T_half_width_s", T}, {"rms", fit->rms}};
}

/// Spectrum of the lift after the first quarter, in which the hole is dug.
ordered_json spectrum_of(const RunFolder& run) {
  const std::vector<double>&t = run.series->column("time_s"), &lift = run.series->column("lift_N_m");
  if (!run.pipe || run.mean_speed <= 0 || t.back() <= 0) return nullptr;
  const auto from = std::lower_bound(t.begin(), t.end(), 0.25 * t.back()) - t.begin();
  const std::vector<double> times(t.begin() + from, t.end()), signal(lift.begin() + from, lift.end());
  const double turnover = run.pipe->diameter / run.mean_speed;
  if (times.size() < 32 || times.back() - times.front() < 5 * turnover) return nullptr;
  const double rate = static_cast<double>(times.size() - 1) / (times.back() - times.front());
  const base::Spectrum s = base::power_spectrum(times, signal, std::min(1 / turnover, 0.5 * rate));
  const double peak = base::peak_frequency(s);
  double near = 0, all = 0;
  for (std::size_t n = 0; n < s.power.size(); ++n) {
    all += s.power[n];
    if (std::abs(s.frequency[n] - peak) < 0.2 * peak) near += s.power[n];
  }
  return {{"frequency_Hz", numbers(s.frequency)},
          {"power", numbers(s.power)},
          {"from_s", times.front()},
          {"peak_Hz", peak},
          {"strouhal", peak * turnover},
          {"share_at_peak", all > 0 ? near / all : 0},
          {"speed_m_s", run.mean_speed}};
}

/// Sand dug out of the original bed and laid on it, areas over D^2.
ordered_json sand_budget(const RunFolder& run) {
  std::vector<double> eroded, deposited;
  const double level = run.original_level(), D = run.pipe ? run.pipe->diameter : 1;
  const double h = run.bed->x.size() > 1 ? run.bed->x[1] - run.bed->x[0] : 0;
  for (const std::vector<double>& line : run.bed->y) {
    double below = 0, above = 0;
    for (double y : line) below += std::max(0.0, level - y), above += std::max(0.0, y - level);
    eroded.push_back(below * h / base::square(D));
    deposited.push_back(above * h / base::square(D));
  }
  return {{"time_s", numbers(run.bed->time)}, {"eroded", numbers(eroded)}, {"deposited", numbers(deposited)}};
}

ordered_json shear_of(const RunFolder& run, const NearBed& near_bed) {
  const NearBed::Shear s = near_bed.shear(run);
  return {{"from_s", s.from},
          {"to_s", s.to},
          {"frames", s.frames},
          {"x_m", numbers(s.x)},
          {"on_sand_Pa", numbers(s.on_sand)},
          {"in_water_Pa", numbers(s.in_water)},
          {"upstream_on_sand_Pa", s.upstream_on_sand},
          {"upstream_in_water_Pa", s.upstream_in_water}};
}

/// What is known of pipes in a live bed, to hold the run against.
ordered_json formulas(const RunFolder& run) {
  if (!run.pipe) return nullptr;
  const double gap = (run.pipe->y - run.original_level()) / run.pipe->diameter - 0.5;
  ordered_json all = ordered_json::array();
  if (const auto depth = base::equilibrium_depth(gap)) {
    all.push_back({{"name", fmt::format("{} ({})", depth->formula, depth->source)}, {"S_eq_over_D", depth->over_D}});
    if (depth->scatter > 0) all.back()["scatter"] = depth->scatter;
  }
  if (run.time_scale)
    all.push_back(
        {{"name", "T = D² θ^(-5/3) / (50 √(g(s-1)d³)) (Fredsøe, Sumer and Arnskov 1992)"}, {"T_s", *run.time_scale}});
  return all;
}

}  // namespace

std::vector<ScourStage> find_stages(const std::vector<double>& t, const std::vector<double>& S,
                                    const std::vector<double>& under, double T, double d_over_D) {
  std::vector<ScourStage> found;
  const auto onset = for_good(t.size(), [&](std::size_t n) { return under[n] >= d_over_D; });
  if (!onset) return found;
  found.push_back({"onset", t[*onset], "the bed under the pipe's centre has fallen by a grain for good"});
  const auto tunnel = for_good(t.size(), [&](std::size_t n) { return under[n] >= 0.1; });
  if (!tunnel) return found;
  found.push_back({"tunnel erosion", t[*tunnel], "a gap of 0.1 D under the pipe's centre"});

  const std::vector<double> S_fast = smoothed(t, S, 0.2 * T);
  std::vector<double> rate(t.size());
  for (std::size_t n = 0, before = 0; n < t.size(); ++n) {
    while (t[before] < t[n] - 0.2 * T) ++before;
    rate[n] = before < n ? (S_fast[n] - S_fast[before]) / (t[n] - t[before]) : 0;
  }
  const auto fastest = std::max_element(rate.begin(), rate.end()) - rate.begin();
  for (std::size_t n = std::max<std::size_t>(fastest, *tunnel); n < t.size(); ++n)
    if (rate[n] < 0.2 * rate[fastest]) {
      found.push_back({"lee-wake erosion", t[n], "the hole deepens at less than a fifth of its fastest"});
      break;
    }
  const auto steady = base::equilibrium(t, S, steady_window * T, steady_change);
  if (!steady) return found;
  const std::vector<double> S_slow = smoothed(t, S, 0.5 * T);
  const auto reached =
      for_good(t.size(), [&](std::size_t n) { return std::abs(S_slow[n] - *steady) < 0.05 * std::abs(*steady); });
  if (reached && t[*reached] > found.back().begins)
    found.push_back({"equilibrium", t[*reached], "S has come within 5 % of its steady value for good"});
  return found;
}

bool is_maos_case(const RunFolder& run) {
  if (!run.pipe || !run.time_scale) return false;
  const double D = run.pipe->diameter, gap = (run.pipe->y - run.original_level()) / D - 0.5;
  return std::abs(D / 0.05 - 1) < 0.02 && std::abs(gap) < 0.1 && std::abs(run.theta / 0.33 - 1) < 0.05;
}

ordered_json analyse(const RunFolder& run, const NearBed& near_bed) {
  ordered_json all;
  if (run.series && run.pipe && run.time_scale) {
    const std::vector<double>&t = run.series->column("time_s"), &S = run.series->column("S_over_D");
    all["fit"] = fit_of(run);
    const auto steady = base::equilibrium(t, S, steady_window * *run.time_scale, steady_change);
    all["S_eq_over_D"] = steady ? ordered_json(*steady) : ordered_json(nullptr);
    all["stages"] = ordered_json::array();
    for (const ScourStage& s : find_stages(t, S, run.series->column("depth_under_pipe_over_D"), *run.time_scale,
                                           run.grain_diameter / run.pipe->diameter))
      all["stages"].push_back({{"name", s.name}, {"t_s", s.begins}, {"rule", s.rule}});
    all["spectrum"] = spectrum_of(run);
    all["comparisons"] = comparisons(run);
  }
  all["formulas"] = formulas(run);
  if (run.bed) all["sand"] = sand_budget(run);
  if (!near_bed.empty()) all["shear"] = shear_of(run, near_bed);
  return all;
}

}  // namespace livebed::report
