#include "drivers/mesh_files.hpp"

#include <cstring>
#include <filesystem>
#include <map>

#include "parallel/error.hpp"

namespace brisance::drivers {

void keep_mesh_files(Scene& scene, std::string const& directory, parallel::Comm& comm) {
  if (!scene.solid) return;
  std::map<std::string, std::string> copy_of;  // path -> name below `directory`
  for (solid::BodyConfig& body : scene.solid->body) {
    if (!body.mesh) continue;
    std::string const path = body.mesh->path();
    // Numbered, since files of several folders may bear one name.
    auto const [it, fresh] = copy_of.try_emplace(path);
    if (fresh)
      it->second =
          "meshes/" + std::to_string(copy_of.size() - 1) + "-" + std::filesystem::path(path).filename().string();
    body.mesh->file = it->second;
  }
  std::string trouble;
  if (comm.rank() == 0 && !copy_of.empty()) {
    std::error_code error;
    std::filesystem::create_directories(directory + "/meshes", error);
    for (auto const& [path, name] : copy_of) {
      if (error) break;
      std::filesystem::path const to = std::filesystem::path(directory) / name;
      bool const same = std::filesystem::equivalent(path, to, error);
      if (same) continue;
      std::filesystem::copy_file(path, to, std::filesystem::copy_options::overwrite_existing, error);
      if (error) trouble = path + ": cannot be copied to " + to.string() + ": " + error.message();
    }
    if (error && trouble.empty()) trouble = directory + "/meshes: cannot be created: " + error.message();
  }
  parallel::Bytes bytes(trouble.size());
  std::memcpy(bytes.data(), trouble.data(), trouble.size());
  comm.broadcast(bytes, 0);
  if (!bytes.empty())
    throw Error(Failure::system, std::string(reinterpret_cast<char const*>(bytes.data()), bytes.size()));
}

}  // namespace brisance::drivers
