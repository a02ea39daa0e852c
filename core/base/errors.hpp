// Wording shared by all error messages: the nearest known word, lists, and scene errors with their place.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/base/location.hpp"
#include "parallel/error.hpp"

namespace brisance {

/// Smallest number of inserted, deleted, replaced or swapped neighbouring letters that turns `a` into `b`.
int edit_distance(std::string_view a, std::string_view b);

/// The entry of `known` nearest to `word`; the first one when several are as near, empty when `known` is.
std::string nearest(std::string_view word, std::vector<std::string> const& known);

/// "1, 3, 5"
std::string joined(std::vector<std::string> const& words, std::string_view separator = ", ");

/// Throws the scene error "blast.toml:6:9: message".
[[noreturn]] void scene_error(Location const& at, std::string const& message);

/// Throws a scene error unless `ok`.
inline void require(bool ok, Location const& at, std::string const& message) {
  if (!ok) scene_error(at, message);
}

}  // namespace brisance
