#include "core/solid/meshes/surface_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/solid/meshes/element_mesh.hpp"
#include "core/solid/meshes/node_buckets.hpp"

namespace brisance::solid {
namespace {

std::string read_text(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (!file.is_open() || file.bad()) mesh_error(path, 0, std::string("cannot be read: ") + std::strerror(errno));
  return std::move(text).str();
}

/// Words of a text with the line they stand in; '#' begins a comment when asked for.
class Words {
 public:
  Words(std::string const& path, std::string const& text, bool comments)
      : path_(path), text_(text), comments_(comments) {}
  std::string next() {
    while (at_ < text_.size() && (blank(text_[at_]) || (comments_ && text_[at_] == '#'))) {
      if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ < text_.size() && text_[at_] == '\n') ++line_;
      ++at_;
    }
    std::size_t const from = at_;
    while (at_ < text_.size() && !blank(text_[at_])) ++at_;
    return text_.substr(from, std::min(at_, text_.size()) - from);
  }
  Real real() {
    std::string const w = next();
    Real value = 0;
    char const* const from = w.c_str() + (w.starts_with('+') ? 1 : 0);
    auto const [end, error] = std::from_chars(from, w.c_str() + w.size(), value);
    if (error != std::errc() || end != w.c_str() + w.size() || !std::isfinite(value)) fail("a number", w);
    return value;
  }
  std::int64_t integer() {
    std::string const w = next();
    std::int64_t value = 0;
    auto const [end, error] = std::from_chars(w.c_str(), w.c_str() + w.size(), value);
    if (error != std::errc() || end != w.c_str() + w.size()) fail("an integer", w);
    return value;
  }
  /// The rest of the line: colours of OFF, names of STL.
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  [[noreturn]] void fail(std::string const& expected, std::string const& found) const {
    mesh_error(path_, line_,
               found.empty() ? "the file ends too early: expected " + expected
                             : "expected " + expected + " and found \"" + found.substr(0, 40) + "\"");
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  std::string const& path_;
  std::string const& text_;
  bool comments_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::vector<Vec3> ascii_corners(std::string const& path, std::string const& text) {
  Words words(path, text, false);
  words.next();  // solid
  words.skip_line();
  std::vector<Vec3> corners;
  for (std::string w = words.next(); !w.empty(); w = words.next()) {
    if (w == "vertex") {
      Real const x = words.real(), y = words.real(), z = words.real();
      corners.push_back({x, y, z});
    } else if (w == "endfacet" && corners.size() % 3 != 0) {
      words.fail("three vertices a facet", w);
    } else if (w == "endsolid" || w == "solid") {
      words.skip_line();
    } else if (w == "normal") {
      for (int d = 0; d < 3; ++d) words.next();  // the order of the corners tells the same
    } else if (w != "facet" && w != "outer" && w != "loop" && w != "endloop" && w != "endfacet") {
      words.fail("a word of an STL facet", w);
    }
  }
  if (corners.size() % 3 != 0) words.fail("three vertices a facet", "");
  return corners;
}

std::vector<Vec3> binary_corners(std::string const& path, std::string const& text, std::uint32_t count) {
  constexpr std::size_t header = 84, record = 50;
  std::vector<Vec3> corners;
  for (std::uint32_t f = 0; f < count; ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<float, 3> x;
      std::memcpy(x.data(), text.data() + header + record * f + 12 + 12 * c, 12);
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        mesh_error(path, 0, "facet " + std::to_string(f + 1) + " has a vertex that is no number");
      corners.push_back({x[0], x[1], x[2]});
    }
  return corners;
}

}  // namespace

void weld(std::vector<Vec3> const& corners, TriangleSurface& surface) {
  Vec3 low = corners[0], high = low;
  for (Vec3 const& x : corners)
    for (int d = 0; d < 3; ++d) low[d] = min(low[d], x[d]), high[d] = max(high[d], x[d]);
  Real const near = 1e-7 * norm(high - low);
  NodeBuckets buckets(corners, max(4 * near, 1e-300));
  std::vector<Index> vertex(corners.size(), -1);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    Index first = -1;
    buckets.each_near(corners[c], near, [&](Index other) {
      if (norm(corners[static_cast<std::size_t>(other)] - corners[c]) <= near && (first < 0 || other < first))
        first = other;
    });
    if (first >= 0) {
      vertex[c] = vertex[static_cast<std::size_t>(first)];
      continue;
    }
    vertex[c] = static_cast<Index>(surface.vertices.size());
    surface.vertices.push_back(corners[c]);
    buckets.add(static_cast<Index>(c));
  }
  for (std::size_t f = 0; f < corners.size() / 3; ++f) {
    Index const a = vertex[3 * f], b = vertex[3 * f + 1], c = vertex[3 * f + 2];
    if (a == b || b == c || c == a) continue;
    surface.facets.push_back({a, b, c});
    surface.number.push_back(static_cast<std::int64_t>(f) + 1);
  }
}

TriangleSurface read_stl(std::string const& path) {
  std::string const text = read_text(path);
  TriangleSurface surface;
  surface.path = path;
  // Some binary files begin with "solid" too: the size tells.
  std::uint32_t count = 0;
  if (text.size() >= 84) std::memcpy(&count, text.data() + 80, 4);
  bool const sized = text.size() >= 84 && text.size() == 84 + 50 * static_cast<std::size_t>(count);
  if (!sized && !text.starts_with("solid"))
    mesh_error(path, 0,
               text.size() < 84 ? "is neither ASCII nor binary STL: it is too short"
                                : "is no ASCII STL, and a binary one of " + std::to_string(count) + " facets has " +
                                      std::to_string(84 + 50 * static_cast<std::size_t>(count)) + " bytes, not " +
                                      std::to_string(text.size()));
  auto const corners = sized ? binary_corners(path, text, count) : ascii_corners(path, text);
  if (corners.empty()) mesh_error(path, 0, "has no facets");
  weld(corners, surface);
  return surface;
}

TriangleSurface read_off(std::string const& path) {
  std::string const text = read_text(path);
  TriangleSurface surface;
  surface.path = path;
  Words words(path, text, true);
  if (std::string const w = words.next(); w != "OFF") words.fail("OFF", w);
  std::int64_t const vertices = words.integer(), faces = words.integer();
  words.integer();
  if (vertices < 4 || faces < 4 || vertices + faces > static_cast<std::int64_t>(text.size()))
    mesh_error(path, 0,
               "a closed surface of " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                   " faces is not possible");
  for (std::int64_t v = 0; v < vertices; ++v) {
    Real const x = words.real(), y = words.real(), z = words.real();
    surface.vertices.push_back({x, y, z});
  }
  for (std::int64_t f = 0; f < faces; ++f) {
    std::int64_t const n = words.integer();
    if (n < 3) words.fail("three corners or more", std::to_string(n));
    std::vector<Index> loop;
    for (std::int64_t k = 0; k < n; ++k) {
      std::int64_t const v = words.integer();
      if (v < 0 || v >= vertices)
        mesh_error(path, 0,
                   "face " + std::to_string(f + 1) + " has a vertex " + std::to_string(v) + " that is not there");
      loop.push_back(static_cast<Index>(v));
    }
    words.skip_line();
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      surface.facets.push_back({loop[0], loop[k], loop[k + 1]});
      surface.number.push_back(f + 1);
    }
  }
  return surface;
}

}  // namespace brisance::solid
