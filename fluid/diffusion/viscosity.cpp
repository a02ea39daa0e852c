#include "fluid/diffusion/viscosity.hpp"

#include <cmath>
#include <utility>

namespace brisance::fluid {
namespace {

/// mu / rho of a row of cells, m2/s; 0 in vacuum. Loops that compilers turn into vectors.
void kinematic_viscosity(std::array<Real const*, 5> const& u, Index n, Transport const& transport,
                         Real* __restrict__ out) {
  Real const vacuum_density = transport.gas.vacuum_density, vacuum_energy = transport.gas.vacuum_energy;
  Real const per_energy = transport.gas.kappa() / transport.gas.gas_constant;
  auto const fill = [&](auto const law) {
    for (Index i = 0; i < n; ++i) {
      Real const density = u[0][i], inverse = 1 / (density > vacuum_density ? density : 1.0);
      Real const twice = u[1][i] * u[1][i] + u[2][i] * u[2][i] + u[3][i] * u[3][i];
      Real const internal = u[4][i] - 0.5 * (twice * inverse);
      Real const there = internal > vacuum_energy ? 1.0 : 0.0;
      Real const full = density > vacuum_density ? there : 0.0;
      out[i] = full * (law(full * (per_energy * internal * inverse)) * inverse);
    }
  };
  if (transport.sutherland)
    fill(transport.law_sutherland);
  else
    fill(transport.law_constant);
}

}  // namespace

Real viscous_time_step(ViscosityConfig const& config, Transport const& transport, Grid const& grid, Real kinematic) {
  Real inverse_squares = 0;
  for (int d = 0; d < grid.dimension; ++d) inverse_squares += 1 / square(grid.spacing[d]);
  Real const rate = kinematic * transport.diffusivity_ratio * inverse_squares;
  return rate > 0 ? (config.time == "strang" ? 0.9 : 0.45) / rate : std::numeric_limits<Real>::infinity();
}

Real sub_cycled_limit(ViscosityConfig const& config, Real stable, Real others) {
  return stable < 0.5 * others ? config.max_substeps * stable : stable;
}

Viscosity::Viscosity(FlowConfig const& config, Flow& flow)
    : config_(*config.viscosity),
      flow_(flow),
      transport_(config_, flow.gas()),
      sides_(config, flow.gas(), flow.boundaries()),
      ghosts_(flow.grid(), flow.owners(), flow.blocks(), flow.boundaries(), flow.comm(), {1, true},
              [this](Block& block, int direction, int side, Real time, GhostRange const& range) {
                sides_.fill(block, direction, side, time, range);
              }),
      block_stage_(transport_, flow.grid()) {
  flow.keep_awake();  // these steps write into all cells
  if (config_.time == "strang")
    for (Block const& block : flow.blocks()) before_.emplace_back(BlockStage::before_size(block));
}

void Viscosity::join(Plan& plan) {
  plan.effect("fluid.viscosity", [this] { return bytes(); });
  if (config_.time == "strang") {
    for (Stage const half : {Stage::diffuse, Stage::diffuse_again})
      plan.at(half,
              [this](Clock const& clock) { advance(0.5 * clock.dt, substeps(clock.dt), clock.time + 0.5 * clock.dt); });
  } else {
    plan.at(Stage::diffuse_again,
            [this](Clock const& clock) { advance(clock.dt, substeps(clock.dt), clock.time + 0.5 * clock.dt); });
  }
  plan.limit(
      "fluid.viscous", [this](Clock const&) { return stable_step(); },
      [this](Real own, Real others) {
        stable_ = own;
        return walls_ ? own : sub_cycled_limit(config_, own, others);
      });
  plan.health([this](Clock const&) { return verdict_; });
  Plan::Keep keep;  // cells and ledger are the flow's
  keep.save = [] {};
  keep.restore = [this] { verdict_ = {}; };
  keep.write = [](parallel::ArchiveWriter&) {};
  keep.read = [](parallel::ArchiveReader&) {};
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

Real Viscosity::stable_step() const {
  Real largest = 0;  // kinematic viscosity
  std::vector<Real> row;
  for (Block const& block : std::as_const(flow_).blocks()) {
    auto const [nx, ny, nz] = block.size();
    CellIndex const first = block.first();
    bool const cut = volume_.cuts(block.id());
    row.resize(static_cast<std::size_t>(nx));
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j) {
        std::array<Real const*, 5> u;
        for (int q = 0; q < 5; ++q) u[static_cast<std::size_t>(q)] = block.component(q) + block.at(0, j, k);
        kinematic_viscosity(u, nx, transport_, row.data());
        for (Index i = 0; i < nx; ++i) {
          Real const nu = row[static_cast<std::size_t>(i)];
          if (!(nu > largest)) continue;
          if (!cut || volume_({first[0] + i, first[1] + j, first[2] + k}) > 0) largest = nu;
        }
      }
  }
  Real const stable = viscous_time_step(config_, transport_, flow_.grid(), largest);
  return walls_ ? share_at_walls * stable : stable;
}

int Viscosity::substeps(Real dt) const { return static_cast<int>(max(1, std::ceil(dt / stable_ * (1 - 1e-12)))); }

void Viscosity::advance(Real dt, int substeps, Real middle) {
  middle_ = middle;
  Real const tau = dt / substeps;
  for (int s = 0; s < substeps; ++s) {
    if (config_.time == "strang") {
      stage(tau, DiffusionStage::heun_first, 0.5 * tau);
      stage(tau, DiffusionStage::heun_second, 0.5 * tau);
    } else {
      stage(tau, DiffusionStage::euler, tau);
    }
  }
}

void Viscosity::exchange() {
  if (walls_) walls_->prepare();
  for (int d = 0; d < flow_.grid().dimension; ++d) {
    ghosts_.start(d, middle_);
    ghosts_.finish(d);
  }
}

void Viscosity::stage(Real tau, DiffusionStage stage, Real weight) {
  Grid const& grid = flow_.grid();
  exchange();
  std::vector<Block>& blocks = flow_.blocks();  // tells the flow that they change
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Block& block = blocks[b];
    std::array<bool, 6> sides{};
    for (int d = 0; d < grid.dimension; ++d)
      for (int side = 0; side < 2; ++side)
        sides[static_cast<std::size_t>(2 * d + side)] = grid.neighbour(block.id(), d, side) < 0;
    std::array<State, 6> through{};
    std::span<Real> const before = before_.empty() ? std::span<Real>() : std::span<Real>(before_[b]);
    FaceSink* const sink = walls_ && walls_->handles(block.id()) ? &walls_->sink(block.id(), weight) : nullptr;
    std::int64_t const inadmissible = block_stage_.run(block, tau, stage, before, sides, through, sink);
    if (sink) walls_->finish(block, stage == DiffusionStage::heun_second ? 0.5 * tau : tau);
    if (inadmissible > 0) locate(block);
    if (sink) continue;
    for (int s = 0; s < 6; ++s)
      if (sides[static_cast<std::size_t>(s)])
        flow_.ledger().add(s / 2, s % 2, weight, grid.face_area(s / 2), through[static_cast<std::size_t>(s)]);
  }
}

