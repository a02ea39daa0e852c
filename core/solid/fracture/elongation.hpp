// Elongation criterion of the first publications; blind to shear.  Source: theory/solid.md section 14, criterion 1.
#pragma once
#include "core/solid/fracture/link_state.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// The link breaks when its poles have drifted apart by the share `at_break` of their distance.
struct Elongation {
  static constexpr char const* name = "elongation";
  static constexpr bool softens = false;
  Real at_break = 0;  // 1
  static void keys(Keys<Elongation>& k);

  Wants wants() const { return {false, false, false, true}; }
  /// `scatter`: strength of this link over the mean.
  Real safe_traction(Real, Real) const { return 0; }  // it looks at poles, not at gaps
  bool fails(LinkState const& s, Real scatter) const { return s.stretch >= scatter * at_break; }
};

}  // namespace brisance::solid
