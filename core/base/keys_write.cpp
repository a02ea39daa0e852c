#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/key_schema.hpp"
#include "core/base/units.hpp"

namespace brisance::keys {
namespace {

template <class List, class Text>
std::string list_text(List const& list, Text text) {
  std::vector<std::string> parts;
  for (auto const& element : list) parts.push_back(text(element));
  return "[" + joined(parts) + "]";
}

bool is_table(Kind kind) { return kind == Kind::table || kind == Kind::tables || kind == Kind::named; }

/// The value behind a std::optional, or the value itself; null when it is not given.
void const* held(Key const& key, void const* object) {
  void const* const value = key.value(object);
  return key.access.optional() ? key.access.get(value) : value;
}

void write_section(Schema const& schema, void const* object, std::string const& path, std::string& out) {
  for (Key const& key : schema.keys) {
    void const* const value = held(key, object);
    if (value && !is_table(key.access.kind))
      out += toml_key(key.name) + " = " + value_text(key.access.kind, value) + "\n";
  }
  for (Key const& key : schema.keys) {
    void const* const value = held(key, object);
    if (!value || !is_table(key.access.kind)) continue;
    std::string const name = path.empty() ? toml_key(key.name) : path + "." + toml_key(key.name);
    Schema const& nested = key.access.nested();
    if (key.access.kind == Kind::table) {
      out += "\n[" + name + "]\n";
      write_section(nested, value, name, out);
    } else if (key.access.kind == Kind::tables) {
      key.access.each(value, [&](std::string const&, void const* element) {
        out += "\n[[" + name + "]]\n";
        write_section(nested, element, name, out);
      });
    } else {
      key.access.each(value, [&](std::string const& element_name, void const* element) {
        std::string const element_path = name + "." + toml_key(element_name);
        out += "\n[" + element_path + "]\n";
        write_section(nested, element, element_path, out);
      });
    }
  }
}

std::string default_text(Key const& key, void const* prototype) {
  if (key.is_required) return "required";
  void const* const value = held(key, prototype);
  if (!value) return is_table(key.access.kind) ? "absent (off)" : "not given";
  if (is_table(key.access.kind)) return "";
  std::string const text = value_text(key.access.kind, value);
  bool const number = key.access.kind == Kind::real && text.ends_with(".0");
  return number ? text.substr(0, text.size() - 2) : text;
}

std::string first_part(std::string const& path) { return path.substr(0, path.find('.')); }
std::string rest(std::string const& path) {
  std::size_t const dot = path.find('.');
  return dot == std::string::npos ? "" : path.substr(dot + 1);
}

/// Prints one key and all below it. `wanted` is what is left of the path asked for; every level consumes one part of
/// it.
class Reference {
 public:
  std::string text;

  void section(Schema const& schema, std::string const& prefix, std::string const& wanted) {
    std::string const part = first_part(wanted);
    std::string const name = part.substr(0, part.find('['));
    std::shared_ptr<void> const prototype = schema.make();
    bool found = false;
    for (Key const& key : schema.keys) {
      if (!wanted.empty() && key.name != name) continue;
      found = true;
      entry(key, prototype.get(), prefix, wanted.empty() ? "" : rest(wanted), part != name);
    }
    if (found || wanted.empty()) return;
    std::vector<std::string> known;
    for (Key const& key : schema.keys) known.push_back(key.name);
    throw Error(Failure::scene, "no key " + prefix + part + "; the nearest known key is " + prefix +
                                    nearest(name, known) + " (known here: " + joined(known) + ")");
  }

 private:
  void entry(Key const& key, void const* prototype, std::string const& prefix, std::string wanted, bool indexed) {
    std::string const path = prefix + key.name;
    Kind const kind = key.access.kind;
    if (wanted.empty()) print(key, path, default_text(key, prototype));
    if (!is_table(kind)) {
      if (!wanted.empty()) throw Error(Failure::scene, path + " holds a value; there is no key " + path + "." + wanted);
      return;
    }
    // One part of the path names an element: solid.material.steel.density, solid.body.0.name (or solid.body[0].name).
    bool const list_index =
        kind == Kind::tables && !indexed && !wanted.empty() &&
        std::all_of(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(first_part(wanted).size()),
                    [](char c) { return c >= '0' && c <= '9'; });
    bool const element = kind == Kind::named || list_index;
    bool const whole_element = element && !wanted.empty() && rest(wanted).empty();
    if (whole_element) print(key, path, default_text(key, prototype));
    if (element && !wanted.empty()) wanted = rest(wanted);
    std::string const dots = kind == Kind::tables ? "[]." : kind == Kind::named ? ".NAME." : ".";
    section(key.access.nested(), path + dots, wanted);
  }

  void print(Key const& key, std::string const& path, std::string const& standard) {
    std::string const unit = key.unit.empty() ? "-" : key.unit;
    bool const table = is_table(key.access.kind);
    Key without_unit = key;
    without_unit.unit.clear();  // it has a column of its own
    text += fmt::format("{}{}\n    type: {}", table && !text.empty() ? "\n" : "", path, expectation(without_unit));
    if (!table) text += fmt::format("; unit: {}", unit);
    if (!standard.empty()) text += fmt::format("; default: {}", standard);
    text += fmt::format("\n    {}\n", key.meaning);
  }
};

}  // namespace

std::string value_text(Kind kind, void const* value) {
  auto const integer_text = [](auto x) { return std::to_string(x); };
  switch (kind) {
    case Kind::real:
      return exact_text(*static_cast<double const*>(value));
    case Kind::integer:
      return std::to_string(*static_cast<int const*>(value));
    case Kind::long_integer:
      return std::to_string(*static_cast<std::int64_t const*>(value));
    case Kind::flag:
      return *static_cast<bool const*>(value) ? "true" : "false";
    case Kind::text:
      return quoted(*static_cast<std::string const*>(value));
    case Kind::vector: {
      auto const& v = *static_cast<Vec3 const*>(value);
      return list_text(std::array{v.x, v.y, v.z}, exact_text);
    }
    case Kind::triple:
      return list_text(*static_cast<std::array<Index, 3> const*>(value), integer_text);
    case Kind::reals:
      return list_text(*static_cast<std::vector<double> const*>(value), exact_text);
    case Kind::integers:
      return list_text(*static_cast<std::vector<int> const*>(value), integer_text);
    case Kind::texts:
      return list_text(*static_cast<std::vector<std::string> const*>(value), quoted);
    case Kind::table:
    case Kind::tables:
    case Kind::named:
      break;
  }
  return "";
}

std::string write(Schema const& schema, void const* from) {
  std::string out;
  write_section(schema, from, "", out);
  return out;
}

std::string reference(Schema const& schema, std::string const& path) {
  Reference reference;
  reference.section(schema, "", path);
  return reference.text;
}

}  // namespace brisance::keys
