#include "fluid/flux/mixture_kernel.hpp"

BRISANCE_INSTANTIATE_MIXTURE(9)
