#include "case/schema.hpp"

#include <fmt/format.h>
#include <type_traits>
#include <utility>

#include "case/check.hpp"

namespace livebed::casefile {
namespace {

/// Path from a Case to one of its numbers: at(&Case::flow, &flow::Params::density).
template <class... Members>
auto at(Members... members) {
  return [=](auto& c) -> auto& { return (c.*....*members); };
}

/// A row whose value is stored as Stored (double, integer, bool, text) at the end of a path.
template <class Stored, class Path>
Row row(std::string name, Type type, Path path) {
  Row r;
  r.name = std::move(name);
  r.type = type;
  r.get = [path](const Case& c) { return Value(static_cast<Stored>(path(c))); };
  r.set = [path](Case& c, const Value& v) {
    using Member = std::remove_reference_t<decltype(path(c))>;
    path(c) = static_cast<Member>(std::get<Stored>(v));
  };
  return r;
}

template <class Path>
Row real(std::string name, std::string unit, Path path) {
  Row r = row<double>(std::move(name), Type::real, path);
  r.unit = std::move(unit);
  return r;
}
template <class Path>
Row integer(std::string name, Path path) {
  return row<long long>(std::move(name), Type::integer, path);
}
template <class Path>
Row flag(std::string name, Path path) {
  return row<bool>(std::move(name), Type::flag, path);
}
template <class Path>
Row text(std::string name, Path path) {
  return row<std::string>(std::move(name), Type::text, path);
}
/// A choice between words, each standing for one value of an enumeration.
template <class Enum, class Path>
Row word(std::string name, Path path, std::vector<std::pair<std::string, Enum>> meanings) {
  Row r;
  r.name = std::move(name);
  r.type = Type::word;
  for (const auto& [allowed, value] : meanings) r.words.push_back(allowed);
  r.get = [=](const Case& c) {
    for (const auto& [allowed, value] : meanings)
      if (path(c) == value) return Value(allowed);
    return Value(std::string("?"));  // an enumerator without a word: the schema's test fails on it
  };
  r.set = [=](Case& c, const Value& v) {
    for (const auto& [allowed, value] : meanings)
      if (std::get<std::string>(v) == allowed) path(c) = value;
  };
  return r;
}
/// A number that follows from others.
template <class Path>
Row derived(std::string name, std::string unit, Path path) {
  Row r = real(std::move(name), std::move(unit), path);
  r.derived = true;
  return r;
}

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

const std::vector<std::pair<std::string, flow::Wall>> walls{{"rough", flow::Wall::rough},
                                                            {"smooth", flow::Wall::smooth},
                                                            {"no_slip", flow::Wall::no_slip},
                                                            {"slip", flow::Wall::slip}};

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
                                   {"k_omega_sst", flow::Closure::k_omega_sst},
                                   {"laminar", flow::Closure::laminar}})
                  .says("turbulence model: the standard one; with Durbin's bound on its time scale; Menter's SST; none")
                  .from("Eq. 4-7, Table 1: k_epsilon"));
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
                                   {"uniform", flow::Profile::uniform}})
                  .says("inlet profile: u*/kappa ln(30 y/ks); ln(9 u* y/nu); the 1D solution of the closure; one speed")
                  .from("Eq. 8"));
  s.push_back(real("current.roughness", "m", current(&C::roughness))
                  .at_least(0)
                  .says("ks of the approaching bed; 2.5 d when 0"));
}

