#include "case/rows.hpp"

namespace livebed::casefile {

void add_general(std::vector<Row>& s) {
  Row preset = text("preset", at(&Case::preset)).says("whose choices the keys start from: the paper's or ours");
  preset.type = Type::word;
  preset.words = presets();
  s.push_back(preset);
  s.push_back(text("case.title", at(&Case::title)).says("one line for the report"));
}

void add_mesh(std::vector<Row>& s) {
  using M = flow::MeshParams;
  const auto mesh = [](double M::*member) { return at(&Case::flow, &flow::Params::mesh, member); };
  s.push_back(
      real("mesh.length", "m", mesh(&M::length)).above(0).says("length of the box, inlet to outlet").from("Sec. 4.4"));
  s.push_back(
      real("mesh.height", "m", mesh(&M::height)).above(0).says("height of the box: water and bed").from("Sec. 4.4"));
  s.push_back(real("mesh.cell_x", "m", mesh(&M::cell_x)).above(0).says("width of the cells in the fine window"));
  s.push_back(real("mesh.cell_y", "m", mesh(&M::cell_y)).above(0).says("height of the cells in the fine window"));
  s.push_back(real("mesh.growth", "-", mesh(&M::growth))
                  .within(1, 1.3)
                  .says("ratio of neighbouring cells outside the fine window; 1 = uniform everywhere"));
  s.push_back(real("mesh.fine_x_from", "m", mesh(&M::fine_x_from)).at_least(0).says("left edge of the fine window"));
  s.push_back(real("mesh.fine_x_to", "m", mesh(&M::fine_x_to))
                  .at_least(0)
                  .says("right edge; the whole length when both are 0"));
  s.push_back(real("mesh.fine_y_from", "m", mesh(&M::fine_y_from)).at_least(0).says("lower edge of the fine window"));
  s.push_back(real("mesh.fine_y_to", "m", mesh(&M::fine_y_to))
                  .at_least(0)
                  .says("upper edge; the whole height when both are 0"));
}

namespace {

const std::vector<std::pair<std::string, flow::Wall>> walls{{"rough", flow::Wall::rough},
                                                            {"smooth", flow::Wall::smooth},
                                                            {"no_slip", flow::Wall::no_slip},
                                                            {"slip", flow::Wall::slip}};

}  // namespace

void add_pipe(std::vector<Row>& s) {
  using P = flow::PipeParams;
  const auto pipe = [](auto P::*member) { return at(&Case::flow, &flow::Params::pipe, member); };
  s.push_back(flag("pipe.present", pipe(&P::present)).says("is there a pipe?"));
  s.push_back(real("pipe.diameter", "m", pipe(&P::diameter)).above(0).says("D").from("Table 3"));
  s.push_back(real("pipe.x", "m", pipe(&P::x))
                  .above(0)
                  .says("centre, distance from the inlet")
                  .from("Fig. 10; its place is not printed"));
  s.push_back(real("pipe.gap_ratio", "-", pipe(&P::gap_ratio))
                  .within(-1, 5)
                  .says("e/D, from the level of the bed to the lowest point of the pipe; below 0: embedded")
                  .from("Table 3"));
  s.push_back(
      word("pipe.wall", pipe(&P::wall), walls).says("what the pipe's surface does to the flow").from("Eq. 9-12"));
  s.push_back(
      word<flow::PipeLayer>("pipe.boundary_layer", pipe(&P::layer),
                            {{"turbulent", flow::PipeLayer::turbulent}, {"laminar", flow::PipeLayer::laminar}})
          .says("turbulent: it leaves the pipe where the wall function's does, late; laminar: where a laminar "
                "one does (Thwaites 1949), near 80 degrees from the front, and has no eddies within 0.1 D, as on "
                "smooth pipes below Re_D = 2e5"));
  s.push_back(real("pipe.roughness", "m", pipe(&P::roughness)).at_least(0).says("ks of a rough pipe"));
  s.push_back(derived("pipe.y", "m", pipe(&P::y)).says("centre above the floor of the box, at the nominal bed level"));
}

void add_flow(std::vector<Row>& s) {
  using F = flow::Params;
  const auto flow = [](auto F::*member) { return at(&Case::flow, member); };
  s.push_back(real("flow.density", "kg/m3", flow(&F::density)).above(0).says("rho of the water"));
  s.push_back(real("flow.viscosity", "m2/s", flow(&F::viscosity)).above(0).says("kinematic viscosity of the water"));
  s.push_back(word<flow::Closure>("flow.closure", flow(&F::closure),
                                  {{"k_epsilon", flow::Closure::k_epsilon},
                                   {"k_epsilon_realizable", flow::Closure::k_epsilon_realizable},
                                   {"k_omega", flow::Closure::k_omega},
                                   {"k_omega_sst", flow::Closure::k_omega_sst},
                                   {"laminar", flow::Closure::laminar}})
                  .says("turbulence model: the standard one; with Durbin's bound on its time scale; Wilcox's k-omega "
                        "of 2006; Menter's "
                        "SST; none")
                  .from("Eq. 4-7, Table 1: k_epsilon"));
  s.push_back(
      real("flow.realizability", "-", flow(&F::realizability))
          .within(0.54, 1)
          .says("alpha of k_epsilon_realizable: nut S stays below alpha k/sqrt(3); 1: no negative normal stress, "
                "0.6: Durbin's later choice, with which pipes shed; the log layer needs 0.54"));
  s.push_back(word<flow::Convection>("flow.convection", flow(&F::convection),
                                     {{"hybrid", flow::Convection::hybrid}, {"bounded", flow::Convection::bounded}})
                  .says("hybrid: central below a cell Peclet number of 2, upwind above; bounded: second order, limited")
                  .from("Sec. 2.3"));
  s.push_back(
      word<flow::Algorithm>("flow.algorithm", flow(&F::algorithm),
                            {{"projection", flow::Algorithm::projection}, {"simple", flow::Algorithm::simple}})
          .says(
              "how pressure and velocity are brought together: one second-order projection a step, or implicit SIMPLE "
              "with outer iterations, flow.max_step long at any Courant number")
          .from("Sec. 3: simple"));
  s.push_back(
      flag("flow.steady", flow(&F::steady)).says("simple without inertia: the steady flow past the bed as it is"));
  s.push_back(
      real("flow.relax_velocity", "-", flow(&F::relax_velocity)).above(0, 1).says("under-relaxation of simple"));
  s.push_back(
      real("flow.relax_pressure", "-", flow(&F::relax_pressure)).above(0, 1).says("under-relaxation of simple"));
  s.push_back(real("flow.relax_turbulence", "-", flow(&F::relax_turbulence))
                  .above(0, 1)
                  .says("under-relaxation of simple for k and epsilon or omega"));
  s.push_back(real("flow.tolerance", "-", flow(&F::tolerance))
                  .within(1e-12, 1e-1)
                  .says("outer iterations of simple end when the scaled residuals of all equations are below it"));
  s.push_back(integer("flow.outer_iterations", flow(&F::outer_iterations))
                  .within(1, 100000)
                  .says("most outer iterations of simple in a step"));
  s.push_back(
      word("flow.floor", flow(&F::floor), walls).says("what the floor of the box does to the flow").from("Eq. 9-12"));
  s.push_back(
      flag("flow.wall_damping", flow(&F::wall_damping))
          .says("Van Driest's factor in epsilon at walls with wall function, for the k-epsilon closures; without it "
                "as in OpenFOAM; nothing above y+ = 100")
          .from("Eq. 10-11"));
  s.push_back(real("flow.floor_roughness", "m", flow(&F::floor_roughness))
                  .at_least(0)
                  .says("ks of a rough floor; 2.5 d when 0"));
  s.push_back(real("flow.courant", "-", flow(&F::courant)).above(0, 1).says("target of the adaptive flow step"));
  s.push_back(real("flow.courant_y", "-", flow(&F::courant_y))
                  .within(0, 2)
                  .says("the same along y alone: what exceeds flow.courant is carried upwind and implicitly, so that "
                        "few low cells do not hold up all others; 0: nothing is"));
  s.push_back(
      real("flow.max_step", "s", flow(&F::max_step)).above(0).says("longest flow step").from("Sec. 4.4: 0.04 s"));
  s.push_back(real("flow.pressure_tolerance", "-", flow(&F::pressure_tolerance))
                  .within(1e-14, 1e-2)
                  .says("residual of the pressure solve after over before"));
  s.push_back(integer("flow.pressure_iterations", flow(&F::pressure_iterations))
                  .within(1, 100000)
                  .says("most iterations before the pressure solve counts as failed"));
}

void add_current(std::vector<Row>& s) {
  using C = flow::CurrentParams;
  const auto current = [](auto C::*member) { return at(&Case::flow, &flow::Params::current, member); };
  s.push_back(real("current.theta", "-", at(&Case::theta))
                  .within(1e-4, 10)
                  .says("Shields parameter u*^2/((s-1) g d) of the approaching current")
                  .from("Eq. 29, Table 3"));
  s.push_back(real("current.mean_speed", "m/s", current(&C::mean_speed))
                  .above(0)
                  .says("depth mean over the water")
                  .from("Table 3"));
  s.push_back(real("current.shear_velocity", "m/s", current(&C::shear_velocity)).above(0).says("u*"));
  s.push_back(word<flow::Profile>("current.profile", current(&C::profile),
                                  {{"rough", flow::Profile::rough},
                                   {"smooth", flow::Profile::smooth},
                                   {"developed", flow::Profile::developed},
                                   {"uniform", flow::Profile::uniform},
                                   {"recycled", flow::Profile::recycled}})
                  .says("inlet profile: u*/kappa ln(30 y/ks); ln(9 u* y/nu); the 1D solution of the closure; one "
                        "speed; recycled: the mean over the box, at the speed that makes the measured theta nominal")
                  .from("Eq. 8"));
  s.push_back(real("current.roughness", "m", current(&C::roughness))
                  .at_least(0)
                  .says("ks of the approaching bed; 2.5 d when 0"));
  s.push_back(real("current.rise", "s", current(&C::rise))
                  .at_least(0)
                  .says("time in which the current rises from a tenth, at which no sand moves, to its full speed once "
                        "the grains are free; 0: it is there when they are let go"));
}

}  // namespace livebed::casefile
