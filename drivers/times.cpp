#include "drivers/times.hpp"

#include <charconv>
#include <optional>

#include "core/base/units.hpp"
#include "parallel/error.hpp"

namespace brisance::drivers {
namespace {

/// Takes a number off the front of `text`.
std::optional<double> take_number(std::string_view& text) {
  double value = 0;
  auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (failure != std::errc{} || !(value >= 0 && value < 1e9)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

void skip_spaces(std::string_view& text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
}

/// "1:50:00", "50:00"
std::optional<double> clock_time(std::string_view text) {
  double seconds = 0;
  for (int fields = 0; fields < 3; ++fields) {
    std::optional<double> const value = take_number(text);
    if (!value) return std::nullopt;
    seconds = 60 * seconds + *value;
    if (text.empty()) return fields > 0 ? std::optional(seconds) : std::nullopt;
    if (!text.starts_with(':')) return std::nullopt;
    text.remove_prefix(1);
  }
  return std::nullopt;
}

/// "1h50m", "90 s", "3600"
std::optional<double> sum_of_parts(std::string_view text) {
  struct Part {
    std::string_view name;
    double seconds;
  };
  constexpr Part parts[] = {{"d", 86400}, {"h", 3600}, {"min", 60}, {"m", 60}, {"s", 1}};
  double seconds = 0;
  bool only_number = true;
  for (skip_spaces(text); !text.empty(); skip_spaces(text)) {
    std::optional<double> const value = take_number(text);
    if (!value) return std::nullopt;
    skip_spaces(text);
    if (text.empty() && only_number) return *value;
    only_number = false;
    Part const* unit = nullptr;
    for (Part const& part : parts)
      if (!unit && text.starts_with(part.name)) unit = &part;
    if (!unit) return std::nullopt;
    text.remove_prefix(unit->name.size());
    seconds += *value * unit->seconds;
  }
  return only_number ? std::nullopt : std::optional(seconds);
}

}  // namespace

double parse_time(std::string const& option, std::string const& text) {
  double time = 0;
  try {
    time = parse_quantity(text, "s");
  } catch (UnitError const& error) {
    throw Error(Failure::scene, option + " \"" + text + "\": " + error.what() + "; expected a time such as \"1 ms\"");
  }
  require(time >= 0, Failure::scene, option + " \"" + text + "\": a time cannot be negative");
  return time;
}

double parse_walltime(std::string const& option, std::string const& text) {
  bool const clock = text.find(':') != std::string::npos;
  std::optional<double> const seconds = clock ? clock_time(text) : sum_of_parts(text);
  if (!seconds)
    throw Error(Failure::scene, option + " \"" + text + "\" is not a time; expected one such as 1h50m, 90s or 1:50:00");
  return *seconds;
}

}  // namespace brisance::drivers
