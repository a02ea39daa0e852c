// Gases and regions of test scenes in one call each.
#pragma once
#include <string>
#include <utility>

#include "fluid/flow_config.hpp"

namespace brisance::testing {

inline fluid::GasConfig gas_config(fluid::Gas const& gas) {
  fluid::GasConfig config;
  config.gamma = gas.gamma;
  if (gas.curve.stiffness > 0) config.law = "stiffened", config.stiffness = gas.curve.stiffness;
  if (gas.curve.exponential()) config.law = "jwl";  // its defaults are the products of TNT
  return config;
}

inline fluid::RegionConfig region(std::string shape, Real density, Real pressure, Vec3 velocity = {}) {
  fluid::RegionConfig r;
  r.shape = std::move(shape), r.density = density, r.pressure = pressure, r.velocity = velocity;
  return r;
}
inline fluid::RegionConfig ball(Vec3 centre, Real radius, Real density, Real pressure, Vec3 velocity = {}) {
  fluid::RegionConfig r = region("ball", density, pressure, velocity);
  r.centre = centre, r.radius = radius;
  return r;
}
inline fluid::RegionConfig box(Vec3 low, Vec3 high, Real density, Real pressure, Vec3 velocity = {}) {
  fluid::RegionConfig r = region("box", density, pressure, velocity);
  r.low = low, r.high = high;
  return r;
}
inline fluid::RegionConfig half_space(Vec3 point, Vec3 normal, Real density, Real pressure, Vec3 velocity = {}) {
  fluid::RegionConfig r = region("half_space", density, pressure, velocity);
  r.point = point, r.normal = normal;
  return r;
}

}  // namespace brisance::testing
