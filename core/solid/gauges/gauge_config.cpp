#include "core/solid/gauges/gauge_config.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/base/errors.hpp"

namespace brisance::solid {
namespace {

constexpr double most_rows = 1e8;

bool fits_file_name(std::string const& name) {
  auto const plain = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '.'; };
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), plain);
}

}  // namespace

void SolidGaugeConfig::keys(Keys<SolidGaugeConfig>& k) {
  k("name", &SolidGaugeConfig::name, "", "its file is gauges/NAME.csv: letters, digits, and - _ . inside").required();
  k("watch", &SolidGaugeConfig::watch, "",
    "particle: the one nearest to `position`; surface: the centre of the boundary face nearest to it; support: force "
    "and "
    "moment of the supports in the box on the solid; section: of the part ahead of a plane on the part behind it")
      .one_of({"particle", "surface", "support", "section"});
  k("interval", &SolidGaugeConfig::interval, "s", "time between two rows, at its multiples whatever the time step")
      .required()
      .above(0);
  k("body", &SolidGaugeConfig::body, "", "name of the body that is watched; not given: all");
  k("position", &SolidGaugeConfig::position, "m",
    "in the reference state: particle, surface: where it is looked for; section: a point of the plane; support, "
    "section: "
    "moments are about it, the origin if not given");
  k("normal", &SolidGaugeConfig::normal, "1", "section: normal of the plane, from the part behind to the part ahead");
  k("low", &SolidGaugeConfig::low, "m",
    "support, section: lower corner of the box in which particles and faces count; not given: no limit");
  k("high", &SolidGaugeConfig::high, "m", "support, section: upper corner of that box; not given: no limit");
  k("quantities", &SolidGaugeConfig::quantities, "",
    "particle: columns to write, not given: all; displacement of its centre, velocity, rotation vector, spin (rad/s), "
    "mean stress and the strain that belongs to it")
      .one_of({"displacement", "velocity", "rotation", "spin", "stress", "strain"});
}

std::vector<std::string> columns(SolidGaugeConfig const& gauge, int dimension) {
  std::vector<std::string> quantities = gauge.quantities;
  if (gauge.watch == "surface") quantities = {"displacement", "velocity"};
  if (gauge.watch == "support" || gauge.watch == "section") quantities = {"force", "moment"};
  if (quantities.empty()) quantities = {"displacement", "velocity", "rotation", "spin", "stress", "strain"};
  std::vector<std::string> all;
  for (std::string const& q : quantities) {
    bool const turning = q == "rotation" || q == "spin" || q == "moment", tensor = q == "stress" || q == "strain";
    if (tensor) {
      for (char const* c : {"_xx", "_yy", "_zz"}) all.push_back(q + c);
      if (dimension > 1) all.push_back(q + "_xy");
      if (dimension > 2) all.push_back(q + "_xz"), all.push_back(q + "_yz");
      continue;
    }
    for (int d = 0; d < 3; ++d) {
      bool const there = turning ? dimension == 3 || (dimension == 2 && d == 2) : d < dimension;
      if (there) all.push_back(q + "_" + "xyz"[d]);
    }
  }
  return all;
}

void check(std::vector<SolidGaugeConfig> const& gauges, std::vector<std::string> const& taken, Mesh const& mesh,
           Real end_time) {
  std::set<std::string> names(taken.begin(), taken.end());
  for (SolidGaugeConfig const& gauge : gauges) {
    std::string const who = "output.solid_gauge \"" + gauge.name + "\"";
    require(fits_file_name(gauge.name), gauge.at,
            who + ": its name becomes a file: use letters, digits, and - _ . inside");
    require(names.insert(gauge.name).second, gauge.at, who + " is there twice: give every gauge a name of its own");
    require(end_time / gauge.interval <= most_rows, gauge.at,
            who + " would write more than 1e8 rows by end_time: raise its interval");
    bool const point = gauge.watch == "particle" || gauge.watch == "surface", section = gauge.watch == "section";
    require(gauge.position || !(point || section), gauge.at, who + " needs a `position`");
    require(!section || (gauge.normal && norm2(*gauge.normal) > 0), gauge.at,
            who + ": a section needs the `normal` of its plane");
    require(section || !gauge.normal, gauge.at, who + ": only a section has a `normal`; leave it out");
    require(!point || (!gauge.low && !gauge.high), gauge.at,
            who + ": a gauge of a " + gauge.watch + " has no box: leave out `low` and `high`, or name a `body`");
    require(gauge.quantities.empty() || gauge.watch == "particle", gauge.at,
            who + ": `quantities` are chosen for a particle only; leave them out");
    std::vector<std::string> bodies;
    for (Body const& b : mesh.bodies) bodies.push_back(b.name);
    require(!gauge.body || std::count(bodies.begin(), bodies.end(), *gauge.body), gauge.at,
            who + ": there is no body \"" + gauge.body.value_or("") + "\"; the nearest name is \"" +
                nearest(gauge.body.value_or(""), bodies) + "\"");
  }
}

}  // namespace brisance::solid
