#include "app/plan_text.hpp"

#include <cmath>
#include <fmt/format.h>

#include "base/loops.hpp"

namespace livebed::app {
namespace {

using casefile::Expected;
using casefile::Scene;

constexpr const char* mark = "(*)";  ///< of a formula whose text was not seen in its source
constexpr const char* time_scale_formula = "T = D²/√(g(s-1)d³) θ^(-5/3)/50, Fredsøe, Sumer and Arnskov 1992";
constexpr const char* onset_formula = "U² = 0.025 exp(9√b) g D (1-n)(s-1), Sumer et al. 2001";
constexpr const char* three_dimensional =
    "Free spans and the spread of scour along the pipe are three-dimensional matters: nothing here answers them.";

std::string row(const char* name, const std::string& value, const std::string& meaning) {
  return fmt::format("  {:<12} {:<14} {}\n", name, value, meaning);
}

const char* name_of(base::Regime regime) {
  switch (regime) {
    case base::Regime::no_motion:
      return "no motion";
    case base::Regime::clear_water:
      return "clear water";
    case base::Regime::live_bed:
      break;
  }
  return "live bed";
}

std::string meaning_of(const Expected& e) {
  switch (e.regime) {
    case base::Regime::no_motion:
      return "theta stays below theta_c, also under a pipe: nothing moves";
    case base::Regime::clear_water:
      return fmt::format("sand moves under the pipe alone, where the stress rises up to {:g} times {}",
                         base::pipe_amplification, mark);
    case base::Regime::live_bed:
      break;
  }
  return fmt::format("theta/theta_c = {:.3g}: the whole bed moves", e.theta / e.theta_critical);
}

const char* meaning_of_rouse(double rouse) {
  if (rouse > 2.5) return "sand stays near the bed";
  return rouse > 0.8 ? "part of the sand is carried up into the water" : "the water carries the sand through its depth";
}

std::string length(double m) { return m < 0.01 ? fmt::format("{:.3g} mm", 1e3 * m) : fmt::format("{:.3g} m", m); }

std::string sand_and_current(const Scene& w, const Expected& e) {
  std::string text = "Current and sand\n";
  text += row("theta", fmt::format("{:.3g}", e.theta), "Shields parameter u*²/((s-1) g d)");
  text += row("theta_c", fmt::format("{:.3g}", e.theta_critical),
              fmt::format("threshold of motion, Soulsby (1997); D* = {:.3g}", e.D_star));
  text += row("regime", name_of(e.regime), meaning_of(e));
  text += row("u*", fmt::format("{:.3g} m/s", w.shear_velocity),
              fmt::format("U = {:.3g} m/s over {} of water", w.mean_speed, length(w.depth)));
  text += row("Re*", fmt::format("{:.3g}", e.grain_reynolds), "u* d/nu");
  if (w.D > 0) text += row("Re_D", fmt::format("{:.3g}", e.pipe_reynolds), "U D/nu");
  text +=
      row("w_s", fmt::format("{:.3g} m/s", e.fall_speed), fmt::format("fall speed of {}, Soulsby (1997)", length(w.d)));
  text += row("Rouse", fmt::format("{:.3g}", e.rouse), fmt::format("w_s/(kappa u*): {}", meaning_of_rouse(e.rouse)));
  return text;
}

std::string scour(const Scene& w, const Expected& e) {
  std::string text = "\nScour to expect from experiments\n";
  if (e.depth)
    text +=
        row("S_eq",
            e.depth->scatter > 0 ? fmt::format("{} ± {}", length(e.depth->over_D * w.D), length(e.depth->scatter * w.D))
                                 : length(e.depth->over_D * w.D),
            fmt::format("{}, {}{} {}", e.depth->formula, e.depth->source,
                        e.depth->scatter > 0 ? "; one standard deviation" : "; scatter not known", mark));
  else
    text += row("S_eq", "-",
                e.regime == base::Regime::live_bed ? "no formula for a pipe buried this deep or this far up"
                : e.regime == base::Regime::no_motion
                    ? "no scour"
                    : "no formula here; the deepest holes are those at theta near theta_c (Chiew 1991)");
  if (e.time_scale)
    text += row("T", spoken(*e.time_scale),
                fmt::format("{} {}; 11.5 s where Mao (1986) measured 11 to 12 s", time_scale_formula, mark));
  if (e.undermined)
    text += row("undermined", spoken(*e.undermined),
                fmt::format("until S = {:g} D by S = S_eq (1 - exp(-t/T))", casefile::tunnel_depth));
  if (e.onset_speed)
    text += row("onset", fmt::format("{:.3g} m/s", *e.onset_speed),
                fmt::format("{} {}; the current there has {:.3g} m/s: it {}", onset_formula, mark, w.speed_at_pipe,
                            w.speed_at_pipe > *e.onset_speed ? "breaks through" : "does not break through"));
  text +=
      fmt::format("  {} Quoted from the literature; the text of the formula was not checked in its source.\n", mark);
  return text + "  " + three_dimensional + "\n";
}

std::string cost(const Plan& p) {
  const run::Prediction& t = p.prediction;
  std::string text = "\nThe run\n";
  text += row("grains", fmt::format("{:.4g}", p.work.grains), fmt::format("of {}", length(p.scene.d)));
  text += row("cells", fmt::format("{:.4g}", p.work.cells), "");
  text += row("steps", fmt::format("{:.3g}", t.flow_steps),
              fmt::format("of the flow, {:.3g} of the grains", p.work.grain_steps));
  text += row("memory", fmt::format("{:.3g} MB", 1e-6 * t.memory), "");
  text += row("wall time", spoken(t.wall()),
              fmt::format("at the machine's present load; {} of processor time", spoken(t.cpu)));
  text += row("", "",
              fmt::format("{} thread{}: packing {}, spin-up {}, flow {}, exchange {}, grains {}, files {}", p.threads,
                          p.threads == 1 ? "" : "s", spoken(t.packing), spoken(t.spin_up), spoken(t.flow),
                          spoken(t.exchange), spoken(t.grains), spoken(t.output)));
  text += row("", "",
              fmt::format("timed for {:.1f} s on {:.4g} grains and {:.4g} cells, with {:.0f} % of a processor",
                          p.speeds.seconds, p.speeds.grains, p.speeds.cells, 100 * p.speeds.cpu));
  return text;
}

nlohmann::ordered_json json_of(const Scene& w, const Expected& e) {
  const auto or_null = [](const auto& v) { return v ? nlohmann::ordered_json(*v) : nlohmann::ordered_json(nullptr); };
  nlohmann::ordered_json j{{"theta", e.theta},
                           {"theta_critical", e.theta_critical},
                           {"regime", name_of(e.regime)},
                           {"D_star", e.D_star},
                           {"shear_velocity_m_s", w.shear_velocity},
                           {"mean_speed_m_s", w.mean_speed},
                           {"depth_m", w.depth},
                           {"grain_diameter_m", w.d},
                           {"grain_reynolds", e.grain_reynolds},
                           {"pipe_reynolds", e.pipe_reynolds},
                           {"fall_speed_m_s", e.fall_speed},
                           {"rouse", e.rouse}};
  j["S_eq_over_D"] = e.depth ? nlohmann::ordered_json(e.depth->over_D) : nullptr;
  j["S_eq_scatter_over_D"] = e.depth && e.depth->scatter > 0 ? nlohmann::ordered_json(e.depth->scatter) : nullptr;
  j["T_s"] = or_null(e.time_scale);
  j["undermined_s"] = or_null(e.undermined);
  j["onset_speed_m_s"] = or_null(e.onset_speed);
  j["speed_at_pipe_m_s"] = w.speed_at_pipe;
  return j;
}

/// Where the numbers of `expected` come from.
nlohmann::ordered_json formulas(const Scene& w, const Expected& e) {
  nlohmann::ordered_json j;
  const auto add = [&](const char* number, const std::string& formula, bool seen) {
    j[number] = {{"formula", formula}, {"text_seen_in_source", seen}};
  };
  add("theta", "u*²/((s-1) g d)", true);
  add("theta_critical", "0.30/(1 + 1.2 D*) + 0.055 (1 - exp(-0.020 D*)), Soulsby 1997", true);
  add("fall_speed_m_s", "nu/d (√(10.36² + 1.049 D*³) - 10.36), Soulsby 1997", true);
  add("rouse", "w_s/(kappa u*)", true);
  if (w.D == 0) return j;
  if (e.depth) add("S_eq_over_D", fmt::format("{}, {}", e.depth->formula, e.depth->source), false);
  if (e.time_scale) add("T_s", time_scale_formula, false);
  if (e.undermined)
    add("undermined_s", fmt::format("S = S_eq (1 - exp(-t/T)) reaches {:g} D", casefile::tunnel_depth), true);
  if (e.onset_speed) add("onset_speed_m_s", onset_formula, false);
  return j;
}

nlohmann::ordered_json json_of(const run::Prediction& t) {
  return {{"wall_s", t.wall()},
          {"cpu_s", t.cpu},
          {"parts",
           {{"packing_s", t.packing},
            {"spin_up_s", t.spin_up},
            {"flow_s", t.flow},
            {"exchange_s", t.exchange},
            {"grains_s", t.grains},
            {"output_s", t.output}}},
          {"flow_steps", t.flow_steps},
          {"memory_MB", 1e-6 * t.memory}};
}

}  // namespace

std::string kept_and_lost(const Scene& sand, const Scene& grains) {
  const Expected a = casefile::expect(sand), b = casefile::expect(grains);
  std::string text = fmt::format("  {:<26} {:>10} {:>10}\n", "", "sand", "grains");
  const auto line = [&](const char* what, const std::string& of_sand, const std::string& of_grains,
                        const char* verdict) {
    text += fmt::format("  {:<26} {:>10} {:>10}  {}\n", what, of_sand, of_grains, verdict);
  };
  const auto number = [](double v) { return fmt::format("{:.3g}", v); };
  line("diameter", length(sand.d), length(grains.d), "");
  line("theta", number(a.theta), number(b.theta), "kept");
  line("theta/theta_c", number(a.theta / a.theta_critical), number(b.theta / b.theta_critical), "nearly kept");
  line("mean speed [m/s]", number(sand.mean_speed), number(grains.mean_speed), "lost: larger grains need more current");
  line("fall speed over u*", number(a.fall_speed / sand.shear_velocity), number(b.fall_speed / grains.shear_velocity),
       "lost: what the water carries off is not that of the sand");
  line("Re*", number(a.grain_reynolds), number(b.grain_reynolds), "lost");
  if (a.time_scale && b.time_scale)
    line("time scale T", spoken(*a.time_scale), spoken(*b.time_scale), "lost: compare in t/T, never in seconds");
  return text;
}

std::string text_of(const Plan& p) {
  const Expected e = casefile::expect(p.scene);
  std::string text = p.title + "\n\n" + sand_and_current(p.scene, e);
  if (p.scene.D > 0) text += scour(p.scene, e);
  if (p.real) text += "\nWhat the grains keep of the sand they stand for\n" + kept_and_lost(*p.real, p.scene);
  text += cost(p);
  if (p.size) {
    text += fmt::format("\nOut of reach in {:g} h.\n", p.hours);
    text += p.size->fits
                ? fmt::format("With grains of {} it takes {} and {:.3g} MB. At the same theta they keep and lose\n",
                              length(p.size->d), spoken(p.size->prediction.wall()), 1e-6 * p.size->prediction.memory)
                : fmt::format("The coarsest grains that still show a hole, {}, take {}: allow more hours.\n",
                              length(p.size->d), spoken(p.size->prediction.wall()));
    if (p.size->fits) text += kept_and_lost(p.scene, *p.model);
  }
  for (const std::string& note : p.notes) text += "note: " + note + "\n";
  text.pop_back();
  return text;
}

nlohmann::ordered_json json_of(const Plan& p) {
  nlohmann::ordered_json j{{"title", p.title}, {"expected", json_of(p.scene, casefile::expect(p.scene))}};
  j["formulas"] = formulas(p.scene, casefile::expect(p.scene));
  if (p.real) j["sand"] = json_of(*p.real, casefile::expect(*p.real));
  j["work"] = {{"grains", p.work.grains}, {"cells", p.work.cells}, {"grain_steps", p.work.grain_steps}};
  j["prediction"] = json_of(p.prediction);
  j["threads"] = p.threads;
  j["timed"] = {{"seconds", p.speeds.seconds},
                {"grains", p.speeds.grains},
                {"cells", p.speeds.cells},
                {"cpu_over_wall", p.speeds.cpu},
                {"grain_steps_per_second", p.speeds.grain > 0 ? 1 / p.speeds.grain : 0}};
  j["hours"] = p.hours;
  j["fits"] = p.prediction.wall() <= 3600 * p.hours;
  if (p.size)
    j["larger_grains"] = {{"diameter_m", p.size->d},
                          {"fits", p.size->fits},
                          {"prediction", json_of(p.size->prediction)},
                          {"expected", json_of(*p.model, casefile::expect(*p.model))}};
  j["notes"] = p.notes;
  j["not_answered"] = three_dimensional;
  return j;
}

}  // namespace livebed::app
