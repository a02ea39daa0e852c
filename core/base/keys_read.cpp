#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.hpp"
#include "core/base/key_schema.hpp"
#include "core/base/units.hpp"

namespace brisance::keys {
namespace {

std::string kind_name(Tree::Kind kind) {
  switch (kind) {
    case Tree::Kind::flag:
      return "a boolean";
    case Tree::Kind::integer:
      return "an integer";
    case Tree::Kind::real:
      return "a number";
    case Tree::Kind::text:
      return "a string";
    case Tree::Kind::list:
      return "an array";
    case Tree::Kind::table:
      return "a table";
    case Tree::Kind::other:
      break;
  }
  return "a date or time";
}

/// Values in messages are cut: an inline mesh of a thousand numbers helps nobody.
std::string shown(Tree const& value) {
  constexpr std::size_t longest = 60;
  std::string const text = toml_text(value);
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

/// Reads the value of one key; `path` is its full name.
class ValueReader {
 public:
  ValueReader(Key const& key, std::string path) : key_(key), path_(std::move(path)) {}

  void read(Tree const& value, void* into) const {
    switch (key_.access.kind) {
      case Kind::real:
        *static_cast<double*>(into) = real(value, path_);
        return;
      case Kind::integer:
        *static_cast<int*>(into) = static_cast<int>(integer(value, path_, 32));
        return;
      case Kind::long_integer:
        *static_cast<std::int64_t*>(into) = integer(value, path_, 64);
        return;
      case Kind::flag:
        if (value.kind != Tree::Kind::flag) wrong_type(value, path_);
        *static_cast<bool*>(into) = value.flag;
        return;
      case Kind::text:
        *static_cast<std::string*>(into) = text(value, path_);
        return;
      case Kind::vector:
        read_vector(value, *static_cast<Vec3*>(into));
        return;
      case Kind::triple:
        read_triple(value, *static_cast<std::array<Index, 3>*>(into));
        return;
      case Kind::reals:
        read_list(value, *static_cast<std::vector<double>*>(into), &ValueReader::real);
        return;
      case Kind::integers:
        read_list(value, *static_cast<std::vector<int>*>(into), &ValueReader::index);
        return;
      case Kind::texts:
        read_list(value, *static_cast<std::vector<std::string>*>(into), &ValueReader::text);
        return;
      default:
        return;  // tables are the business of SectionReader
    }
  }

  [[noreturn]] void wrong_type(Tree const& value, std::string const& path) const {
    scene_error(value.at,
                path + " = " + shown(value) + " is " + kind_name(value.kind) + "; expected " + expectation(key_));
  }

 private:
  double real(Tree const& value, std::string const& path) const {
    double result = 0;
    if (value.kind == Tree::Kind::integer) {
      result = static_cast<double>(value.integer);
    } else if (value.kind == Tree::Kind::real) {
      result = value.real;
    } else if (value.kind == Tree::Kind::text) {
      try {
        result = parse_quantity(value.text, key_.unit);
      } catch (UnitError const& error) {
        scene_error(value.at, path + " = " + shown(value) + ": " + error.what() + "; expected " + expectation(key_));
      }
    } else {
      wrong_type(value, path);
    }
    check(result, value, path);
    return result;
  }

  std::int64_t integer(Tree const& value, std::string const& path, int bits) const {
    if (value.kind != Tree::Kind::integer) wrong_type(value, path);
    bool const fits = bits == 64 || (value.integer >= std::numeric_limits<std::int32_t>::min() &&
                                     value.integer <= std::numeric_limits<std::int32_t>::max());
    if (!fits) scene_error(value.at, path + " = " + shown(value) + " is out of range; expected an integer of 32 bits");
    check(static_cast<double>(value.integer), value, path);
    return value.integer;
  }
  int index(Tree const& value, std::string const& path) const { return static_cast<int>(integer(value, path, 32)); }

  std::string text(Tree const& value, std::string const& path) const {
    if (value.kind != Tree::Kind::text) wrong_type(value, path);
    bool const known = key_.words.empty() || std::count(key_.words.begin(), key_.words.end(), value.text) > 0;
    if (!known)
      scene_error(value.at, path + " = " + shown(value) + " is not known; expected " + expectation(key_) +
                                "; the nearest is " + quoted(nearest(value.text, key_.words)));
    return value.text;
  }

  void check(double x, Tree const& value, std::string const& path) const {
    bool ok = !std::isnan(x);
    if (key_.low) ok = ok && (key_.low_allowed ? x >= *key_.low : x > *key_.low);
    if (key_.high) ok = ok && (key_.high_allowed ? x <= *key_.high : x < *key_.high);
    if (!key_.numbers.empty()) ok = ok && std::count(key_.numbers.begin(), key_.numbers.end(), x) > 0;
    if (!ok) scene_error(value.at, path + " = " + shown(value) + " is out of range; expected " + expectation(key_));
  }

  std::string element_path(std::size_t i) const { return path_ + "[" + std::to_string(i) + "]"; }

  void check_length(Tree const& value) const {
    if (value.kind != Tree::Kind::list) wrong_type(value, path_);
    if (value.list.empty() || value.list.size() > 3)
      scene_error(value.at, path_ + " = " + shown(value) + " has " + std::to_string(value.list.size()) +
                                " elements; expected " + expectation(key_));
  }

  void read_vector(Tree const& value, Vec3& into) const {
    check_length(value);
    into = {};
    for (std::size_t i = 0; i < value.list.size(); ++i)
      into[static_cast<int>(i)] = real(value.list[i], element_path(i));
  }

  void read_triple(Tree const& value, std::array<Index, 3>& into) const {
    check_length(value);
    into = {1, 1, 1};
    for (std::size_t i = 0; i < value.list.size(); ++i) into[i] = index(value.list[i], element_path(i));
  }

  template <class T>
  void read_list(Tree const& value, std::vector<T>& into,
                 T (ValueReader::*read_one)(Tree const&, std::string const&) const) const {
    if (value.kind != Tree::Kind::list) wrong_type(value, path_);
    into.clear();
    for (std::size_t i = 0; i < value.list.size(); ++i)
      into.push_back((this->*read_one)(value.list[i], element_path(i)));
  }

  Key const& key_;
  std::string path_;
};

/// All paths below a schema whose last part is `name`, to find a key written in the wrong section.
void find_leaf(Schema const& schema, std::string const& prefix, std::string const& name,
               std::vector<std::string>& found) {
  for (Key const& key : schema.keys) {
    if (key.name == name) found.push_back(prefix + key.name);
    if (!key.access.nested) continue;
    std::string const dots = key.access.kind == Kind::tables ? "[]." : key.access.kind == Kind::named ? ".NAME." : ".";
    find_leaf(key.access.nested(), prefix + key.name + dots, name, found);
  }
}

class SectionReader {
 public:
  explicit SectionReader(Schema const& root) : root_(root) {}

  void read(Schema const& schema, Tree const& table, std::string const& path, void* into) const {
    std::string const prefix = path.empty() ? "" : path + ".";
    for (Tree::Entry const& entry : table.table) {
      bool const known =
          std::any_of(schema.keys.begin(), schema.keys.end(), [&](Key const& k) { return k.name == entry.key; });
      if (!known) unknown(schema, entry, prefix);
    }
    if (schema.location) *schema.location(into) = table.at;
    for (Key const& key : schema.keys) {
      Tree::Entry const* entry = table.find(key.name);
      if (entry)
        read_member(key, entry->value, prefix + key.name, key.member(into));
      else
        absent(key, table, prefix + key.name, key.member(into));
    }
  }

 private:
  /// A struct whose table is absent keeps its defaults, but its required keys are still asked for.
  void absent(Key const& key, Tree const& table, std::string const& path, void* into) const {
    if (key.is_required) scene_error(table.at, path + " is missing; expected " + expectation(key) + ": " + key.meaning);
    if (key.access.kind != Kind::table || key.access.optional()) return;
    Tree nothing;
    nothing.at = table.at;
    read(key.access.nested(), nothing, path, into);
  }

  void read_member(Key const& key, Tree const& value, std::string const& path, void* into) const {
    ValueReader const reader(key, path);
    if (key.access.optional()) into = key.access.emplace(into);
    if (key.access.kind == Kind::table) {
      if (value.kind != Tree::Kind::table) reader.wrong_type(value, path);
      read(key.access.nested(), value, path, into);
    } else if (key.access.kind == Kind::tables) {
      if (value.kind != Tree::Kind::list) reader.wrong_type(value, path);
      key.access.clear(into);
      for (std::size_t i = 0; i < value.list.size(); ++i) {
        std::string const element = path + "[" + std::to_string(i) + "]";
        if (value.list[i].kind != Tree::Kind::table) reader.wrong_type(value.list[i], element);
        read(key.access.nested(), value.list[i], element, key.access.add(into, ""));
      }
    } else if (key.access.kind == Kind::named) {
      if (value.kind != Tree::Kind::table) reader.wrong_type(value, path);
      key.access.clear(into);
      for (Tree::Entry const& entry : value.table) {
        std::string const element = path + "." + toml_key(entry.key);
        if (entry.value.kind != Tree::Kind::table) reader.wrong_type(entry.value, element);
        read(key.access.nested(), entry.value, element, key.access.add(into, entry.key));
      }
    } else {
      reader.read(value, into);
    }
  }

  [[noreturn]] void unknown(Schema const& schema, Tree::Entry const& entry, std::string const& prefix) const {
    std::vector<std::string> siblings, elsewhere;
    for (Key const& key : schema.keys) siblings.push_back(key.name);
    std::string best = nearest(entry.key, siblings);
    bool const close = !best.empty() && edit_distance(entry.key, best) <= static_cast<int>(entry.key.size()) / 2;
    if (!close) find_leaf(root_, "", entry.key, elsewhere);
    best = elsewhere.empty() ? prefix + best : elsewhere.front();
    std::string message = "unknown key " + prefix + toml_key(entry.key) + "; the nearest known key is " + best;
    if (!siblings.empty()) message += " (known here: " + joined(siblings) + ")";
    scene_error(entry.at, message);
  }

  Schema const& root_;
};

std::string bounds_text(Key const& key) {
  auto const number = [](double x) {
    std::string text = exact_text(x);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
  };
  std::vector<std::string> choices = key.words, bounds;
  for (double const x : key.numbers) choices.push_back(number(x));
  if (!choices.empty()) return ", one of " + joined(choices);
  if (key.low) bounds.push_back((key.low_allowed ? "at least " : "above ") + number(*key.low));
  if (key.high) bounds.push_back((key.high_allowed ? "at most " : "below ") + number(*key.high));
  return bounds.empty() ? "" : ", " + joined(bounds, " and ");
}

std::string type_text(Key const& key) {
  bool const plain = key.unit.empty() || key.unit == "1";
  std::string const in_unit =
      plain ? "" : " in " + key.unit + " (a bare number, or a string with a unit, such as \"1 " + key.unit + "\")";
  switch (key.access.kind) {
    case Kind::real:
      return "a number" + in_unit;
    case Kind::integer:
    case Kind::long_integer:
      return "an integer";
    case Kind::flag:
      return "true or false";
    case Kind::text:
      return "a string";
    case Kind::vector:
      return "an array of 1 to 3 numbers" + in_unit;
    case Kind::triple:
      return "an array of 1 to 3 integers";
    case Kind::reals:
      return "an array of numbers" + in_unit;
    case Kind::integers:
      return "an array of integers";
    case Kind::texts:
      return "an array of strings";
    case Kind::table:
      return "a table";
    case Kind::tables:
      return "an array of tables";
    case Kind::named:
      return "tables by name";
  }
  return "";
}

}  // namespace

std::string expectation(Key const& key) { return type_text(key) + bounds_text(key); }

void read(Schema const& schema, Tree const& root, void* into) { SectionReader(schema).read(schema, root, "", into); }

}  // namespace brisance::keys
