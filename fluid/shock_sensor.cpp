#include "fluid/shock_sensor.hpp"

#include <array>
#include <cmath>

namespace brisance::fluid {
namespace {

constexpr Index reach = 2;        // cells along d whose pressures a mark depends on
constexpr Real steep_jump = 0.5;  // of the smaller pressure
// Only shocks along the grid break up. A shock at an angle jumps along several directions: it is left alone from about
// 6 degrees on, because shear dissipation along it costs accuracy (20 % on a spherical blast).
constexpr Real oblique_jump = 0.1;  // of the jump along d
constexpr int pressure_tag = 8, mark_tag = 9;

/// rho c^2 / gamma: the pressure of an ideal gas, p + p_inf of a stiffened one; 0 in vacuum.
void pressure_row(Block const& block, Gas const& gas, Index j, Index k, Real* out) {
  std::ptrdiff_t const row = block.at(0, j, k);
  Real const *const rho = block.component(0) + row, *const mx = block.component(1) + row;
  Real const *const my = block.component(2) + row, *const mz = block.component(3) + row;
  Real const* const energy = block.component(4) + row;
  Index const n = block.size()[0];
  if (!gas.curve.zero()) {
    for (Index i = 0; i < n; ++i) {
      Real const c = gas.sound_speed({rho[i], mx[i], my[i], mz[i], energy[i]});
      out[i] = rho[i] * c * c / gas.gamma;
    }
    return;
  }
  Real const kappa = gas.kappa(), least_density = gas.vacuum_density, least_energy = gas.vacuum_energy;
  for (Index i = 0; i < n; ++i) {
    bool const some = rho[i] > least_density;
    Real const kinetic = 0.5 * (mx[i] * mx[i] + my[i] * my[i] + mz[i] * mz[i]) / (some ? rho[i] : 1.0);
    Real const internal = energy[i] - kinetic;
    out[i] = some && internal > least_energy ? kappa * internal : 0.0;
  }
}

/// p + p_inf of the gas beside the products; 0 in vacuum.
void pressure_row(Block const& block, Mixture const& mixture, Index j, Index k, Real* out) {
  for (Index i = 0; i < block.size()[0]; ++i) {
    MixtureState const x = block.load_mixture(i, j, k);
    out[i] = mixture.vacuum(x) ? 0 : max(mixture.pressure(x) + mixture.ambient.curve.stiffness, 0);
  }
}

/// Is the jump between two cells that of a shock? Never beside a cell without pressure (theory/fluid.md, trap T10).
inline bool steep(Real a, Real b) {
  Real const least = min(a, b);
  return std::fabs(a - b) > steep_jump * least && least > 0;
}

/// Largest jump, in parts of the smaller pressure, at the faces along one direction that a mark depends on.
Real largest_jump(Real const* p, std::ptrdiff_t step) {
  Real largest = 0;
  for (Index face = -1; face <= 2; ++face) {
    Real const a = p[(face - 1) * step], b = p[face * step], least = min(a, b);
    if (least > 0) largest = max(largest, std::fabs(a - b) / least);
  }
  return largest;
}

template <class T>
std::vector<CellLayer<T>> layers_of(std::vector<Block> const& blocks) {
  std::vector<CellLayer<T>> layers;
  for (Block const& block : blocks) layers.emplace_back(block, reach);
  return layers;
}

}  // namespace

ShockSensor::ShockSensor(Grid const& grid, std::vector<int> const& owner, std::vector<Block> const& blocks,
                         parallel::Comm& comm)
    : dimension_(grid.dimension),
      pressure_(layers_of<Real>(blocks)),
      marks_(layers_of<std::uint8_t>(blocks)),
      marked_(blocks.size(), 0),
      changed_(blocks.size(), 1),
      exchange_pressure_(grid, owner, blocks, reach, comm, pressure_tag),
      exchange_marks_(grid, owner, blocks, 1, comm, mark_tag) {}

void ShockSensor::update(std::vector<Block> const& blocks, Gas const& gas, Mixture const* mixture,
                         std::function<bool(Index)> const& has_walls, IsFluid const& is_fluid,
                         std::function<bool(std::size_t)> const& uniform) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    auto const [nx, ny, nz] = blocks[b].size();
    bool const walls = has_walls(blocks[b].id());
    changed_[b] = changed_[b] || walls;  // they move
    if (!changed_[b]) continue;
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j) {
        Real* const row = pressure_[b].at(0, j, k);
        if (mixture)
          pressure_row(blocks[b], *mixture, j, k, row);
        else
          pressure_row(blocks[b], gas, j, k, row);
        if (walls)
          for (Index i = 0; i < nx; ++i)
            if (!is_fluid(blocks[b], i, j, k)) row[i] = 0;
      }
  }
  // Beyond a side of the domain there is no pair: those ghosts keep their 0.
  exchange_pressure_.run(
      pressure_, [](CellLayer<Real>&, int, int) {}, [this](std::size_t b) { return changed_[b] != 0; });
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!marked_[b] && !changed_[b] && !exchange_pressure_.received(b)) continue;  // as it was: no marks
    if (marked_[b]) marks_[b].fill(0);
    marked_[b] = uniform(b) && !steep_at_ends(b) ? false : mark(b);
    changed_[b] = 0;
  }
  // A ghost beyond a side of the domain takes the mark of the cell beside it.
  auto const at_domain = [](CellLayer<std::uint8_t>& layer, int direction, int side) {
    auto const d = static_cast<std::size_t>(direction);
    CellIndex begin{0, 0, 0}, end = layer.size();
    begin[d] = side == 0 ? -1 : layer.size()[d];
    end[d] = begin[d] + 1;
    std::ptrdiff_t const inward = side == 0 ? layer.stride()[d] : -layer.stride()[d];
    for (Index k = begin[2]; k < end[2]; ++k)
      for (Index j = begin[1]; j < end[1]; ++j)
        for (Index i = begin[0]; i < end[0]; ++i) {
          std::uint8_t* const ghost = layer.at(i, j, k);
          *ghost = ghost[inward];
        }
  };
  // Ghosts that look at a block without marks are 0 already.
  exchange_marks_.run(marks_, at_domain, [this](std::size_t b) { return marked_[b] != 0; });
  for (std::size_t b = 0; b < blocks.size(); ++b)
    marked_[b] = marked_[b] || (exchange_marks_.received(b) && any(marks_[b]));
}

