#include "validate/channel.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "base/math.hpp"
#include "flow/constants.hpp"
#include "flow/profiles.hpp"
#include "io/table.hpp"
#include "validate/picture.hpp"
#include "validate/references.hpp"

namespace livebed::validate {

namespace {

/// Linear in the table's rows.
double at(const std::vector<double>& x, const std::vector<double>& y, double where) {
  const auto above = std::lower_bound(x.begin(), x.end(), where);
  const std::size_t k = std::clamp<std::ptrdiff_t>(above - x.begin(), 1, static_cast<std::ptrdiff_t>(x.size()) - 1);
  return y[k - 1] + (y[k] - y[k - 1]) * (where - x[k - 1]) / (x[k] - x[k - 1]);
}

}  // namespace

ChannelRun run_channel(flow::Closure closure, double re_tau, double first) {
  const auto start = std::chrono::steady_clock::now();
  constexpr double lengths = 60, passes = 3;
  flow::Params p;  // depth 1, u* = 1 at the inlet
  p.density = 1;
  p.viscosity = 1 / re_tau;
  p.closure = closure;
  p.max_step = 1;
  p.floor = flow::Wall::smooth;
  p.mesh.length = lengths, p.mesh.height = 1;
  p.mesh.cell_x = 0.5;
  p.mesh.cell_y = 2 * first / re_tau;
  p.mesh.growth = 1.12;
  p.mesh.fine_x_from = 0, p.mesh.fine_x_to = lengths;
  p.mesh.fine_y_from = 0, p.mesh.fine_y_to = p.mesh.cell_y;
  p.pipe.present = false;
  p.current.profile = flow::Profile::smooth;
  p.current.shear_velocity = 1;
  const flow::Mesh m = flow::make_mesh(p.mesh, p.pipe);
  flow::Solver flow(p, m, flow::make_boundary(m, p));
  flow.start();
  const double mean = flow::depth_mean(1, 1, flow::zero_level(flow::Profile::smooth, 0, 1, p.viscosity));
  while (flow.state.time < passes * lengths / mean) flow.advance(flow.step_limit());
  ChannelRun run;
  const int i = 9 * m.nx / 10;
  const double u_star = flow.floor_shear_velocity(i);
  run.re_tau = u_star * re_tau;
  for (int j = 0; j < m.ny; ++j) {
    run.y.push_back(m.centre_y(j) * u_star / p.viscosity);
    run.u.push_back(flow.state.u(i, j) / u_star);
    run.k.push_back(flow.state.k(i, j) / base::square(u_star));
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

Result channel(const Tell& tell) {
  const io::Table dns = io::parse_table(channel_dns, "data/channel_dns_retau180.csv");
  struct Model {
    const char* name;
    flow::Closure closure;
    double re_tau, first;
    const char* colour;
    double off_most;  ///< target; 0 = told, not judged
  };
  const std::vector<Model> models = {
      {"k-epsilon, wall function", flow::Closure::k_epsilon, 178, 20, "#1f77b4", 0},
      {"k-omega SST, resolved", flow::Closure::k_omega_sst, 178, 0.5, "#d62728", 0.05},
      {"k-epsilon, wall function", flow::Closure::k_epsilon, 5000, 60, "#1f77b4", 0.05},
      {"realizable k-epsilon, wall function", flow::Closure::k_epsilon_realizable, 5000, 60, "#2ca02c", 0.05},
      {"k-omega SST, wall function", flow::Closure::k_omega_sst, 5000, 60, "#d62728", 0.04},
      {"k-omega of 2006, wall function", flow::Closure::k_omega, 5000, 60, "#9467bd", 0.05},
  };
  Result result;
  report::Chart low{{"y+"}, {"U+, Re_tau 180"}, {}}, energy{{"y+"}, {"k+, Re_tau 180"}, {}},
      high{{"ln y+"}, {"U+, Re_tau 5000"}, {}};
  low.curves.push_back({"DNS", "#000000", dns.column("yplus"), dns.column("Uplus"), true});
  energy.curves.push_back({"DNS", "#000000", dns.column("yplus"), dns.column("k_plus"), true});
  report::Curve log_law{"log law", "#000000", {}, {}, false, true};
  for (double y = 20; y < 5000; y *= 1.3)
    log_law.x.push_back(std::log(y)), log_law.y.push_back(std::log(flow::smooth_E * y) / flow::kappa);
  high.curves.push_back(log_law);
  for (const Model& model : models) {
    const bool with_dns = model.re_tau < 1000;
    const ChannelRun run = run_channel(model.closure, model.re_tau, model.first);
    double worst = 0, worst_k = 0;
    for (std::size_t j = 0; j < run.y.size(); ++j) {
      if (with_dns && run.y[j] < dns.column("yplus").back()) {
        worst = std::max(worst, std::abs(run.u[j] - at(dns.column("yplus"), dns.column("Uplus"), run.y[j])) /
                                    dns.column("Uplus").back());
        worst_k = std::max(worst_k, std::abs(run.k[j] - at(dns.column("yplus"), dns.column("k_plus"), run.y[j])));
      }
      const double z = run.y[j] / run.re_tau;
      if (!with_dns && run.y[j] > 30 && z < 0.3)
        worst = std::max(worst, std::abs(run.u[j] * flow::kappa / std::log(flow::smooth_E * run.y[j]) - 1));
    }
    const auto add = [&](const std::string& what, double value, const std::string& unit, double most,
                         const char* reference) {
      Row row{fmt::format("Re_tau {}, {}: {}", model.re_tau, model.name, what), value, unit};
      if (most > 0) row.low = 0, row.high = most;
      row.reference = reference;
      row.setup = fmt::format(
          "open channel 60 depths long, smooth floor, Re_tau {}, {}, first cell at y+ {}, log law at the inlet, looked "
          "at 54 "
          "depths on, {} rows",
          model.re_tau, model.name, model.first, run.y.size());
      row.seconds = run.seconds;
      tell(fmt::format("{}: {:.4f}{}", row.name, value, row.pass() ? "" : "  <- outside"));
      result.rows.push_back(row);
    };
    if (with_dns) {
      add("largest difference of U", worst, "centre speed", model.off_most, "DNS, data/channel_dns_retau180.csv");
      add("largest difference of k+", worst_k, "-", 0, "DNS, data/channel_dns_retau180.csv");
      low.curves.push_back({model.name, model.colour, run.y, run.u});
      energy.curves.push_back({model.name, model.colour, run.y, run.k});
    } else {
      add("largest relative difference of U, y+ > 30, y < 0.3 h", worst, "-", model.off_most,
          "log law, kappa 0.41, E 9");
      std::vector<double> log_y;
      for (double y : run.y) log_y.push_back(std::log(y));
      high.curves.push_back({model.name, model.colour, log_y, run.u});
    }
    add("friction velocity over that of the inlet's log law", run.re_tau / model.re_tau, "-", 0, "");
  }
  result.pictures = {{"channel_dns_u.svg", picture(low)},
                     {"channel_dns_k.svg", picture(energy)},
                     {"channel_log_law.svg", picture(high)}};
  return result;
}

}  // namespace livebed::validate
