#include "core/solid/links/link_law.hpp"

#include <gtest/gtest.h>

#include "core/solid/links/link_store.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

LinkRest<double> some_rest(testing::Random& random) {
  auto triple = [&] { return Triple<double>{random(), random(), random()}; };
  LinkRest<double> r{2 + random(), 0.5 + 0.2 * random(), triple(), triple(), triple(), {}};
  for (double& c : r.bending) c = random();
  return r;
}

TEST(LinkLaw, PacksGiveTheBitsOfDoublesInEveryLane) {
  testing::Random random(11);
  std::vector<Pose> pose(9);
  for (Pose& p : pose) p = {random.vector(), 0, testing::rotation(random.vector())};
  LinkStore store;
  std::vector<std::pair<Index, Index>> ends;
  for (Index k = 0; k < 8; ++k) ends.push_back({k, k + 1});
  ends.push_back({0, 5});  // 9 links: the last block has spare lanes
  std::vector<LinkRest<double>> rests;
  for (auto const& [i, j] : ends) {
    rests.push_back(some_rest(random));
    store.add(i, j, rests.back());
  }
  std::vector<double> pressure;
  for (std::size_t p = 0; p < pose.size(); ++p) pressure.push_back(random());

  std::vector<double> opened(pose.size(), 0), opened_plain(pose.size(), 0);
  store.add_opened_volume(pose, opened);
  std::vector<Wrench> wrench(pose.size()), plain(pose.size());
  store.add_wrench(pose, pressure, wrench);
  for (std::size_t l = 0; l < ends.size(); ++l) {
    auto const i = static_cast<std::size_t>(ends[l].first), j = static_cast<std::size_t>(ends[l].second);
    double const v = opened_volume(rests[l], ends_of(pose[i], pose[j]));
    opened_plain[i] += rests[l].weight * v;
    opened_plain[j] += v - rests[l].weight * v;
    auto const w = link_wrench(rests[l], ends_of(pose[i], pose[j]), pressure[i], pressure[j]);
    plain[i].force += Vec3{w.force.x, w.force.y, w.force.z};
    plain[j].force -= Vec3{w.force.x, w.force.y, w.force.z};
    plain[i].torque += Vec3{w.torque_i.x, w.torque_i.y, w.torque_i.z};
    plain[j].torque -= Vec3{w.torque_j.x, w.torque_j.y, w.torque_j.z};
  }
  EXPECT_EQ(opened, opened_plain);
  for (std::size_t p = 0; p < pose.size(); ++p) EXPECT_EQ(wrench[p], plain[p]) << p;
}

TEST(LinkLaw, RigidMotionOfThePairGivesNoForce) {
  Triple<double> const x_i{0, 0, 0}, x_j{1, 0, 0};
  LinkRest<double> const rest{1, 0.5, {1, 0, 0}, {0.5, 0, 0}, {-0.5, 0, 0}, {1, 1, 1, 0, 0, 0}};
  Quaternion const q = testing::rotation({0.3, 1, -2});
  Vec3 const xi = rotate(q, {x_i.x, x_i.y, x_i.z}), xj = rotate(q, {x_j.x, x_j.y, x_j.z});
  auto const w = link_wrench(rest, ends_of({xi, 0, q}, {xj, 0, q}), 0.0, 0.0);
  for (double value : {w.force.x, w.force.y, w.force.z, w.torque_i.x, w.torque_j.y}) EXPECT_NEAR(value, 0, 1e-15);
}

}  // namespace
}  // namespace brisance::solid
