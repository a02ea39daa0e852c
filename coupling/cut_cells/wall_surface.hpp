// The deformed boundary between the ranks that own the particles and the ranks whose blocks it cuts: triangles go out,
// vertex forces come back, vertex velocities follow (theory/coupling.md 1.6, 8.2).
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/solid/solid.hpp"
#include "core/solid/surface.hpp"
#include "coupling/geometry/cell_map.hpp"
#include "coupling/geometry/surface.hpp"
#include "fluid/flow.hpp"
#include "parallel/archive.hpp"

namespace brisance::coupling {

/// Force of the fluid on the three vertices of a triangle from the pieces of it in one cell, N.
struct CellForce {
  GlobalId triangle = 0, cell = 0;
  std::array<Vec3, 3> force{};
  Real area = 0;  ///< of these pieces, m2
};

/// What the area vector of a triangle (2D: a segment times `depth`) gains from half way to `after`, by the vertex that
/// moves, m2. The parts of one vertex add up to nothing over the triangles around it.
std::array<Vec3, 3> area_gained(int dimension, Real depth, std::array<Vec3, 3> const& before,
                                std::array<Vec3, 3> const& after);

/// The boundary whose areas bear a load: the present one, for good, or one of the two of a step that moves it.
enum class LoadOf { present, start, end };

class WallSurface {
 public:
  /// `margin`: cells around a block within which its rank needs the triangles.
  WallSurface(solid::Solid& solid, std::shared_ptr<solid::Surface const> surface, fluid::Flow& flow,
              parallel::Comm& comm, Index margin);

  solid::Surface const& topology() const { return *surface_; }
  /// The surface with more broken links, before the vertices are read from a checkpoint.
  void replace(std::shared_ptr<solid::Surface const> surface);
  /// The surface opens between two steps: vertices that part start from their common place in the record, those that
  /// were inside from the mean of their particles. Expects: `opened` was made from topology(); poses and half-step
  /// velocities of ghosts are current.
  void open(std::shared_ptr<solid::Surface const> opened);

  /// Vertices at the present positions of the particles become the record (start of a run).
  void start();
  /// A new step: vertices that lag behind their particles come nearer to them. Expects: poses of ghosts are current.
  void begin_step();
  /// Vertices at the present places of the particles. Expects: poses of ghosts are current.
  void place();
  /// Until the next call the arms of velocities are those of the present poses, those of centred loads the mean of
  /// these and of the poses at begin_step.
  void freeze_arms();
  /// `share` of the vertex velocities of a half step under the frozen arms, added to those of earlier sub-steps or, as
  /// the first, instead of them. Expects: half-step velocities of ghosts are current.
  void take_velocities(Real share = 1, bool first = true);
  /// The present velocities under the arms of begin_step: those of the boundary of record.
  void take_velocities_at_start();
  /// Largest distance along an axis, in cells, of a local vertex from where the particles are now; infinite when that
  /// is no number.
  Real away() const;
  /// The positions become the record.
  void accept();

  /// Collective. All triangles within reach of this rank's blocks, sorted by id.
  void send_triangles(std::vector<SurfaceTriangle>& received);
  /// The triangles of the record where nothing is new: as send_triangles would, without messages.
  void repeat_triangles(std::vector<SurfaceTriangle> const& record, std::vector<SurfaceTriangle>& received) const;
  /// Collective. The present vertex velocities, where they changed, into the same triangles; true if any came here.
  bool send_velocities(std::vector<SurfaceTriangle>& received);
  /// Collective. Conjugate load: `forces` of this rank's cells become forces and torques of particles; those on the
  /// areas at the start or end of the step as they are in its middle. The total force stays the same to round-off; the
  /// work differs by SurfaceTriangle::centring. Loads of the start stay those of the fluid until the boundary has
  /// turned: the difference, nothing in all, is SurfaceTriangle::turning.
  void apply(std::vector<CellForce> const& forces, LoadOf of);
  /// The pressure that the fluid gives beyond the loads, Pa.
  Real beyond_loads = 0;