/// Is a face steep between or beside the ghosts? In a uniform block no other can be.
bool ShockSensor::steep_at_ends(std::size_t position) const {
  CellLayer<Real> const& p = pressure_[position];
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension_); ++d)
    for (int side = 0; side < 2; ++side) {
      CellIndex begin{0, 0, 0}, end = p.size();
      begin[d] = side == 0 ? -1 : p.size()[d];
      end[d] = begin[d] + 1;
      std::ptrdiff_t const inward = side == 0 ? p.stride()[d] : -p.stride()[d];
      for (Index k = begin[2]; k < end[2]; ++k)
        for (Index j = begin[1]; j < end[1]; ++j)
          for (Index i = begin[0]; i < end[0]; ++i) {
            Real const* const ghost = p.at(i, j, k);
            if (steep(*ghost, ghost[inward]) || steep(*ghost, ghost[-inward])) return true;
          }
    }
  return false;
}

/// Cell i is marked in d when one of the faces i-3/2 ... i+3/2 along d is steep: it or its neighbour along d is
/// shocked.
bool ShockSensor::mark(std::size_t position) {
  CellLayer<Real> const& p = pressure_[position];
  CellLayer<std::uint8_t>& marks = marks_[position];
  bool found = false;
  for (int direction = 0; direction < dimension_; ++direction) {
    auto const d = static_cast<std::size_t>(direction);
    auto const bit = static_cast<std::uint8_t>(1u << d);
    std::ptrdiff_t const step = p.stride()[d];
    // Low faces of the cells -1 ... n+1 along d.
    CellIndex extent = p.size();
    extent[d] += 3;
    CellIndex const first{d == 0 ? -1 : 0, d == 1 ? -1 : 0, d == 2 ? -1 : 0};
    steep_.resize(static_cast<std::size_t>(extent[0]) * static_cast<std::size_t>(extent[1] * extent[2]));
    std::uint8_t any = 0;
    std::uint8_t* out = steep_.data();
    std::vector<std::uint8_t> row_is_steep;
    row_is_steep.reserve(static_cast<std::size_t>(extent[1] * extent[2]));
    for (Index k = 0; k < extent[2]; ++k)
      for (Index j = 0; j < extent[1]; ++j, out += extent[0]) {
        Real const* const row = p.at(first[0], first[1] + j, first[2] + k);
        std::uint8_t some = 0;
        for (Index i = 0; i < extent[0]; ++i) {
          out[i] = steep(row[i - step], row[i]);
          some = static_cast<std::uint8_t>(some | out[i]);
        }
        any = static_cast<std::uint8_t>(any | some);
        row_is_steep.push_back(some);
      }
    if (!any) continue;
    std::ptrdiff_t const face_step = d == 0 ? 1 : d == 1 ? extent[0] : std::ptrdiff_t{extent[0]} * extent[1];
    std::ptrdiff_t const row_step = d == 0 ? 0 : d == 1 ? 1 : extent[1];
    for (Index k = 0; k < p.size()[2]; ++k)
      for (Index j = 0; j < p.size()[1]; ++j) {
        std::uint8_t const* const steep_row = row_is_steep.data() + (j + std::ptrdiff_t{extent[1]} * k);
        if (!(steep_row[0] | steep_row[row_step] | steep_row[2 * row_step] | steep_row[3 * row_step])) continue;
        std::uint8_t const* const face =
            steep_.data() + std::ptrdiff_t{extent[0]} * (j + std::ptrdiff_t{extent[1]} * k);
        std::uint8_t* const row = marks.at(0, j, k);
        for (Index i = 0; i < p.size()[0]; ++i) {
          bool const near = face[i] | face[i + face_step] | face[i + 2 * face_step] | face[i + 3 * face_step];
          if (near) row[i] |= bit, found = true;
        }
      }
  }
  return found && drop_oblique(position);
}

