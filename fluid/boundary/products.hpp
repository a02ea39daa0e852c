// What the sides of the domain do with detonation products.
#pragma once
#include <string>

#include "fluid/grid/block.hpp"

namespace brisance::fluid {

/// Fills the two components of the products in the ghosts of a side, the other five being filled already: a wall
/// mirrors them, an outflow copies the last cell, an inflow brings ambient gas.
void fill_products(Block& block, int direction, int side, std::string const& law);

/// Does fill_products() know what this law does?
bool carries_products(std::string const& law);

}  // namespace brisance::fluid
