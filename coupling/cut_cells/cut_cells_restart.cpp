// The way back: a pair of steps that is taken back, a restart from a checkpoint. The geometry is made anew in both.
#include <algorithm>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/cut_cells.hpp"

namespace brisance::coupling {

Plan::Keep CutCells::keep() {
  Plan::Keep keep;
  keep.save = [this] {
    surface_.save();
    broken_saved_ = broken_;
    kept_saved_ = kept_;
    minor_saved_ = minor_;
  };
  keep.restore = [this] {
    surface_.restore();
    areal_mass_ = areal_masses(surface_.topology(), solid_.mesh());
    broken_ = broken_saved_;
    kept_ = kept_saved_;
    minor_ = minor_saved_;
    surface_.send_triangles(record_.triangles);
    rebuild_record();
    for (auto& sum : crossed_) sum = {};
    for (auto& sum : ambient_given_) sum = {};
    wall_work_ = pressure_impulse_ = exchanged_energy_ = wall_heat_ = {};
    health_ = {};
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    surface_.write(file);
    std::vector<std::int64_t> ids;
    std::vector<double> rows;
    for (Content const& k : kept_) ids.push_back(k.cell), rows.insert(rows.end(), k.amount.begin(), k.amount.end());
    file.sparse("coupling/covered", 5, ids, rows);
    ids.clear(), rows.clear();
    for (Content const& m : minor_) {
      ids.push_back(m.cell * static_cast<GlobalId>(most_parts) + m.unit);
      rows.insert(rows.end(), m.amount.begin(), m.amount.end());
    }
    file.sparse("coupling/parts", 5, ids, rows);
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    if (!broken_.empty() && gather_broken())
      surface_.replace(std::make_shared<solid::Surface>(solid_.mesh(), broken_, nullptr));
    areal_mass_ = areal_masses(surface_.topology(), solid_.mesh());
    surface_.read(file);
    parallel::ArchiveReader::Sparse const stored = file.sparse("coupling/covered", 5);
    kept_.clear();
    for (std::size_t s = 0; s < stored.ids.size(); ++s) {
      if (!owned(cell_from_id(flow_.grid(), stored.ids[s]))) continue;
      Content k{stored.ids[s], {}};
      std::copy_n(stored.data.begin() + static_cast<std::ptrdiff_t>(5 * s), 5, k.amount.begin());
      kept_.push_back(k);
    }
    std::sort(kept_.begin(), kept_.end(), [](auto const& a, auto const& b) { return a.cell < b.cell; });
    minor_.clear();
    parallel::ArchiveReader::Sparse const parts = file.sparse("coupling/parts", 5);
    for (std::size_t s = 0; s < parts.ids.size(); ++s) {
      GlobalId const id = parts.ids[s] / static_cast<GlobalId>(most_parts);
      if (!owned(cell_from_id(flow_.grid(), id))) continue;
      Content m{id, {}, static_cast<Index>(parts.ids[s] % static_cast<GlobalId>(most_parts))};
      std::copy_n(parts.data.begin() + static_cast<std::ptrdiff_t>(5 * s), 5, m.amount.begin());
      minor_.push_back(m);
    }
    std::sort(minor_.begin(), minor_.end());
    surface_.send_triangles(record_.triangles);
    rebuild_record();
  };
  keep.digest = [this](parallel::Digest& d) { digest(d); };
  return keep;
}

}  // namespace brisance::coupling
