#include "case/check.hpp"
#include "case/rows.hpp"

namespace livebed::casefile {

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
  s.push_back(
      word<Supply>("bed.supply", at(&Case::supply),
                   {{"periodic", Supply::periodic}, {"equilibrium", Supply::equilibrium}, {"none", Supply::none}})
          .says("sand at the ends: what leaves through one end comes in at the other; or it is gone, and there "
                "comes in what moves over the bed well before the pipe, or nothing")
          .from("Sec. 4.3: periodic"));
  s.push_back(integer("bed.seed", grains(&G::seed))
                  .within(0, 4294967295.0)
                  .says("of the diameters and of the lattice's small shifts"));
  s.push_back(
      word<grains::Placing>("bed.start", grains(&G::start),
                            {{"lattice", grains::Placing::lattice}, {"scattered", grains::Placing::scattered}})
          .says("the grains before they settle: rows of a square lattice, or scattered as densely as they will lie")
          .from("Sec. 4.3: lattice"));
  s.push_back(integer("bed.pieces", grains(&G::pieces))
                  .within(1, 1000)
                  .says("equal pieces side by side that the bed is made of: one is packed, then copied and settled "
                        "with its copies, so that a long bed takes little longer than a short one"));
  s.push_back(
      text("bed.file", at(&Case::bed_file))
          .says("LAMMPS data file (atom_style sphere) from which the grains settle instead of being packed; its "
                "box is mesh.length long"));
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
  s.push_back(word<grains::Precision>("grains.precision", grains(&G::precision),
                                      {{"double", grains::Precision::all_double}, {"mixed", grains::Precision::mixed}})
                  .says("of the steps; mixed: places and overlaps in double, velocities and forces in single, which is "
                        "faster; beds are packed in double")
                  .from("not said"));
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
                  .says("change of the fluid's force, over what presses the grain, that wakes it"));
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

}  // namespace livebed::casefile