void add_bed(std::vector<Row>& s) {
  using G = grains::Params;
  const auto grains = [](auto G::*member) { return at(&Case::grains, member); };
  s.push_back(real("bed.thickness", "m", at(&Case::bed_thickness))
                  .at_least(0)
                  .says("level of the bed: packed higher and cut to it; the run measures the true one")
                  .from("Sec. 4.4"));
  s.push_back(
      integer("bed.count", grains(&G::count)).within(0, most_grains).says("number of grains").from("Sec. 4.3: 6240"));
  s.push_back(
      real("bed.cut", "m", at(&Case::cut))
          .at_least(0)
          .says("level to which the bed is cut so that bed.count grains remain; a run writes it into its resolved "
                "case; 0: it is not cut"));
  s.push_back(real("bed.level", "m", at(&Case::measured_level))
                  .at_least(0)
                  .says("true level of the packed bed; a run writes it into its resolved case; 0: not known yet"));
  s.push_back(word<grains::Floor>("bed.floor", grains(&G::floor),
                                  {{"grains", grains::Floor::grains}, {"plane", grains::Floor::plane}})
                  .says("the bottom of the bed: a row of fixed grains or a smooth plane")
                  .from("Sec. 4.3"));
  s.push_back(
      flag("bed.side_walls", grains(&G::side_walls))
          .says("walls for the grains at both ends of the box instead of the period; the water does not see them"));
  s.push_back(
      text("bed.walls", at(&Case::walls))
          .says("further walls for the grains: points \"x y\" in m with commas, lines with semicolons between, as in "
                "\"0.1 0.3, 0.1 0; 0.2 0.1, 0.3 0.2\"; the water does not see them"));
  s.push_back(integer("bed.seed", grains(&G::seed))
                  .within(0, 4294967295.0)
                  .says("of the diameters and of the lattice's small shifts"));
  s.push_back(
      word<grains::Placing>("bed.start", grains(&G::start),
                            {{"lattice", grains::Placing::lattice}, {"scattered", grains::Placing::scattered}})
          .says("the grains before they settle: rows of a square lattice, or scattered as densely as they will lie")
          .from("Sec. 4.3: lattice"));
  s.push_back(real("bed.packing_fraction", "-", grains(&G::packing_fraction))
                  .within(0.5, 0.9)
                  .says("share of the plane inside the bed that grains are to fill as circles: how densely they are "
                        "scattered, and how many a thickness needs; the run tells what came out"));
  s.push_back(real("bed.lattice_gap", "-", grains(&G::lattice_gap))
                  .within(0, 1)
                  .says("gap between the grains of the starting lattice over d")
                  .from("Sec. 4.3"));
  s.push_back(real("bed.settled_speed", "m/s", grains(&G::settled_speed))
                  .above(0)
                  .says("packing ends when the mean grain speed stays below this"));
  s.push_back(real("bed.settle_time", "s", grains(&G::settle_time)).above(0).says("longest packing"));
}

void add_grains(std::vector<Row>& s) {
  using G = grains::Params;
  const auto grains = [](auto G::*member) { return at(&Case::grains, member); };
  s.push_back(real("grains.diameter", "m", grains(&G::diameter))
                  .within(1e-6, 1)
                  .says("d, mean; follows as d50 from a grading")
                  .from("Sec. 4.3"));
  s.push_back(real("grains.density", "kg/m3", grains(&G::density)).above(0).says("rho_s"));
  s.push_back(real("grains.spread", "-", grains(&G::spread))
                  .within(0, 0.5)
                  .says("half-width of the uniform distribution of diameters over d; 0 settles into a crystal"));
  s.push_back(real("grains.d10", "m", at(&Case::d10))
                  .at_least(0)
                  .says("10 % of the mass of the sand is finer; goes with grains.d50; 0: not given"));
  s.push_back(real("grains.d50", "m", at(&Case::d50))
                  .within(1e-6, 1)
                  .says("median by mass of sand of many sizes, instead of grains.diameter and grains.spread"));
  s.push_back(real("grains.d90", "m", at(&Case::d90))
                  .at_least(0)
                  .says("90 % of the mass of the sand is finer; goes with grains.d50; 0: not given"));
  s.push_back(
      text("grains.grading", at(&Case::grading))
          .says("the same as a sieve curve, diameter: share of the mass that passes, as in \"0.2 mm: 10 %, 0.36 "
                "mm: 50 %, 0.6 mm: 90 %\"; log-linear between the points and beyond"));
  s.push_back(real("grains.added_mass", "-", grains(&G::added_mass)).within(0, 2).says("C_M").from("Eq. 15, Table 2"));
  s.push_back(word<grains::Inertia>("grains.inertia", grains(&G::inertia),
                                    {{"sphere", grains::Inertia::sphere}, {"disk", grains::Inertia::disk}})
                  .says("moment of inertia: m d^2/10 or m d^2/8")
                  .from("Eq. 17"));
  s.push_back(real("grains.gravity", "m/s2", grains(&G::gravity)).above(0).says("g"));
  s.push_back(
      flag("grains.sleep", grains(&G::sleep))
          .says("grains of the bed that have been at rest for a while are passed over until a force on them changes"));
  s.push_back(real("grains.sleep_speed", "-", grains(&G::sleep_speed))
                  .within(1e-8, 0.1)
                  .says("slower than this over sqrt(g' d) counts as at rest"));
  s.push_back(real("grains.sleep_time", "-", grains(&G::sleep_time))
                  .within(0.1, 1000)
                  .says("for so long over sqrt(d/g') before they fall asleep"));
  s.push_back(real("grains.sleep_force", "-", grains(&G::sleep_force))
                  .within(1e-6, 1)
                  .says("change of the contact force, over what presses the grain, that wakes it"));
  s.push_back(real("grains.sleep_drag", "-", grains(&G::sleep_drag))
                  .within(1e-6, 10)
                  .says("change of the fluid's force, over the submerged weight, that wakes a grain"));
}

