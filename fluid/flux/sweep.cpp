#include "fluid/flux/sweep.hpp"

#include <cstdlib>

#include "fluid/flux/face.hpp"
#include "fluid/flux/pack.hpp"

namespace brisance::fluid {

namespace detail {
// Instantiated in sweep_[smooth_][curve_]order<N>.cpp, so that they compile side by side.
template <int Order, class Curve, bool Smooth>
SweepReport sweep_box_of(CellBox const& box, int direction, Real sigma, Gas const& gas, SweepOptions const& options);
template <int Order, class Curve, bool Smooth>
SweepReport sweep_lines_of(LineBundle const& lines, std::uint32_t valid_lanes, Real sigma, Gas const& gas,
                           SweepOptions const& options);
}  // namespace detail

namespace {

/// Calls run(order, kind of curve, smooth) with all known at compile time. Order 1 has no terms of smooth flow.
template <class Run>
SweepReport with_kernel(int order, Gas const& gas, bool smooth, Run run) {
  auto const with_curve = [&]<int Order>(std::integral_constant<int, Order> o) {
    if constexpr (Order > 1)
      if (smooth)
        return gas.curve.zero() ? run(o, IdealCurve{}, std::true_type{}) : run(o, AnyCurve{}, std::true_type{});
    return gas.curve.zero() ? run(o, IdealCurve{}, std::false_type{}) : run(o, AnyCurve{}, std::false_type{});
  };
  switch (order) {
    case 1:
      return with_curve(std::integral_constant<int, 1>{});
    case 3:
      return with_curve(std::integral_constant<int, 3>{});
    case 5:
      return with_curve(std::integral_constant<int, 5>{});
    case 7:
      return with_curve(std::integral_constant<int, 7>{});
    case 9:
      return with_curve(std::integral_constant<int, 9>{});
    case 11:
      return with_curve(std::integral_constant<int, 11>{});
    default:
      std::abort();  // the scene admits these six only
  }
}

}  // namespace

SweepReport sweep_box(int order, CellBox const& box, int direction, Real sigma, Gas const& gas,
                      SweepOptions const& options) {
  return with_kernel(order, gas, options.smooth, [&](auto o, auto curve, auto smooth) {
    return detail::sweep_box_of<decltype(o)::value, decltype(curve), decltype(smooth)::value>(box, direction, sigma,
                                                                                              gas, options);
  });
}

SweepReport sweep_lines(int order, LineBundle const& lines, std::uint32_t valid_lanes, Real sigma, Gas const& gas,
                        SweepOptions const& options) {
  return with_kernel(order, gas, options.smooth, [&](auto o, auto curve, auto smooth) {
    return detail::sweep_lines_of<decltype(o)::value, decltype(curve), decltype(smooth)::value>(lines, valid_lanes,
                                                                                                sigma, gas, options);
  });
}

int lanes() { return lanes_of<Pack>; }

}  // namespace brisance::fluid
