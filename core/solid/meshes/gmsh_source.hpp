// The numbers of a .msh file, written as text or as bytes, behind one face.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/real.hpp"

namespace brisance::solid {

/// Reads sections, words and numbers one after the other. Section names and physical names are text in both forms.
/// Errors: Failure::scene "path:line: ..." (bytes have no lines: "path: ... of $Section").
class GmshSource {
 public:
  /// Errors: the file cannot be opened.
  explicit GmshSource(std::string path);

  std::string const& path() const { return path_; }
  /// Moves past the next "$Name" and returns its name; empty at the end of the file.
  std::string next_section();
  /// Moves past "$EndName" of the current section, whatever is before it.
  void skip_section();
  /// Expects "$EndName" next.
  void end_section();

  std::string word();
  std::string quoted();
  Real text_real();
  std::int64_t text_integer();

  /// From here on numbers are bytes; reads the 1 that tells their order.
  void expect_bytes();
  bool binary() const { return binary_; }
  /// In a binary file, moves to the bytes after the current line.
  void end_line();
  /// An int of the format (4 bytes).
  std::int64_t integer();
  /// A size_t of the format (8 bytes), and what 2.2 writes as an int.
  std::int64_t size();
  Real real();

  [[noreturn]] void fail(std::string const& what) const;
  /// Throws unless `count` is one that the rest of the file can hold.
  std::int64_t checked(std::int64_t count, char const* of) const;

 private:
  template <class T>
  T bytes();
  void skip_blank();
  int line() const;

  std::string path_, text_, section_;
  std::size_t at_ = 0;
  bool binary_ = false, swapped_ = false;
};

}  // namespace brisance::solid
