// Hash of the physical state: 128-bit hashes of (kind, id, bits), added modulo 2^128, so order and ranks do not matter.
#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace brisance::parallel {

struct Digest {
  std::uint64_t low = 0, high = 0;
  /// Adds the hash of one entity. `kind` tells cells from particles from links; `bits` are its raw doubles.
  void add(std::uint32_t kind, std::int64_t id, std::span<double const> bits);
  /// The same for integers or packed words; equal bits give equal hashes.
  void add(std::uint32_t kind, std::int64_t id, std::span<std::uint64_t const> words);
  void add(Digest const& other);  ///< modulo 2^128
  std::string hex() const;        ///< 32 hexadecimal digits
  bool operator==(Digest const&) const = default;
};

}  // namespace brisance::parallel
