#include "core/base/tree.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>

#include "core/base/errors.hpp"
#include "core/base/units.hpp"

namespace brisance {
namespace {

Location place(toml::source_region const& region, std::string const& file) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Tree convert(toml::node const& node, std::string const& file);

void convert_table(toml::table const& table, std::string const& file, Tree& tree) {
  tree.kind = Tree::Kind::table;
  for (auto const& [key, value] : table)
    tree.table.push_back({std::string(key.str()), place(key.source(), file), convert(value, file)});
  auto const earlier = [](Tree::Entry const& a, Tree::Entry const& b) {
    return std::pair(a.at.line, a.at.column) < std::pair(b.at.line, b.at.column);
  };
  std::stable_sort(tree.table.begin(), tree.table.end(), earlier);  // toml++ sorts by name
}

Tree convert(toml::node const& node, std::string const& file) {
  Tree tree;
  tree.kind = Tree::Kind::other;
  tree.at = place(node.source(), file);
  if (auto const* table = node.as_table()) {
    convert_table(*table, file, tree);
  } else if (auto const* list = node.as_array()) {
    tree.kind = Tree::Kind::list;
    for (toml::node const& element : *list) tree.list.push_back(convert(element, file));
  } else if (auto const* flag = node.as_boolean()) {
    tree.kind = Tree::Kind::flag, tree.flag = flag->get();
  } else if (auto const* integer = node.as_integer()) {
    tree.kind = Tree::Kind::integer, tree.integer = integer->get();
  } else if (auto const* real = node.as_floating_point()) {
    tree.kind = Tree::Kind::real, tree.real = real->get();
  } else if (auto const* text = node.as_string()) {
    tree.kind = Tree::Kind::text, tree.text = text->get();
  }
  return tree;
}

Tree override_value(std::string const& value, std::string const& place) {
  try {
    toml::table const parsed = toml::parse("v = " + value);
    if (parsed.size() == 1) return convert(*parsed.get("v"), place);
  } catch (toml::parse_error const&) {  // not TOML: a string without its quotes, such as 2 ms
  }
  Tree text;
  text.kind = Tree::Kind::text;
  text.text = value;
  return text;
}

void set_location(Tree& tree, Location const& at) {
  tree.at = at;
  for (Tree& element : tree.list) set_location(element, at);
  for (Tree::Entry& entry : tree.table) entry.at = at, set_location(entry.value, at);
}

Tree& descend(Tree& tree, std::string const& part, Location const& at) {
  if (tree.kind == Tree::Kind::list) {
    std::size_t index = 0;
    auto const [end, failure] = std::from_chars(part.data(), part.data() + part.size(), index);
    bool const whole = failure == std::errc{} && end == part.data() + part.size();
    require(whole && index <= tree.list.size(), at,
            "'" + part + "' is not an index of a list of " + std::to_string(tree.list.size()) + " elements");
    if (index == tree.list.size()) tree.list.emplace_back().at = at;
    return tree.list[index];
  }
  require(tree.kind == Tree::Kind::table, at,
          "nothing can be set below " + toml_text(tree) + " (" + tree.at.text() + "), which is not a table");
  if (Tree::Entry* entry = tree.find(part)) return entry->value;
  tree.table.push_back({part, at, {}});
  tree.table.back().value.at = at;
  return tree.table.back().value;
}

}  // namespace

Tree::Entry const* Tree::find(std::string_view key) const {
  for (Entry const& entry : table)
    if (entry.key == key) return &entry;
  return nullptr;
}

Tree::Entry* Tree::find(std::string_view key) { return const_cast<Entry*>(std::as_const(*this).find(key)); }

Tree parse_toml(std::string_view text, std::string const& file) {
  try {
    toml::table const parsed = toml::parse(text, file);
    Tree root;
    root.at = {file, 1, 1};
    convert_table(parsed, file, root);
    return root;
  } catch (toml::parse_error const& error) {
    scene_error(place(error.source(), file), "not valid TOML: " + std::string(error.description()));
  }
}

void apply_override(Tree& root, std::string const& assignment) {
  Location const at{"--set " + assignment};
  std::size_t const equals = assignment.find('=');
  require(equals != std::string::npos && equals > 0, at, "expected key.path=VALUE");
  std::string const path = assignment.substr(0, equals);
  Tree* tree = &root;
  for (std::size_t first = 0; first <= path.size();) {
    std::size_t const dot = std::min(path.find('.', first), path.size());
    require(dot > first, at, "the key path has an empty part");
    tree = &descend(*tree, path.substr(first, dot - first), at);
    first = dot + 1;
  }
  *tree = override_value(assignment.substr(equals + 1), at.file);
  set_location(*tree, at);
}

std::string toml_text(Tree const& value) {
  std::vector<std::string> parts;
  switch (value.kind) {
    case Tree::Kind::flag:
      return value.flag ? "true" : "false";
    case Tree::Kind::integer:
      return std::to_string(value.integer);
    case Tree::Kind::real:
      return exact_text(value.real);
    case Tree::Kind::text:
      return quoted(value.text);
    case Tree::Kind::list:
      for (Tree const& element : value.list) parts.push_back(toml_text(element));
      return "[" + joined(parts) + "]";
    case Tree::Kind::table:
      for (Tree::Entry const& entry : value.table)
        parts.push_back(toml_key(entry.key) + " = " + toml_text(entry.value));
      return parts.empty() ? "{}" : "{ " + joined(parts) + " }";
    case Tree::Kind::other:
      break;
  }
  return "a date or time";
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (char const c : text) {
    if (c == '"' || c == '\\') {
      result += '\\', result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr char digits[] = "0123456789ABCDEF";
      result += "\\u00", result += digits[(c >> 4) & 15], result += digits[c & 15];
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string toml_key(std::string_view key) {
  auto const is_bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  bool const bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
  return bare ? std::string(key) : quoted(key);
}

}  // namespace brisance