void add_contact(std::vector<Row>& s) {
  using G = grains::Params;
  const auto grains = [](auto G::*member) { return at(&Case::grains, member); };
  s.push_back(real("contact.stiffness", "N/m", grains(&G::stiffness))
                  .above(0)
                  .says("k_n; follows from time.grain_step when that is given")
                  .from("Eq. 21, 25"));
  s.push_back(real("contact.steps", "-", grains(&G::steps_per_contact))
                  .within(5, 10000)
                  .says("grain steps in the critical time 2 pi sqrt(m / 2 k_n)")
                  .from("Eq. 25: 20"));
  s.push_back(real("contact.damping", "-", grains(&G::damping))
                  .within(0, 2)
                  .says("alpha_cn: dashpot over critical damping of the full mass")
                  .from("Eq. 27: 1.0"));
  s.push_back(real("contact.restitution", "-", grains(&G::restitution))
                  .above(0, 1)
                  .says("dry normal restitution of a pair; alpha_cn follows from it"));
  s.push_back(real("contact.friction", "-", grains(&G::friction)).within(0, 5).says("mu").from("Eq. 24"));
  s.push_back(real("contact.poisson", "-", grains(&G::poisson))
                  .within(0, 0.5)
                  .says("k_s = k_n/(2 (1 + nu)), eta_s likewise")
                  .from("Eq. 26-27"));
  s.push_back(real("contact.wall_factor", "-", grains(&G::wall_factor))
                  .within(0.1, 10)
                  .says("stiffness, damping and friction of walls over those of grains")
                  .from("Eq. 28"));
  s.push_back(
      word<grains::Law>("contact.law", grains(&G::law), {{"paper", grains::Law::paper}, {"hooke", grains::Law::hooke}})
          .says("dashpots: one constant for all pairs, or by the reduced mass of the pair, so that any two sizes "
                "rebound alike")
          .from("Eq. 27: paper"));
  s.push_back(real("contact.rolling_friction", "-", grains(&G::rolling_friction))
                  .within(0, 2)
                  .says("mu_r of an elastic-plastic resistance to rolling; 0: none")
                  .from("none"));
  s.push_back(real("contact.rolling_damping", "-", grains(&G::rolling_damping))
                  .within(0, 1)
                  .says("dashpot of that resistance over its critical damping"));
  const auto factor = [&](std::string name, grains::WallFactors G::*wall, double grains::WallFactors::*of,
                          std::string what) {
    s.push_back(real(std::move(name), "-", at(&Case::grains, wall, of))
                    .within(-1, 100)
                    .says(what + " over that between grains; negative: contact.wall_factor"));
  };
  using W = grains::WallFactors;
  factor("contact.pipe_stiffness", &G::pipe, &W::stiffness, "spring of the pipe");
  factor("contact.pipe_damping", &G::pipe, &W::damping, "dashpot of the pipe");
  factor("contact.pipe_friction", &G::pipe, &W::friction, "friction of the pipe");
  factor("contact.pipe_rolling", &G::pipe, &W::rolling, "rolling friction of the pipe");
  factor("contact.bottom_stiffness", &G::bottom, &W::stiffness, "spring of the floor and of other walls");
  factor("contact.bottom_damping", &G::bottom, &W::damping, "their dashpot");
  factor("contact.bottom_friction", &G::bottom, &W::friction, "their friction");
  factor("contact.bottom_rolling", &G::bottom, &W::rolling, "their rolling friction");
  s.push_back(real("contact.gamma", "-", grains(&G::gamma))
                  .within(0.9, 1.1)
                  .says("distance of first contact over the sum of the radii")
                  .from("Eq. 19"));
  s.push_back(word<grains::Tension>("contact.tension", grains(&G::tension),
                                    {{"none", grains::Tension::none}, {"spring", grains::Tension::spring}})
                  .says("may the dashpot pull? spring: cut when the spring is in tension; none: total force >= 0")
                  .from("Eq. 23"));
  s.push_back(word<grains::FrictionLimit>(
                  "contact.friction_limit", grains(&G::friction_limit),
                  {{"total", grains::FrictionLimit::total_force}, {"spring", grains::FrictionLimit::spring_force}})
                  .says("what bounds friction: the total normal force or the spring's")
                  .from("Eq. 24"));
  s.push_back(real("contact.skin", "-", grains(&G::skin))
                  .within(0.01, 2)
                  .says("extra reach of the neighbour lists over d; speed alone depends on it"));
}

