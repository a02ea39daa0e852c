// The exceptions of the whole code. A message says what, where, why and what to try; the kind sets the exit code.
#pragma once
#include <stdexcept>
#include <string>

namespace brisance {

/// Exit codes of the contract.
enum class Failure { internal = 1, scene = 2, numerical = 3, system = 4 };

class Error : public std::runtime_error {
 public:
  Error(Failure kind, std::string const& message) : std::runtime_error(message), kind_(kind) {}
  Failure kind() const { return kind_; }
  int exit_code() const { return static_cast<int>(kind_); }

 private:
  Failure kind_;
};

/// Throws an Error of `kind` unless `ok`. Always on; not for hot loops.
inline void require(bool ok, Failure kind, std::string const& message) {
  if (!ok) throw Error(kind, message);
}

}  // namespace brisance
