#include "fluid/rows.hpp"

#include <cmath>

#include "core/base/errors.hpp"

namespace brisance::fluid {
namespace {

std::int64_t cells_of(CellIndex const& size) { return std::int64_t{size[0]} * size[1] * size[2]; }

std::size_t cells_of(Flow const& flow) {
  std::int64_t n = 0;
  for (Block const& block : flow.blocks()) n += cells_of(block.size());
  return static_cast<std::size_t>(n);
}

template <class Blocks, class Visit>
void for_cells(Blocks& blocks, Visit&& visit) {
  for (auto& block : blocks) {
    auto const [nx, ny, nz] = block.size();
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) visit(block, i, j, k);
  }
}

Vec3 velocity(Gas const& gas, State const& u) { return gas.vacuum(u) ? Vec3{} : Vec3{u[1], u[2], u[3]} / u[0]; }

}  // namespace

std::vector<parallel::Range> block_rows(Flow const& flow) {
  std::vector<parallel::Range> ranges;
  std::int64_t row = 0;
  for (Index b = 0; b < flow.grid().block_count(); ++b) {
    std::int64_t const count = cells_of(flow.grid().block_size(b));
    if (flow.owner(b) == flow.comm().rank()) ranges.push_back({row, count});
    row += count;
  }
  return ranges;
}

std::vector<double> pack_cells(Flow const& flow) {
  std::vector<double> data;
  data.reserve(5 * cells_of(flow));
  for_cells(flow.blocks(), [&](Block const& block, Index i, Index j, Index k) {
    State const u = block.load(i, j, k);
    data.insert(data.end(), u.begin(), u.end());
  });
  return data;
}

void unpack_cells(Flow& flow, std::span<double const> data) {
  std::size_t at = 0;
  for_cells(flow.blocks(), [&](Block& block, Index i, Index j, Index k) {
    block.store(i, j, k, {data[at], data[at + 1], data[at + 2], data[at + 3], data[at + 4]});
    at += 5;
  });
}

std::vector<parallel::ArchiveWriter::Box> cell_boxes(Flow const& flow) {
  std::vector<parallel::ArchiveWriter::Box> boxes;
  for (Block const& block : flow.blocks()) {
    CellIndex const first = block.first(), size = block.size();
    boxes.push_back({{first[0], first[1], first[2]}, {size[0], size[1], size[2]}});
  }
  return boxes;
}

std::vector<std::string> const& cell_field_names() {
  static std::vector<std::string> const names{"density", "pressure", "velocity", "energy", "mach"};
  return names;
}

CellField cell_field(Flow const& flow, std::string const& name) {
  Gas const& gas = flow.gas();
  CellField field;
  field.columns = name == "velocity" ? 3 : 1;
  field.data.reserve(cells_of(flow) * static_cast<std::size_t>(field.columns));
  auto const scalar = [&](auto const& value) {
    for_cells(flow.blocks(),
              [&](Block const& block, Index i, Index j, Index k) { field.data.push_back(value(block.load(i, j, k))); });
  };
  if (name == "density") {
    scalar([](State const& u) { return u[0]; });
  } else if (name == "pressure") {
    scalar([&](State const& u) { return gas.pressure(u); });
  } else if (name == "energy") {
    scalar([](State const& u) { return u[4]; });
  } else if (name == "mach") {
    scalar([&](State const& u) { return gas.vacuum(u) ? 0 : norm(velocity(gas, u)) / gas.sound_speed(u); });
  } else if (name == "velocity") {
    for_cells(flow.blocks(), [&](Block const& block, Index i, Index j, Index k) {
      Vec3 const v = velocity(gas, block.load(i, j, k));
      field.data.insert(field.data.end(), {v.x, v.y, v.z});
    });
  } else {
    throw Error(Failure::scene, "output.fields: there is no fluid field `" + name + "`. Did you mean `" +
                                    nearest(name, cell_field_names()) + "`?");
  }
  return field;
}

}  // namespace brisance::fluid
