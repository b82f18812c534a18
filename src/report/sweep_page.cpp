#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <limits>
#include <numeric>

#include "base/curves.hpp"
#include "report/chart.hpp"
#include "report/page.hpp"
#include "report/sweep.hpp"

namespace livebed::report {

namespace {

constexpr int points_of_a_curve = 300;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t S_eq = 0, depth = 4;  ///< in sweep_quantities

std::string colour(std::size_t n) { return fmt::format("var(--c{})", n % 6); }

/// "theta = 0.2, seed = 1" of a combination; a sweep of seeds alone has no words for it.
std::string label_of(const SweepPlan& plan, std::size_t c) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < plan.columns.size(); ++k)
    parts.push_back(fmt::format("{} = {}", plan.columns[k], plan.combinations[c][k]));
  return parts.empty() ? plan.title : fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::size_t> runs_of(const Sweep& sweep, std::size_t combination) {
  std::vector<std::size_t> runs;
  for (std::size_t r = 0; r < sweep.runs.size(); ++r)
    if (sweep.plan.runs[r].combination == combination && sweep.runs[r].time.size() > 1) runs.push_back(r);
  return runs;
}

/// S/D of every seed against t/T (t where a run has no time scale), and mean and band as far as all of them have come.
Chart depth_chart(const Sweep& sweep, const std::vector<std::size_t>& runs) {
  const bool scaled =
      std::all_of(runs.begin(), runs.end(), [&](std::size_t r) { return sweep.runs[r].time_scale > 0; });
  Chart chart;
  chart.x.name = scaled ? "t/T" : "t [s]";
  chart.y.name = "S/D";
  std::vector<std::vector<double>> times;
  double shared = std::numeric_limits<double>::infinity();
  for (std::size_t r : runs) {
    const RunNumbers& run = sweep.runs[r];
    std::vector<double>& t = times.emplace_back(run.time);
    for (double& value : t) value /= scaled ? run.time_scale : 1.0;
    shared = std::min(shared, t.back());
    chart.curves.push_back({"", "var(--c5)", t, run.S_over_D});
  }
  if (runs.size() < 2) {
    if (!chart.curves.empty()) chart.curves[0].name = fmt::format("seed {}", sweep.plan.runs[runs[0]].seed);
    return chart;
  }
  chart.curves[0].name = "one seed each";
  Curve mean{fmt::format("mean of {} seeds", runs.size()), "var(--c0)", {}, {}};
  Band band{"from the least to the most", "var(--c0)", {}, {}, {}};
  for (int n = 0; n <= points_of_a_curve; ++n) {
    const double t = shared * n / points_of_a_curve;
    std::vector<std::optional<double>> values;
    for (std::size_t k = 0; k < runs.size(); ++k)
      values.push_back(base::interpolate(times[k], sweep.runs[runs[k]].S_over_D, t));
    const Spread s = spread_of(values);
    mean.x.push_back(t), mean.y.push_back(s.mean);
    band.x.push_back(t), band.low.push_back(s.least), band.high.push_back(s.most);
  }
  chart.curves.push_back(std::move(mean));
  chart.bands.push_back(std::move(band));
  return chart;
}

/// Where the values of a swept key stand on an axis.
struct Places {
  std::vector<double> x;           ///< [combinations]
  std::vector<std::string> words;  ///< at 0, 1, ... when the values are no numbers
};
Places places_of(const SweepPlan& plan, std::size_t key) {
  Places places;
  for (const auto& values : plan.combinations) {
    const std::string& text = values[key];
    double x = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    places.x.push_back(error == std::errc{} && stop == text.data() + text.size() ? x : nan);
  }
  if (std::none_of(places.x.begin(), places.x.end(), [](double x) { return std::isnan(x); })) return places;
  for (std::size_t c = 0; c < plan.combinations.size(); ++c) {
    const std::string& text = plan.combinations[c][key];
    const auto found = std::find(places.words.begin(), places.words.end(), text);
    places.x[c] = static_cast<double>(found - places.words.begin());
    if (found == places.words.end()) places.words.push_back(text);
  }
  return places;
}

/// S_eq/D and the depth at the end against one key, a colour for each combination of the other keys.
Chart key_chart(const Sweep& sweep, std::size_t key) {
  const SweepPlan& plan = sweep.plan;
  const Places places = places_of(plan, key);
  Chart chart;
  chart.x.name = plan.columns[key];
  chart.x.words = places.words;
  chart.y.name = "S/D";
  std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;  // of equal other keys
  for (std::size_t c = 0; c < plan.combinations.size(); ++c) {
    std::vector<std::string> others;
    for (std::size_t k = 0; k < plan.columns.size(); ++k)
      if (k != key) others.push_back(fmt::format("{} = {}", plan.columns[k], plan.combinations[c][k]));
    const std::string name = others.empty() ? "" : fmt::format(", {}", fmt::join(others, ", "));
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == name; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->second.push_back(c);
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    auto& [name, members] = groups[g];
    std::sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) { return places.x[a] < places.x[b]; });
    Curve steady{"S_eq/D" + name, colour(g), {}, {}};
    Curve end{"S/D at the end" + name, colour(g), {}, {}, false, true};
    Curve seeds{g == 0 ? "S_eq/D of one seed" : "", colour(g), {}, {}, true};
    Band band{g == 0 ? "from the least to the most" : "", colour(g), {}, {}, {}};
    for (std::size_t c : members) {
      const Spread &s = sweep.spreads[c][S_eq], &last = sweep.spreads[c][depth];
      if (last.n > 0) end.x.push_back(places.x[c]), end.y.push_back(last.mean);
      if (s.n == 0) continue;
      steady.x.push_back(places.x[c]), steady.y.push_back(s.mean);
      band.x.push_back(places.x[c]), band.low.push_back(s.least), band.high.push_back(s.most);
      for (std::size_t r : runs_of(sweep, c))
        if (const auto& value = sweep.runs[r].values[S_eq]; value && sweep.runs[r].state == RunState::ended)
          seeds.x.push_back(places.x[c]), seeds.y.push_back(*value);
    }
    chart.curves.push_back(std::move(end));
    chart.bands.push_back(std::move(band));
    if (steady.x.empty()) continue;
    chart.curves.push_back(std::move(steady));
    chart.curves.push_back(std::move(seeds));
  }
  return chart;
}

