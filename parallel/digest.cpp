#include "parallel/digest.hpp"

#include <fmt/format.h>

#include <bit>

namespace brisance::parallel {
namespace {

/// Bijection of 64-bit words in which every input bit reaches every output bit (the splitmix64 finaliser).
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Two chains of 64 bits with unequal steps; each is a bijection of its last word, so one changed word always shows.
class Chains {
 public:
  Chains(std::uint32_t kind, std::int64_t id, std::size_t length) {
    take((static_cast<std::uint64_t>(length) << 32) | kind);
    take(static_cast<std::uint64_t>(id));
  }
  void take(std::uint64_t word) {
    a_ = mix(a_ ^ word);
    b_ = mix(std::rotl(b_, 23) + word * 0x9e3779b97f4a7c15u);
  }
  void add_to(Digest& digest) const { digest.add(Digest{mix(a_ + std::rotl(b_, 32)), mix(b_ ^ (a_ * 5))}); }

 private:
  std::uint64_t a_ = 0x243f6a8885a308d3u, b_ = 0x13198a2e03707344u;  // digits of pi
};

}  // namespace

void Digest::add(std::uint32_t kind, std::int64_t id, std::span<double const> bits) {
  Chains chains(kind, id, bits.size());
  for (double const x : bits) chains.take(std::bit_cast<std::uint64_t>(x));
  chains.add_to(*this);
}

void Digest::add(std::uint32_t kind, std::int64_t id, std::span<std::uint64_t const> words) {
  Chains chains(kind, id, words.size());
  for (std::uint64_t const word : words) chains.take(word);
  chains.add_to(*this);
}

void Digest::add(Digest const& other) {
  low += other.low;
  high += other.high + (low < other.low ? 1u : 0u);
}

std::string Digest::hex() const { return fmt::format("{:016x}{:016x}", high, low); }

}  // namespace brisance::parallel
