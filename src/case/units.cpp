#include "case/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace livebed::casefile {
namespace {

struct Base {
  std::string_view name;
  Unit unit;
  bool takes_prefix;
};

constexpr std::array<Base, 8> bases{{{"m", {1, 0, 0, 0, 1}, true},
                                     {"g", {0, 1, 0, -3, 1}, true},
                                     {"s", {0, 0, 1, 0, 1}, true},
                                     {"min", {0, 0, 1, 0, 60}, false},
                                     {"h", {0, 0, 1, 0, 3600}, false},
                                     {"N", {1, 1, -2, 0, 1}, true},
                                     {"Pa", {-1, 1, -2, 0, 1}, true},
                                     {"%", {0, 0, 0, -2, 1}, false}}};

struct Prefix {
  std::string_view name;
  int decades;
};
constexpr std::array<Prefix, 8> prefixes{
    {{"n", -9}, {"u", -6}, {"µ", -6}, {"m", -3}, {"c", -2}, {"d", -1}, {"k", 3}, {"M", 6}}};

std::optional<Unit> named_unit(std::string_view name) {
  for (const Base& base : bases)
    if (base.name == name) return base.unit;
  for (const Prefix& prefix : prefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (const Base& base : bases) {
      if (!base.takes_prefix || base.name != name.substr(prefix.name.size())) continue;
      Unit unit = base.unit;
      unit.decades += prefix.decades;
      return unit;
    }
  }
  return std::nullopt;
}

void multiply(Unit& product, const Unit& by, int power) {
  product.metre += power * by.metre;
  product.kilogram += power * by.kilogram;
  product.second += power * by.second;
  product.decades += power * by.decades;
  product.factor *= std::pow(by.factor, power);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  Unit unit;
  text = trimmed(text);
  if (text.empty() || text == "-") return unit;
  int sign = 1;  // -1 behind a slash
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("/ .*");
    std::string_view factor = text.substr(0, end);
    const std::size_t power_at = factor.find_first_of("^-0123456789");
    int power = 1;
    if (power_at != std::string_view::npos) {
      std::string_view digits = factor.substr(power_at);
      if (digits.starts_with('^')) digits.remove_prefix(1);
      const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
      if (error != std::errc{} || stop != digits.data() + digits.size()) return std::nullopt;
      factor = factor.substr(0, power_at);
    }
    const std::optional<Unit> base = named_unit(factor);
    if (!base && !(factor == "1" && power == 1)) return std::nullopt;
    if (base) multiply(unit, *base, sign * power);
    if (end == std::string_view::npos) break;
    sign = text[end] == '/' ? -1 : sign;
    text = text.substr(end + 1);
    if (text.empty()) return std::nullopt;
  }
  return unit;
}

std::string describe(std::string_view unit) {
  struct Known {
    std::string_view unit, words;
  };
  static constexpr std::array<Known, 9> known{{{"-", "a pure number (or %)"},
                                               {"m", "a length (m, cm, mm)"},
                                               {"s", "a time (s, ms, us, min)"},
                                               {"m/s", "a speed (m/s, cm/s)"},
                                               {"m/s2", "an acceleration (m/s2)"},
                                               {"m2/s", "a kinematic viscosity (m2/s, mm2/s)"},
                                               {"kg/m3", "a density (kg/m3, g/cm3)"},
                                               {"N/m", "a stiffness (N/m, kN/m)"},
                                               {"kg/s", "a damping (kg/s)"}}};
  for (const Known& k : known)
    if (k.unit == unit) return std::string(k.words);
  return fmt::format("a quantity in {}", unit);
}

std::optional<Quantity> parse_quantity(std::string_view text) {
  text = trimmed(text);
  const std::string_view unsigned_text = text.starts_with('+') ? text.substr(1) : text;
  double value = 0;
  const auto [stop, error] = std::from_chars(unsigned_text.data(), unsigned_text.data() + unsigned_text.size(), value);
  if (error == std::errc::invalid_argument) return std::nullopt;  // out of range is a number still
  const std::size_t length = static_cast<std::size_t>(stop - unsigned_text.data());
  return Quantity{std::string(unsigned_text.substr(0, length)), std::string(trimmed(unsigned_text.substr(length)))};
}

double in_si(const Quantity& quantity, const Unit& unit) {
  // Shift the written exponent instead of multiplying: "0.36 mm" is read as 0.36e-3.
  const std::string& text = quantity.number;
  const std::size_t e = text.find_first_of("eE");
  int exponent = 0;
  if (e != std::string::npos) {
    const std::size_t digits = e + 1 + (text[e + 1] == '+' ? 1 : 0);
    std::from_chars(text.data() + digits, text.data() + text.size(), exponent);
  }
  const bool finite = text.find_first_of("nN") == std::string::npos;  // neither nan nor inf
  const std::string shifted = finite ? fmt::format("{}e{}", text.substr(0, e), exponent + unit.decades) : text;
  double value = 0;
  const auto result = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (result.ec == std::errc::result_out_of_range)  // from_chars leaves value alone: overflow or underflow
    value = exponent + unit.decades > 0 ? HUGE_VAL : 0.0;
  return value * unit.factor;
}

Measured measured(std::string_view name, std::string_view written, std::string_view text, std::string_view unit) {
  const std::string expected = describe(unit);
  const std::optional<Quantity> quantity = parse_quantity(text);
  if (!quantity)
    return {0, fmt::format("{} = {} is not a number with a unit; {} is expected", name, written, expected)};
  const std::optional<Unit> given = parse_unit(quantity->unit);
  if (!given)
    return {0, fmt::format("{} = {} has the unknown unit {}; {} is expected", name, written, quantity->unit, expected)};
  if (quantity->unit.empty() && unit != "-")
    return {0,
            fmt::format("{} = {} has no unit; {} is expected, or a bare number in {}", name, written, expected, unit)};
  if (!given->same_dimension(*parse_unit(unit)))
    return {0, fmt::format("{} = {} has the wrong unit {}; {} is expected", name, written, quantity->unit, expected)};
  return {in_si(*quantity, *given), ""};
}

}  // namespace livebed::casefile
