// What a program knows of other processes. Every call is collective unless it says otherwise: all ranks reach the calls
// in the same order. Moves bytes; knows no physics. Two forms: serial (tests, one rank) and MPI.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "parallel/digest.hpp"
#include "parallel/exact_sum.hpp"

namespace brisance::parallel {

using Bytes = std::vector<std::byte>;

/// One message of known or unknown partners.
struct Message {
  int rank = 0;  ///< destination when given, source when received
  Bytes data;
};

class Comm {
 public:
  virtual ~Comm() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;

  /// Element-wise, in place. -0 < +0, and a NaN on any rank gives NaN: the same bits whatever the order of the ranks.
  virtual void min(std::span<double> values) = 0;
  virtual void max(std::span<double> values) = 0;
  virtual void sum(std::span<std::int64_t> values) = 0;  ///< integers: exact in any order
  virtual void bit_or(std::span<std::uint64_t> values) = 0;
  virtual void sum(std::span<ExactSum> sums) = 0;  ///< exact, same bits on every rank
  virtual void sum(Digest& digest) = 0;            ///< modulo 2^128
  virtual void barrier() = 0;
  virtual void broadcast(Bytes& data, int root) = 0;                   ///< resizes on the receivers
  virtual std::vector<Bytes> gather(Bytes const& mine, int root) = 0;  ///< at root: one per rank, in rank order
  virtual std::vector<Bytes> all_gather(Bytes const& mine) = 0;

  /// Sparse messages whose receivers do not know their senders. Messages to oneself are allowed and come back too.
  /// Returns the received ones sorted by source rank; several from one source keep their order.
  virtual std::vector<Message> deliver(std::vector<Message> outgoing) = 0;

  /// Non-blocking exchange with known partners: buffers must outlive `finish`. One message per partner and tag. A
  /// receive that is at most `longest_variable` bytes long takes shorter messages too, which must tell their length
  /// themselves; a longer one has the length of its message.
  static constexpr std::size_t longest_variable = std::size_t{1} << 30;
  struct Send {
    int rank;
    std::span<std::byte const> data;
  };
  struct Receive {
    int rank;
    std::span<std::byte> data;
  };
  class Pending {
   public:
    virtual ~Pending() = default;  ///< never finished (an exception is on its way): receives nothing more
    virtual void finish() = 0;     ///< waits for all sends and receives; not collective
  };
  virtual std::unique_ptr<Pending> start(std::span<Send const> sends, std::span<Receive const> receives, int tag) = 0;

  /// Ends all ranks at once with this exit code; for a failure of one rank alone, after it has said why. Never returns.
  [[noreturn]] virtual void abort(int exit_code) = 0;

  /// The MPI_Comm behind this form, null in the serial one. For the archive, which hands it to HDF5.
  virtual void* native() { return nullptr; }
};

/// One rank, no MPI.
std::unique_ptr<Comm> serial();
/// MPI_COMM_WORLD. Initialises MPI on first use and finalises it when the program ends. Errors of MPI become
/// Error(system).
std::unique_ptr<Comm> world(int& argc, char**& argv);

/// Appends trivially copyable records to a byte buffer, and reads them back in order.
template <class T>
void put(Bytes& out, T const& record) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::size_t const at = out.size();
  out.resize(at + sizeof(T));
  std::memcpy(out.data() + at, &record, sizeof(T));
}
template <class T>
T take(std::span<std::byte const>& in) {
  static_assert(std::is_trivially_copyable_v<T>);
  T record;
  std::memcpy(&record, in.data(), sizeof(T));
  in = in.subspan(sizeof(T));
  return record;
}

}  // namespace brisance::parallel
