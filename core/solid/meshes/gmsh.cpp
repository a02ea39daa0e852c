#include "core/solid/meshes/gmsh.hpp"

#include <map>
#include <unordered_map>

#include "core/solid/meshes/gmsh_source.hpp"

namespace brisance::solid {
namespace {

constexpr int point_type = 15;

/// Nodes of an element type; 0: not known here.
int nodes_of_type(std::int64_t type) {
  if (type == point_type) return 1;
  return type >= 1 && type <= 7 ? node_count(static_cast<ElementKind>(type)) : 0;
}

/// What Gmsh calls the types that are not read.
std::string type_name(std::int64_t type) {
  static std::map<std::int64_t, char const*> const names{
      {8, "3-node line"},          {9, "6-node triangle"},      {10, "9-node quadrangle"},
      {11, "10-node tetrahedron"}, {12, "27-node hexahedron"},  {13, "18-node prism"},
      {14, "14-node pyramid"},     {16, "8-node quadrangle"},   {17, "20-node hexahedron"},
      {18, "15-node prism"},       {19, "13-node pyramid"},     {20, "9-node triangle"},
      {21, "10-node triangle"},    {22, "12-node triangle"},    {23, "15-node triangle"},
      {24, "15-node triangle"},    {25, "21-node triangle"},    {26, "4-node line"},
      {27, "5-node line"},         {28, "6-node line"},         {29, "20-node tetrahedron"},
      {30, "35-node tetrahedron"}, {31, "56-node tetrahedron"}, {92, "64-node hexahedron"},
      {93, "125-node hexahedron"}};
  auto const found = names.find(type);
  return found == names.end() ? "type " + std::to_string(type) : found->second;
}

class Reader {
 public:
  explicit Reader(std::string const& path) : in_(path) { mesh_.path = path; }

  ElementMesh read() {
    read_format();
    for (std::string section = in_.next_section(); !section.empty(); section = in_.next_section()) {
      if (section == "PhysicalNames")
        read_names();
      else if (section == "Entities")
        read_entities();
      else if (section == "PartitionedEntities")
        in_.fail("a partitioned mesh is not read: save it without partitions");
      else if (section == "Nodes")
        four_ ? read_nodes_4() : read_nodes_2();
      else if (section == "Elements")
        four_ ? read_elements_4() : read_elements_2();
      else {
        in_.skip_section();
        continue;
      }
      in_.end_section();
    }
    if (mesh_.nodes.empty()) mesh_error(mesh_.path, 0, "has no nodes: is $Nodes missing?");
    if (mesh_.elements.empty())
      mesh_error(mesh_.path, 0,
                 "has no elements. Gmsh saves only physical groups once there is one: put the volumes into one.");
    return std::move(mesh_);
  }

 private:
  void read_format() {
    if (in_.next_section() != "MeshFormat") in_.fail("this is no .msh file: it does not begin with $MeshFormat");
    std::string const version = in_.word();
    if (version != "2.2" && version != "4.1")
      in_.fail("format " + version + " is not read. Save as version 2.2 or 4.1 (Mesh.MshFileVersion).");
    four_ = version == "4.1";
    std::int64_t const binary = in_.text_integer(), size = in_.text_integer();
    if (size != 8) in_.fail("data of " + std::to_string(size) + " bytes are not read: only doubles of 8");
    if (binary != 0) in_.expect_bytes();
    in_.end_section();
  }

  void read_names() {
    for (std::int64_t n = in_.checked(in_.text_integer(), "physical names"); n > 0; --n) {
      auto const dimension = in_.text_integer(), tag = in_.text_integer();
      name_of_[{dimension, tag}] = in_.quoted();
    }
  }

  std::string group_name(std::int64_t dimension, std::int64_t tag) const {
    auto const found = name_of_.find({dimension, tag});
    return found == name_of_.end() ? std::to_string(tag) : found->second;
  }

  /// Physical tags of all points, curves, surfaces and volumes.
  void read_entities() {
    in_.end_line();
    std::array<std::int64_t, 4> count{};
    for (auto& n : count) n = in_.checked(in_.size(), "entities");
    for (std::int64_t d = 0; d < 4; ++d)
      for (std::int64_t n = 0; n < count[static_cast<std::size_t>(d)]; ++n) {
        std::int64_t const tag = in_.integer();
        for (int c = 0; c < (d == 0 ? 3 : 6); ++c) in_.real();
        std::vector<std::string> names;
        for (std::int64_t k = in_.checked(in_.size(), "physical tags"); k > 0; --k)
          names.push_back(group_name(d, std::abs(in_.integer())));
        groups_of_[{d, tag}] = mesh_.group_set(names);
        if (d > 0)
          for (std::int64_t k = in_.checked(in_.size(), "bounding entities"); k > 0; --k) in_.integer();
      }
  }

