#include "validate/oner.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "validate/oner_figures.hpp"

namespace livebed::validate {

namespace {

using flow::Closure;

constexpr double experiment_depth = 12;  ///< [D], Oner et al.: 0.6 m
constexpr double paper_strouhal = 0.158;

struct Model {
  const char* name;
  Closure closure;
  const char* colour;
};
const std::vector<Model> models = {{"k-epsilon", Closure::k_epsilon, "#1f77b4"},
                                   {"k-epsilon, realizable", Closure::k_epsilon_realizable, "#2ca02c"},
                                   {"k-omega SST", Closure::k_omega_sst, "#d62728"}};
const std::vector<std::pair<double, const char*>> gaps = {
    {0.1, "#440154"}, {0.2, "#3b528b"}, {0.3, "#21918c"}, {0.5, "#5ec962"}, {1.0, "#fd9a44"}};

/// The runs made or read so far, by the name of their setup.
class Runs {
public:
  explicit Runs(const Tell& tell) : tell_(tell) {}
  const PipeRun& operator()(const PipeSetup& setup) {
    const auto found = all_.find(setup.name());
    return found != all_.end() ? found->second
                               : all_.emplace(setup.name(), kept_run(setup, kept_runs, tell_)).first->second;
  }

private:
  const Tell& tell_;
  std::map<std::string, PipeRun> all_;
};

PipeSetup setup(Closure closure, double gap, double depth = box_depth) {
  PipeSetup s;
  s.closure = closure, s.gap_ratio = gap, s.depth = depth;
  if (gap != 0.3 && gap != 0.0) s.record = 80;  // only the bed shear and the trends are asked of these
  return s;
}

/// Rows of one run.
void add_rows(const std::string& name, const PipeSetup& which, const PipeRun& run, const Tell& tell, Result& result) {
  const PipeNumbers n = measure(run);
  const auto add = [&](const std::string& what, double value, const std::string& unit,
                       const std::string& reference = {}) -> Row& {
    Row row{name + ": " + what, value, unit};
    row.setup = fmt::format("{}; {} x {} cells, {:.0f} steps in the record", which.text(), run.nx, run.ny, run.steps);
    row.reference = reference;
    row.seconds = run.seconds;
    row.commit = run.commit;
    result.rows.push_back(row);
    return result.rows.back();
  };
  const bool papers = which.gap_ratio == 0.3;
  add("Strouhal number of the lift, with U0; 0 = steady", n.strouhal, "-",
      papers ? fmt::format("{} in Yeganeh-Bakhtiary et al. (2013), close to Oner et al. (2008)", paper_strouhal) : "");
  if (!n.steady()) {
    add("Strouhal number of v 2 D behind the centre, with U0", n.strouhal_wake, "-");
    add("Strouhal number of the lift, with the inlet's speed at the axis", n.strouhal / run.axis_speed, "-");
    add("Strouhal number of the lift, with that speed times depth/(depth - D)",
        n.strouhal / run.axis_speed * (1 - 1 / which.depth), "-");
    add("Strouhal number over five periods, smallest", n.slowest, "-");
    add("Strouhal number over five periods, largest", n.fastest, "-");
    Row& periods = add("shedding periods in the record", n.periods, "-");
    if (papers) periods.low = 20, periods.high = 1000, periods.reference = "at least 20 asked for";
  }
  add("mean drag coefficient", n.cd, "-");
  add("mean lift coefficient", n.cl, "-");
  add("rms lift coefficient", n.cl_rms, "-");
  if (run.cd_box != 0) {
    Row& box = add("drag by the momentum of a box over that on the surface - 1", run.cd_box / n.cd - 1, "-",
                   "the two are the same force");
    box.low = -0.01, box.high = 0.01;
  }
  add("bed shear far upstream (-8 D to -5 D)", n.far_shear * run.inlet_shear, "Pa");
  add("largest mean bed shear within 1 D", n.peak_shear * run.inlet_shear, "Pa");
  add("its place", n.peak_at, "D");
  add("its ratio to the far shear", n.peak_shear / n.far_shear, "-");
  add("length of backward flow on the bed in front of the pipe", n.eddy_before, "D");
  add("first separation on the bed behind the centre; 0 = none", n.separation, "D");
  add("last reattachment on the bed; 0 = none", n.reattachment, "D");
  add("end of the mean wake on the axis, behind the centre; 0 = none", n.wake_end, "D");
  tell(fmt::format(
      "{}: St {:.4f} (wake {:.4f}, axis speed {:.3f}), {:.0f} periods, Cd {:.4f} (box {:+.4f}), Cl {:.4f}, "
      "rms {:.4f}, shear {:.2f} at {:.2f} D, {:.0f} s",
      name, n.strouhal, n.strouhal_wake, run.axis_speed, n.periods, n.cd, run.cd_box != 0 ? run.cd_box / n.cd - 1 : 0.0,
      n.cl, n.cl_rms, n.peak_shear / n.far_shear, n.peak_at, run.seconds));
}

std::string title(const Model& model, const PipeSetup& s) {
  return fmt::format("{}, e/D {}, {} D deep", model.name, s.gap_ratio, s.depth);
}

/// One line for each closure.
std::vector<Drawn> each_closure(Runs& runs, double gap) {
  std::vector<Drawn> drawn;
  for (const Model& m : models) drawn.push_back({m.name, m.colour, &runs(setup(m.closure, gap)), gap});
  return drawn;
}

/// Runs on the paper's grid beside those on the usual one; name: of the figures.
Result fine_grid(const std::vector<Model>& which, const std::vector<double>& at_gaps, const std::string& name,
                 const Tell& tell) {
  Result result;
  Runs runs(tell);
  const auto fine = [](Closure closure, double gap) {
    PipeSetup s = setup(closure, gap);
    s.nx = 1500, s.ny = 260;
    s.record = gap > 0 ? 80 : 20;  // at e/D 0 the flow is steady
    return s;
  };
  const auto change = [&](const std::string& what, const PipeSetup& s, double usual, double refined) {
    Row row{fmt::format("{}: {} on 540 x 94 over that on 1500 x 260 - 1", s.name(), what), usual / refined - 1, "-"};
    row.setup = s.text();
    row.commit = runs(s).commit;
    result.rows.push_back(row);
  };
  for (double gap : at_gaps) {
    std::vector<Drawn> both;
    std::vector<ShearPanel> shear;
    for (const Model& m : which) {
      const PipeSetup s = fine(m.closure, gap), usual = setup(m.closure, gap);
      add_rows(fmt::format("{}, 1500 x 260", title(m, s)), s, runs(s), tell, result);
      const PipeNumbers n = measure(runs(s)), u = measure(runs(usual));
      change("mean drag", s, u.cd, n.cd);
      change("bed shear ratio", s, u.peak_shear / u.far_shear, n.peak_shear / n.far_shear);
      if (!n.steady()) change("Strouhal number", s, u.strouhal, n.strouhal);
      both.push_back({fmt::format("{}, 1500 x 260", m.name), m.colour, &runs(s), gap});
      both.push_back({fmt::format("{}, 540 x 94", m.name), m.colour, &runs(usual), gap, true});
    }
    result.pictures.push_back({fmt::format("{}_profiles_e{}.svg", name, gap), figure_profiles(both)});
    shear.push_back({fmt::format("e/D {}", gap), both});
    result.pictures.push_back({fmt::format("{}_bed_shear_e{}.svg", name, gap), figure_bed_shear(shear)});
    if (gap == 0.3) result.pictures.push_back({name + "_snapshots.svg", figure_snapshots(both.front())});
  }
  return result;
}

}  // namespace

Result oner(const Tell& tell) {
  Result result;
  Runs runs(tell);
  const auto look = [&](const std::string& name, const PipeSetup& s) { add_rows(name, s, runs(s), tell, result); };
  const auto look_each = [&](double gap) {
    for (const Model& m : models) look(title(m, setup(m.closure, gap)), setup(m.closure, gap));
  };
  look_each(0.3), look_each(0.0);
  for (const auto& [gap, colour] : gaps)
    if (gap != 0.3) look_each(gap);
  for (const Model& m : models) {
    double before = 0;
    for (const auto& [gap, colour] : gaps) {
      const PipeNumbers n = measure(runs(setup(m.closure, gap)));
      const double ratio = n.peak_shear / n.far_shear;
      if (before > 0) {
        Row row{fmt::format("{}: bed shear ratio at e/D {} over that at the next smaller gap", m.name, gap),
                ratio / before, "-", 0, 1};
        row.reference = "falls as the gap grows: Yeganeh-Bakhtiary et al. (2013), Fig. 7";
        row.setup = setup(m.closure, gap).text();
        result.rows.push_back(row);
      }
      before = ratio;
    }
  }

  std::vector<ShearPanel> shear;
  for (const Model& m : models) {
    ShearPanel panel{m.name, {}};
    for (const auto& [gap, colour] : gaps)
      panel.runs.push_back({fmt::format("e/D {}", gap), colour, &runs(setup(m.closure, gap)), gap});
    shear.push_back(panel);
  }
  shear.push_back({"k-epsilon, mu dU/dy in the first cells (Eq. 13)", shear.front().runs, true});
  std::vector<Drawn> shedding;
  for (const Model& m : models) {
    const PipeSetup s = setup(m.closure, 0.3);
    shedding.push_back({title(m, s), m.colour, &runs(s), 0.3});
  }
  result.pictures = {
      {"oner_3_profiles_e0.3.svg", figure_profiles(each_closure(runs, 0.3))},
      {"oner_3_profiles_e0.svg", figure_profiles(each_closure(runs, 0.0))},
      {"oner_4_streamlines_e0.svg", figure_mean_streamlines(each_closure(runs, 0.0))},
      {"oner_4_streamlines_e0.3.svg", figure_mean_streamlines(each_closure(runs, 0.3))},
      {"oner_5_snapshots.svg", figure_snapshots(shedding.front())},
      {"oner_6_velocity.svg", figure_velocity(shedding)},
      {"oner_7_bed_shear.svg", figure_bed_shear(shear)},
      {"oner_8_spectra.svg", figure_spectra(shedding)},
  };
  return result;
}

Result oner_depth(const Tell& tell) {
  Result result;
  Runs runs(tell);
  const auto look = [&](const std::string& name, const PipeSetup& s) { add_rows(name, s, runs(s), tell, result); };
  for (const Model& m : models) {
    const PipeSetup s = setup(m.closure, 0.3, experiment_depth);
    look(title(m, s), s);
  }
  // One thing changed at a time, k-epsilon, e/D 0.3.
  const PipeSetup base = setup(Closure::k_epsilon, 0.3);
  look(title(models.front(), base), base);
  const auto varied = [&](const std::string& what, auto&& change) {
    PipeSetup s = base;
    change(s);
    look("k-epsilon, e/D 0.3: " + what, s);
  };
  varied("12 D deep, inlet profile of the 3.5 D box",
         [](PipeSetup& s) { s.depth = experiment_depth, s.profile_depth = box_depth; });
  varied("3.5 D deep, inlet profile of the 12 D channel", [](PipeSetup& s) { s.profile_depth = experiment_depth; });
  varied("3.5 D deep, uniform inlet", [](PipeSetup& s) { s.profile = flow::Profile::uniform; });
  varied("3.5 D deep, hybrid scheme", [](PipeSetup& s) { s.convection = flow::Convection::hybrid; });
  varied("3.5 D deep, 270 x 48 cells", [](PipeSetup& s) { s.nx = 270, s.ny = 48; });
  varied("3.5 D deep, 810 x 140 cells", [](PipeSetup& s) { s.nx = 810, s.ny = 140, s.record = 80; });
  std::vector<Drawn> deep, spectra;
  for (const Model& m : models) {
    const PipeSetup s = setup(m.closure, 0.3, experiment_depth), box = setup(m.closure, 0.3);
    deep.push_back({fmt::format("{}, 12 D deep", m.name), m.colour, &runs(s), 0.3});
    deep.push_back({fmt::format("{}, 3.5 D deep", m.name), m.colour, &runs(box), 0.3, true});
    spectra.push_back({title(m, s), m.colour, &runs(s), 0.3});
  }
  result.pictures = {{"oner_depth_3_profiles_e0.3.svg", figure_profiles(deep)},
                     {"oner_depth_7_bed_shear_e0.3.svg", figure_bed_shear({{"e/D 0.3", deep}})},
                     {"oner_depth_8_spectra.svg", figure_spectra(spectra)}};
  return result;
}

Result oner_layer(const Tell& tell) {
  Result result;
  Runs runs(tell);
  std::vector<ShearPanel> shear;
  std::vector<Drawn> spectra;
  for (const double depth : {box_depth, experiment_depth})
    for (const auto& gap : gaps) {
      if (depth == experiment_depth && gap.first != 0.3 && gap.first != 1.0) continue;
      std::vector<Drawn> both;
      for (const flow::PipeLayer layer : {flow::PipeLayer::turbulent, flow::PipeLayer::laminar}) {
        PipeSetup s = setup(Closure::k_epsilon_realizable, gap.first, depth);
        s.layer = layer;
        const bool laminar = layer == flow::PipeLayer::laminar;
        const std::string name = laminar ? "laminar layer" : "turbulent layer";
        add_rows(fmt::format("{}, e/D {}, {} D deep", name, gap.first, depth), s, runs(s), tell, result);
        both.push_back({name, laminar ? "#d62728" : "#2ca02c", &runs(s), gap.first});
      }
      if (depth == box_depth) shear.push_back({fmt::format("e/D {}", gap.first), both});
      if (depth == box_depth && gap.first == 1.0) spectra = both;
    }
  result.pictures = {{"oner_layer_7_bed_shear.svg", figure_bed_shear(shear)},
                     {"oner_layer_8_spectra_e1.svg", figure_spectra(spectra)}};
  return result;
}

Result oner_fine(const Tell& tell) { return fine_grid({models[0]}, {0.3}, "oner_fine", tell); }

Result oner_fine_bed(const Tell& tell) { return fine_grid({models[0]}, {0.0}, "oner_fine_bed", tell); }

Result oner_fine_closures(const Tell& tell) {
  return fine_grid({models[1], models[2]}, {0.3}, "oner_fine_closures", tell);
}

Result oner_fine_bed_closures(const Tell& tell) {
  return fine_grid({models[1], models[2]}, {0.0}, "oner_fine_bed_closures", tell);
}

}  // namespace livebed::validate