void add_coupling(std::vector<Row>& s) {
  using C = coupling::Params;
  const auto coupling = [](auto C::*member) { return at(&Case::coupling, member); };
  s.push_back(
      word<coupling::Mode>(
          "coupling.mode", coupling(&C::mode),
          {{"none", coupling::Mode::none}, {"one-way", coupling::Mode::one_way}, {"two-way", coupling::Mode::two_way}})
          .says("one-way: the flow pushes the grains; two-way: and they push back")
          .from("Abstract: two-way, Sec. 5: one-way"));
  s.push_back(
      word<coupling::Exchange>("coupling.exchange", coupling(&C::exchange),
                               {{"implicit", coupling::Exchange::implicit}, {"lagged", coupling::Exchange::lagged}})
          .says("how the water takes the drag: inside the momentum step, or the whole impulse one step later")
          .from("Sec. 4.1"));
  s.push_back(word<coupling::Drag>("coupling.drag", coupling(&C::drag), {{"paper", coupling::Drag::paper}})
                  .says("drag law; paper: C_D = C_Dinf + 24/Re_p on the slip")
                  .from("Eq. 15-18"));
  s.push_back(word<coupling::Voidage>("coupling.voidage", coupling(&C::voidage), {{"off", coupling::Voidage::off}})
                  .says("does the void fraction enter the equations of the water?")
                  .from("Sec. 2: it does not"));
  s.push_back(
      real("coupling.drag_infinity", "-", coupling(&C::drag_infinity)).within(0, 10).says("C_Dinf").from("Table 2"));
  s.push_back(real("coupling.kernel", "-", coupling(&C::kernel))
                  .within(0.5, 10)
                  .says("half-width of the transfer between grains and cells over d"));
}

void add_time(std::vector<Row>& s) {
  using T = TimeParams;
  const auto time = [](auto T::*member) { return at(&Case::time, member); };
  s.push_back(real("time.grain_step", "s", at(&Case::grains, &grains::Params::step))
                  .above(0)
                  .says("step of the grains; follows from contact.stiffness when that is given")
                  .from("Sec. 4.4: \"10 E-5\""));
  s.push_back(real("time.end", "s", time(&T::end)).above(0).says("last time; t = 0 is the release of the grains"));
  s.push_back(real("time.end_over_T", "-", time(&T::end_over_T))
                  .above(0)
                  .says("the same in scour time scales; needs a pipe and a bed"));
  s.push_back(real("time.spin_up", "s", time(&T::spin_up)).at_least(0).says("flow over the fixed bed before t = 0"));
  s.push_back(flag("time.stop_at_equilibrium", time(&T::stop_at_equilibrium)).says("end as soon as S/D is steady"));
  s.push_back(real("time.equilibrium_change", "-", time(&T::equilibrium_change))
                  .above(0, 1)
                  .says("S/D is steady when its means over the two halves of the window differ by less"));
  s.push_back(real("time.equilibrium_window", "-", time(&T::equilibrium_window))
                  .above(0)
                  .says("length of that window in scour time scales"));
  s.push_back(derived("time.scale", "s", at(&Case::time_scale))
                  .says("T = D^2/sqrt(g (s-1) d^3) theta^(-5/3)/50; 0 without a pipe or grains"));
}