std::string figure(const std::string& title, const Chart& chart, const std::string& note) {
  return fmt::format(
      "<figure><figcaption><h3>{}</h3></figcaption><div class=\"plot\">{}</div><p class=\"note\">{}</p></figure>\n",
      escaped(title), svg(chart), escaped(note));
}

std::string table(const Sweep& sweep) {
  std::string out = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& column : sweep.plan.columns) out += fmt::format("<th>{}</th>", escaped(column));
  out += "<th>ended</th>";
  for (const char* quantity : sweep_quantities) out += fmt::format("<th>{}</th>", quantity);
  out += "</tr></thead><tbody>\n";
  for (std::size_t c = 0; c < sweep.plan.combinations.size(); ++c) {
    std::size_t asked = 0, ended = 0;
    for (std::size_t r = 0; r < sweep.runs.size(); ++r)
      if (sweep.plan.runs[r].combination == c) ++asked, ended += sweep.runs[r].state == RunState::ended;
    out += "<tr>";
    for (const std::string& value : sweep.plan.combinations[c]) out += fmt::format("<td>{}</td>", escaped(value));
    out += fmt::format("<td>{} of {}</td>", ended, asked);
    for (const Spread& s : sweep.spreads[c]) {
      const std::string told = s.n == 0   ? "not reached"
                               : s.n == 1 ? fmt::format("{:.4g}", s.mean)
                                          : fmt::format("{:.4g} ± {:.2g}", s.mean, s.sd);
      const std::string of =
          s.n > 0 && static_cast<std::size_t>(s.n) < ended ? fmt::format(" ({} of {})", s.n, ended) : "";
      out += fmt::format("<td>{}{}</td>", ended == 0 ? "–" : told, of);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

/// What is not there, so that nobody takes a mean of some for a mean of all.
std::string missing(const Sweep& sweep) {
  std::string items;
  for (std::size_t r = 0; r < sweep.runs.size(); ++r) {
    const SweepRun& run = sweep.plan.runs[r];
    if (!run.fault.empty())
      items += fmt::format("<li>{} failed: {}</li>", escaped(run.name), escaped(run.fault));
    else if (sweep.runs[r].state != RunState::ended)
      items += fmt::format("<li>{} is {}</li>", escaped(run.name),
                           sweep.runs[r].state == RunState::waiting ? "not begun" : "not finished");
    else if (!sweep.runs[r].values[S_eq])
      items += fmt::format("<li>{} ended before S/D was steady: it tells no S_eq and no T</li>", escaped(run.name));
  }
  return items.empty() ? "" : fmt::format("<div class=\"missing\">Not in the means:<ul>{}</ul></div>\n", items);
}

}  // namespace

std::string sweep_page(const Sweep& sweep) {
  std::string body = fmt::format("<h1>Sweep: {}</h1>\n{}<h2>Mean ± standard deviation over seeds</h2>\n{}",
                                 escaped(sweep.plan.title), missing(sweep), table(sweep));
  body +=
      "<p class=\"note\">Forces: a metre of pipe, water and grains; means over the second half of the series. The fit "
      "is "
      "S_eq (1 − exp(−t/T)), which also tells where a run was going that has not become steady.</p>\n";
  std::string keys;
  for (std::size_t k = 0; k < sweep.plan.columns.size(); ++k) {
    const bool varies = std::any_of(sweep.plan.combinations.begin(), sweep.plan.combinations.end(),
                                    [&](const auto& values) { return values[k] != sweep.plan.combinations[0][k]; });
    if (varies)
      keys += figure("Depth against " + sweep.plan.columns[k], key_chart(sweep, k),
                     "S_eq: only of seeds that became steady; the depth at the end is that of all that ended.");
  }
  if (!keys.empty()) body += "<h2>Depth against the swept keys</h2>\n<div class=\"grid\">" + keys + "</div>\n";
  body += "<h2>Depth in time</h2>\n<div class=\"grid\">\n";
  for (std::size_t c = 0; c < sweep.plan.combinations.size(); ++c) {
    const std::vector<std::size_t> runs = runs_of(sweep, c);
    const Chart chart = depth_chart(sweep, runs);
    body += figure(label_of(sweep.plan, c), chart,
                   runs.empty() ? "No run has written anything yet." : "Mean and band end with the shortest run.");
  }
  body += "</div>\n";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><link rel=\"icon\" href=\"data:,\"><title>{}</title><style>{}\n"
      ".chart text {{ font-size: 12px; fill: var(--ink); }} .axis path {{ stroke: var(--rule); }} .axis rect {{ fill: "
      "none; stroke: var(--dim); }} td, th {{ white-space: nowrap; "
      "}}</style></head><body><main>{}</main></body></html>\n",
      escaped("Sweep: " + sweep.plan.title), page_style, body);
}

}  // namespace livebed::report
