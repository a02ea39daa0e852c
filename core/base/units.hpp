// Quantities written with units, such as "210 GPa" or "9.81 m/s2", converted to SI with their dimension checked.
#pragma once
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace brisance {

/// Powers of metre, kilogram, second, kelvin and radian.
struct Dimension {
  std::array<int, 5> power{};
  bool operator==(Dimension const&) const = default;
};

/// A unit as factor * 10^exponent of SI. Powers of ten are kept apart so that "0.4 ms" is exactly the double 4e-4.
struct Unit {
  Dimension dimension;
  double factor = 1;
  int exponent = 0;
};

/// What is wrong with a unit or a quantity; the message does not repeat the text.
class UnitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a product of units: SI prefixes, powers ("m3", "m^3", "s-1"), products (space or *), quotients (/),
/// parentheses. Known: m g s K rad N Pa J W Hz bar atm t l L min h deg rev rpm % 1.  Errors: UnitError.
Unit parse_unit(std::string_view text);

/// Reads a number followed by a unit and returns its value in `si_unit` (an SI unit, "1" or "" for a plain number).
/// A number without unit is taken in SI. Angles count as numbers: rad/s fits 1/s.  Errors: UnitError.
double parse_quantity(std::string_view text, std::string_view si_unit);

/// Shortest text that reads back as the same double, always with a point or an exponent.
std::string exact_text(double value);

}  // namespace brisance
