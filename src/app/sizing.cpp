#include "app/sizing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "case/enlarge.hpp"
#include "case/read.hpp"
#include "case/schema.hpp"

namespace livebed::app {
namespace {

/// Larger models are timed with larger grains: a look at the machine should take seconds.
constexpr double most_grains_to_time = 20'000, most_cells_to_time = 60'000;
/// A question is not made a case with finer grains than this [D]: 25 million of them, out of anybody's reach.
constexpr double finest_case = 1e-3;

std::string key_of(const std::string& setting) { return setting.substr(0, setting.find('=')); }

/// Are two keys the same, or ways to say the same?
bool stands_for(const std::string& a, const std::string& b) {
  if (a == b) return true;
  for (const casefile::Alternatives& group : casefile::alternatives()) {
    const auto has = [&](const std::string& key) {
      return std::find(group.keys.begin(), group.keys.end(), key) != group.keys.end();
    };
    if (has(a) && has(b)) return true;
  }
  return false;
}

/// Round sizes: the smallest of them above a size.
double next_size(double d) {
  constexpr std::array<double, 11> series{1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
  const double decade = std::pow(10, std::floor(std::log10(d)));
  for (double n : series)
    if (n * decade > d * 1.001) return n * decade;
  return 12 * decade;
}

Size finest_with(const run::Speeds& speeds, double hours, const Sizable& what) {
  Size size{what.sand, predict(what.work, speeds), false};
  for (double d = what.sand; size.prediction.wall() > 3600 * hours;) {
    d = next_size(d);
    if (d > what.coarsest) return size;
    if (d < what.finest) continue;
    size = {d, predict(run::work_of(what.at(d)), speeds), false};
  }
  size.fits = true;
  return size;
}

}  // namespace

Sizable sizable(const casefile::Question& question) {
  Sizable s;
  s.sand = question.sand;
  s.finest = std::max(question.sand, finest_case * question.pipe);
  s.coarsest = casefile::coarsest_grain * question.pipe;
  s.at = [question](double d) {
    return casefile::read_text(casefile::case_text(question, d), "the case of the question");
  };
  s.work = run::work_of(s.at(s.finest)).scaled(std::pow(s.finest / s.sand, 2));
  return s;
}

Sizable sizable(const CaseOptions& which) {
  const casefile::Case c = which.read();
  Sizable s;
  s.sand = s.finest = c.grains.diameter;
  s.coarsest = c.flow.pipe.present ? casefile::coarsest_grain * c.flow.pipe.diameter : 0.1 * c.bed_thickness;
  s.at = [which, c](double d) {
    if (d == c.grains.diameter) return c;
    CaseOptions other = which;
    const std::vector<std::string> larger = casefile::enlarging(c, d / c.grains.diameter);
    for (const std::string& setting : larger)
      std::erase_if(other.overrides,
                    [&](const std::string& given) { return stands_for(key_of(setting), key_of(given)); });
    other.overrides.insert(other.overrides.end(), larger.begin(), larger.end());
    return other.read();
  };
  s.work = run::work_of(c);
  return s;
}

run::Speeds time_on_this_machine(const Sizable& what, double budget) {
  const double factor =
      std::sqrt(std::max({1.0, what.work.grains / most_grains_to_time, what.work.cells / most_cells_to_time}));
  const double d = std::min(factor * what.sand, std::max(what.coarsest, what.finest));
  return run::time_model(what.at(d), budget);
}

Size finest_within(double hours, const Sizable& what, run::Speeds speeds, double budget) {
  const Size size = finest_with(speeds, hours, what);
  const double grains = run::work_of(what.at(std::max(size.d, what.finest))).grains;
  constexpr double alike = 2;
  const bool other = grains > alike * speeds.grains || alike * grains < speeds.grains;
  return other && grains <= most_grains_to_time ? finest_with(run::time_model(what.at(size.d), budget), hours, what)
                                                : size;
}

std::string spoken(double s) {
  if (s < 120) return fmt::format("{:.2g} s", s);
  if (s < 7200) return fmt::format("{:.2g} min", s / 60);
  if (s < 48 * 3600) return fmt::format("{:.2g} h", s / 3600);
  if (s < 2 * 365 * 86400.0) return fmt::format("{:.3g} days", s / 86400);
  return fmt::format("{:.0f} years", s / (365.25 * 86400));
}

}  // namespace livebed::app
