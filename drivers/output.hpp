// Results: fields.xdmf + fields/*.h5 and solid.xdmf + solid/*.h5, time series that ParaView and VisIt open as they are,
// and the tables of the effects.
#pragma once
#include <string>
#include <vector>

#include "drivers/assembly.hpp"

namespace brisance::drivers {

class Output {
 public:
  Output(World& world, Scene const& scene, std::string directory);
  /// Collective. One frame of fields and solid at the present time, then the two .xdmf files, all atomically; then rows
  /// of the tables.
  void write();
  /// Collective. The frames and rows a previous run left, so that the series go on after a restart; later ones are
  /// forgotten.
  void resume(double time);

 private:
  struct Frame {
    std::int64_t step;
    double time;
  };
  void write_fields(std::string const& name);
  void write_series();
  void start_tables();
  void add_to_tables();
  World& world_;
  Scene const& scene_;
  std::string directory_;
  std::vector<Frame> frames_;
};

}  // namespace brisance::drivers
