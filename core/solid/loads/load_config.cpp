#include "core/solid/loads/load_config.hpp"

#include "core/base/keys.hpp"

namespace brisance::solid {

template <class T>
void FaceSelection::declare(Keys<T>& k) {
  k("body", &T::body, "", "the body whose faces are meant; not given: all bodies");
  k("low", &T::low, "m", "lower corner of a box in which a face lies with all its corners; not given: no limit");
  k("high", &T::high, "m", "upper corner of that box; not given: no limit");
  k("normal", &T::normal, "1", "outward direction of the faces that are meant; not given: any");
  k("facing", &T::facing, "m", "a point that the faces look at, such as the centre of a vessel: its inner faces");
  k("within", &T::within, "rad", "largest angle between the normal of a face and `normal`").above(0).at_most(3.2);
}

template <class T>
void HistoryConfig::declare(Keys<T>& k) {
  k("history", &T::history, "", "factors on the value at given times, linear between them; not given: constant");
  k("pulse", &T::pulse, "", "a standard pulse instead of a table");
}

void PressureConfig::keys(Keys<PressureConfig>& k) {
  k("pressure", &PressureConfig::pressure, "Pa", "pressure over the ambient one, on faces that turn with the body")
      .required();
  FaceSelection::declare(k);
  HistoryConfig::declare(k);
}

void TractionConfig::keys(Keys<TractionConfig>& k) {
  k("traction", &TractionConfig::traction, "Pa", "force per area").required();
  k("follow", &TractionConfig::follow, "", "does it turn with its face? false: its direction stays fixed in space");
  FaceSelection::declare(k);
  HistoryConfig::declare(k);
}

void PointForceConfig::keys(Keys<PointForceConfig>& k) {
  k("position", &PointForceConfig::position, "m", "where it acts at the start; the particle there carries it along")
      .required();
  k("force", &PointForceConfig::force, "N", "the force; in 2D per metre of depth").required();
  k("follow", &PointForceConfig::follow, "", "does it turn with its particle? false: its direction stays fixed");
  k("body", &PointForceConfig::body, "", "the body it acts on; not given: the nearest particle of all");
  HistoryConfig::declare(k);
}

void MomentTensorConfig::keys(Keys<MomentTensorConfig>& k) {
  k("position", &MomentTensorConfig::position, "m", "place of the source; the particle nearest to it is the source")
      .required();
  k("moment", &MomentTensorConfig::moment, "N m", "xx, yy, zz, xy, xz, yz; an explosion has positive diagonal entries")
      .required();
  k("body", &MomentTensorConfig::body, "", "the body of the source; not given: the nearest particle of all");
  HistoryConfig::declare(k);
}

void AbsorbingConfig::keys(Keys<AbsorbingConfig>& k) { FaceSelection::declare(k); }

void BlastConfig::keys(Keys<BlastConfig>& k) {
  k("mass", &BlastConfig::mass, "kg", "mass of the explosive").required().above(0);
  k("tnt_factor", &BlastConfig::tnt_factor, "1", "mass of TNT of the same effect over the mass of the explosive")
      .above(0);
  k("centre", &BlastConfig::centre, "m", "place of the charge").required();
  k("burst", &BlastConfig::burst, "",
    "air: a sphere in free air; surface: a hemisphere on the ground, whose reflection the tables contain")
      .one_of({"air", "surface"});
  k("start", &BlastConfig::start, "s", "time of the detonation");
  FaceSelection::declare(k);
}

}  // namespace brisance::solid
