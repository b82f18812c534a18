#include "validate/oner_figures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/math.hpp"
#include "base/spectrum.hpp"
#include "validate/contours.hpp"
#include "validate/picture.hpp"

namespace livebed::validate {

namespace {

const char *above_colour = "#1f77b4", *below_colour = "#d62728", *water = "#4a7fb0", *ink = "#222222";

/// Streamlines of the window.  Levels lie close about that of the pipe's surface, where the eddies are, and further
/// apart in the stream: psi_pipe +- 0.012 n^2 U0 D.
report::Chart streamlines(const Drawn& drawn, const std::vector<double>& psi, int width) {
  constexpr double step = 0.012, tolerance = 0.006;
  constexpr int levels = 18;
  const PipeRun& run = *drawn.run;
  const double centre = drawn.gap_ratio + 0.5;
  report::Chart chart{{"x/D", window_from, window_to}, {"y/D", 0, window_height}, {}, width, 0, true};
  // On the axis inside the pipe the stream function is that of its surface.
  const auto i =
      static_cast<std::size_t>(std::lower_bound(run.window_x.begin(), run.window_x.end(), 0.0) - run.window_x.begin());
  const auto j = static_cast<std::size_t>(std::lower_bound(run.window_y.begin(), run.window_y.end(), centre) -
                                          run.window_y.begin());
  const double surface = psi[j * run.window_x.size() + i];
  for (int n = -levels; n <= levels; ++n) {
    if (n == 0) continue;
    const double level = surface + step * n * std::abs(n);
    for (const Line& line : contour_lines(run.window_x, run.window_y, psi, level, tolerance))
      chart.curves.push_back({"", water, line.x, line.y});
  }
  report::Curve pipe{"", ink, {}, {}};
  for (int k = 0; k <= 48; ++k)
    pipe.x.push_back(0.5 * std::cos(k * base::pi / 24)), pipe.y.push_back(centre + 0.5 * std::sin(k * base::pi / 24));
  chart.curves.push_back(pipe);
  return chart;
}

}  // namespace

std::string figure_profiles(const std::vector<Drawn>& runs) {
  std::vector<Panel> all;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    Panel panel{fmt::format("x/D = {}", sections[k]), {{"U/U0", -0.6, 2.0}, {"y/D", 0, box_depth}, {}, 300, 320}};
    for (const Drawn& d : runs)
      panel.chart.curves.push_back({d.label, d.colour, d.run->section_u[k], d.run->section_y, false, d.dashed});
    all.push_back(panel);
  }
  return panels(all, 3);
}

std::string figure_mean_streamlines(const std::vector<Drawn>& runs) {
  std::vector<Panel> all;
  for (const Drawn& d : runs) all.push_back({d.label, streamlines(d, d.run->psi_mean, 640)});
  return panels(all, 1);
}

std::string figure_snapshots(const Drawn& run) {
  std::vector<Panel> all;
  for (int k = 0; k < snapshots; ++k)
    all.push_back({fmt::format("t + {:.1f} D/U0", snapshot_distance * k), streamlines(run, run.run->psi[k], 470)});
  return panels(all, 2);
}

std::string figure_velocity(const std::vector<Drawn>& runs) {
  std::vector<Panel> all;
  constexpr double shown = 20;  // [D/U0]
  for (const Drawn& d : runs) {
    const double end = d.run->t.back();
    Panel panel{d.label, {{"t U0/D", end - shown, end}, {"u/U0"}, {}, 620, 240}};
    report::Curve above{"0.15 D above the pipe's rear", above_colour, {}, {}},
        below{"below it, half way to the floor", below_colour, {}, {}};
    for (std::size_t k = 0; k < d.run->t.size(); ++k) {
      if (d.run->t[k] < end - shown) continue;
      above.x.push_back(d.run->t[k]), above.y.push_back(d.run->u_above[k]);
      below.x.push_back(d.run->t[k]), below.y.push_back(d.run->u_below[k]);
    }
    panel.chart.curves = {above, below};
    all.push_back(panel);
  }
  return panels(all, 1);
}

std::string figure_bed_shear(const std::vector<ShearPanel>& lists) {
  std::vector<Panel> all;
  for (const ShearPanel& list : lists) {
    Panel panel{list.title, {{"x/D", -6, 16}, {"bed shear / rho u*^2 of the inlet"}, {}, 520, 320}};
    for (const Drawn& d : list.runs)
      panel.chart.curves.push_back(
          {d.label, d.colour, d.run->floor_x, list.viscous ? d.run->shear_viscous : d.run->shear, false, d.dashed});
    const double far = measure(*list.runs.front().run).far_shear;
    if (!list.viscous)
      panel.chart.curves.push_back(
          {"far field: mean over -8 < x/D < -5", "#999999", {-6, 16}, {far, far}, false, true});
    all.push_back(panel);
  }
  return panels(all, 2);
}

std::string figure_spectra(const std::vector<Drawn>& runs) {
  std::vector<Panel> all;
  constexpr double highest = 0.8;
  for (const Drawn& d : runs) {
    Panel panel{d.label, {{"f D/U0", 0, highest}, {"power of u / (U0 D)"}, {}, 420, 280}};
    panel.chart.y.logarithmic = true;
    panel.chart.y.from = 1e-5;
    const base::Spectrum above = base::power_spectrum(d.run->t, d.run->u_above, highest),
                         below = base::power_spectrum(d.run->t, d.run->u_below, highest);
    panel.chart.curves = {{"0.15 D above the pipe's rear", above_colour, above.frequency, above.power},
                          {"below it, half way to the floor", below_colour, below.frequency, below.power}};
    all.push_back(panel);
  }
  return panels(all, 2);
}

}  // namespace livebed::validate