bool ShockSensor::drop_oblique(std::size_t position) {
  CellLayer<Real> const& p = pressure_[position];
  CellLayer<std::uint8_t>& marks = marks_[position];
  auto const dimension = static_cast<std::size_t>(dimension_);
  bool left = false;
  for (Index k = 0; k < p.size()[2]; ++k)
    for (Index j = 0; j < p.size()[1]; ++j)
      for (Index i = 0; i < p.size()[0]; ++i) {
        std::uint8_t& mark = *marks.at(i, j, k);
        if (mark == 0) continue;
        std::array<Real, 3> jump{};
        for (std::size_t d = 0; d < dimension; ++d) jump[d] = largest_jump(p.at(i, j, k), p.stride()[d]);
        for (std::size_t d = 0; d < dimension; ++d)
          for (std::size_t e = 0; e < dimension; ++e)
            if (e != d && !(jump[e] < oblique_jump * jump[d])) mark = static_cast<std::uint8_t>(mark & ~(1u << d));
        left = left || mark != 0;
      }
  return left;
}

bool ShockSensor::any(CellLayer<std::uint8_t> const& layer) const {
  // Ghosts only: the cells have been counted.
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension_); ++d)
    for (int side = 0; side < 2; ++side) {
      CellIndex begin{0, 0, 0}, end = layer.size();
      begin[d] = side == 0 ? -1 : layer.size()[d];
      end[d] = begin[d] + 1;
      for (Index k = begin[2]; k < end[2]; ++k)
        for (Index j = begin[1]; j < end[1]; ++j)
          for (Index i = begin[0]; i < end[0]; ++i)
            if (*layer.at(i, j, k)) return true;
    }
  return false;
}

std::size_t ShockSensor::bytes() const {
  std::size_t n = steep_.capacity() + exchange_pressure_.bytes() + exchange_marks_.bytes();
  for (auto const& layer : pressure_) n += layer.bytes();
  for (auto const& layer : marks_) n += layer.bytes();
  return n;
}

}  // namespace brisance::fluid
