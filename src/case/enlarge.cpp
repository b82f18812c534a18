#include "case/enlarge.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/sediment.hpp"
#include "case/check.hpp"

namespace livebed::casefile {

namespace {

/// The sieve curve of a case with other diameters.
std::string scaled_grading(const Case& c, double factor) {
  std::string text;
  for (const grains::SievePoint& point : c.grains.grading)
    text += fmt::format("{}{:.6g} m: {:.6g}", text.empty() ? "" : ", ", factor * point.diameter, point.passing);
  return text;
}

}  // namespace

std::vector<std::string> enlarging(const Case& c, double factor) {
  std::vector<std::string> all;
  const auto set = [&](const char* key, double value) { all.push_back(fmt::format("{}={:.6g}", key, value)); };
  const flow::Params& f = c.flow;
  if (c.is_given("grains.d50")) {
    set("grains.d10", factor * c.d10), set("grains.d50", factor * c.d50), set("grains.d90", factor * c.d90);
  } else if (c.is_given("grains.grading")) {
    all.push_back("grains.grading=" + scaled_grading(c, factor));
  } else {
    set("grains.diameter", factor * c.grains.diameter);
  }
  if (c.is_given("bed.count")) all.push_back(fmt::format("bed.count={:.0f}", c.grains.count / (factor * factor)));
  const double widest = f.pipe.present ? f.pipe.diameter / (1.25 * least_cells_across_pipe) : f.mesh.height / 10;
  set("mesh.cell_x", std::max(f.mesh.cell_x, std::min(factor * f.mesh.cell_x, widest)));
  set("mesh.cell_y", std::max(f.mesh.cell_y, std::min(factor * f.mesh.cell_y, widest)));
  set("current.theta", c.theta);
  set("time.grain_step", std::sqrt(factor) * c.grains.step);
  set("time.spin_up", c.time.spin_up / std::sqrt(factor));
  // Scour slows down with d^(-3/2) at the same theta (base::scour_time_scale), a flat bed with the current.
  const double times = c.time_scale > 0 ? std::pow(factor, -1.5) : 1 / std::sqrt(factor);
  set("time.end", times * c.time.end);
  set("output.series_every", times * c.output.series_every);
  set("output.bed_every", times * c.output.bed_every);
  set("output.fields_every", times * c.output.fields_every);
  set("output.checkpoint_every", times * c.output.checkpoint_every);
  return all;
}

}  // namespace livebed::casefile
