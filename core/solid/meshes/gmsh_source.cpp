#include "core/solid/meshes/gmsh_source.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/solid/meshes/element_mesh.hpp"

namespace brisance::solid {
namespace {

bool blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

GmshSource::GmshSource(std::string path) : path_(std::move(path)) {
  std::ifstream file(path_, std::ios::binary);
  std::ostringstream text;
  if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (!file.is_open() || file.bad()) mesh_error(path_, 0, std::string("cannot be read: ") + std::strerror(errno));
  text_ = std::move(text).str();
}

int GmshSource::line() const {
  if (binary_) return 0;
  return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'));
}

void GmshSource::fail(std::string const& what) const {
  mesh_error(path_, line(), what + (section_.empty() ? "" : " in $" + section_));
}

void GmshSource::skip_blank() {
  while (at_ < text_.size() && blank(text_[at_])) ++at_;
}

std::string GmshSource::word() {
  skip_blank();
  std::size_t const from = at_;
  while (at_ < text_.size() && !blank(text_[at_])) ++at_;
  if (from == at_) fail("the file ends too early");
  return text_.substr(from, at_ - from);
}

std::string GmshSource::quoted() {
  skip_blank();
  if (at_ >= text_.size() || text_[at_] != '"') fail("a name in quotes is missing");
  std::size_t const end = text_.find('"', at_ + 1);
  if (end == std::string::npos) fail("the quotes of a name are not closed");
  std::string const inner = text_.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return inner;
}

std::string GmshSource::next_section() {
  section_.clear();
  skip_blank();
  if (at_ >= text_.size()) return "";
  std::string const w = word();
  if (w[0] != '$') fail("expected the name of a section, such as $Nodes, and found \"" + w.substr(0, 40) + "\"");
  return section_ = w.substr(1);
}

void GmshSource::skip_section() {
  std::size_t const found = text_.find("$End" + section_, at_);
  if (found == std::string::npos) fail("$End" + section_ + " is missing: the file is cut off");
  at_ = found + section_.size() + 4;
}

void GmshSource::end_section() {
  std::string const w = word();
  if (w != "$End" + section_) fail("expected $End" + section_ + " and found \"" + w.substr(0, 40) + "\"");
}

Real GmshSource::text_real() {
  std::string const w = word();
  Real value = 0;
  char const* const from = w.c_str() + (w[0] == '+' ? 1 : 0);
  auto const [end, error] = std::from_chars(from, w.c_str() + w.size(), value);
  if (error != std::errc() || end != w.c_str() + w.size() || !std::isfinite(value))
    fail("expected a number and found \"" + w.substr(0, 40) + "\"");
  return value;
}

std::int64_t GmshSource::text_integer() {
  std::string const w = word();
  std::int64_t value = 0;
  auto const [end, error] = std::from_chars(w.c_str(), w.c_str() + w.size(), value);
  if (error != std::errc() || end != w.c_str() + w.size())
    fail("expected an integer and found \"" + w.substr(0, 40) + "\"");
  return value;
}

void GmshSource::end_line() {
  if (!binary_) return;
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  ++at_;
}

void GmshSource::expect_bytes() {
  binary_ = true;
  end_line();
  if (at_ + 4 > text_.size()) fail("the file ends too early");
  std::uint32_t one = 0;
  std::memcpy(&one, text_.data() + at_, 4);
  at_ += 4;
  if (one != 1 && one != 0x01000000u) fail("the byte order cannot be told: the integer 1 is missing");
  swapped_ = one != 1;
}

template <class T>
T GmshSource::bytes() {
  if (at_ + sizeof(T) > text_.size()) fail("the file ends too early");
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), text_.data() + at_, sizeof(T));
  if (swapped_) std::reverse(raw.begin(), raw.end());
  at_ += sizeof(T);
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

std::int64_t GmshSource::integer() { return binary_ ? bytes<std::int32_t>() : text_integer(); }
std::int64_t GmshSource::size() { return binary_ ? bytes<std::int64_t>() : text_integer(); }
Real GmshSource::real() {
  if (!binary_) return text_real();
  Real const value = bytes<double>();
  if (!std::isfinite(value)) fail("a number is not finite");
  return value;
}

std::int64_t GmshSource::checked(std::int64_t count, char const* of) const {
  // The shortest entry has two characters: a larger count would only exhaust the memory.
  if (count < 0 || count > static_cast<std::int64_t>(text_.size()))
    fail("the number of " + std::string(of) + ", " + std::to_string(count) + ", is not possible");
  return count;
}

}  // namespace brisance::solid
