#include "case/schema.hpp"

#include <fmt/format.h>

#include "case/rows.hpp"

namespace livebed::casefile {

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
  static const std::vector<Choice> rows{{"flow.closure", "k_epsilon", "k_omega"},
                                        {"flow.convection", "hybrid", "bounded"},
                                        {"current.profile", "rough", "rough"},
                                        {"bed.floor", "grains", "grains"},
                                        {"bed.start", "lattice", "scattered"},
                                        {"grains.spread", "0", "0.2"},
                                        {"grains.inertia", "disk", "sphere"},
                                        {"contact.steps", "80", "30"},
                                        {"contact.damping", "1.0", ""},
                                        {"contact.restitution", "", "0.3"},
                                        {"contact.wall_factor", "2", "2"},
                                        {"contact.tension", "spring", "none"},
                                        {"contact.friction_limit", "spring", "total"},
                                        {"contact.rolling_friction", "0", "0.25"},
                                        {"time.grain_step", "1e-5", "1e-5"},
                                        {"coupling.mode", "two-way", "two-way"},
                                        {"coupling.exchange", "lagged", "implicit"},
                                        {"coupling.voidage", "off", "on"},
                                        {"coupling.drag", "paper", "di_felice"},
                                        {"coupling.drag_viscous", "24", "26.4"},
                                        {"coupling.drag_infinity", "0.4", "1.27"},
                                        {"coupling.lift", "none", "saffman_mei"},
                                        {"coupling.turbulence", "untouched", "bounded"},
                                        {"coupling.dispersion", "none", "attached"},
                                        {"coupling.room_power", "1", "3"},
                                        {"coupling.dispersion_energy", "1", "1.4"},
                                        {"coupling.kernel", "2", "0.6"}};
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
