#include "core/solid/fracture/law_figures.hpp"

#include <fmt/format.h>

#include "core/solid/fracture/link_laws.hpp"

namespace brisance::solid {
namespace {

constexpr Real tip_share = EnergyRelease{}.tip_share;

/// Of the links of one law; means are weighted by area.
struct Figures {
  std::int64_t links = 0;
  Real area = 0, length = 0, modulus = 0, longest = 0;
  Real mean_length() const { return length / area; }
  Real mean_modulus() const { return modulus / area; }
};

std::string implied(MixedStress const& law, Figures const& f) {
  Real const g = law.tensile_strength * law.tensile_strength * f.mean_length() / (2 * tip_share * f.mean_modulus());
  return fmt::format("a long crack then has a toughness of about {:.3g} J/m2, in proportion to their length", g);
}

std::string implied(MohrCoulomb const& law, Figures const& f) {
  if (!law.tensile_strength) return "no tension cut-off";
  MixedStress same;
  same.tensile_strength = *law.tensile_strength;
  return implied(same, f);
}

std::string implied(EnergyRelease const& law, Figures const& f) {
  Real const strength = std::sqrt(2 * law.tip_share * f.mean_modulus() * law.toughness / f.mean_length());
  return fmt::format("a sound body then has a tensile strength of about {:.3g} Pa, in proportion to their length^-1/2",
                     strength);
}

std::string implied(Cohesive const& law, Figures const& f) {
  Real const zone = f.mean_modulus() * law.toughness / (law.tensile_strength * law.tensile_strength);
  return f.longest <= zone / 3
             ? fmt::format("they resolve the softening zone of {:.3g} m", zone)
             : fmt::format(
                   "warning: the softening zone of {:.3g} m wants links of at most {:.3g} m: cracks follow the mesh",
                   zone, zone / 3);
}

std::string implied(Elongation const&, Figures const&) { return "blind to shear"; }

}  // namespace

std::vector<std::string> law_figures(FractureConfig const& config, Mesh const& mesh) {
  std::vector<Figures> figures(config.law.size());
  LawFinder const finder(config, mesh);
  for (Link const& link : mesh.links) {
    auto const law = finder(link);
    if (!law) continue;
    Figures& f = figures[*law];
    Section const s = section_of(mesh, link);
    ++f.links;
    f.area += s.area;
    f.length += s.area * s.length;
    f.modulus += s.area * mesh.material(link.i).young_modulus;
    f.longest = max(f.longest, s.length);
  }
  std::vector<std::string> lines;
  for (std::size_t n = 0; n < figures.size(); ++n) {
    Figures const& f = figures[n];
    std::visit(
        [&](auto const& law) {
          std::string const head = fmt::format("solid.fracture.law[{}], {}: ", n, law.name);
          lines.push_back(f.links == 0
                              ? head + "warning: no link follows it"
                              : head + fmt::format("{} links, {:.3g} m long on average; ", f.links, f.mean_length()) +
                                    implied(law, f));
        },
        config.law[n].criterion());
  }
  return lines;
}

}  // namespace brisance::solid
