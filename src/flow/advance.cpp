#include "flow/advance.hpp"

#include <cmath>
#include <utility>

#include "base/fault.hpp"
#include "base/loops.hpp"
#include "flow/constants.hpp"
#include "flow/pipe.hpp"
#include "flow/separation.hpp"
#include "flow/transport.hpp"

namespace livebed::flow {

using base::Field;
using base::for_each_item;
using base::vector_loop;

Solver::Solver(const Params& params, const Mesh& mesh, const Boundary& boundary)
    : params_(params),
      mesh_(mesh),
      water_(mesh),
      boundary_(boundary),
      at_u_(Staggering::west_faces(mesh)),
      at_v_(Staggering::south_faces(mesh)),
      at_c_(Staggering::centres(mesh)),
      work_(mesh),
      turbulence_(mesh, boundary, params),
      simple_(params.algorithm == Algorithm::simple ? Simple(mesh) : Simple()),
      pressure_(mesh.nx, mesh.ny) {
  const Field zero(mesh.nx, mesh.ny);
  State& s = state;
  s.u = s.v = s.p = s.p_change = s.nut = s.u_old = s.v_old = zero;
  s.convection_u = s.convection_v = s.convection_k = s.convection_e = zero;
  s.k = s.k_old = Field(mesh.nx, mesh.ny, 2, k_floor);
  s.epsilon = s.epsilon_old = Field(mesh.nx, mesh.ny, 2, epsilon_floor);
  s.load = {0, zero, zero, zero, zero, zero, zero};
  if (params.algorithm == Algorithm::simple) work_.own_rows(mesh.ny);
}

void Solver::set_voidage(const Field& voidage, double interval, double margin) {
  state.voidage = voidage;
  volume_before_ = water_.volume;
  fill_with_voids(mesh_, voidage, boundary_.inlet, water_);
  for (Staggering* at : {&at_u_, &at_v_, &at_c_}) at->open_to(water_, openings_);
  work_.face_x.keep(water_.aperture_x);
  work_.face_y.keep(water_.aperture_y);
  coefficients_set_ = false;
  if (interval <= 0) {
    work_.storage = Field();
    return;
  }
  if (work_.storage.nx() == 0) work_.storage = Field(mesh_.nx, mesh_.ny);
  const double from = boundary_.inlet ? margin : 0.0, to = mesh_.length() - (boundary_.outlet ? margin : 0.0);
  base::for_each_item(0, mesh_.ny, [&](int j) {
    for (int i = 0; i < mesh_.nx; ++i)
      if (mesh_.x[i] >= from && mesh_.x[i + 1] <= to)
        work_.storage(i, j) = (water_.volume(i, j) - volume_before_(i, j)) * mesh_.dx(i) * mesh_.dy(j) / interval;
  });
}

void Solver::set_inlet(const Column& profiles) {
  boundary_.inlet_u = profiles.u, boundary_.inlet_k = profiles.k, boundary_.inlet_epsilon = profiles.epsilon;
  turbulence_.set_inlet(boundary_);
  fill_velocity_ghosts(mesh_, boundary_, state.u, state.v);
}

void Solver::start() {
  State& s = state;
  for (int j = 0; j < mesh_.ny; ++j) {
    for (int i = 0; i <= mesh_.nx; ++i)
      s.u(i, j) = mesh_.aperture_x(i, j) > 0 && boundary_.inlet ? boundary_.inlet_u[j] : 0.0;
    if (params_.closure == Closure::laminar || !boundary_.inlet) continue;
    for (int i = 0; i < mesh_.nx; ++i) s.k(i, j) = boundary_.inlet_k[j], s.epsilon(i, j) = boundary_.inlet_epsilon[j];
  }
  fill_velocity_ghosts(mesh_, boundary_, s.u, s.v);
  double residual = 0;
  set_pressure_coefficients();
  s.p_change.fill(0.0);
  project(1.0, params_.pressure_tolerance, 1.0, residual);
  if (params_.closure != Closure::laminar) {
    evaluate_walls(mesh_, boundary_, params_, s, work_);
    turbulence_.start(mesh_, boundary_, params_, s, work_);
  }
  s.p.fill(0.0), s.p_change.fill(0.0);  // of a start by impulse: they mean nothing for the steps to come
  coefficients_set_ = false;            // the steps use their own, whether they follow this start or a checkpoint
  s.u_old = s.u;
  s.v_old = s.v;
  s.step = s.time = 0;
}

double Solver::step_limit() const {
  if (params_.algorithm == Algorithm::simple) return params_.max_step;
  const double courant = params_.courant, relief = params_.courant_y > 0 ? courant / params_.courant_y : 0.0;
  const double rate = relief > 0 ? passage_rate([&](double x, double y) { return std::max(x, y * relief); }, true)
                                 : passage_rate([](double x, double y) { return x + y; });
  return rate > 0 ? std::min(params_.max_step, courant / rate) : params_.max_step;
}

template <class Both>
double Solver::passage_rate(Both&& both, bool by_what_cells_hold) const {
  const double *per_dx = work_.per_dx.data() + 2, *one = work_.ones.row(0);
  return base::largest(0, mesh_.ny, partial_, 0.0, [&](int j) {
    const double *u = state.u.row(j), *v = state.v.row(j), *va = state.v.row(j + 1), per_dy = 1.0 / mesh_.dy(j);
    const double *face = by_what_cells_hold ? work_.cut_x.row(j) : one,
                 *holds = by_what_cells_hold ? mesh_.volume.row(j) : one;
    return base::vector_largest(0, mesh_.nx, 0.0, [&](int i) {
      return both(std::max(face[i] * std::abs(u[i]), face[i + 1] * std::abs(u[i + 1])) * per_dx[i] /
                      std::max(holds[i], inertia_least),
                  std::max(std::abs(v[i]), std::abs(va[i])) * per_dy);
    });
  });
}

void Solver::set_pressure_coefficients() {
  const bool loaded = state.load.top > 0 || params_.algorithm == Algorithm::simple;
  if (coefficients_set_ && !loaded) return;
  coefficients_set_ = !loaded;
  const Mesh& m = mesh_;
  for_each_item(0, m.ny, [&](int j) {
    const double *ax = work_.face_x.row(j), *ay = work_.face_y.row(j), *per_hx = work_.per_dx_face.data() + 2,
                 *dx = m.dx_.data() + 2;
    const double *ru = work_.response_u.row(j), *rv = work_.response_v.row(j);
    const double dy = m.dy(j), per_hy = 1.0 / m.dy_face(j);
    double *cx = work_.c_x.row(j), *cy = work_.c_y.row(j);
    vector_loop(0, m.nx, [&](int i) {
      cx[i] = ax[i] * ru[i] * dy * per_hx[i];
      cy[i] = ay[i] * rv[i] * dx[i] * per_hy;
    });
    if (boundary_.outlet) work_.c_boundary(m.nx - 1, j) = ax[m.nx] * ru[m.nx] * dy / (0.5 * dx[m.nx - 1]);
  });
  pressure_.set_coefficients(work_.c_x, work_.c_y, work_.c_boundary);
}

double Solver::sum_outflow(double scale, Field* to) {
  const Mesh& m = mesh_;
  return std::sqrt(base::ordered_sum(0, m.ny, partial_,
                                     [&](int j) {
                                       const double *u = state.u.row(j), *v = state.v.row(j), *va = state.v.row(j + 1),
                                                    *ax = work_.face_x.row(j);
                                       const double *ay = work_.face_y.row(j), *aya = work_.face_y.row(j + 1),
                                                    *dx = m.dx_.data() + 2;
                                       const double dy = m.dy(j);
                                       const double* stored =
                                           work_.storage.nx() > 0 ? work_.storage.row(j) : work_.nothing.data();
                                       const auto out = [&](int i) {
                                         return (ax[i + 1] * u[i + 1] - ax[i] * u[i]) * dy +
                                                (aya[i] * va[i] - ay[i] * v[i]) * dx[i] + stored[i];
                                       };
                                       if (!to)
                                         return base::vector_sum(0, m.nx, [&](int i) { return out(i) * out(i); });
                                       double* b = to->row(j);
                                       vector_loop(0, m.nx, [&](int i) { b[i] = scale * out(i); });
                                       return base::vector_sum(0, m.nx, [&](int i) { return b[i] * b[i]; });
                                     })) /
         (to ? std::abs(scale) : 1.0);
}

void Solver::guess_pressure_change(double dt) {
  const double ratio = state.step > 0 ? dt / state.step : 0.0;
  if (ratio == 1.0) return;
  for_each_item(0, mesh_.ny, [&](int j) {
    double* change = state.p_change.row(j);
    vector_loop(0, mesh_.nx, [&](int i) { change[i] *= ratio; });
  });
}

SolveReport Solver::project(double dt, double tolerance, double relax, double& mass_residual) {
  const Mesh& m = mesh_;
  const double before = sum_outflow(-params_.density / dt, &work_.outflow);
  const SolveReport report = pressure_.solve(state.p_change, work_.outflow, tolerance, params_.pressure_iterations);
  const double kick = dt / params_.density;
  for_each_item(0, m.ny, [&](int j) {
    const double *phi = state.p_change.row(j), *below = state.p_change.row(j - 1), *ax = work_.face_x.row(j),
                 *ay = work_.face_y.row(j);
    const double *ru = work_.response_u.row(j), *rv = work_.response_v.row(j), *per_hx = work_.per_dx_face.data() + 2;
    const double along_y = j > 0 ? kick / m.dy_face(j) : 0.0;
    double *u = state.u.row(j), *v = state.v.row(j), *p = state.p.row(j);
    vector_loop(0, m.nx, [&](int i) {
      u[i] -= ax[i] > 0 && i > 0 ? kick * ru[i] * (phi[i] - phi[i - 1]) * per_hx[i] : 0.0;
      v[i] -= ay[i] > 0 ? along_y * rv[i] * (phi[i] - below[i]) : 0.0;
      p[i] += relax * phi[i];
    });
    if (boundary_.outlet) u[m.nx] += kick * ru[m.nx] * phi[m.nx - 1] / (0.5 * m.dx(m.nx - 1));
  });
  fill_velocity_ghosts(m, boundary_, state.u, state.v);
  mass_residual = before > 0 ? sum_outflow(0.0, nullptr) / before : 0.0;
  return report;
}

StepReport Solver::advance(double dt) {
  const double courant = dt * passage_rate([](double x, double y) { return x + y; });
  if (mesh_.has_pipe() && params_.pipe.layer == PipeLayer::laminar)
    follow_separation(mesh_, work_.wall_cells, params_, dt, state);
  StepReport report = params_.algorithm == Algorithm::simple ? advance_simple(dt) : advance_projection(dt);
  report.courant = courant;
  state.step = dt;
  state.time += dt;
  report.pipe_force = pipe_force();
  return report;
}

StepReport Solver::advance_projection(double dt) {
  StepReport report;
  evaluate_walls(mesh_, boundary_, params_, state, work_);
  predict_velocity(mesh_, boundary_, params_, at_u_, at_v_, dt, state, work_);
  set_pressure_coefficients();
  guess_pressure_change(dt);
  report.pressure = project(dt, params_.pressure_tolerance, 1.0, report.mass_residual);
  if (params_.closure != Closure::laminar)
    advance_turbulence(mesh_, boundary_, params_, at_c_, dt, turbulence_, state, work_);
  return report;
}

base::Vec2 Solver::pipe_force() const {
  base::Vec2 force;
  if (!mesh_.has_pipe()) return force;
  for (const WallCell& cell : work_.wall_cells) {
    const base::Vec2 wall = wall_vector(mesh_, cell.i, cell.j);
    force.x -= state.p(cell.i, cell.j) * wall.x;
    force.y -= state.p(cell.i, cell.j) * wall.y;
  }
  for (const WallPart& part : work_.wall_u) force.x += params_.density * part.friction * state.u(part.i, part.j);
  for (const WallPart& part : work_.wall_v) force.y += params_.density * part.friction * state.v(part.i, part.j);
  return force;
}

double Solver::floor_shear_velocity(int i) const {
  return std::sqrt(work_.floor_c[i] * std::abs(0.5 * (state.u(i, 0) + state.u(i + 1, 0))));
}

std::string Solver::find_fault() const {
  const auto look = [&](const char* name, const Field& f) -> std::string {
    for (int j = 0; j < mesh_.ny; ++j)
      for (int i = 0; i < mesh_.nx; ++i)
        if (!std::isfinite(f(i, j)))
          return fmt::format("{} = {} in cell ({},{}), x = {:.4g} m, y = {:.4g} m", name, f(i, j), i, j,
                             mesh_.centre_x(i), mesh_.centre_y(j));
    return {};
  };
  for (const auto& [name, field] :
       {std::pair{"u", &state.u}, {"v", &state.v}, {"p", &state.p}, {"k", &state.k}, {"epsilon", &state.epsilon}}) {
    const std::string fault = look(name, *field);
    if (!fault.empty()) return fault;
  }
  return {};
}

}  // namespace livebed::flow
