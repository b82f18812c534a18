#include "case/units.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "case/schema.hpp"

namespace livebed::casefile {
namespace {

double si(std::string_view text) {
  const std::optional<Quantity> quantity = parse_quantity(text);
  return quantity ? in_si(*quantity, parse_unit(quantity->unit).value()) : std::nan("");
}

TEST(units, are_read_to_the_very_double_of_the_si_number) {
  EXPECT_EQ(si("0.36 mm"), 0.00036);
  EXPECT_EQ(si("2.5 cm"), 0.025);
  EXPECT_EQ(si("10 us"), 10e-6);
  EXPECT_EQ(si("10 µs"), 10e-6);
  EXPECT_EQ(si("1e-5 s"), 1e-5);
  EXPECT_EQ(si("1E+2ms"), 0.1);
  EXPECT_EQ(si("0.9 m/s"), 0.9);
  EXPECT_EQ(si("86.9 cm/s"), 0.869);
  EXPECT_EQ(si("2650 kg/m3"), 2650);
  EXPECT_EQ(si("2.65 g/cm3"), 2650);
  EXPECT_EQ(si("5.5 kN/m"), 5500);
  EXPECT_EQ(si("1e-6 m2/s"), 1e-6);
  EXPECT_EQ(si("1 mm2/s"), 1e-6);
  EXPECT_EQ(si("9.81 m/s2"), 9.81);
  EXPECT_EQ(si("9.81 m s-2"), 9.81);
  EXPECT_EQ(si("9.81 m/s^2"), 9.81);
  EXPECT_EQ(si("20 %"), 0.2);
  EXPECT_EQ(si("2 min"), 120);
  EXPECT_EQ(si("-3 mm"), -0.003);
  EXPECT_EQ(si("+3 mm"), 0.003);
}

TEST(units, know_what_they_measure) {
  EXPECT_TRUE(parse_unit("kN/m")->same_dimension(*parse_unit("kg/s2")));
  EXPECT_TRUE(parse_unit("Pa")->same_dimension(*parse_unit("N/m2")));
  EXPECT_TRUE(parse_unit("-")->same_dimension(*parse_unit("%")));
  EXPECT_FALSE(parse_unit("m/s")->same_dimension(*parse_unit("m/s2")));
  EXPECT_FALSE(parse_unit("min")->same_dimension(*parse_unit("m")));
}

TEST(units, refuse_what_is_none) {
  for (const char* text : {"parsec", "m/", "m//s", "m2x", "mmm", "kmin", "m-", "2"})
    EXPECT_FALSE(parse_unit(text)) << text;
  for (const char* text : {"", "mm", "two mm", "- 3 m"}) EXPECT_FALSE(parse_quantity(text)) << text;
}

TEST(units, of_every_row_are_known) {
  for (const Row& row : schema()) EXPECT_TRUE(parse_unit(row.unit)) << row.name;
}

}  // namespace
}  // namespace livebed::casefile
