#include "validate/grains.hpp"

#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "validate/grain_beds.hpp"
#include "validate/grain_gas.hpp"
#include "validate/grain_impact.hpp"
#include "validate/grain_silo.hpp"
#include "validate/picture.hpp"

namespace livebed::validate {

namespace {

const std::vector<std::string> colours = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e"};

/// Rows and pictures as they come, told at once.
struct Book {
  Result result;
  const Tell& tell;

  void add(Row row) {
    tell(fmt::format("{}: {:.4g} {}{}", row.name, row.value, row.unit, row.pass() ? "" : "  <- outside"));
    result.rows.push_back(std::move(row));
  }
  void draw(const std::string& name, const report::Chart& chart) {
    result.pictures.push_back({"grains_" + name + ".svg", picture(chart)});
  }
};

void oblique_impacts(Book& book) {
  struct Quantity {
    const char* name;
    const char* label;
    const char* unit;
    double Rebound::*member;
    double digitised;  ///< how far the curve's points may be off where the contact slides
  };
  const std::vector<Quantity> quantities = {
      {"tangential_restitution", "tangential restitution", "-", &Rebound::tangential_restitution, 0.005},
      {"final_spin_rad_s", "spin after the impact", "1/s", &Rebound::spin, 12},
      {"contact_point_rebound_angle_deg", "rebound angle of the contact point", "degrees", &Rebound::contact_angle, 1}};
  constexpr double sliding = 38;  // [degrees]; contacts slide throughout above that
  // The default, and Hertz and Mindlin's ratio 2 (1 - nu) / (2 - nu) for nu = 0.23.
  const std::vector<std::pair<double, std::string>> ratios = {{1 / 2.6, "1/2.6"}, {0.87, "0.87"}};
  const std::string setup =
      "sphere of 5 mm, 4000 kg/m3, at 3.9 m/s on a plane, friction 0.092, restitution 0.98, no gravity, linear "
      "springs, "
      "2000 steps a contact";
  for (const Quantity& q : quantities) {
    const auto start = std::chrono::steady_clock::now();
    report::Chart chart{{"angle from the normal [degrees]"}, {fmt::format("{} [{}]", q.label, q.unit)}, {}};
    const ImpactData reference = impact_data("al_oxide_FEM_DEM_reference", q.name);
    const ImpactData experiment = impact_data("experiment", q.name);
    for (std::size_t k = 0; k < ratios.size(); ++k) {
      double worst_sliding = 0, worst_sticking = 0;
      for (std::size_t n = 0; n < reference.angle.size(); ++n) {
        const double found = run_oblique_impact(reference.angle[n], ratios[k].first).*q.member;
        double& worst = reference.angle[n] < sliding ? worst_sticking : worst_sliding;
        worst = std::max(worst, std::abs(found - reference.value[n]));
      }
      report::Curve curve{"linear springs, tangential over normal " + ratios[k].second, colours[k], {}, {}};
      for (int degrees = 2; degrees <= 86; degrees += 2) {
        curve.x.push_back(degrees);
        curve.y.push_back(run_oblique_impact(degrees, ratios[k].first).*q.member);
      }
      chart.curves.push_back(curve);
      for (const bool slides : {true, false}) {
        Row row{fmt::format("oblique impact, {}, {} degrees, springs {}: largest difference", q.label,
                            slides ? "above 38" : "below 38", ratios[k].second),
                slides ? worst_sliding : worst_sticking, q.unit};
        if (slides) row.low = 0, row.high = q.digitised;
        row.reference = "Chung and Ooi (2011), test 4, finite elements and Hertz contacts";
        row.setup = setup;
        row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        book.add(row);
      }
    }
    chart.curves.push_back({"Chung and Ooi (2011)", "#000000", reference.angle, reference.value, true});
    chart.curves.push_back({"experiment (Kharaz et al.)", "#2ca02c", experiment.angle, experiment.value, true});
    book.draw(fmt::format("oblique_{}", q.name), chart);
  }
}

void colliding_grains(Book& book) {
  report::Chart chart{{"time [s]"}, {"energy over the first"}, {}};
  std::size_t k = 0;
  for (const double restitution : {1.0, 0.9, 0.6, 0.3}) {
    const GasRun run = run_gas({.restitution = restitution});
    const std::string setup = fmt::format(
        "1000 grains, 2 mm +- 5 %, thrown up to 0.5 m/s over a smooth plane under their weight, frictionless, "
        "restitution {}, 200 steps a contact, 60000 steps",
        restitution);
    const auto add = [&](const std::string& name, double value, double high, const std::string& unit) {
      Row row{fmt::format("colliding grains, restitution {}: {}", restitution, name), value, unit};
      if (high == high) row.low = 0, row.high = high;
      row.reference = high == high ? "conservation of energy and momentum" : "";
      row.setup = setup, row.seconds = run.seconds;
      book.add(row);
    };
    const double told = std::numeric_limits<double>::quiet_NaN();
    if (restitution == 1) add("largest drift of the energy", run.drift, 1e-4, "of the first");
    add("largest gain of energy", std::max(0.0, run.largest_gain), restitution == 1 ? told : 1e-5, "of the first");
    add("change of momentum along the plane", std::abs(run.momentum), 1e-12, "of sum m |u|");
    add("collisions", static_cast<double>(run.collisions), told, "-");
    chart.curves.push_back({fmt::format("restitution {}", restitution), colours[k++], run.time, run.energy});
  }
  book.draw("energy", chart);
}

void rest(Book& book) {
  using grains::Law;
  using grains::Tension;
  struct Damping {
    double restitution, alpha, steps;
    Tension tension;
  };
  // Each restitution at the default steps a contact, the paper's full damping at its preset's.
  const std::vector<Damping> offered = {
      {0.1, 0, 30, Tension::none},   {0.3, 0, 30, Tension::none}, {0.5, 0, 30, Tension::none},
      {0.7, 0, 30, Tension::none},   {0.9, 0, 30, Tension::none}, {0.1, 0, 30, Tension::spring},
      {0.5, 0, 30, Tension::spring}, {0, 1, 80, Tension::none},   {0, 1, 80, Tension::spring}};
  for (const Law law : {Law::paper, Law::hooke}) {
    for (const Damping& damping : offered) {
      grains::Params p;
      p.law = law;
      p.stiffness = 5500;
      p.restitution = damping.restitution;
      p.damping = damping.alpha;
      p.tension = damping.tension;
      p.steps_per_contact = damping.steps;
      p.length = 0.0848;
      p.count = 480;
      const RestRun run = run_rest(p);
      const std::string name =
          fmt::format("{}, {}, {} steps a contact{}", law == Law::hooke ? "hooke" : "paper",
                      damping.alpha > 0 ? fmt::format("alpha_cn {}", damping.alpha)
                                        : fmt::format("restitution {}", damping.restitution),
                      damping.steps, damping.tension == Tension::spring ? ", the dashpot may pull" : "");
      Row row{"bed at rest, " + name + ": mean speed", run.mean_speed, "m/s", 0, 1e-5, "asked for"};
      row.setup =
          "480 grains, 2 mm +- 5 %, friction 0.55, 5500 N/m, on a plane, settled; largest mean speed 0.3 to 0.4 s "
          "later; " +
          name;
      row.seconds = run.seconds;
      book.add(row);
    }
  }
}

void heaps(Book& book) {
  constexpr int seeds = 3;
  report::Chart chart{{"distance from the middle [m]"}, {"surface [m]"}, {}, 720, 320};
  double before = 0;
  std::size_t k = 0;
  for (const auto& [friction, rolling] : {std::pair{0.1, 0.0}, {0.3, 0.0}, {0.5, 0.0}, {0.5, 0.1}, {0.5, 0.3}}) {
    double mean = 0, square = 0, seconds = 0;
    const std::string name =
        fmt::format("friction {}{}", friction, rolling > 0 ? fmt::format(", rolling {}", rolling) : "");
    report::Curve curve{name, colours[k++], {}, {}};
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const HeapRun run = run_heap({.friction = friction, .rolling_friction = rolling, .seed = seed});
      mean += run.angle() / seeds, square += run.angle() * run.angle() / seeds, seconds += run.seconds;
      curve.x = run.x;
      curve.y.resize(run.x.size());
      for (std::size_t n = 0; n < run.x.size(); ++n) curve.y[n] += run.surface[n] / seeds;
    }
    chart.curves.push_back(curve);
    const std::string setup = fmt::format(
        "600 grains, 2 mm +- 30 %, {}, sunk at 0.15 m/s onto a floor of grains, at rest without a fluid; mean of {} "
        "seeds",
        name, seeds);
    Row angle{fmt::format("heap, {}: slope", name),
              mean,
              "degrees",
              before,
              40,
              "steeper than with less friction; natural sand has 30 to 35"};
    Row error{fmt::format("heap, {}: standard error of the slope", name),
              std::sqrt(std::max(0.0, square - mean * mean) / (seeds - 1)), "degrees"};
    for (Row* row : {&angle, &error}) {
      row->setup = setup, row->seconds = seconds;
      book.add(*row);
    }
    before = mean;
  }
  book.draw("heaps", chart);
}

/// The same grains in mixed precision.
void mixed_precision(Book& book) {
  using grains::Precision;
  const auto add = [&](Row row, const std::string& setup, double seconds) {
    row.name = "mixed precision, " + row.name, row.setup = setup, row.seconds = seconds;
    book.add(std::move(row));
  };
  const double told = std::numeric_limits<double>::quiet_NaN();

  const GasRun gas = run_gas({.precision = Precision::mixed});
  const std::string flying = "1000 elastic grains as above, 60000 steps";
  add({"colliding grains: largest drift of the energy", gas.drift, "of the first", 0, 1e-4, "conservation of energy"},
      flying, gas.seconds);
  add({"colliding grains: change of momentum along the plane", std::abs(gas.momentum), "of sum m |u|", 0, 1e-5,
       "conservation of momentum"},
      flying, gas.seconds);
  add({"colliding grains: collisions", static_cast<double>(gas.collisions), "-", told, told, ""}, flying, gas.seconds);

  for (const double rolling : {0.0, 0.25}) {
    grains::Params p;
    p.stiffness = 5500, p.restitution = 0.3, p.rolling_friction = rolling;
    p.length = 0.0848, p.count = 480;
    constexpr int steps = 200;
    const PrecisionRun run = compare_precision(p, steps);
    const std::string setup = fmt::format(
        "480 grains, 2 mm +- 5 %, rolling friction {}, settled, knocked at up to 0.02 m/s, {} steps later, {:.2g} m/s "
        "in root mean square",
        rolling, steps, run.speed);
    const std::string reference = "the same in double precision";
    add({fmt::format("knocked bed, rolling friction {}: velocity of the worst grain, difference", rolling), run.worst,
         "of the rms", 0, 1e-4, reference},
        setup, run.seconds);
    add({fmt::format("knocked bed, rolling friction {}: velocities, rms difference", rolling), run.mean, "of the rms",
         0, 2e-5, reference},
        setup, run.seconds);
    add({fmt::format("knocked bed, rolling friction {}: overlaps, rms difference", rolling), run.overlap, "of the mean",
         0, 5e-5, reference},
        setup, run.seconds);
    p.precision = Precision::mixed;
    const RestRun rest = run_rest(p);
    add({fmt::format("bed at rest, rolling friction {}: mean speed", rolling), rest.mean_speed, "m/s", 0, 1e-5,
         "asked for"},
        "480 grains as above, settled; largest mean speed 0.3 to 0.4 s later", rest.seconds);
  }

  constexpr int seeds = 3;
  for (const double rolling : {0.0, 0.3}) {
    double slope[2] = {0, 0}, square[2] = {0, 0}, seconds = 0;
    for (const Precision precision : {Precision::all_double, Precision::mixed})
      for (unsigned seed = 1; seed <= seeds; ++seed) {
        const HeapRun run = run_heap({.rolling_friction = rolling, .seed = seed, .precision = precision});
        const int k = precision == Precision::mixed;
        slope[k] += run.angle() / seeds, square[k] += run.angle() * run.angle() / seeds, seconds += run.seconds;
      }
    const auto variance = [&](int k) { return std::max(0.0, square[k] - slope[k] * slope[k]) / (seeds - 1); };
    add({fmt::format("heap, friction 0.5, rolling {}: slope less that in double", rolling), slope[1] - slope[0],
         "degrees", -2 * std::sqrt(variance(0) + variance(1)), 2 * std::sqrt(variance(0) + variance(1)),
         "two standard errors of the difference"},
        fmt::format("600 grains as above, means of {} seeds each", seeds), seconds);
  }
}

void silos(Book& book) {
  constexpr int seeds = 2;
  report::Chart chart{{"force of a side wall over its height [N/m]"}, {"height [m]"}, {}, 420, 420};
  std::size_t k = 0;
  for (const double friction : {0.0, 0.25, 0.5}) {
    double floor = 0, lateral = 0, mobilised = 0, janssen = 0, unbalanced = 0, seconds = 0;
    report::Curve side{fmt::format("pressure, wall friction {}", friction), colours[k], {}, {}};
    report::Curve above{fmt::format("vertical stress, wall friction {}", friction), colours[k++], {}, {}, false, true};
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const SiloRun run = run_silo({.wall_friction = friction, .seed = seed});
      floor += run.floor / run.weight / seeds, janssen += run.janssen() / seeds;
      lateral += run.lateral_ratio / seeds, mobilised += run.mobilised / seeds;
      unbalanced = std::max(unbalanced, std::abs((run.floor + run.sides) / run.weight - 1));
      seconds += run.seconds;
      side.y.resize(run.bands.size()), above.y.resize(run.bands.size());
      side.x.resize(run.bands.size()), above.x.resize(run.bands.size());
      for (std::size_t n = 0; n < run.bands.size(); ++n) {
        side.x[n] += run.bands[n].lateral / seeds, above.x[n] += run.bands[n].vertical / seeds;
        side.y[n] = above.y[n] = run.height - run.bands[n].depth;
      }
    }
    chart.curves.push_back(side);
    chart.curves.push_back(above);
    const std::string setup = fmt::format(
        "1600 grains, 2 mm +- 5 %, friction 0.5, in a bin 44 mm wide, wall friction {}, settled under half the weight "
        "and "
        "loaded with all of it; mean of {} seeds",
        friction, seeds);
    const auto add = [&](const std::string& name, double value, double low, double high, const std::string& reference) {
      Row row{
          fmt::format("silo, wall friction {}: {}", friction, name), value, "-", low, high, reference, setup, seconds};
      book.add(row);
    };
    const double told = std::numeric_limits<double>::quiet_NaN();
    add("what floor and walls carry over the weight - 1, worst", unbalanced, 0, 1e-3, "balance of forces");
    add("lateral over vertical stress", lateral, told, told, "");
    add("friction called up at the walls", mobilised, told, told, "");
    add("share of the weight on the floor", floor, told, told, "");
    add("that share over Janssen's with this ratio and friction", floor / janssen, 0.9, 1.1, "Janssen (1895)");
  }
  book.draw("silo", chart);
}

}  // namespace

Result grains(const Tell& tell) {
  Book book{{}, tell};
  oblique_impacts(book);
  colliding_grains(book);
  rest(book);
  heaps(book);
  silos(book);
  mixed_precision(book);
  return book.result;
}

}  // namespace livebed::validate
