// A parsed scene file as plain data: every value with the place where it was written.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/location.hpp"

namespace brisance {

/// One value of a TOML file.
struct Tree {
  enum class Kind { flag, integer, real, text, list, table, other };
  struct Entry;

  Kind kind = Kind::table;
  bool flag = false;
  std::int64_t integer = 0;
  double real = 0;
  std::string text;
  std::vector<Tree> list;
  std::vector<Entry> table;  ///< in the order of the file
  Location at;

  Entry const* find(std::string_view key) const;
  Entry* find(std::string_view key);
};

struct Tree::Entry {
  std::string key;
  Location at;
  Tree value;
};

/// Parses TOML text; `file` names it in messages.  Errors: Failure::scene with line and column.
Tree parse_toml(std::string_view text, std::string const& file);

/// Applies "key.path=VALUE": VALUE is TOML, or a string when it is not. Elements of lists are named by index, from 0;
/// the index after the last appends; missing tables are created.  Errors: Failure::scene.
void apply_override(Tree& root, std::string const& assignment);

/// The value as TOML on one line, as it appears in messages.
std::string toml_text(Tree const& value);

/// A string in quotes, escaped.
std::string quoted(std::string_view text);

/// A key as TOML: bare when it can be, else quoted.
std::string toml_key(std::string_view key);

}  // namespace brisance
