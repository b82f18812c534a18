// Two parts of Livebed used on their own: the flow past a cylinder in the open, and how fast a grain sinks after each
// of two drag laws.
#include <fmt/core.h>

#include "base/math.hpp"
#include "coupling/drag.hpp"
#include "flow/advance.hpp"
#include "flow/boundary.hpp"
#include "flow/mesh.hpp"

using namespace livebed;

/// Speed at which drag carries the submerged weight: bisection, for drag grows with speed.
template <class Law>
double settling_speed(const Law& law, double d) {
  const double weight = 1650 * 9.81 * base::sphere_volume(d);
  double low = 0, high = 10;
  while (high - low > 1e-9) {
    const double w = (low + high) / 2;
    (law({w, d, 1000, 1e-6, 1}) * w < weight ? low : high) = w;
  }
  return low;
}

int main() {
  flow::Params p;
  p.mesh = {.length = 1.0, .height = 0.5, .cell_x = 0.01, .cell_y = 0.01};
  p.pipe = {.diameter = 0.1, .x = 0.3, .y = 0.25};
  p.closure = flow::Closure::laminar;
  p.viscosity = 1e-3;  // Re = 100
  p.floor = flow::Wall::slip;
  p.current = {.profile = flow::Profile::uniform, .shear_velocity = 0.05, .mean_speed = 1.0};

  const flow::Mesh mesh = flow::make_mesh(p.mesh, p.pipe);
  flow::Solver water(p, mesh, flow::make_boundary(mesh, p));
  water.start();
  flow::StepReport step;
  while (water.state.time < 2) step = water.advance(water.step_limit());
  fmt::print("drag coefficient {:.3f}\n", step.pipe_force.x / (0.5 * p.density * p.pipe.diameter));

  const coupling::SingleGrain sphere{coupling::DragCurve::dallavalle, 23.04, 0.397};
  fmt::print("a grain of 0.36 mm sinks at {:.4f} m/s, after the paper's curve at {:.4f} m/s\n",
             settling_speed(coupling::PaperDrag{sphere}, 0.36e-3), settling_speed(coupling::PaperDrag{}, 0.36e-3));
}