  void add_node(std::int64_t tag, Vec3 const& x) {
    if (!node_of_.try_emplace(tag, static_cast<Index>(mesh_.nodes.size())).second)
      in_.fail("node " + std::to_string(tag) + " is given twice");
    mesh_.nodes.push_back(x);
    mesh_.node_tag.push_back(tag);
  }

  Vec3 read_place() {
    Real const x = in_.real(), y = in_.real(), z = in_.real();
    return {x, y, z};
  }

  void read_nodes_2() {
    for (std::int64_t n = in_.checked(in_.text_integer(), "nodes"), k = 0; k < n; ++k) {
      if (k == 0) in_.end_line();
      std::int64_t const tag = in_.integer();
      add_node(tag, read_place());
    }
  }

  void read_nodes_4() {
    in_.end_line();
    std::int64_t const blocks = in_.checked(in_.size(), "blocks");
    for (int k = 0; k < 3; ++k) in_.size();
    std::vector<std::int64_t> tags;
    for (std::int64_t b = 0; b < blocks; ++b) {
      std::int64_t const dimension = in_.integer();
      in_.integer();
      bool const parametric = in_.integer() != 0;
      tags.resize(static_cast<std::size_t>(in_.checked(in_.size(), "nodes")));
      for (auto& t : tags) t = in_.size();
      for (auto const t : tags) {
        add_node(t, read_place());
        for (std::int64_t k = 0; parametric && k < dimension; ++k) in_.real();
      }
    }
  }

  void read_elements_2() {
    std::int64_t const n = in_.checked(in_.text_integer(), "elements");
    if (n > 0) in_.end_line();
    for (std::int64_t done = 0; done < n;) {
      std::int64_t tag = 0, type = 0, alike = 1, tags = 0;
      if (in_.binary()) {
        type = in_.integer(), alike = in_.checked(in_.integer(), "elements"), tags = in_.integer();
        if (alike == 0) in_.fail("a block of no elements");
      } else {
        tag = in_.integer(), type = in_.integer(), tags = in_.integer();
      }
      in_.checked(tags, "tags");
      for (; alike > 0; --alike, ++done) {
        if (in_.binary()) tag = in_.integer();
        std::int64_t physical = 0;
        for (std::int64_t k = 0; k < tags; ++k) {
          std::int64_t const value = in_.integer();
          if (k == 0) physical = std::abs(value);
        }
        Index groups = 0;
        if (physical != 0 && nodes_of_type(type) != 0 && type != point_type) {
          int const d = dimension(static_cast<ElementKind>(type));
          auto const [it, fresh] = groups_of_.try_emplace({d, physical}, 0);
          if (fresh) it->second = mesh_.group_set({group_name(d, physical)});
          groups = it->second;
        }
        add_element(type, tag, groups);
      }
    }
  }

  void read_elements_4() {
    in_.end_line();
    std::int64_t const blocks = in_.checked(in_.size(), "blocks");
    for (int k = 0; k < 3; ++k) in_.size();
    for (std::int64_t b = 0; b < blocks; ++b) {
      std::int64_t const dimension = in_.integer(), entity = in_.integer(), type = in_.integer();
      auto const found = groups_of_.find({dimension, entity});
      Index const groups = found == groups_of_.end() ? 0 : found->second;
      for (std::int64_t n = in_.checked(in_.size(), "elements"); n > 0; --n) add_element(type, in_.size(), groups);
    }
  }

  /// Reads the nodes of an element and keeps it, unless it is a point.
  void add_element(std::int64_t type, std::int64_t tag, Index groups) {
    int const count = nodes_of_type(type);
    if (count == 0)
      in_.fail("element " + std::to_string(tag) + " is a " + type_name(type) +
               ": only elements of first order are read. Mesh with order 1 (Mesh.ElementOrder).");
    MeshElement e;
    e.kind = static_cast<ElementKind>(type);
    e.tag = tag;
    e.groups = groups;
    for (int k = 0; k < count; ++k) {
      std::int64_t const node = four_ ? in_.size() : in_.integer();
      auto const found = node_of_.find(node);
      if (found == node_of_.end())
        in_.fail("element " + std::to_string(tag) + " has a node " + std::to_string(node) + " that is not in $Nodes");
      e.node[static_cast<std::size_t>(k)] = found->second;
    }
    if (type != point_type) mesh_.elements.push_back(e);
  }

  GmshSource in_;
  ElementMesh mesh_;
  bool four_ = false;
  std::map<std::pair<std::int64_t, std::int64_t>, std::string> name_of_;  // (dimension, physical tag)
  std::map<std::pair<std::int64_t, std::int64_t>, Index> groups_of_;      // (dimension, entity or physical tag)
  std::unordered_map<std::int64_t, Index> node_of_;
};

}  // namespace

ElementMesh read_gmsh(std::string const& path) { return Reader(path).read(); }

}  // namespace brisance::solid
