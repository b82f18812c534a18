#pragma once
#include <vector>

#include "coupling/exchange.hpp"
#include "flow/advance.hpp"
#include "grains/advance.hpp"

namespace livebed::coupling {

/// A closed box without friction, water at rest in it, and a few grains that do not meet: flow, grains and exchange
/// stepped as a run does.
struct Tank {
  double length = 0.1, height = 0.2, cell = 2.5e-3;  ///< [m]
  double viscosity = 1e-6;                           ///< that the drag sees [m2/s]
  double fluid_viscosity = 1e-6;                     ///< that the water itself has
  Params coupling;
};

struct Body {
  double x = 0, y = 0, u = 0, v = 0;  ///< [m], [m/s]
  double diameter = 2e-3;             ///< [m]
};

class Experiment {
public:
  Experiment(const Tank& tank, const std::vector<Body>& bodies)
      : solver_(params_of(tank), mesh_of(tank), closed()),
        bed_(grains::make_bed(grains_of(tank, bodies.size()))),
        coupler_(tank.coupling, solver_,
                 {diameter, 2650, bed_.params.added_mass, tank.viscosity, bed_.params.count, 1}) {
    solver_.start();
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      bed_.state.x[k] = bodies[k].x, bed_.state.y[k] = bodies[k].y;
      bed_.state.u[k] = bodies[k].u, bed_.state.v[k] = bodies[k].v;
      bed_.state.diameter[k] = bodies[k].diameter;
    }
  }

  /// One coupled step of `substeps` grain steps.
  void step(int substeps) {
    const double dt = substeps * bed_.params.step;
    coupler_.load_flow(bed_.state, solver_, dt, false);
    solver_.advance(dt);
    coupler_.push_grains(solver_, bed_.state, dt);
    grains::advance(bed_, substeps);
    coupler_.collect(bed_.state, solver_, dt);
  }

  const flow::Solver& solver() const { return solver_; }
  const grains::Bed& bed() const { return bed_; }
  const Coupler& coupler() const { return coupler_; }
  double grain_step() const { return bed_.params.step; }

  /// Momentum of the water in the slab [N s].
  base::Vec2 momentum() const {
    const auto sum = [&](const flow::Staggering& at, const base::Field& f) {
      double total = 0;
      for (int j = at.j0; j < at.j1; ++j)
        for (int i = at.i0; i < at.i1; ++i) total += f(i, j) * at.volume(i, j);
      return total * density * diameter;
    };
    return {sum(solver_.at_u(), solver_.state.u), sum(solver_.at_v(), solver_.state.v)};
  }

  /// Force of the walls on the water by pressure [N].
  base::Vec2 wall_force() const {
    const flow::Mesh& m = solver_.mesh();
    const base::Field& p = solver_.state.p;
    base::Vec2 force;
    for (int j = 0; j < m.ny; ++j) force.x += (p(0, j) - p(m.nx - 1, j)) * m.dy(j) * diameter;
    for (int i = 0; i < m.nx; ++i) force.y += (p(i, 0) - p(i, m.ny - 1)) * m.dx(i) * diameter;
    return force;
  }

  static constexpr double diameter = 2e-3, density = 1000;

private:
  static flow::Params params_of(const Tank& tank) {
    flow::Params p;
    p.density = density, p.viscosity = tank.fluid_viscosity;
    p.closure = flow::Closure::laminar;
    p.floor = flow::Wall::slip;
    p.pressure_tolerance = 1e-10;
    p.mesh.length = tank.length, p.mesh.height = tank.height;
    p.mesh.cell_x = p.mesh.cell_y = tank.cell;
    p.pipe.present = false;
    return p;
  }
  static flow::Mesh mesh_of(const Tank& tank) { return flow::make_mesh(params_of(tank).mesh, {.present = false}); }
  static flow::Boundary closed() {
    flow::Boundary b;
    b.inlet = b.outlet = false;
    b.floor = flow::Wall::slip;
    return b;
  }
  static grains::Params grains_of(const Tank& tank, std::size_t count) {
    grains::Params p;
    p.diameter = diameter, p.spread = 0, p.step = 1e-5, p.restitution = 0.5;
    p.length = tank.length, p.count = static_cast<int>(count);
    return grains::derive(p);
  }

  flow::Solver solver_;
  grains::Bed bed_;
  Coupler coupler_;
};

}  // namespace livebed::coupling