void add_output(std::vector<Row>& s) {
  using O = OutputParams;
  const auto output = [](double O::*member) { return at(&Case::output, member); };
  s.push_back(real("output.series_every", "s", output(&O::series_every)).above(0).says("rows of series.csv"));
  s.push_back(real("output.bed_every", "s", output(&O::bed_every)).above(0).says("lines of bed.csv"));
  s.push_back(
      real("output.fields_every", "s", output(&O::fields_every)).above(0).says("fields and grains for ParaView"));
  s.push_back(real("output.checkpoint_every", "s", output(&O::checkpoint_every))
                  .above(0)
                  .says("checkpoints, in simulated time"));
}

}  // namespace

const std::vector<Row>& schema() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> s;
    for (const auto add : {add_general, add_mesh, add_pipe, add_flow, add_current, add_bed, add_grains, add_contact,
                           add_coupling, add_time, add_output})
      add(s);
    return s;
  }();
  return rows;
}

const Row* find_row(std::string_view name) {
  for (const Row& row : schema())
    if (row.name == name) return &row;
  return nullptr;
}

const std::vector<Alternatives>& alternatives() {
  static const std::vector<Alternatives> groups{
      {{"current.theta", "current.mean_speed", "current.shear_velocity"}, ""},
      {{"bed.thickness", "bed.count"}, "bed.thickness"},
      {{"grains.diameter", "grains.d50", "grains.grading"}, "grains.diameter"},
      {{"grains.spread", "grains.d50", "grains.grading"}, "grains.spread"},
      {{"contact.stiffness", "time.grain_step"}, "time.grain_step"},
      {{"contact.damping", "contact.restitution"}, "contact.restitution"},
      {{"time.end", "time.end_over_T"}, "time.end"}};
  return groups;
}

const std::vector<std::string>& presets() {
  static const std::vector<std::string> names{"livebed", "mbs2d"};
  return names;
}

const std::vector<Choice>& choices() {
  // The damping of the paper, alpha_cn = 1 with 20 steps, never comes to rest in a dense bed: 80 steps do.  Over a
  // smooth plane the lowest grains roll and the whole bed slides downstream, so both presets stand on fixed grains.
  static const std::vector<Choice> rows{{"flow.convection", "hybrid", "bounded"},
                                        {"current.profile", "rough", "rough"},
                                        {"bed.floor", "grains", "grains"},
                                        {"bed.start", "lattice", "scattered"},
                                        {"grains.spread", "0", "0.05"},
                                        {"grains.inertia", "disk", "sphere"},
                                        {"contact.steps", "80", "30"},
                                        {"contact.damping", "1.0", ""},
                                        {"contact.restitution", "", "0.3"},
                                        {"contact.wall_factor", "2", "2"},
                                        {"contact.tension", "spring", "none"},
                                        {"contact.friction_limit", "spring", "total"},
                                        {"time.grain_step", "1e-5", "1e-5"},
                                        {"coupling.mode", "two-way", "two-way"},
                                        {"coupling.exchange", "lagged", "implicit"},
                                        {"coupling.voidage", "off", "off"}};
  return rows;
}

std::string Range::text() const {
  return fmt::format("{}{}, {}{}", least_open ? '(' : '[', least, most, most_open ? ')' : ']');
}

std::string written(const Value& value) {
  if (const bool* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  if (const long long* i = std::get_if<long long>(&value)) return fmt::format("{}", *i);
  if (const double* a = std::get_if<double>(&value)) return fmt::format("{}", *a);
  std::string quoted = "\"";
  for (const char c : std::get<std::string>(value)) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      quoted += c;
  }
  return quoted + "\"";
}

}  // namespace livebed::casefile
