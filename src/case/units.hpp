#pragma once
#include <optional>
#include <string>
#include <string_view>

/// Numbers with units, as people write them in a case file: "0.36 mm", "5.5 kN/m", "20 %".
namespace livebed::casefile {

/// A unit as powers of metre, kilogram and second, with its size in SI: 10^decades * factor.  Decades are kept apart so
/// that "2 mm" becomes the very double that 0.002 is.
struct Unit {
  int metre = 0, kilogram = 0, second = 0;
  int decades = 0;
  double factor = 1;

  bool same_dimension(const Unit& other) const {
    return metre == other.metre && kilogram == other.kilogram && second == other.second;
  }
};

/// Reads a unit: bases m, g, s, min, h, N, Pa, % with prefixes n, u, m, c, d, k, M; powers as m2, m^2, s-1; products
/// by blanks, dots or stars, one or more quotients by slashes.  "-" and "" are the pure number.  Empty when unknown.
std::optional<Unit> parse_unit(std::string_view text);

/// What a unit measures, in words and examples: "a length (m, cm, mm)", "a pure number".
std::string describe(std::string_view unit);

/// A number with a unit as written: the number's text, its unit's text.
struct Quantity {
  std::string number, unit;
};

/// Splits "0.36 mm" into number and unit.  Empty when the text does not begin with a number.
std::optional<Quantity> parse_quantity(std::string_view text);

/// The number in SI, correctly rounded.
double in_si(const Quantity& quantity, const Unit& unit);

/// A text like "0.36 mm" as a number in SI, or the sentence that says why it is none.
struct Measured {
  double value = 0;
  std::string fault;  ///< empty when all is well
};
/// name and written: how the fault is to call key and value; unit: of the schema, "m/s".
Measured measured(std::string_view name, std::string_view written, std::string_view text, std::string_view unit);

}  // namespace livebed::casefile
