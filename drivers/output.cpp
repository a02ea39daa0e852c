#include "drivers/output.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "drivers/solid_frame.hpp"
#include "fluid/cell_fields.hpp"
#include "fluid/rows.hpp"
#include "parallel/error.hpp"

namespace brisance::drivers {

namespace {
std::string frame_name(std::int64_t step) { return fmt::format("{:08d}.h5", step); }
}  // namespace

Output::Output(World& world, Scene const& scene, std::string directory)
    : world_(world), scene_(scene), directory_(std::move(directory)) {
  if (world_.comm->rank() != 0) return;
  if (world_.flow) std::filesystem::create_directories(directory_ + "/fields");
  if (world_.solid) std::filesystem::create_directories(directory_ + "/solid");
  start_tables();
}

void Output::write() {
  Clock const& clock = world_.simulation->clock();
  if (!frames_.empty() && frames_.back().step == clock.step) return;
  std::string const name = frame_name(clock.step);
  if (world_.flow) write_fields(directory_ + "/fields/" + name);
  if (world_.solid) write_solid_frame(world_, scene_.output.solid_fields, directory_ + "/solid/" + name);
  frames_.push_back({clock.step, clock.time});
  write_series();
  add_to_tables();
}

/// Rows up to the present step stay, as in history.csv: a run from the start has none.
void Output::start_tables() {
  for (Plan::Table const& table : world_.plan.tables()) {
    std::string const path = directory_ + "/" + table.file;
    std::string kept = table.header, line;
    std::int64_t const step = world_.simulation->clock().step;
    std::ifstream old(path);
    if (step > 0 && std::getline(old, line))
      while (std::getline(old, line))
        if (std::atoll(line.c_str()) <= step) kept += line + "\n";
    old.close();
    std::ofstream file(path);
    file << kept << std::flush;
    require(file.good(), Failure::system, path + ": cannot be written (is the disk full?)");
  }
}

void Output::add_to_tables() {
  for (Plan::Table const& table : world_.plan.tables()) {
    std::string const rows = table.rows(world_.simulation->clock());
    if (world_.comm->rank() != 0) continue;
    std::string const path = directory_ + "/" + table.file;
    std::ofstream file(path, std::ios::app);
    file << rows << std::flush;
    require(file.good(), Failure::system, path + ": cannot be written (is the disk full?)");
  }
}

void Output::resume(double time) {
  parallel::Bytes bytes;
  if (world_.comm->rank() == 0) {
    std::ifstream file(directory_ + "/frames.txt");
    Frame frame{};
    while (file >> frame.step >> frame.time)
      if (frame.time <= time) parallel::put(bytes, frame);
  }
  world_.comm->broadcast(bytes, 0);
  for (std::span<std::byte const> in(bytes); !in.empty();) frames_.push_back(parallel::take<Frame>(in));
}

void Output::write_fields(std::string const& path) {
  fluid::Flow& flow = *world_.flow;
  parallel::ArchiveWriter file(*world_.comm, path);
  auto const boxes = fluid::cell_boxes(flow);
  fluid::Grid const& grid = flow.grid();
  std::array<std::int64_t, 3> const cells{grid.cells[0], grid.cells[1], grid.cells[2]};
  fluid::FluidVolume const volume = fluid_volumes(world_);
  for (std::string const& name : scene_.output.fields) {
    fluid::CellField const field = fluid::cell_field(flow, *scene_.fluid, volume, name);
    file.grid(name, cells, field.columns, boxes, field.data, true);
  }
  if (world_.cut_cells) {
    std::vector<double> fraction;
    for (fluid::Block const& b : std::as_const(flow).blocks()) {
      fluid::CellIndex const first = b.first();
      for (Index k = 0; k < b.size()[2]; ++k)
        for (Index j = 0; j < b.size()[1]; ++j)
          for (Index i = 0; i < b.size()[0]; ++i)
            fraction.push_back(world_.cut_cells->solid_fraction({first[0] + i, first[1] + j, first[2] + k}));
    }
    file.grid("solid_fraction", cells, 1, boxes, fraction, true);
  }
  file.attribute("time", world_.simulation->clock().time);
  file.close();
}

void Output::write_series() {
  std::string frames;
  for (Frame const& f : frames_) frames += fmt::format("{} {:.17g}\n", f.step, f.time);
  parallel::write_text_atomically(*world_.comm, directory_ + "/frames.txt", frames);
  auto const series = [&](std::string const& grids) {
    return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n  <Grid Name=\"series\" "
           "GridType=\"Collection\" "
           "CollectionType=\"Temporal\">\n" +
           grids + "  </Grid>\n </Domain>\n</Xdmf>\n";
  };
  if (world_.flow) {
    fluid::Grid const& g = world_.flow->grid();
    std::string grids;
    for (Frame const& f : frames_) {
      grids += fmt::format(
          "   <Grid Name=\"flow\"><Time Value=\"{:.9g}\"/>\n    <Topology TopologyType=\"3DCoRectMesh\" "
          "Dimensions=\"{} {} "
          "{}\"/>\n    <Geometry GeometryType=\"ORIGIN_DXDYDZ\"><DataItem Dimensions=\"3\">{:.17g} {:.17g} "
          "{:.17g}</DataItem><DataItem Dimensions=\"3\">{:.17g} {:.17g} {:.17g}</DataItem></Geometry>\n",
          f.time, g.cells[2] + 1, g.cells[1] + 1, g.cells[0] + 1, g.low.z, g.low.y, g.low.x, g.spacing.z, g.spacing.y,
          g.spacing.x);
      std::vector<std::string> names = scene_.output.fields;
      if (world_.cut_cells) names.push_back("solid_fraction");
      for (std::string const& name : names) {
        bool const vector = fluid::cell_field_columns(name, g.dimension) == 3;
        grids += fmt::format(
            "    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Cell\"><DataItem Format=\"HDF\" Precision=\"4\" "
            "Dimensions=\"{} {} {}{}\">fields/{}:/{}</DataItem></Attribute>\n",
            name, vector ? "Vector" : "Scalar", g.cells[2], g.cells[1], g.cells[0], vector ? " 3" : "",
            frame_name(f.step), name);
      }
      grids += "   </Grid>\n";
    }
    parallel::write_text_atomically(*world_.comm, directory_ + "/fields.xdmf", series(grids));
  }
  if (world_.solid) {
    std::string grids;
    for (Frame const& f : frames_)
      grids += solid_frame_xdmf(world_, scene_.output.solid_fields, "solid/" + frame_name(f.step), f.time);
    parallel::write_text_atomically(*world_.comm, directory_ + "/solid.xdmf", series(grids));
  }
}

}  // namespace brisance::drivers
