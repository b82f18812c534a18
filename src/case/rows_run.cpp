#include "case/rows.hpp"

namespace livebed::casefile {

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
  s.push_back(word<coupling::Drag>("coupling.drag", coupling(&C::drag),
                                   {{"paper", coupling::Drag::paper},
                                    {"di_felice", coupling::Drag::di_felice},
                                    {"gidaspow", coupling::Drag::gidaspow},
                                    {"rong", coupling::Drag::rong}})
                  .says("drag law; paper: one grain alone; the others know the void fraction around it")
                  .from("Eq. 15-18: paper"));
  s.push_back(
      word<coupling::DragCurve>("coupling.drag_curve", coupling(&C::drag_curve),
                                {{"sum", coupling::DragCurve::sum}, {"dallavalle", coupling::DragCurve::dallavalle}})
          .says("drag coefficient of one grain: A/Re + B, or (sqrt(A/Re) + sqrt(B))^2")
          .from("Eq. 18: sum"));
  s.push_back(
      real("coupling.drag_viscous", "-", coupling(&C::drag_viscous)).within(0, 100).says("A").from("Eq. 18: 24"));
  s.push_back(
      real("coupling.drag_infinity", "-", coupling(&C::drag_infinity)).within(0, 10).says("B, C_Dinf").from("Table 2"));
  s.push_back(word<coupling::Voidage>("coupling.voidage", coupling(&C::voidage),
                                      {{"off", coupling::Voidage::off}, {"on", coupling::Voidage::on}})
                  .says("does the void fraction enter the equations of the water, and its pressure gradient push the "
                        "grains?")
                  .from("Sec. 2: it does not"));
  s.push_back(
      word<coupling::AddedMass>("coupling.added_mass", coupling(&C::added_mass),
                                {{"grain", coupling::AddedMass::grain}, {"relative", coupling::AddedMass::relative}})
          .says("added mass on the grain's own acceleration, or on that relative to the water, which takes the "
                "reaction")
          .from("Eq. 14: grain"));
  s.push_back(word<coupling::Lift>("coupling.lift", coupling(&C::lift),
                                   {{"none", coupling::Lift::none}, {"saffman_mei", coupling::Lift::saffman_mei}})
                  .says("lift of a grain in sheared water")
                  .from("none"));
  s.push_back(
      word<coupling::Turbulence>("coupling.turbulence", coupling(&C::turbulence),
                                 {{"untouched", coupling::Turbulence::untouched},
                                  {"bounded", coupling::Turbulence::bounded},
                                  {"damped", coupling::Turbulence::damped}})
          .says("what grains do to the eddies; bounded: none among them is larger than its distance from the packed "
                "bed; damped: besides, grains that do not follow the eddies take k from them")
          .from("untouched"));
  s.push_back(real("coupling.turbulence_inertia", "-", coupling(&C::turbulence_inertia))
                  .within(0, 10)
                  .says("B of the share exp(-B St) of an eddy's motion that a grain follows"));
  s.push_back(real("coupling.room_power", "-", coupling(&C::room_power))
                  .within(0, 10)
                  .says("n of (1 - solid/packed)^n, by which a way through grains counts in that distance"));
  s.push_back(word<coupling::Dispersion>("coupling.dispersion", coupling(&C::dispersion),
                                         {{"none", coupling::Dispersion::none},
                                          {"random_walk", coupling::Dispersion::random_walk},
                                          {"attached", coupling::Dispersion::attached}})
                  .says("do grains feel a fluctuation of the modelled k?  attached: along the stream that of the "
                        "strongest eddies that reach down to them")
                  .from("none"));
  s.push_back(real("coupling.dispersion_energy", "-", coupling(&C::dispersion_energy))
                  .above(0, 10)
                  .says("energy of that fluctuation over the modelled k; right above a bed more than closures say"));
  s.push_back(real("coupling.dispersion_time", "-", coupling(&C::dispersion_time))
                  .above(0, 10)
                  .says("time scale of that fluctuation over k/epsilon"));
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
  const auto output = [](auto O::*member) { return at(&Case::output, member); };
  s.push_back(real("output.series_every", "s", output(&O::series_every)).above(0).says("rows of series.csv"));
  s.push_back(real("output.bed_every", "s", output(&O::bed_every)).above(0).says("lines of bed.csv"));
  s.push_back(
      real("output.fields_every", "s", output(&O::fields_every)).above(0).says("fields and grains for ParaView"));
  s.push_back(real("output.checkpoint_every", "s", output(&O::checkpoint_every))
                  .above(0)
                  .says("checkpoints, in simulated time"));
  s.push_back(real("output.profiles_every", "s", output(&O::profiles_every))
                  .at_least(0)
                  .says("profiles.csv: means over windows of this length, one after the other; 0: none"));
  s.push_back(
      real("output.profiles_from", "s", output(&O::profiles_from)).at_least(0).says("begin of the first window"));
  s.push_back(real("output.profiles_x_from", "m", output(&O::profiles_x_from))
                  .at_least(0)
                  .says("begin of the stretch that profiles are taken over"));
  s.push_back(real("output.profiles_x_to", "m", output(&O::profiles_x_to))
                  .at_least(0)
                  .says("end of that stretch; 0: that of the box"));
  s.push_back(real("output.profiles_cell", "m", output(&O::profiles_cell))
                  .at_least(0)
                  .says("height of the layers of a profile; 0: a quarter of a grain"));
  s.push_back(real("output.tracks_every", "s", output(&O::tracks_every))
                  .at_least(0)
                  .says("tracks.csv: rows of grains that are followed; 0: none"));
  s.push_back(integer("output.tracks", output(&O::tracks))
                  .within(1, 10000)
                  .says("how many of them: those nearest to the bed under the pipe when the grains are released"));
  s.push_back(text("output.track_ids", output(&O::track_ids))
                  .says("or which: their ids with commas, as in \"12, 40\"; grains/ tells them"));
  s.push_back(real("output.contacts_every", "s", output(&O::contacts_every))
                  .at_least(0)
                  .says("contacts.pvd: forces in the contacts, as lines for ParaView; 0: none"));
}

}  // namespace livebed::casefile
