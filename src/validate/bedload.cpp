#include "validate/bedload.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/math.hpp"
#include "base/sediment.hpp"
#include "case/read.hpp"
#include "coupling/drag.hpp"
#include "io/table.hpp"
#include "validate/flat_bed.hpp"
#include "validate/grain_beds.hpp"
#include "validate/picture.hpp"
#include "validate/references.hpp"

namespace livebed::validate {

namespace {

constexpr double factor_allowed = 1.5;                // about Meyer-Peter and Mueller
constexpr double judged_from = 0.1, judged_to = 0.6;  // theta
constexpr double reference_transport =
    0.002;  // of W = Phi / theta^1.5 at the threshold (Parker, Klingeman, McLean 1982)

struct Sand {
  double diameter;
  const char *name, *colour;
};
const std::vector<Sand> sands = {{2e-3, "2 mm", "#1f77b4"}, {0.36e-3, "0.36 mm", "#d62728"}};
const std::vector<double> thetas = {0.02, 0.03, 0.04, 0.06, 0.1, 0.2, 0.33, 0.6, 1.0};
constexpr double line_from = 0.05, line_to = 0.4;  // theta; a line of Phi^(2/3) is laid through these
const std::vector<unsigned> seeds = {1, 2, 3};
constexpr unsigned heaps = 12;  // their slopes scatter by 4 degrees

FlatBedSetup setup_of(const Sand& sand, double theta, unsigned seed) {
  FlatBedSetup s;
  s.diameter = sand.diameter, s.theta = theta, s.seed = seed;
  if (sand.diameter < 1e-3) s.depth = 100, s.begin = 1, s.end = 3;
  return s;
}

struct Band {
  double mean = 0, low = 0, high = 0;
};
Band band(const std::vector<double>& values) {
  Band b{0, *std::min_element(values.begin(), values.end()), *std::max_element(values.begin(), values.end())};
  for (double v : values) b.mean += v / static_cast<double>(values.size());
  return b;
}

/// Shields parameter at which Phi / theta^1.5 passes the reference transport, by straight lines between logarithms; 0
/// when it does not.
double threshold(const std::vector<double>& theta, const std::vector<double>& phi) {
  const auto excess = [&](std::size_t n) {
    return std::log(std::max(phi[n], 1e-12) / std::pow(theta[n], 1.5) / reference_transport);
  };
  for (std::size_t n = 0; n + 1 < theta.size(); ++n) {
    const double a = excess(n), b = excess(n + 1);
    if (a < 0 && b >= 0) return theta[n] * std::pow(theta[n + 1] / theta[n], -a / (b - a));
  }
  return 0;
}

/// Where a straight line through Phi^(2/3) over theta meets zero, by least squares: the threshold that a formula like
/// Meyer-Peter and Mueller's has (their 0.047 was found so), whatever little moves below it.
double threshold_of_line(const std::vector<double>& theta, const std::vector<double>& phi) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < theta.size(); ++k) {
    if (theta[k] < line_from || theta[k] > line_to) continue;
    const double root = std::cbrt(base::square(phi[k]));
    n += 1, x += theta[k], y += root, xx += base::square(theta[k]), xy += theta[k] * root;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return (x - y / slope) / n;
}

void add_transport(const Sand& sand, const Tell& tell, Result& result, report::Chart& chart) {
  std::vector<double> at, phi, each_theta, each_phi;
  for (double theta : thetas) {
    std::vector<double> measured, einstein, ratio;
    double seconds = 0;
    FlatBedSetup setup;
    std::string commit;
    for (unsigned seed : seeds) {
      setup = setup_of(sand, theta, seed);
      const FlatBedRun run = kept_flat_bed(setup, kept_flat_beds, tell);
      measured.push_back(run.theta), einstein.push_back(run.einstein(setup));
      ratio.push_back(run.einstein(setup) / std::max(1e-9, base::meyer_peter_mueller(run.theta)));
      each_theta.push_back(run.theta), each_phi.push_back(run.einstein(setup));
      seconds += run.seconds, commit = run.commit;
    }
    const Band moved = band(einstein);
    at.push_back(band(measured).mean), phi.push_back(moved.mean);
    const std::string name = fmt::format("{} sand, theta {}: ", sand.name, theta);
    Row row{name + "transport q/sqrt((s-1) g d^3)", moved.mean, "-"};
    row.reference = fmt::format("three seeds, {:.3g} to {:.3g}", moved.low, moved.high);
    row.setup = setup.text(), row.seconds = seconds, row.commit = commit;
    result.rows.push_back(row);
    if (theta < judged_from || theta > judged_to) continue;
    row.name = name + "transport over that of Meyer-Peter and Mueller at the measured theta";
    row.value = moved.mean / base::meyer_peter_mueller(at.back());
    row.low = 1 / factor_allowed, row.high = factor_allowed;
    row.reference = fmt::format("Meyer-Peter and Mueller (1948), measured theta {:.3f}; seeds {:.2f} to {:.2f}",
                                at.back(), band(ratio).low, band(ratio).high);
    result.rows.push_back(row);
  }
  Row row{fmt::format("{} sand: threshold of motion, Phi/theta^1.5 = {}", sand.name, reference_transport),
          threshold(at, phi),
          "-",
          0.03,
          0.06,
          "asked for; Shields diagram"};
  result.rows.push_back(row);
  row = {fmt::format("{} sand: threshold of the line through Phi^(2/3), theta 0.06 to 0.33", sand.name),
         threshold_of_line(at, phi), "-"};
  row.reference = "Meyer-Peter and Mueller (1948): 0.047";
  result.rows.push_back(row);
  chart.curves.push_back({fmt::format("{} sand", sand.name), sand.colour, each_theta, each_phi, true});
}

void add_heap(const Tell& tell, Result& result) {
  const casefile::Case livebed = casefile::preset_case("livebed");
  std::vector<double> slopes;
  double seconds = 0;
  for (unsigned seed = 1; seed <= heaps; ++seed) {
    HeapSetup setup;
    setup.friction = livebed.grains.friction, setup.rolling_friction = livebed.grains.rolling_friction;
    setup.seed = seed;
    const HeapRun run = run_heap(setup);
    slopes.push_back(run.angle());
    seconds += run.seconds;
  }
  const Band slope = band(slopes);
  Row row{"angle of repose of a heap", slope.mean, "degrees", 28, 36};
  row.reference = fmt::format("32 asked for; {} heaps {:.1f} to {:.1f}", heaps, slope.low, slope.high);
  row.setup = fmt::format("friction {}, rolling friction {}", livebed.grains.friction, livebed.grains.rolling_friction);
  row.seconds = seconds;
  tell(fmt::format("angle of repose: {:.1f} degrees", slope.mean));
  result.rows.push_back(row);
}

/// Speed at which the drag of one grain balances its weight [m/s].
double fall_speed(const coupling::SingleGrain& drag, double d, double s, double nu) {
  double w = 0.1;
  for (int n = 0; n < 200; ++n)  // rho/2 A (C_D w) w = (rho_s - rho) V g; half steps keep the iteration calm
    w = 0.5 * (w + (s - 1) * 9.81 * base::sphere_volume(d) / (0.5 * base::sphere_area(d) * drag(w, d, nu)));
  return w;
}

void add_fall(Result& result) {
  const casefile::Case livebed = casefile::preset_case("livebed");
  const coupling::Params& p = livebed.coupling;
  for (const Sand& sand : sands) {
    const double d = sand.diameter, nu = 1e-6, s = 2.65;
    const double soulsby = base::fall_speed(d, s, 9.81, nu);
    Row row{fmt::format("{} sand: fall speed", sand.name),
            fall_speed({p.drag_curve, p.drag_viscous, p.drag_infinity}, d, s, nu), "m/s"};
    row.low = 0.9 * soulsby, row.high = 1.1 * soulsby;
    row.reference = fmt::format("natural sand, Soulsby (1997): {:.4f}", soulsby);
    result.rows.push_back(row);
  }
}

}  // namespace

