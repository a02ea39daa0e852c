#include "fluid/flux/sweep.hpp"

#include <cstdlib>

#include "fluid/flux/pack.hpp"

namespace brisance::fluid {

namespace detail {
// Instantiated in sweep_order<N>.cpp, one order per file so that they compile side by side.
template <int Order>
SweepReport sweep_box_of(CellBox const& box, int direction, Real sigma, Gas const& gas);
template <int Order>
SweepReport sweep_lines_of(LineBundle const& lines, std::uint32_t valid_lanes, Real sigma, Gas const& gas);
}  // namespace detail

SweepReport sweep_box(int order, CellBox const& box, int direction, Real sigma, Gas const& gas) {
  switch (order) {
    case 1:
      return detail::sweep_box_of<1>(box, direction, sigma, gas);
    case 3:
      return detail::sweep_box_of<3>(box, direction, sigma, gas);
    case 5:
      return detail::sweep_box_of<5>(box, direction, sigma, gas);
    case 7:
      return detail::sweep_box_of<7>(box, direction, sigma, gas);
    case 9:
      return detail::sweep_box_of<9>(box, direction, sigma, gas);
    case 11:
      return detail::sweep_box_of<11>(box, direction, sigma, gas);
    default:
      std::abort();  // the scene admits these six only
  }
}

SweepReport sweep_lines(int order, LineBundle const& lines, std::uint32_t valid_lanes, Real sigma, Gas const& gas) {
  switch (order) {
    case 1:
      return detail::sweep_lines_of<1>(lines, valid_lanes, sigma, gas);
    case 3:
      return detail::sweep_lines_of<3>(lines, valid_lanes, sigma, gas);
    case 5:
      return detail::sweep_lines_of<5>(lines, valid_lanes, sigma, gas);
    case 7:
      return detail::sweep_lines_of<7>(lines, valid_lanes, sigma, gas);
    case 9:
      return detail::sweep_lines_of<9>(lines, valid_lanes, sigma, gas);
    case 11:
      return detail::sweep_lines_of<11>(lines, valid_lanes, sigma, gas);
    default:
      std::abort();  // the scene admits these six only
  }
}

int lanes() { return lanes_of<Pack>; }

}  // namespace brisance::fluid
