#include "report/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "base/fault.hpp"
#include "base/version.hpp"
#include "io/table.hpp"

namespace livebed::report {

using nlohmann::ordered_json;

namespace {

ordered_json read_summary(const io::Path& folder) {
  const io::Path file = folder / "summary.json";
  if (!std::filesystem::exists(file)) return nullptr;
  ordered_json summary = ordered_json::parse(io::read_file(file), nullptr, false);
  if (!summary.is_object()) base::fail(base::Exit::input_output, "{} is not valid JSON", file.string());
  return summary;
}

std::optional<double> number_of(const ordered_json& object, const char* name) {
  if (!object.is_object() || !object.contains(name) || !object[name].is_number()) return {};
  return object[name].get<double>();
}

RunState state_of(const io::Path& folder, const ordered_json& summary) {
  if (!std::filesystem::exists(folder)) return RunState::waiting;
  const std::string ended = summary.is_object() ? summary.value("ended", "") : "";
  return ended == "end of time" || ended == "equilibrium" ? RunState::ended : RunState::unfinished;
}

std::optional<double> mean_of_second_half(const std::vector<double>& t, const std::vector<double>& f) {
  double sum = 0;
  int count = 0;
  for (std::size_t n = 0; n < t.size(); ++n)
    if (2 * t[n] >= t.back()) sum += f[n], ++count;
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

std::optional<double> largest(const std::vector<double>& f) {
  if (f.empty()) return {};
  return std::abs(*std::max_element(f.begin(), f.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
}

/// A value as JSON: a number or true and false where it is one.
ordered_json as_json(const std::string& text) {
  const ordered_json value = ordered_json::parse(text, nullptr, false);
  return value.is_number() || value.is_boolean() ? value : ordered_json(text);
}

/// A cell that may hold a comma.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

ordered_json or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

}  // namespace

const char* word_of(RunState state) {
  return state == RunState::ended ? "ended" : state == RunState::unfinished ? "unfinished" : "waiting";
}

RunState state_of(const io::Path& folder) { return state_of(folder, read_summary(folder)); }

RunNumbers read_numbers(const io::Path& folder) {
  const ordered_json summary = read_summary(folder);
  RunNumbers run;
  run.state = state_of(folder, summary);
  if (summary.is_object()) run.ended = summary.value("ended", "");
  io::Table series;
  if (std::filesystem::exists(folder / "series.csv")) {
    series = io::read_table(folder / "series.csv");
    run.time = series.column("time_s");
    run.S_over_D = series.column("S_over_D");
  }
  run.time_scale = number_of(summary, "time_scale_s").value_or(0);
  const ordered_json fit = summary.is_object() ? summary.value("fit", ordered_json()) : ordered_json();
  const auto column = [&](const char* name) { return run.time.empty() ? std::vector<double>{} : series.column(name); };
  const std::vector<double> drag = column("drag_N_m"), lift = column("lift_N_m");
  run.values = {number_of(summary, "S_eq_over_D"),
                number_of(summary, "T_s"),
                number_of(fit, "S_eq_over_D"),
                number_of(fit, "T_s"),
                number_of(summary, "scour_depth_over_D"),
                number_of(summary, "theta_measured"),
                mean_of_second_half(run.time, drag),
                mean_of_second_half(run.time, lift),
                largest(drag),
                largest(lift),
                number_of(summary, "wall_s")};
  static_assert(std::size(sweep_quantities) == 11);
  return run;
}

Spread spread_of(const std::vector<std::optional<double>>& values) {
  Spread s;
  for (const auto& value : values) {
    if (!value) continue;
    s.least = s.n == 0 ? *value : std::min(s.least, *value);
    s.most = s.n == 0 ? *value : std::max(s.most, *value);
    s.mean += *value;
    ++s.n;
  }
  if (s.n == 0) return s;
  s.mean /= s.n;
  double squares = 0;
  for (const auto& value : values)
    if (value) squares += (*value - s.mean) * (*value - s.mean);
  s.sd = s.n > 1 ? std::sqrt(squares / (s.n - 1)) : 0;
  return s;
}

Sweep gather(SweepPlan plan) {
  Sweep sweep{std::move(plan), {}, {}};
  for (const SweepRun& run : sweep.plan.runs) sweep.runs.push_back(read_numbers(run.folder));
  for (std::size_t c = 0; c < sweep.plan.combinations.size(); ++c) {
    std::vector<Spread>& spreads = sweep.spreads.emplace_back();
    for (std::size_t q = 0; q < std::size(sweep_quantities); ++q) {
      std::vector<std::optional<double>> values;
      for (std::size_t r = 0; r < sweep.runs.size(); ++r)
        if (sweep.plan.runs[r].combination == c && sweep.runs[r].state == RunState::ended)
          values.push_back(sweep.runs[r].values[q]);
      spreads.push_back(spread_of(values));
    }
  }
  return sweep;
}

std::string sweep_csv(const Sweep& sweep) {
  std::string out;
  for (const std::string& column : sweep.plan.columns) out += column + ",";
  out += "runs,ended";
  for (const char* quantity : sweep_quantities)
    for (const char* what : {"n", "mean", "sd", "min", "max"}) out += fmt::format(",{}_{}", quantity, what);
  out += '\n';
  for (std::size_t c = 0; c < sweep.plan.combinations.size(); ++c) {
    for (const std::string& value : sweep.plan.combinations[c]) out += cell(value) + ",";
    int asked = 0, ended = 0;
    for (std::size_t r = 0; r < sweep.runs.size(); ++r) {
      if (sweep.plan.runs[r].combination != c) continue;
      ++asked;
      ended += sweep.runs[r].state == RunState::ended;
    }
    out += fmt::format("{},{}", asked, ended);
    for (const Spread& s : sweep.spreads[c]) {
      out += s.n > 0 ? fmt::format(",{},{}", s.n, s.mean) : ",0,";
      out += s.n > 1 ? fmt::format(",{}", s.sd) : ",";
      out += s.n > 0 ? fmt::format(",{},{}", s.least, s.most) : ",,";
    }
    out += '\n';
  }
  return out;
}

ordered_json sweep_json(const Sweep& sweep) {
  ordered_json combinations = ordered_json::array();
  for (std::size_t c = 0; c < sweep.plan.combinations.size(); ++c) {
    ordered_json values = ordered_json::object(), runs = ordered_json::array(), result;
    for (std::size_t k = 0; k < sweep.plan.columns.size(); ++k)
      values[sweep.plan.columns[k]] = as_json(sweep.plan.combinations[c][k]);
    for (std::size_t r = 0; r < sweep.runs.size(); ++r) {
      const SweepRun& asked = sweep.plan.runs[r];
      if (asked.combination != c) continue;
      ordered_json run = {
          {"name", asked.name},
          {"folder", asked.folder.string()},
          {"seed", asked.seed},
          {"state", asked.fault.empty() ? word_of(sweep.runs[r].state) : "failed"},
          {"ended", sweep.runs[r].ended.empty() ? ordered_json(nullptr) : ordered_json(sweep.runs[r].ended)}};
      if (!asked.fault.empty()) run["fault"] = asked.fault;
      for (std::size_t q = 0; q < std::size(sweep_quantities); ++q)
        run[sweep_quantities[q]] = or_null(sweep.runs[r].values[q]);
      runs.push_back(run);
    }
    result["values"] = values;
    for (std::size_t q = 0; q < std::size(sweep_quantities); ++q) {
      const Spread& s = sweep.spreads[c][q];
      const auto told = [&](bool there, double value) { return there ? std::optional(value) : std::nullopt; };
      result[sweep_quantities[q]] = {{"n", s.n},
                                     {"mean", or_null(told(s.n > 0, s.mean))},
                                     {"sd", or_null(told(s.n > 1, s.sd))},
                                     {"min", or_null(told(s.n > 0, s.least))},
                                     {"max", or_null(told(s.n > 0, s.most))}};
    }
    result["runs"] = runs;
    combinations.push_back(result);
  }
  return {{"title", sweep.plan.title},
          {"commit", base::commit()},
          {"version", base::version()},
          {"columns", sweep.plan.columns},
          {"combinations", combinations}};
}

void write_sweep(const Sweep& sweep, const io::Path& folder) {
  io::write_atomically(folder / "sweep.csv", sweep_csv(sweep));
  io::write_atomically(folder / "sweep.json", sweep_json(sweep).dump(2) + "\n");
  io::write_atomically(folder / "sweep.html", sweep_page(sweep));
}

}  // namespace livebed::report
