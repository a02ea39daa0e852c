#include "fluid/flux/sweep_kernel.hpp"

BRISANCE_INSTANTIATE_SWEEP(7, IdealCurve, true)
