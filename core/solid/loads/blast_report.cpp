#include "core/solid/loads/blast_report.hpp"

#include <cstdio>

#include "core/solid/loads/blast_wave.hpp"
#include "core/solid/loads/face_selection.hpp"

namespace brisance::solid {

std::vector<std::string> describe_blasts(SolidConfig const& config, Mesh const& mesh) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < config.blast.size(); ++i) {
    BlastConfig const& blast = config.blast[i];
    std::string const name = "solid.blast[" + std::to_string(i) + "]";
    auto const faces = select_faces(blast, mesh, name, blast.at);
    Real near = 1e300, far = 0;
    BlastWave first{}, last{};
    for (FaceRef const& f : faces) {
      FaceGeometry const& face = mesh.face(f.particle, f.face);
      Vec3 const centroid = mesh.particle(f.particle).centre + face.centroid;
      Vec3 ray = centroid - blast.centre;
      for (int d = mesh.dimension; d < 3; ++d) ray[d] = 0;
      BlastWave const wave = blast_wave(blast, mesh.dimension, centroid, face.normal, name);
      if (norm(ray) < near) near = norm(ray), first = wave;
      if (norm(ray) > far) far = norm(ray), last = wave;
    }
    char text[300];
    std::snprintf(
        text, sizeof text,
        "%s: %.4g kg of TNT on %zu faces from %.4g to %.4g m away; the nearest bears %.4g kPa (reflected %.4g, "
        "incident %.4g) from %.4g ms on, for %.4g ms; the last is reached at %.4g ms",
        name.c_str(), blast.mass * blast.tnt_factor, faces.size(), near, far, 1e-3 * first.pressure(first.arrival),
        1e-3 * first.reflected.peak, 1e-3 * first.incident.peak, 1e3 * first.arrival, 1e3 * first.duration,
        1e3 * last.arrival);
    lines.push_back(text);
  }
  return lines;
}

}  // namespace brisance::solid
