#include "core/base/units.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace brisance {
namespace {

struct Symbol {
  std::string_view name;
  Unit unit;
  bool prefixes;
};

constexpr double pi = std::numbers::pi;
constexpr Dimension number{}, metre{{1, 0, 0, 0, 0}}, kilogram{{0, 1, 0, 0, 0}}, second{{0, 0, 1, 0, 0}};
constexpr Dimension pascal{{-1, 1, -2, 0, 0}}, radian{{0, 0, 0, 0, 1}};

Symbol const symbols[] = {
    {"m", {metre}, true},
    {"g", {kilogram, 1, -3}, true},
    {"s", {second}, true},
    {"K", {{{0, 0, 0, 1, 0}}}, true},
    {"rad", {radian}, true},
    {"N", {{{1, 1, -2, 0, 0}}}, true},
    {"Pa", {pascal}, true},
    {"J", {{{2, 1, -2, 0, 0}}}, true},
    {"W", {{{2, 1, -3, 0, 0}}}, true},
    {"Hz", {{{0, 0, -1, 0, 0}}}, true},
    {"bar", {pascal, 1, 5}, true},
    {"t", {kilogram, 1, 3}, true},
    {"l", {{{3, 0, 0, 0, 0}}, 1, -3}, true},
    {"L", {{{3, 0, 0, 0, 0}}, 1, -3}, true},
    {"atm", {pascal, 101325}, false},
    {"min", {second, 60}, false},
    {"h", {second, 3600}, false},
    {"deg", {radian, pi / 180}, false},
    {"rev", {radian, 2 * pi}, false},
    {"rpm", {{{0, 0, -1, 0, 1}}, pi / 30}, false},
    {"%", {number, 1, -2}, false},
};

struct Prefix {
  std::string_view name;
  int exponent;
};
// The micro sign has two code points in use.
Prefix const prefixes[] = {{"p", -12}, {"n", -9}, {"u", -6}, {"\u00b5", -6}, {"\u03bc", -6}, {"m", -3}, {"c", -2},
                           {"d", -1},  {"h", 2},  {"k", 3},  {"M", 6},       {"G", 9},       {"T", 12}};

std::optional<Unit> find_symbol(std::string_view name) {
  for (Symbol const& symbol : symbols)
    if (symbol.name == name) return symbol.unit;
  for (Prefix const& prefix : prefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (Symbol const& symbol : symbols) {
      if (!symbol.prefixes || symbol.name != name.substr(prefix.name.size())) continue;
      Unit unit = symbol.unit;
      unit.exponent += prefix.exponent;
      return unit;
    }
  }
  return std::nullopt;
}

Unit power(Unit unit, int n) {
  for (int& p : unit.dimension.power) p *= n;
  return {unit.dimension, std::pow(unit.factor, n), unit.exponent * n};
}

Unit operator*(Unit a, Unit const& b) {
  for (std::size_t i = 0; i < a.dimension.power.size(); ++i) a.dimension.power[i] += b.dimension.power[i];
  return {a.dimension, a.factor * b.factor, a.exponent + b.exponent};
}

/// Recursive descent over: product = factor { [*|/] factor },  factor = symbol [power] | ( product ) [power].
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  Unit all() {
    Unit const unit = product();
    if (at_ < text_.size()) throw UnitError("unexpected '" + std::string(text_.substr(at_)) + "' in the unit");
    return unit;
  }

 private:
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool next_is(char c) const { return at_ < text_.size() && text_[at_] == c; }

  Unit product() {
    skip_spaces();
    Unit unit = factor();
    for (skip_spaces(); at_ < text_.size() && text_[at_] != ')'; skip_spaces()) {
      bool const divide = next_is('/');
      if (divide || next_is('*')) ++at_;
      skip_spaces();
      Unit const next = factor();
      unit = unit * (divide ? power(next, -1) : next);
    }
    return unit;
  }

  Unit factor() {
    if (next_is('(')) {
      ++at_;
      Unit const inner = product();
      if (!next_is(')')) throw UnitError("a closing parenthesis is missing in the unit");
      ++at_;
      return power(inner, exponent());
    }
    if (next_is('1')) return ++at_, Unit{};
    std::size_t const first = at_;
    while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
    std::string_view const name = text_.substr(first, at_ - first);
    if (name.empty()) throw UnitError("a unit is missing at '" + std::string(text_.substr(first)) + "'");
    std::optional<Unit> const unit = find_symbol(name);
    if (!unit) throw UnitError("unknown unit '" + std::string(name) + "'");
    return power(*unit, exponent());
  }

  int exponent() {
    std::size_t at = at_;
    if (at < text_.size() && text_[at] == '^') ++at;
    int n = 1;
    auto const [end, failure] = std::from_chars(text_.data() + at, text_.data() + text_.size(), n);
    if (failure != std::errc{}) {
      if (at != at_) throw UnitError("a power is missing after '^'");
      return 1;
    }
    if (std::abs(n) > 9) throw UnitError("a power of a unit is at most 9");
    at_ = static_cast<std::size_t>(end - text_.data());
    return n;
  }

  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || (c & 0x80) != 0;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// True when a value of dimension `given` may be used for a key of dimension `wanted`. Angles are numbers: rad/s fits
/// 1/s and 1 fits rad; but a plain number is not an angle.
bool fits(Dimension given, Dimension wanted) {
  bool const given_angle = given.power[4] != 0, wanted_angle = wanted.power[4] != 0;
  given.power[4] = wanted.power[4] = 0;
  bool const plain = wanted == Dimension{};
  return given == wanted && !(given_angle && !wanted_angle && plain);
}

double parse_number(std::string_view digits, int shift) {
  std::size_t const e = digits.find_first_of("eE");
  int written = 0;
  if (e != std::string_view::npos) {
    std::size_t const sign = digits[e + 1] == '+' ? 2 : 1;
    std::from_chars(digits.data() + e + sign, digits.data() + digits.size(), written);
  }
  std::string const shifted = std::string(digits.substr(0, e)) + "e" + std::to_string(written + shift);
  double value = 0;
  auto const [end, failure] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (failure != std::errc{}) throw UnitError("the number is too large or too small");
  return value;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

Unit parse_unit(std::string_view text) {
  text = trimmed(text);
  return text.empty() ? Unit{} : UnitParser(text).all();
}

double parse_quantity(std::string_view text, std::string_view si_unit) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  std::size_t const first = text.starts_with('-') ? 1 : 0;
  bool const starts = first < text.size() && (text[first] == '.' || (text[first] >= '0' && text[first] <= '9'));
  double value = 0;
  auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (!starts || failure == std::errc::invalid_argument) throw UnitError("it does not begin with a number");
  auto const length = static_cast<std::size_t>(end - text.data());
  std::string_view const unit_text = trimmed(text.substr(length));
  if (unit_text.empty()) return parse_number(text.substr(0, length), 0);
  bool const quotient = unit_text.starts_with('/');  // "3 /s"
  Unit const unit = parse_unit(quotient ? "1" + std::string(unit_text) : std::string(unit_text));
  if (!fits(unit.dimension, parse_unit(si_unit).dimension))
    throw UnitError("'" + std::string(unit_text) + "' has the wrong dimension");
  return parse_number(text.substr(0, length), unit.exponent) * unit.factor;
}

std::string exact_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char buffer[40];
  std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace brisance
