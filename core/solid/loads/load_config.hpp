// What a scene says about the loads on its solid: one array of tables per kind.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/location.hpp"
#include "core/base/vec3.hpp"
#include "core/solid/loads/history.hpp"

namespace brisance::solid {

/// Which boundary faces a load acts on: all conditions that are given must hold.  Units: m, rad.
struct FaceSelection {
  std::optional<std::string> body;
  std::optional<Vec3> low, high, normal, facing;
  double within = 0.17453292519943295;
  template <class T>
  static void declare(Keys<T>& k);
};

/// Pressure on boundary faces; its direction turns with each face.  Units: Pa.
struct PressureConfig : FaceSelection, HistoryConfig {
  double pressure = 0;
  Location at;
  static void keys(Keys<PressureConfig>& k);
};

/// Traction on boundary faces, fixed in space or turning with each face.  Units: Pa.
struct TractionConfig : FaceSelection, HistoryConfig {
  Vec3 traction{};
  bool follow = false;
  Location at;
  static void keys(Keys<TractionConfig>& k);
};

/// Force at a point of the particle that holds it.  Units: m, N.
struct PointForceConfig : HistoryConfig {
  std::optional<std::string> body;
  Vec3 position{}, force{};
  bool follow = false;
  Location at;
  static void keys(Keys<PointForceConfig>& k);
};

/// Stress glut in one particle: a seismic source.  Units: m, N m.
struct MomentTensorConfig : HistoryConfig {
  std::optional<std::string> body;
  Vec3 position{};
  std::vector<double> moment;  ///< xx, yy, zz, xy, xz, yz
  Location at;
  static void keys(Keys<MomentTensorConfig>& k);
};

/// Faces that let plane waves out.
struct AbsorbingConfig : FaceSelection {
  Location at;
  static void keys(Keys<AbsorbingConfig>& k);
};

/// The air blast of a charge of TNT by the tables of Kingery and Bulmash.  Units: kg, m, s.
struct BlastConfig : FaceSelection {
  double mass = 0, tnt_factor = 1, start = 0;
  Vec3 centre{};
  std::string burst = "air";
  Location at;
  static void keys(Keys<BlastConfig>& k);
};

}  // namespace brisance::solid
