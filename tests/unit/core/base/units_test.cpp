#include "core/base/units.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <numbers>

namespace brisance {
namespace {

std::string complaint(std::string const& text, std::string const& unit) {
  try {
    parse_quantity(text, unit);
  } catch (UnitError const& error) {
    return error.what();
  }
  return "";
}

TEST(Quantity, PowersOfTenGiveTheNearestDouble) {
  EXPECT_EQ(parse_quantity("210 GPa", "Pa"), 210e9);
  EXPECT_EQ(parse_quantity("1.5 ms", "s"), 1.5e-3);
  EXPECT_EQ(parse_quantity("0.4 ms", "s"), 4e-4);
  EXPECT_EQ(parse_quantity("3 um", "m"), 3e-6);
  EXPECT_EQ(parse_quantity("3 \u00b5m", "m"), 3e-6);
  EXPECT_EQ(parse_quantity("7.86 g/cm3", "kg/m3"), 7860.0);
  EXPECT_EQ(parse_quantity("1e2 kg", "kg"), 100.0);
  EXPECT_EQ(parse_quantity("1.2e-1 MJ", "J"), 0.12e6);
  EXPECT_EQ(parse_quantity("2 t", "kg"), 2000.0);
  EXPECT_EQ(parse_quantity("1.013 bar", "Pa"), 101300.0);
}

TEST(Quantity, CompoundUnits) {
  EXPECT_EQ(parse_quantity("-9.81 m/s2", "m/s2"), -9.81);
  EXPECT_EQ(parse_quantity("-9.81 m s^-2", "m/s2"), -9.81);
  EXPECT_EQ(parse_quantity("4.2 MJ/kg", "J/kg"), 4.2e6);
  EXPECT_EQ(parse_quantity("1005 J/(kg K)", "J/kg/K"), 1005.0);
  EXPECT_EQ(parse_quantity("5 kN m", "J"), 5000.0);
  EXPECT_EQ(parse_quantity("5 kN*m", "J"), 5000.0);
  EXPECT_EQ(parse_quantity("36 m/min", "m/s"), 36.0 * (1 / 60.0));
  EXPECT_EQ(parse_quantity("1/s", "1/s"), parse_quantity("1 1/s", "1/s"));
}

TEST(Quantity, UnitsThatAreNoPowersOfTen) {
  EXPECT_EQ(parse_quantity("1 atm", "Pa"), 101325.0);
  EXPECT_EQ(parse_quantity("2 h", "s"), 7200.0);
  EXPECT_DOUBLE_EQ(parse_quantity("180 deg", "rad"), std::numbers::pi);
  EXPECT_DOUBLE_EQ(parse_quantity("60 rpm", "rad/s"), 2 * std::numbers::pi);
}

TEST(Quantity, AnglesAreNumbersInRatesOnly) {
  EXPECT_DOUBLE_EQ(parse_quantity("12 rpm", "1/s"), 0.4 * std::numbers::pi);
  EXPECT_EQ(parse_quantity("3 1/s", "rad/s"), 3.0);
  EXPECT_EQ(complaint("0.8 rad", "1"), "'rad' has the wrong dimension");
}

TEST(Quantity, PlainNumbersAndPercents) {
  EXPECT_EQ(parse_quantity("0.25", "1"), 0.25);
  EXPECT_EQ(parse_quantity("25 %", "1"), 0.25);
  EXPECT_EQ(parse_quantity("+3", "m"), 3.0);
}

TEST(Quantity, SaysWhatIsWrong) {
  EXPECT_EQ(complaint("7860 kg", "kg/m3"), "'kg' has the wrong dimension");
  EXPECT_EQ(complaint("3 mss", "s"), "unknown unit 'mss'");
  EXPECT_EQ(complaint("fast", "m/s"), "it does not begin with a number");
  EXPECT_EQ(complaint("", "m/s"), "it does not begin with a number");
  EXPECT_EQ(complaint("inf s", "s"), "it does not begin with a number");
  EXPECT_EQ(complaint("1/3", "1"), "a unit is missing at '3'");
  EXPECT_EQ(complaint("3 m/", "m"), "a unit is missing at ''");
  EXPECT_EQ(complaint("3 J/(kg K", "J/kg/K"), "a closing parenthesis is missing in the unit");
  EXPECT_EQ(complaint("3 m^", "m"), "a power is missing after '^'");
  EXPECT_EQ(complaint("3 m)", "m"), "unexpected ')' in the unit");
  EXPECT_EQ(complaint("1e400 m", "m"), "the number is too large or too small");
}

TEST(ExactText, ReadsBackTheSameBits) {
  double const values[] = {
      0.0, -0.0, 1.0, 0.1, 1.0 / 3.0, 4e-4, 1e22, 9223372036854775808.0, 5e-324, 1.7976931348623157e308, -7.5};
  for (double const x : values) {
    std::string const text = exact_text(x);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), x) << text;
    EXPECT_NE(text.find_first_of(".e"), std::string::npos) << text << " would be an integer in TOML";
  }
  EXPECT_EQ(exact_text(std::numeric_limits<double>::infinity()), "inf");
}

}  // namespace
}  // namespace brisance