Result bedload(const Tell& tell) {
  Result result;
  add_fall(result);
  add_heap(tell, result);
  report::Chart chart{{"theta, measured"}, {"q / sqrt((s-1) g d^3)"}, {}};
  chart.y.logarithmic = true, chart.y.from = 1e-3, chart.y.to = 20;
  for (const Sand& sand : sands) add_transport(sand, tell, result, chart);
  report::Curve mpm{"Meyer-Peter and Mueller", "#000000", {}, {}},
      camenen{"Camenen and Larson, threshold 0.045", "#777777", {}, {}, false, true};
  for (double theta = 0.02; theta < 1.1; theta += 0.01) {
    mpm.x.push_back(theta), mpm.y.push_back(base::meyer_peter_mueller(theta));
    camenen.x.push_back(theta), camenen.y.push_back(base::camenen_larson(theta, 0.045));
  }
  chart.curves.push_back(mpm), chart.curves.push_back(camenen);
  result.pictures.push_back({"bedload_transport.svg", picture(chart)});
  return result;
}

Result sheet_flow(const Tell& tell) {
  FlatBedSetup setup;
  setup.diameter = 3e-3, setup.density = 1190;
  setup.theta = 0.05 * 0.05 / (0.19 * 9.81 * 3e-3);  // u* = 0.05 m/s
  setup.length = 80, setup.bed = 10, setup.depth = 170.0 / 3;
  setup.spin_up = 6, setup.begin = 8, setup.end = 16;
  // Round grains that nothing but their shape keeps from rolling.
  setup.keys = {"coupling.drag_curve=dallavalle", "coupling.drag_viscous=23.04", "coupling.drag_infinity=0.397",
                "contact.rolling_friction=0"};
  const FlatBedRun run = kept_flat_bed(setup, kept_flat_beds, tell);

  const io::Table solid = io::parse_table(sheet_flow_solid, "sheetflow_revilbaudard2015_phi.csv"),
                  speed = io::parse_table(sheet_flow_speed, "sheetflow_revilbaudard2015_u_stress.csv");
  const std::vector<double>&z_phi = solid.column("z_m"), &phi = solid.column("phi"), &z_u = speed.column("z_m"),
        &u = speed.column("u_m_s");
  // Both heights count from where a quarter of the volume is solid: the experiment's own origin is arbitrary.
  const auto height_of = [](const std::vector<double>& z, const std::vector<double>& f, double value) {
    for (std::size_t n = z.size() - 1; n > 0; --n)
      if (f[n] < value && f[n - 1] >= value) return z[n] + (value - f[n]) / (f[n - 1] - f[n]) * (z[n - 1] - z[n]);
    return 0.0;
  };
  const auto at = [](const std::vector<double>& z, const std::vector<double>& f, double where) {
    const auto above = std::lower_bound(z.begin(), z.end(), where);
    if (above == z.begin() || above == z.end()) return above == z.begin() ? f.front() : f.back();
    const std::size_t n = above - z.begin();
    return f[n - 1] + (where - z[n - 1]) / (z[n] - z[n - 1]) * (f[n] - f[n - 1]);
  };
  const double d = setup.diameter, here = height_of(run.y, run.solid, 0.25), there = height_of(z_phi, phi, 0.25);
  double above = 0, below = 0, solids = 0;
  int n_above = 0, n_below = 0;
  for (double z = -2 * d; z <= 30 * d; z += 0.5 * d) {
    const double error = at(run.y, run.u, here + z) - at(z_u, u, there + z);
    (z < d ? below : above) += error * error, ++(z < d ? n_below : n_above);
    if (z <= 10 * d) solids += base::square(at(run.y, run.solid, here + z) - at(z_phi, phi, there + z)) / 25;
  }
  Result result;
  const auto add = [&](const std::string& name, double value, const std::string& unit) -> Row& {
    Row row{"sheet flow: " + name, value, unit};
    row.reference = "Revil-Baudard, Chauchat, Hurther and Barraud (2015), J. Fluid Mech. 767, 1";
    row.setup = setup.text(), row.seconds = run.seconds, row.commit = run.commit;
    result.rows.push_back(row);
    return result.rows.back();
  };
  Row& outer = add("speed, rms error 1 to 30 d above a solid fraction of 0.25, over the speed at 30 d",
                   std::sqrt(above / n_above) / at(z_u, u, there + 30 * d), "-");
  outer.low = 0, outer.high = 0.15;
  add("the same from 2 d below to 1 d above", std::sqrt(below / n_below) / at(z_u, u, there + 30 * d), "-");
  add("solid fraction, rms error from 2 d below to 10 d above", std::sqrt(solids), "-").low = 0;
  result.rows.back().high = 0.05;
  const double thick = (height_of(run.y, run.solid, 0.08) - height_of(run.y, run.solid, 0.45)) / d,
               measured = (height_of(z_phi, phi, 0.08) - height_of(z_phi, phi, 0.45)) / d;
  Row& sheet = add("thickness between solid fractions of 0.08 and 0.45, over the measured one", thick / measured, "-");
  sheet.low = 0.7, sheet.high = 1.3;
  double flux = 0;  // of the measured mixture
  for (double z = -3 * d; z <= 20 * d; z += 0.05 * d)
    flux += 0.05 * d * at(z_phi, phi, there + z) * std::max(0.0, at(z_u, u, there + z));
  add("solids flux over the integral of solid fraction x speed as measured", run.flux / flux, "-");
  add("measured Shields parameter", run.theta, "-");

  const auto curve = [&](const char* name, const char* colour, const std::vector<double>& f,
                         const std::vector<double>& z, double origin, bool dots) {
    report::Curve c{name, colour, {}, {}, dots};
    for (std::size_t n = 0; n < z.size(); ++n)
      if (z[n] > origin - 4 * d && z[n] < origin + 32 * d && f[n] != 0)
        c.x.push_back(f[n]), c.y.push_back((z[n] - origin) / d);
    return c;
  };
  const report::Axis height{"height over solid fraction 0.25 [d]", -4, 32};
  report::Chart speeds, fractions;
  speeds.x.name = "speed [m/s]", fractions.x.name = "solid fraction [-]";
  speeds.y = fractions.y = height;
  speeds.curves = {curve("measured", "#000000", u, z_u, there, true),
                   curve("water", "#1f77b4", run.u, run.y, here, false),
                   curve("grains", "#d62728", run.grain_u, run.y, here, false)};
  fractions.curves = {curve("measured", "#000000", phi, z_phi, there, true),
                      curve("Livebed", "#1f77b4", run.solid, run.y, here, false)};
  result.pictures.push_back({"sheet_flow_speed.svg", picture(speeds)});
  result.pictures.push_back({"sheet_flow_solid.svg", picture(fractions)});
  return result;
}

}  // namespace livebed::validate
