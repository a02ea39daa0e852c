// Packing, dealing anew and unpacking changes no bit of what follows.
#include <gtest/gtest.h>

#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

TEST(SolidRestart, GoesOnWithTheSameBitsUnderAnotherDealing) {
  SolidConfig config = testing::one_material(1, 1, 0.3);
  config.body.push_back(testing::box({0, 0, 0}, {4, 3, 2}, {4, 3, 2}));
  config.body[0].spin = {0.02, 0.01, 0.05};
  config.body[0].prescribed.push_back({{0, 0, 0}, {1, 3, 2}, {0.01, 0, 0}});
  Mesh const mesh = build_mesh(config, 3);
  parallel::Comm& comm = testing::comm();
  Real const dt = 0.2;
  auto digest = [&](Solid const& s) {
    parallel::Digest d;
    s.digest(d);
    comm.sum(d);
    return d;
  };

  Solid through(mesh, config, testing::slices(mesh, comm.size()), comm, 3);
  through.load()[0].force = {1e-3, 0, 0};
  for (int n = 0; n < 20; ++n) through.step(dt);

  parallel::Bytes mine;
  auto const rows = through.pack();
  for (std::size_t r = 0; r < through.owned_ids().size(); ++r) {
    parallel::put(mine, through.owned_ids()[r]);
    for (std::size_t c = 0; c < Solid::row_size; ++c) parallel::put(mine, rows[r * Solid::row_size + c]);
  }
  std::vector<GlobalId> ids;
  std::vector<double> all;
  for (parallel::Bytes const& part : comm.all_gather(mine)) {
    std::span<std::byte const> in = part;
    while (!in.empty()) {
      ids.push_back(parallel::take<GlobalId>(in));
      for (int c = 0; c < Solid::row_size; ++c) all.push_back(parallel::take<double>(in));
    }
  }
  std::vector<int> other;
  for (GlobalId p = 0; p < mesh.size(); ++p) other.push_back(static_cast<int>((p + 1) % comm.size()));
  Solid again(mesh, config, other, comm, 3);
  EXPECT_FALSE(digest(again) == digest(through));
  again.unpack(ids, all);
  again.exchange_pose();
  again.compute_forces();
  EXPECT_EQ(digest(again), digest(through));

  for (int n = 0; n < 20; ++n) {
    through.step(dt);
    again.step(dt);
  }
  EXPECT_EQ(digest(again), digest(through));
}

}  // namespace
}  // namespace brisance::solid
