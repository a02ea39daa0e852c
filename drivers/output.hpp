// Results: fields.xdmf + fields/*.h5 and solid.xdmf + solid/*.h5, time series that ParaView and VisIt open as they are.
#pragma once
#include <string>
#include <vector>

#include "drivers/assembly.hpp"

namespace brisance::drivers {

class Output {
 public:
  Output(World& world, Scene const& scene, std::string directory);
  /// Collective. One frame of fields and solid at the present time, then the two .xdmf files, all atomically.
  void write();
  /// Collective. The frames a previous run left, so that the series go on after a restart; later ones are forgotten.
  void resume(double time);

 private:
  struct Frame {
    std::int64_t step;
    double time;
  };
  void write_fields(std::string const& name);
  void write_solid(std::string const& name);
  void write_series();
  World& world_;
  Scene const& scene_;
  std::string directory_;
  std::vector<Frame> frames_;
};

}  // namespace brisance::drivers
