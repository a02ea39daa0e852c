#include "coupling/geometry/face_parts.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::coupling {
namespace {

constexpr Real tolerance = 1e-9;  ///< of a face: beyond it the ends do not make up the aperture

/// A place on the face, in grid units from its low corner.
struct Place {
  Real u, v;
  friend bool operator==(Place const&, Place const&) = default;
  friend auto operator<=>(Place const&, Place const&) = default;
};

/// Where pieces end on an edge of a 2D cell: intervals between them.
bool open_intervals(Geometry const& g, CutCell const& cell, int d, int side, Real aperture,
                    std::vector<FacePart>& parts) {
  struct End {
    Real at;
    int sign;  ///< +1: the fluid is above
    Index piece;
  };
  int const t = 1 - d;
  Real const base = cell.cell[static_cast<std::size_t>(t)];
  Real const plane = cell.cell[static_cast<std::size_t>(d)] + side;
  std::vector<End> ends;
  for (Index f = cell.first_piece; f < cell.last_piece; ++f) {
    auto const corners = g.corners_of(g.pieces[static_cast<std::size_t>(f)]);
    for (int e = 0; e < 2; ++e) {
      Vec3 const& x = corners[static_cast<std::size_t>(e)].point;
      // The fluid is on the right of a piece, whichever end it has in the plane.
      if (x[d] == plane) ends.push_back({x[t] - base, (e + side + d) % 2 == 1 ? 1 : -1, f});
    }
  }
  std::sort(ends.begin(), ends.end(), [](End const& a, End const& b) {
    return a.at != b.at ? a.at < b.at : a.piece != b.piece ? a.piece < b.piece : a.sign < b.sign;
  });
  auto const corner = [&](int end) { return 1u << (d == 0 ? side + 2 * end : end + 2 * side); };
  parts.clear();
  bool open = aperture > 0.5, first = true;
  Real from = 0;
  FacePart part;
  part.corners = corner(0);
  for (std::size_t i = 0, next = 0; i < ends.size(); i = next) {
    int net = 0;
    for (next = i; next < ends.size() && ends[next].at == ends[i].at; ++next) net += ends[next].sign;
    if (net == 0) continue;  // a corner of the wall that only touches the plane
    if (std::abs(net) > 1) return false;
    if (first) open = net < 0;
    first = false;
    if (open != (net < 0)) return false;
    if (open) {
      part.area = ends[i].at - from;
      for (std::size_t e = i; e < next; ++e) part.pieces.push_back(ends[e].piece);
      parts.push_back(std::move(part));
      part = {};
    } else {
      from = ends[i].at;
      part = {};
      for (std::size_t e = i; e < next; ++e) part.pieces.push_back(ends[e].piece);
    }
    open = !open;
  }
  if (open) {
    part.area = 1 - from;
    part.corners |= corner(1);
    parts.push_back(std::move(part));
  }
  return true;
}

/// A closed outline, its points in order with the fluid on the left.
struct Outline {
  FacePart part;
  std::vector<Place> points;
};

Real enclosed(std::vector<Place> const& p) {
  Real sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    sum += (p[i].u - p[0].u) * (p[i + 1].v - p[0].v) - (p[i + 1].u - p[0].u) * (p[i].v - p[0].v);
  return 0.5 * sum;
}

bool surrounds(std::vector<Place> const& p, Place const& x) {
  bool inside = false;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    if ((p[i].v > x.v) != (p[j].v > x.v) && x.u < p[i].u + (x.v - p[i].v) / (p[j].v - p[i].v) * (p[j].u - p[i].u))
      inside = !inside;
  return inside;
}

/// Distance from the low corner along the rim of the unit square, counter-clockwise; negative inside.
Real along_rim(Place const& p) {
  if (p.v == 0) return p.u;
  if (p.u == 1) return 1 + p.v;
  if (p.v == 1) return 3 - p.u;
  if (p.u == 0) return 4 - p.v;
  return -1;
}
constexpr std::array<Place, 4> rim{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// Edges that the pieces leave in the plane of a face, joined to outlines (Green's theorem gives their areas).
class Outlines {
 public:
  Outlines(Geometry const& g, CutCell const& cell, int d, int side) : d_(d), side_(side) {
    auto const plane = static_cast<Real>(cell.cell[static_cast<std::size_t>(d)] + side);
    int const du = (d + 1) % 3, dv = (d + 2) % 3;
    auto const place = [&](Vec3 const& x) {
      return Place{x[du] - cell.cell[static_cast<std::size_t>(du)], x[dv] - cell.cell[static_cast<std::size_t>(dv)]};
    };
    for (Index f = cell.first_piece; f < cell.last_piece; ++f) {
      auto const corners = g.corners_of(g.pieces[static_cast<std::size_t>(f)]);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        Vec3 const &a = corners[i].point, &b = corners[i + 1 == corners.size() ? 0 : i + 1].point;
        if (a[d] != plane || b[d] != plane || a == b) continue;
        // Seen from the high side; the outline of a piece runs counter-clockwise seen from the fluid.
        edges_.push_back(side == 1 ? Edge{place(a), place(b), f} : Edge{place(b), place(a), f});
      }
    }
    std::sort(edges_.begin(), edges_.end(), [](Edge const& x, Edge const& y) {
      return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.piece < y.piece;
    });
  }

  bool join(Real aperture, std::vector<FacePart>& parts) {
    drop_opposite();
    if (!link() || !close()) return false;
    return deliver(aperture, parts);
  }

 private:
  struct Edge {
    Place a, b;
    Index piece;
    std::size_t next = none;
    bool entered = false, used = false;
  };
  struct Chain {
    std::size_t first, last;  ///< edges
    Real from, to;            ///< along the rim
    bool used = false;
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// A ridge that only touches the plane leaves each of its edges twice.
  void drop_opposite() {
    std::vector<bool> gone(edges_.size(), false);
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (std::size_t j = i + 1; j < edges_.size() && !gone[i]; ++j)
        if (!gone[j] && edges_[i].a == edges_[j].b && edges_[i].b == edges_[j].a) gone[i] = gone[j] = true;
    std::vector<Edge> left;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (!gone[i]) left.push_back(edges_[i]);
    edges_ = std::move(left);
  }

  bool link() {
    for (Edge& e : edges_)
      for (std::size_t j = 0; j < edges_.size(); ++j) {
        if (!(edges_[j].a == e.b)) continue;
        if (e.next != none || edges_[j].entered) return false;  // outlines that touch
        e.next = j;
        edges_[j].entered = true;
      }
    return true;
  }

  void follow(std::size_t first, Outline& outline, std::size_t& last) {
    for (std::size_t e = first;; e = edges_[e].next) {
      edges_[e].used = true;
      outline.points.push_back(edges_[e].a);
      outline.part.pieces.push_back(edges_[e].piece);
      last = e;
      if (edges_[e].next == none || edges_[e].next == first) return;
    }
  }

  bool close() {
    std::vector<Chain> chains;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (edges_[i].entered) continue;
      std::size_t last = i;
      while (edges_[last].next != none) last = edges_[last].next;
      Chain const c{i, last, along_rim(edges_[i].a), along_rim(edges_[last].b)};
      if (c.from < 0 || c.to < 0) return false;
      chains.push_back(c);
    }
    reaches_rim_ = !chains.empty();
    for (std::size_t start = 0; start < chains.size(); ++start) {
      if (chains[start].used) continue;
      Outline outline;
      for (std::size_t c = start;;) {
        if (chains[c].used) return false;
        chains[c].used = true;
        std::size_t last = none;
        follow(chains[c].first, outline, last);
        outline.points.push_back(edges_[last].b);
        std::size_t next = none;  // along the rim, the open side on the left, to where the next chain begins
        Real nearest = 5;
        for (std::size_t k = 0; k < chains.size(); ++k) {
          Real way = chains[k].from - chains[c].to;
          if (way < 0) way += 4;
          if (way < nearest) nearest = way, next = k;
        }
        for (int k = 0; k < 8; ++k)
          if (k >= chains[c].to && k <= chains[c].to + nearest) {
            outline.points.push_back(rim[static_cast<std::size_t>(k % 4)]);
            outline.part.corners |= corner(k % 4);
          }
        if (next == start) break;
        c = next;
      }
      outlines_.push_back(std::move(outline));
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (edges_[i].used) continue;
      Outline outline;
      std::size_t last = none;
      follow(i, outline, last);
      outlines_.push_back(std::move(outline));
    }
    return true;
  }

  bool deliver(Real aperture, std::vector<FacePart>& parts) {
    Real sum = 0;
    for (Outline& o : outlines_) sum += o.part.area = enclosed(o.points);
    if (!reaches_rim_ && aperture - sum > 0.5) {
      Outline whole;
      whole.points.assign(rim.begin(), rim.end());
      whole.part.area = 1;
      for (int k = 0; k < 4; ++k) whole.part.corners |= corner(k);
      outlines_.insert(outlines_.begin(), whole);
    }
    parts.clear();
    std::vector<std::size_t> filled;
    for (std::size_t o = 0; o < outlines_.size(); ++o)
      if (outlines_[o].part.area > 0) filled.push_back(o), parts.push_back(outlines_[o].part);
    for (Outline const& hole : outlines_) {
      if (hole.part.area > 0) continue;
      std::size_t in = filled.size() == 1 ? 0 : none;
      for (std::size_t k = 0; k < filled.size() && in == none; ++k)
        if (surrounds(outlines_[filled[k]].points, hole.points.front())) in = k;
      if (in == none) {
        if (hole.part.area > -tolerance) continue;
        return false;
      }
      parts[in].area += hole.part.area;
      parts[in].pieces.insert(parts[in].pieces.end(), hole.part.pieces.begin(), hole.part.pieces.end());
      parts[in].corners |= hole.part.corners;
    }
    return true;
  }

  /// Bit of a corner of the cell, from its place on the rim of the face.
  unsigned corner(int k) const {
    std::array<int, 3> x{};
    x[static_cast<std::size_t>(d_)] = side_;
    x[static_cast<std::size_t>((d_ + 1) % 3)] = k == 1 || k == 2;
    x[static_cast<std::size_t>((d_ + 2) % 3)] = k >= 2;
    return 1u << (x[0] + 2 * x[1] + 4 * x[2]);
  }

  int d_, side_;
  std::vector<Edge> edges_;
  std::vector<Outline> outlines_;
  bool reaches_rim_ = false;
};

}  // namespace

bool open_parts(Lattice const& lattice, Geometry const& geometry, CutCell const& cell, int d, int side,
                std::vector<FacePart>& parts) {
  Real const aperture =
      cell.aperture[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)] / lattice.face_area(d);
  if (lattice.dimension == 2) {
    if (!open_intervals(geometry, cell, d, side, aperture, parts)) return false;
  } else {
    if (!Outlines(geometry, cell, d, side).join(aperture, parts)) return false;
  }
  Real sum = 0;
  std::size_t largest = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    sum += parts[p].area;
    if (parts[p].area > parts[largest].area) largest = p;
  }
  if (!(std::abs(sum - aperture) <= tolerance)) return false;
  if (parts.empty()) return true;
  // The components make up the aperture to the last bit.
  Real rest = aperture;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (p != largest) rest -= parts[p].area;
  parts[largest].area = rest;
  return true;
}

}  // namespace brisance::coupling
