// The flows of theory/fluid.md 8.3 and 8.4.
#pragma once
#include "tests/support/hard_run.hpp"
#include "tests/support/shocks.hpp"

namespace brisance::testing {

/// A tube of `n` cells with open ends.
HardCase tube_case(Shock const& shock, int n);
HardCase shu_osher_case(int n);
HardCase blast_waves_case(int n);

// Quarter or octant with walls at 0, n cells along each side.
HardCase sedov(int dimension, int n);           ///< F23, to t = 1; spherical: radius 1 too
HardCase noh(int dimension, int n, int order);  ///< F23b, exact ghosts outside [0, 1]; as deep as the order needs
HardCase implosion(int n);                      ///< F24b
HardCase riemann_2d(int n);                     ///< F24a, configuration 3
HardCase double_mach(int n, int order);         ///< F23c, 4 n x n
HardCase jet(int dimension, int n, int order, Real cfl);         ///< F23d, 2 n x n (x n): Mach 2000
HardCase odd_even(int dimension, int n);                         ///< F21, 20 n x n (x n)
HardCase steady_shock(int dimension, int order, unsigned seed);  ///< F22, 50 x 25, or 50 x 12 x 12
HardCase vacuum_ball(int dimension, int n);                      ///< F25: gas in true vacuum

}  // namespace brisance::testing
