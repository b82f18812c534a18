#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <vector>

#include "base/fault.hpp"
#include "case/read.hpp"
#include "flow/advance.hpp"
#include "io/table.hpp"

/// Time means of the flow past a pipe, to compare with other codes: velocity and k profiles, shear along the floor, and
/// the series of drag and lift.
namespace {

using namespace livebed;

/// Integrals over time of u and k along one vertical and of the shear along the floor.
class Means {
public:
  Means(const flow::Mesh& mesh, const std::vector<double>& stations) : mesh_(mesh) {
    for (const double x : stations) {
      // u between its two nearest faces, k between its two nearest centres.
      Vertical v;
      while (v.face + 2 < mesh.nx && mesh.x[v.face + 1] <= x) ++v.face;
      while (v.centre + 2 < mesh.nx && mesh.centre_x(v.centre + 1) <= x) ++v.centre;
      v.share_u = (x - mesh.x[v.face]) / mesh.dx(v.face);
      v.share_k = (x - mesh.centre_x(v.centre)) / mesh.dx_face(v.centre + 1);
      v.u.assign(mesh.ny, 0.0);
      v.k.assign(mesh.ny, 0.0);
      verticals_.push_back(v);
    }
    shear_.assign(mesh.nx, 0.0);
  }

  void add(const flow::Solver& flow, double dt) {
    const flow::State& s = flow.state;
    const auto between = [](double a, double b, double share) { return a + share * (b - a); };
    for (Vertical& v : verticals_)
      for (int j = 0; j < mesh_.ny; ++j) {
        v.u[j] += dt * between(s.u(v.face, j), s.u(v.face + 1, j), v.share_u);
        v.k[j] += dt * between(s.k(v.centre, j), s.k(v.centre + 1, j), v.share_k);
      }
    for (int i = 0; i < mesh_.nx; ++i) {
      const double u_star = flow.floor_shear_velocity(i);
      shear_[i] += dt * flow.params().density * std::copysign(u_star * u_star, s.u(i, 0) + s.u(i + 1, 0));
    }
    duration_ += dt;
  }

  void write(const std::filesystem::path& folder) const {
    for (std::size_t n = 0; n < verticals_.size(); ++n) {
      const Vertical& v = verticals_[n];
      io::TableWriter table(folder / fmt::format("profile_{}.csv", n), {"y_m", "u_m_s", "k_m2_s2"});
      for (int j = 0; j < mesh_.ny; ++j)
        table.row(std::vector<double>{mesh_.centre_y(j), v.u[j] / duration_, v.k[j] / duration_});
    }
    io::TableWriter table(folder / "floor.csv", {"x_m", "shear_Pa"});
    for (int i = 0; i < mesh_.nx; ++i) table.row(std::vector<double>{mesh_.centre_x(i), shear_[i] / duration_});
  }

private:
  struct Vertical {
    int face = 0, centre = 0;
    double share_u = 0, share_k = 0;
    std::vector<double> u, k;
  };
  const flow::Mesh& mesh_;
  std::vector<Vertical> verticals_;
  std::vector<double> shear_;  ///< signed like the velocity
  double duration_ = 0;
};

void run(const std::string& path, const std::vector<std::string>& overrides, double from,
         const std::vector<double>& stations, const std::filesystem::path& folder) {
  const casefile::Case c = casefile::read_case(path, overrides);
  const flow::Params& p = c.flow;
  const flow::Mesh mesh = flow::make_mesh(p.mesh, p.pipe);
  flow::Solver flow(p, mesh, flow::make_boundary(mesh, p));
  std::filesystem::create_directories(folder);
  Means means(mesh, stations);
  io::TableWriter series(folder / "series.csv", {"time_s", "drag_N_m", "lift_N_m"});
  flow.start();
  while (flow.state.time < c.time.end) {
    const double dt = flow.step_limit();
    const flow::StepReport report = flow.advance(dt);
    series.row(std::vector<double>{flow.state.time, report.pipe_force.x, report.pipe_force.y});
    if (flow.state.time >= from) means.add(flow, dt);
    if (const std::string fault = flow.find_fault(); !fault.empty())
      base::fail(base::Exit::diverged, "t = {} s: {}", flow.state.time, fault);
  }
  means.write(folder);
  fmt::print("{} x {} cells, lowest row {:.4g} m\n", mesh.nx, mesh.ny, mesh.dy(0));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Time means of the flow of a case, without its grains.");
  std::string path, folder;
  std::vector<std::string> overrides;
  std::vector<double> stations;
  double from = 0;
  app.add_option("case", path, "case file; the run ends at its time.end")->required();
  app.add_option("--set", overrides, "table.key=value");
  app.add_option("--from", from, "time from which means are taken [s]")->required();
  app.add_option("--at", stations, "places of the profiles, from the inlet [m]")->required();
  app.add_option("--out", folder, "folder of the tables")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    run(path, overrides, from, stations, folder);
    return 0;
  } catch (const base::Fault& fault) {
    fmt::print(stderr, "{}\n", fault.what());
    return static_cast<int>(fault.code());
  }
}
