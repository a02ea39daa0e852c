#include "fluid/flux/sweep_kernel.hpp"

BRISANCE_INSTANTIATE_SWEEP(5, IdealCurve, true)
