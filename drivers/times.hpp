// Times given on the command line.
#pragma once
#include <string>

namespace brisance::drivers {

/// "1 ms", "2e-3" (s).  Errors: Failure::scene naming the option.
double parse_time(std::string const& option, std::string const& text);

/// A real time in s: "1h50m", "90 s", "2h", "45m" (minutes), "1:50:00" as batch systems write it, "3600".
/// Errors: Failure::scene naming the option.
double parse_walltime(std::string const& option, std::string const& text);

}  // namespace brisance::drivers
