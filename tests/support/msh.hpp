// Writes .msh files of the formats 2.2 and 4.1, ASCII and binary, for tests of their reader.
#pragma once
#include <unistd.h>
#include <cstdint>
#include <cstdio>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/vec3.hpp"

namespace brisance::testing {

/// Writes a file below the folder that tests run in; returns its path.
inline std::string temporary_file(std::string const& name, std::string const& content) {
  std::filesystem::create_directories("test-files");
  std::string const path = "test-files/" + name;
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

/// A mesh to be written. Node k has the tag k + 1 + `node_shift`, element k the tag k + 1.
struct Msh {
  struct Element {
    int type = 4, dimension = 3, physical = 0;  ///< 0: in no physical group
    std::vector<int> nodes;                     ///< from 0
  };
  std::vector<Vec3> nodes;
  std::vector<Element> elements;
  std::map<std::pair<int, int>, std::string> names;  ///< (dimension, physical tag)
  int node_shift = 0;

  void add(int type, int dimension, int physical, std::vector<int> n) {
    elements.push_back({type, dimension, physical, n});
  }

  std::string write(std::string const& name, char const* version, bool binary, bool swapped = false) const {
    Out out{{}, binary, swapped};
    out.text("$MeshFormat\n" + std::string(version) + (binary ? " 1 8\n" : " 0 8\n"));
    if (binary) out.number(std::int32_t{1}), out.text("\n");
    out.text("$EndMeshFormat\n");
    if (!names.empty()) {
      out.text("$PhysicalNames\n" + std::to_string(names.size()) + "\n");
      for (auto const& [key, n] : names)
        out.text(std::to_string(key.first) + " " + std::to_string(key.second) + " \"" + n + "\"\n");
      out.text("$EndPhysicalNames\n");
    }
    if (std::string(version) == "2.2")
      body_2(out);
    else
      body_4(out);
    return temporary_file(name + ".msh", out.stream.str());
  }

 private:
  struct Out {
    std::ostringstream stream;
    bool binary, swapped;
    void text(std::string const& s) { stream << s; }
    template <class T>
    void number(T value) {
      if (!binary) {
        char s[40];
        if constexpr (std::is_floating_point_v<T>)
          std::snprintf(s, sizeof s, "%.17g ", value);
        else
          std::snprintf(s, sizeof s, "%lld ", static_cast<long long>(value));
        stream << s;
        return;
      }
      char raw[sizeof(T)];
      std::memcpy(raw, &value, sizeof(T));
      if (swapped) std::reverse(raw, raw + sizeof(T));
      stream.write(raw, sizeof(T));
    }
    void integer(long long i) { number(static_cast<std::int32_t>(i)); }
    void size(long long i) { number(static_cast<std::int64_t>(i)); }
    void line() {
      if (!binary) stream << "\n";
    }
  };

  int tag(int node) const { return node + 1 + node_shift; }
  void place(Out& out, Vec3 const& x) const { out.number(x.x), out.number(x.y), out.number(x.z); }

  void body_2(Out& out) const {
    out.text("$Nodes\n" + std::to_string(nodes.size()) + "\n");
    for (std::size_t n = 0; n < nodes.size(); ++n)
      out.integer(tag(static_cast<int>(n))), place(out, nodes[n]), out.line();
    out.text("\n$EndNodes\n$Elements\n" + std::to_string(elements.size()) + "\n");
    for (std::size_t k = 0; k < elements.size(); ++k) {
      Element const& e = elements[k];
      if (out.binary)
        out.integer(e.type), out.integer(1), out.integer(2), out.integer(static_cast<int>(k) + 1);
      else
        out.integer(static_cast<int>(k) + 1), out.integer(e.type), out.integer(2);
      out.integer(e.physical), out.integer(1);
      for (int n : e.nodes) out.integer(tag(n));
      out.line();
    }
    out.text("\n$EndElements\n");
  }

  /// Entities: one of each dimension and physical group, its tag 10 + the physical tag.
  void body_4(Out& out) const {
    std::array<std::set<int>, 4> physical;
    for (Element const& e : elements) physical[static_cast<std::size_t>(e.dimension)].insert(e.physical);
    out.text("$Entities\n");
    for (auto const& p : physical) out.size(static_cast<long long>(p.size()));
    out.line();
    for (std::size_t d = 0; d < 4; ++d)
      for (int p : physical[d]) {
        out.integer(10 + p);
        for (int c = 0; c < (d == 0 ? 3 : 6); ++c) out.number(0.5);
        out.size(p != 0);
        if (p != 0) out.integer(p);
        if (d > 0) out.size(2), out.integer(3), out.integer(-4);
        out.line();
      }
    out.text("\n$EndEntities\n$Nodes\n");
    // Two blocks, the second with parametric coordinates on a surface.
    long long const n = static_cast<long long>(nodes.size()), half = n / 2;
    out.size(2), out.size(n), out.size(tag(0)), out.size(tag(static_cast<int>(n) - 1)), out.line();
    for (int block = 0; block < 2; ++block) {
      long long const from = block == 0 ? 0 : half, to = block == 0 ? half : n;
      out.integer(block == 0 ? 3 : 2), out.integer(10), out.integer(block), out.size(to - from), out.line();
      for (long long k = from; k < to; ++k) out.size(tag(static_cast<int>(k))), out.line();
      for (long long k = from; k < to; ++k) {
        place(out, nodes[static_cast<std::size_t>(k)]);
        if (block == 1) out.number(0.25), out.number(0.75);
        out.line();
      }
    }
    out.text("\n$EndNodes\n$Elements\n");
    out.size(static_cast<long long>(elements.size())), out.size(static_cast<long long>(elements.size()));
    out.size(1), out.size(static_cast<long long>(elements.size())), out.line();
    for (std::size_t k = 0; k < elements.size(); ++k) {
      Element const& e = elements[k];
      out.integer(e.dimension), out.integer(10 + e.physical), out.integer(e.type), out.size(1), out.line();
      out.size(static_cast<long long>(k) + 1);
      for (int m : e.nodes) out.size(tag(m));
      out.line();
    }
    out.text("\n$EndElements\n");
  }
};

/// Nodes of a grid of unit cells, x fastest; `at(i, j, k)` numbers them.
struct Grid {
  int nx, ny, nz;
  int at(int i, int j, int k) const { return i + (nx + 1) * (j + (ny + 1) * k); }
  std::vector<Vec3> nodes(Vec3 const& h = {1, 1, 1}) const {
    std::vector<Vec3> all;
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) all.push_back({h.x * i, h.y * j, h.z * k});
    return all;
  }
  std::vector<int> corners(int i, int j, int k) const {
    return {at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
            at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
  }
};

/// Bricks of 1 x 1 x 1, each cut into six tetrahedra about its diagonal (Kuhn), or kept as hexahedra; physical volume 1
/// "rod"; physical surfaces 2 "left" and 3 "right" at the ends along x.
inline Msh brick_mesh(Grid const& grid, bool tetrahedra, Vec3 const& h = {1, 1, 1}) {
  Msh m;
  m.nodes = grid.nodes(h);
  m.names = {{{3, 1}, "rod"}, {{2, 2}, "left"}, {{2, 3}, "right"}};
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        auto const c = grid.corners(i, j, k);
        if (!tetrahedra) {
          m.add(5, 3, 1, c);
          continue;
        }
        // Paths of the cube from corner 0 to corner 6.
        for (auto const& [a, b] : std::vector<std::pair<int, int>>{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})
          m.add(4, 3, 1, {c[0], c[static_cast<std::size_t>(a)], c[static_cast<std::size_t>(b)], c[6]});
      }
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j) {
      auto const a = grid.corners(0, j, k), b = grid.corners(grid.nx - 1, j, k);
      if (tetrahedra) {
        m.add(2, 2, 2, {a[0], a[3], a[7]}), m.add(2, 2, 2, {a[0], a[7], a[4]});
        m.add(2, 2, 3, {b[1], b[2], b[6]}), m.add(2, 2, 3, {b[1], b[6], b[5]});
      } else {
        m.add(3, 2, 2, {a[0], a[3], a[7], a[4]});
        m.add(3, 2, 3, {b[1], b[2], b[6], b[5]});
      }
    }
  return m;
}

}  // namespace brisance::testing