  Real fastest_vertex(int direction) const;  ///< m/s, over local vertices
  bool moved() const;                        ///< any vertex whose predicted position differs from the record
  bool news() const;                         ///< any vertex that moved, or whose velocity is not the one last sent
  /// Record position of a local vertex whose prediction is farther than `bound` from it, or not a number.
  std::optional<Vec3> beyond(Vec3 const& bound) const;
  /// Predicted position of a local vertex that is closer to a periodic side of the domain than a sweep looks.
  std::optional<Vec3> near_periodic_side() const;
  /// The predicted positions become those of the record: the boundary rests in this step.
  void hold();

  /// Rows by vertex id of the vertices this rank keeps: record position, velocity, lag (9 columns).
  void write(parallel::ArchiveWriter& file) const;
  void read(parallel::ArchiveReader& file);
  void save() { saved_ = vertices_, saved_surface_ = surface_; }
  void restore() {
    if (surface_ != saved_surface_) replace(saved_surface_);
    vertices_ = saved_;
  }

 private:
  struct Vertex {
    GlobalId id = 0;
    Vec3 record, position, velocity;
    Vec3 working;        ///< the velocity under the arms of centred loads
    Vec3 told;           ///< the velocity that was last sent
    Vec3 lag;            ///< from the mean of its particles, after a break that moved this far; taken back in steps
    Real pressure = 0;   ///< mean over its triangles; 0 unless all of them bear a load, Pa
    bool bears = false;  ///< all of them do
    Index triangles = 0;
    Index first_member = 0, last_member = 0;
  };
  /// The part of a lag that is left after a step: a tenth of a cell at a time.
  Vec3 shortened(Vec3 const& lag) const;
  static std::span<Vec3> of(Vertex const& v, std::vector<Vec3>& members) {
    return std::span(members).subspan(static_cast<std::size_t>(v.first_member),
                                      static_cast<std::size_t>(v.last_member - v.first_member));
  }
  static Index find(std::vector<Vertex> const& vertices, GlobalId vertex);
  Index local(GlobalId vertex) const { return find(vertices_, vertex); }

  solid::Solid& solid_;
  std::shared_ptr<solid::Surface const> surface_, saved_surface_;
  fluid::Flow& flow_;
  parallel::Comm& comm_;
  std::vector<Vertex> vertices_, saved_;             ///< sorted by id
  std::vector<Index> member_;                        ///< local particles of the vertices
  std::vector<Vec3> arm_, arm_before_, arm_middle_;  ///< beside member_: at the end, start, middle of the step
  LoadOf load_of_ = LoadOf::present;
  /// An element of the surface that belongs to an owned particle, with the places of its vertices in vertices_.
  struct Triangle {
    std::size_t element = 0;
    GlobalId surface = 0;
    std::array<std::size_t, 3> vertex{};
    std::array<Vec3, 3> given{}, force{};  ///< what the fluid gives the corners, what the solid feels, N
    Real wetted = 0;                       ///< area of the pieces that bear a load, m2
    bool loaded = false;
    Real told = 0;  ///< the centring that was last sent
  };
  /// Collective. Loads of the pieces to the owners of their triangles, summed in the order of cells.
  void gather_forces(std::vector<CellForce> const& forces);
  /// Collective. A row for every corner of a loaded triangle, to all ranks that own a particle of the vertex; received
  /// by vertex and triangle.
  template <class Row>
  std::vector<Row> to_members(std::function<Row(Triangle const&, std::size_t)> const& row);
  /// Collective. The forces on the areas at an end of the step become those on the areas in its middle.
  void centre();
  /// Record and present positions of the vertices.
  std::array<std::array<Vec3, 3>, 2> places(Triangle const& t) const;
  /// What the work of the load on a triangle exceeds what the fluid gives with the velocity of the vertices, W/m2.
  Real centring(Triangle const& t) const;
  /// What the force on the area that a triangle now has exceeds that on its area at the start, per wetted area, Pa.
  Vec3 turning(Triangle const& t) const;
  std::vector<Triangle> triangles_;
  struct Reach {
    int rank;
    CellBox box;
  };
  std::vector<Reach> reach_;                                    ///< ranks with blocks and the box that holds these
  std::vector<std::pair<int, std::vector<std::size_t>>> sent_;  ///< rank, triangles (places in triangles_) last sent
};

}  // namespace brisance::coupling