void Viscosity::locate(Block const& block) {
  if (!verdict_.good) return;
  auto const [nx, ny, nz] = block.size();
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) {
        State const u = block.load(i, j, k);
        Real const twice = 2 * u[0] * u[4] - (u[1] * u[1] + u[2] * u[2] + u[3] * u[3]);
        if (twice >= -2e-13 * std::abs(u[0] * u[4])) continue;
        CellIndex const c{block.first()[0] + i, block.first()[1] + j, block.first()[2] + k};
        if (volume_.cuts(block.id()) && volume_(c) < flow_.grid().cell_volume()) continue;
        Vec3 const x = flow_.grid().centre(c);
        verdict_ = {false, "negative internal energy after a viscous step in cell (" + std::to_string(c[0]) + ", " +
                               std::to_string(c[1]) + ", " + std::to_string(c[2]) + ") at (" + std::to_string(x.x) +
                               ", " + std::to_string(x.y) + ", " + std::to_string(x.z) + ") m, rank " +
                               std::to_string(flow_.comm().rank())};
        return;
      }
}

std::size_t Viscosity::bytes() const {
  std::size_t n = ghosts_.bytes() + block_stage_.bytes();
  for (std::vector<Real> const& b : before_) n += b.capacity() * sizeof(Real);
  return n;
}

}  // namespace brisance::fluid
