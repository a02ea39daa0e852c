// How a section of a scene becomes a plain struct. One declaration beside the struct reads, checks, documents and
// echoes:
//
//   struct EulerConfig {
//     int order = 5;
//     double cfl = 0.8;
//     Location at;                                     // optional: filled with the place of the section
//     static void keys(Keys<EulerConfig>& k) {
//       k("order", &EulerConfig::order, "", "order of the OSMP flux").one_of({1, 3, 5, 7, 9, 11});
//       k("cfl", &EulerConfig::cfl, "1", "Courant number of each sweep").above(0).at_most(0.9);
//     }
//   };
//
// Members: double, int, std::int64_t, bool, std::string, Vec3 (1 to 3 quantities, missing ones 0), std::array<Index, 3>
// (1 to 3 integers, missing ones 1), std::vector of double, int or std::string; std::optional of any of these or of a
// struct with keys (absent = not given, the effect is off); a struct with keys, std::vector of such (array of tables)
// and std::map<std::string, struct> (tables by name).
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/key_schema.hpp"
#include "core/base/tree.hpp"

namespace brisance {

/// Collects the keys of T; passed to T::keys.
template <class T>
class Keys {
 public:
  explicit Keys(keys::Schema& schema) : schema_(schema) {}

  /// Declares one key: its name, member, SI unit ("" or "1" for none) and meaning. The handle adds bounds.
  template <class Member, class Base>
  keys::Key& operator()(std::string name, Member Base::*member, std::string unit, std::string meaning) {
    keys::Key& key = schema_.keys.emplace_back();
    key.name = std::move(name);
    key.unit = std::move(unit);
    key.meaning = std::move(meaning);
    key.access = keys::access_of<Member>();
    key.member = [member](void* object) -> void* { return &(static_cast<T*>(object)->*member); };
    return key;
  }

 private:
  keys::Schema& schema_;
};

namespace keys {

/// The schema of T, built on first use.
template <class T>
Schema const& schema_of() {
  static Schema const schema = [] {
    Schema s;
    s.make = [] { return std::static_pointer_cast<void>(std::make_shared<T>()); };
    if constexpr (requires(T & t) { static_cast<Location&>(t.at); })
      s.location = [](void* object) { return &static_cast<T*>(object)->at; };
    Keys<T> declare(s);
    T::keys(declare);
    return s;
  }();
  return schema;
}

}  // namespace keys

/// Reads a whole tree.  Errors: Failure::scene naming file, line, column, key, what was expected and the nearest key.
template <class T>
T read_keys(Tree const& root) {
  T result{};
  keys::read(keys::schema_of<T>(), root, &result);
  return result;
}

/// Every value in SI as TOML; reading it gives the same struct bit for bit.
template <class T>
std::string write_keys(T const& config) {
  return keys::write(keys::schema_of<T>(), &config);
}

/// Reference of the key at `path` and of everything below it ("" = all): key, type, unit, default, meaning.
/// Errors: Failure::scene when there is no such key.
template <class T>
std::string key_reference(std::string const& path = "") {
  return keys::reference(keys::schema_of<T>(), path);
}

}  // namespace brisance
