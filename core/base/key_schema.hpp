// The type-erased description behind Keys<T>: what the reader, the writer and the reference work on.
#pragma once
#include <array>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/location.hpp"
#include "core/base/tree.hpp"
#include "core/base/vec3.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::keys {

struct Schema;

enum class Kind {
  real,
  integer,
  long_integer,
  flag,
  text,
  vector,
  triple,
  reals,
  integers,
  texts,
  table,
  tables,
  named
};

/// How the members of one type are reached without knowing the type.
struct Access {
  Kind kind = Kind::real;
  Schema const& (*nested)() = nullptr;  ///< table, tables, named
  // std::optional: the value or null; a fresh value.
  void const* (*get)(void const* holder) = nullptr;
  void* (*emplace)(void* holder) = nullptr;
  // tables and named: empty it, add one, visit all.
  void (*clear)(void* holder) = nullptr;
  void* (*add)(void* holder, std::string const& name) = nullptr;
  void (*each)(void const* holder, std::function<void(std::string const&, void const*)> const&) = nullptr;
  bool optional() const { return emplace != nullptr; }
};

/// One key: what Keys<T> returns to add bounds. Bounds hold for every component of a list or vector.
struct Key {
  std::string name, unit, meaning;
  Access access;
  std::function<void*(void*)> member;
  std::optional<double> low, high;
  bool low_allowed = false, high_allowed = false;
  std::vector<double> numbers;
  std::vector<std::string> words;
  bool is_required = false;

  Key& above(double x) { return low = x, low_allowed = false, *this; }
  Key& at_least(double x) { return low = x, low_allowed = true, *this; }
  Key& below(double x) { return high = x, high_allowed = false, *this; }
  Key& at_most(double x) { return high = x, high_allowed = true, *this; }
  Key& one_of(std::initializer_list<double> choices) { return numbers = choices, *this; }
  Key& one_of(std::initializer_list<char const*> choices) {
    return words.assign(choices.begin(), choices.end()), *this;
  }
  Key& required() { return is_required = true, *this; }

  void const* value(void const* object) const { return member(const_cast<void*>(object)); }
};

struct Schema {
  std::vector<Key> keys;
  std::shared_ptr<void> (*make)() = nullptr;  ///< a struct with its defaults
  Location* (*location)(void*) = nullptr;     ///< its member `at`, if it has one
};

void read(Schema const& schema, Tree const& root, void* into);
std::string write(Schema const& schema, void const* from);
std::string reference(Schema const& schema, std::string const& path);

/// "a number in m, above 0": what a key accepts.
std::string expectation(Key const& key);
/// One value (no table) as TOML in SI.
std::string value_text(Kind kind, void const* value);

template <class T>
Schema const& schema_of();

template <class T>
concept HasKeys = requires(Keys<T>& k) {
  T::keys(k);
};

template <class T>
struct AccessOf;
template <class T>
Access access_of() {
  return AccessOf<T>::make();
}

template <Kind kind>
struct Plain {
  static Access make() {
    Access access;
    access.kind = kind;
    return access;
  }
};
template <>
struct AccessOf<double> : Plain<Kind::real> {};
template <>
struct AccessOf<int> : Plain<Kind::integer> {};
template <>
struct AccessOf<std::int64_t> : Plain<Kind::long_integer> {};
template <>
struct AccessOf<bool> : Plain<Kind::flag> {};
template <>
struct AccessOf<std::string> : Plain<Kind::text> {};
template <>
struct AccessOf<Vec3> : Plain<Kind::vector> {};
template <>
struct AccessOf<std::array<Index, 3>> : Plain<Kind::triple> {};
template <>
struct AccessOf<std::vector<double>> : Plain<Kind::reals> {};
template <>
struct AccessOf<std::vector<int>> : Plain<Kind::integers> {};
template <>
struct AccessOf<std::vector<std::string>> : Plain<Kind::texts> {};

template <HasKeys T>
struct AccessOf<T> {
  static Access make() {
    Access access;
    access.kind = Kind::table;
    access.nested = &schema_of<T>;
    return access;
  }
};

template <class T>
struct AccessOf<std::optional<T>> {
  static Access make() {
    Access access = access_of<T>();
    access.get = [](void const* holder) -> void const* {
      auto const& value = *static_cast<std::optional<T> const*>(holder);
      return value ? &*value : nullptr;
    };
    access.emplace = [](void* holder) -> void* { return &static_cast<std::optional<T>*>(holder)->emplace(); };
    return access;
  }
};

template <HasKeys T>
struct AccessOf<std::vector<T>> {
  using List = std::vector<T>;
  static Access make() {
    Access access;
    access.kind = Kind::tables;
    access.nested = &schema_of<T>;
    access.clear = [](void* holder) { static_cast<List*>(holder)->clear(); };
    access.add = [](void* holder, std::string const&) -> void* { return &static_cast<List*>(holder)->emplace_back(); };
    access.each = [](void const* holder, std::function<void(std::string const&, void const*)> const& visit) {
      for (T const& element : *static_cast<List const*>(holder)) visit("", &element);
    };
    return access;
  }
};

template <HasKeys T>
struct AccessOf<std::map<std::string, T>> {
  using Map = std::map<std::string, T>;
  static Access make() {
    Access access;
    access.kind = Kind::named;
    access.nested = &schema_of<T>;
    access.clear = [](void* holder) { static_cast<Map*>(holder)->clear(); };
    access.add = [](void* holder, std::string const& name) -> void* { return &(*static_cast<Map*>(holder))[name]; };
    access.each = [](void const* holder, std::function<void(std::string const&, void const*)> const& visit) {
      for (auto const& [name, element] : *static_cast<Map const*>(holder)) visit(name, &element);
    };
    return access;
  }
};

}  // namespace brisance::keys
