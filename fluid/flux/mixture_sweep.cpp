#include "fluid/flux/mixture_sweep.hpp"

#include <cstdlib>

namespace brisance::fluid {

namespace detail {
// Instantiated in mixture_order<N>.cpp, one order per file so that they compile side by side.
template <int Order>
MixtureReport sweep_mixture_of(MixtureBox const& box, int direction, Real sigma, Mixture const& mixture,
                               SweepOptions const& options);
}  // namespace detail

MixtureReport sweep_mixture(int order, MixtureBox const& box, int direction, Real sigma, Mixture const& mixture,
                            SweepOptions const& options) {
  switch (order) {
    case 1:
      return detail::sweep_mixture_of<1>(box, direction, sigma, mixture, options);
    case 3:
      return detail::sweep_mixture_of<3>(box, direction, sigma, mixture, options);
    case 5:
      return detail::sweep_mixture_of<5>(box, direction, sigma, mixture, options);
    case 7:
      return detail::sweep_mixture_of<7>(box, direction, sigma, mixture, options);
    case 9:
      return detail::sweep_mixture_of<9>(box, direction, sigma, mixture, options);
    case 11:
      return detail::sweep_mixture_of<11>(box, direction, sigma, mixture, options);
  }
  std::abort();  // the scene schema admits no other order
}

}  // namespace brisance::fluid
