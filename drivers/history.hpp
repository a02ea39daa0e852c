// history.csv and stages.csv: what grows by rows while a run goes on.
#pragma once
#include <optional>
#include <string>

#include "drivers/assembly.hpp"

namespace brisance::drivers {

/// Files with rows of the present state, appended on rank 0; after a restart the rows of steps that are run again are
/// dropped. history.csv: a row per pair of steps, or per `interval` (s). stages.csv, where the ledger is kept by
/// stages: as often, a row per part of the step with the defects since the start of the scene.
class History {
 public:
  History(World const& world, std::string const& directory, std::optional<double> interval);
  /// Local. Adds the rows that are due. Errors: Failure::system when the disk refuses.
  void row();

 private:
  World const& world_;
  std::string history_, stages_;  ///< paths
  std::optional<double> interval_;
  double next_ = 1;
};

}  // namespace brisance::drivers
