#include "drivers/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace brisance::drivers {

namespace {
constexpr std::size_t checkpoints_kept = 2;
}

std::vector<std::string> list_checkpoints(parallel::Comm& comm, std::string const& directory) {
  parallel::Bytes bytes;
  if (comm.rank() == 0) {
    std::vector<std::string> names;
    std::error_code none;
    for (auto const& entry : std::filesystem::directory_iterator(directory + "/checkpoints", none)) {
      std::string const name = entry.path().filename().string();
      if (name.starts_with("step-") && name.ends_with(".h5")) names.push_back(name);
    }
    std::sort(names.rbegin(), names.rend());
    std::string text;
    for (std::string const& name : names) text += name + "\n";
    bytes.resize(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
  }
  comm.broadcast(bytes, 0);
  std::vector<std::string> paths;
  std::string name;
  for (std::byte const b : bytes) {
    char const c = static_cast<char>(b);
    if (c != '\n') {
      name += c;
      continue;
    }
    paths.push_back(directory + "/checkpoints/" + name);
    name.clear();
  }
  return paths;
}

void write_checkpoint(World& world, std::string const& directory) {
  if (world.comm->rank() == 0) std::filesystem::create_directories(directory + "/checkpoints");
  world.comm->barrier();
  std::string const name = fmt::format("step-{:010d}.h5", world.simulation->clock().step);
  std::string const path = directory + "/checkpoints/" + name;
  {
    parallel::ArchiveWriter file(*world.comm, path);
    world.simulation->write(file);
    file.close();
  }
  parallel::write_text_atomically(*world.comm, directory + "/checkpoints/latest", name + "\n");
  // Later ones belong to a run that this one replaces, or are damaged.
  auto const all = list_checkpoints(*world.comm, directory);
  std::size_t const present = static_cast<std::size_t>(std::find(all.begin(), all.end(), path) - all.begin());
  if (world.comm->rank() == 0)
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i >= present && i < present + checkpoints_kept) continue;
      std::error_code ignored;
      std::filesystem::remove(all[i], ignored);
    }
}

void forget_checkpoints(parallel::Comm& comm, std::string const& directory) {
  auto const all = list_checkpoints(comm, directory);
  if (comm.rank() == 0) {
    std::error_code ignored;
    for (std::string const& path : all) std::filesystem::remove(path, ignored);
    std::filesystem::remove(directory + "/checkpoints/latest", ignored);
  }
  comm.barrier();
}

void read_checkpoint(World& world, std::string const& path) {
  parallel::ArchiveReader file(*world.comm, path);
  world.simulation->read(file);
}

}  // namespace brisance::drivers
