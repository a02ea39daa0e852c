// The form of Comm over MPI.
#include <mpi.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>

#include "parallel/comm.hpp"
#include "parallel/error.hpp"

namespace brisance::parallel {
namespace {

/// MPI counts are ints: longer messages travel in pieces of this size. A whole piece announces another one.
constexpr std::size_t piece_size = Comm::longest_variable;
constexpr int mail_tag = 1, gather_tag = 2;

void check(int code, char const* call) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw Error(Failure::system, std::string("MPI failed in ") + call + ": " + std::string(text, length) +
                                   ". The ranks can no longer talk to each other; restart from the last checkpoint.");
}

/// MPI from the first use to the end of the program.
class Session {
 public:
  Session(int& argc, char**& argv) {
    int running = 0;
    MPI_Initialized(&running);
    if (running) return;
    int provided = 0;
    check(MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_set_errhandler(MPI_COMM_SELF, MPI_ERRORS_RETURN);
  }
  ~Session() {
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended) MPI_Finalize();
  }
  Session(Session const&) = delete;
  Session& operator=(Session const&) = delete;
};

/// A communicator of our own: traffic in one never meets traffic in another.
class Channel {
 public:
  Channel() {
    check(MPI_Comm_dup(MPI_COMM_WORLD, &comm_), "MPI_Comm_dup");
    MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN);
  }
  ~Channel() {
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended) MPI_Comm_free(&comm_);
  }
  Channel(Channel const&) = delete;
  Channel& operator=(Channel const&) = delete;
  MPI_Comm get() const { return comm_; }
  MPI_Comm* address() { return &comm_; }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

/// Order-preserving map of doubles to integers, so that MPI_MIN needs no rule for -0 and NaN. Its own inverse.
std::int64_t as_ordered(double x) {
  auto const bits = std::bit_cast<std::int64_t>(x);
  return bits < 0 ? bits ^ std::numeric_limits<std::int64_t>::max() : bits;
}
double from_ordered(std::int64_t key) {
  return std::bit_cast<double>(key < 0 ? key ^ std::numeric_limits<std::int64_t>::max() : key);
}

class Exchange final : public Comm::Pending {
 public:
  explicit Exchange(std::size_t messages) { requests_.reserve(messages); }
  ~Exchange() override {
    // Only an exception leads here with open requests. A receive is cancelled, or MPI would write into freed memory;
    // waiting for a send could hang, since its receiver may be the rank that failed.
    for (std::size_t k = 0; k != requests_.size(); ++k) {
      if (requests_[k] == MPI_REQUEST_NULL) continue;
      if (k < receives_) {
        MPI_Cancel(&requests_[k]);
        MPI_Wait(&requests_[k], MPI_STATUS_IGNORE);
      } else {
        MPI_Request_free(&requests_[k]);
      }
    }
  }
  Exchange(Exchange const&) = delete;
  Exchange& operator=(Exchange const&) = delete;

  /// All receives come before the first send.
  void receive(MPI_Comm comm, std::span<std::byte> data, int rank, int tag) {
    for (std::size_t at = 0; at == 0 || at < data.size(); at += piece_size) {
      int const count = static_cast<int>(std::min(piece_size, data.size() - at));
      check(MPI_Irecv(data.data() + at, count, MPI_BYTE, rank, tag, comm, &requests_.emplace_back(MPI_REQUEST_NULL)),
            "MPI_Irecv");
    }
    receives_ = requests_.size();
  }
  void send(MPI_Comm comm, std::span<std::byte const> data, int rank, int tag) {
    for (std::size_t at = 0; at == 0 || at < data.size(); at += piece_size) {
      int const count = static_cast<int>(std::min(piece_size, data.size() - at));
      check(MPI_Isend(data.data() + at, count, MPI_BYTE, rank, tag, comm, &requests_.emplace_back(MPI_REQUEST_NULL)),
            "MPI_Isend");
    }
  }
  void finish() override {
    check(MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
    requests_.clear();
  }

 private:
  std::vector<MPI_Request> requests_;
  std::size_t receives_ = 0;
};

class Mpi final : public Comm {
 public:
  Mpi() {
    MPI_Comm_rank(collective_.get(), &rank_);
    MPI_Comm_size(collective_.get(), &size_);
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void min(std::span<double> values) override { extreme(values, MPI_MIN, std::numeric_limits<std::int64_t>::min()); }
  void max(std::span<double> values) override { extreme(values, MPI_MAX, std::numeric_limits<std::int64_t>::max()); }
  void sum(std::span<std::int64_t> values) override { reduce(values.data(), values.size(), MPI_INT64_T, MPI_SUM); }
  void bit_or(std::span<std::uint64_t> values) override { reduce(values.data(), values.size(), MPI_UINT64_T, MPI_BOR); }

  void sum(std::span<ExactSum> sums) override {
    std::vector<std::int64_t> limbs;
    limbs.reserve(sums.size() * ExactSum::limbs);
    for (ExactSum& sum : sums) limbs.insert(limbs.end(), sum.raw().begin(), sum.raw().end());
    reduce(limbs.data(), limbs.size(), MPI_INT64_T, MPI_SUM);
    auto from = limbs.begin();
    for (ExactSum& sum : sums) {
      std::copy_n(from, ExactSum::limbs, sum.raw().begin());
      from += ExactSum::limbs;
    }
  }

  void sum(Digest& digest) override {
    // 32-bit parts: the carries of up to 2^32 ranks are kept, then propagated modulo 2^128.
    constexpr std::uint64_t mask = 0xffffffffu;
    std::uint64_t parts[4] = {digest.low & mask, digest.low >> 32, digest.high & mask, digest.high >> 32};
    reduce(parts, 4, MPI_UINT64_T, MPI_SUM);
    for (int k = 0; k != 3; ++k) parts[k + 1] += parts[k] >> 32;
    digest.low = (parts[0] & mask) | (parts[1] << 32);
    digest.high = (parts[2] & mask) | (parts[3] << 32);
  }

  void barrier() override { check(MPI_Barrier(collective_.get()), "MPI_Barrier"); }

  void broadcast(Bytes& data, int root) override {
    std::uint64_t length = data.size();
    check(MPI_Bcast(&length, 1, MPI_UINT64_T, root, collective_.get()), "MPI_Bcast");
    data.resize(length);
    for (std::size_t at = 0; at < length; at += piece_size) {
      int const count = static_cast<int>(std::min(piece_size, data.size() - at));
      check(MPI_Bcast(data.data() + at, count, MPI_BYTE, root, collective_.get()), "MPI_Bcast");
    }
  }

  std::vector<Bytes> gather(Bytes const& mine, int root) override {
    if (rank_ != root) {
      Exchange sending(1);
      post(sending, mine, root, gather_tag);
      sending.finish();
      return {};
    }
    std::vector<Bytes> all(static_cast<std::size_t>(size_));
    for (int source = 0; source != size_; ++source)
      all[static_cast<std::size_t>(source)] = source == rank_ ? mine : collect(source, gather_tag);
    return all;
  }

  std::vector<Bytes> all_gather(Bytes const& mine) override {
    auto const ranks = static_cast<std::size_t>(size_);
    std::uint64_t const length = mine.size();
    std::vector<std::uint64_t> lengths(ranks);
    check(MPI_Allgather(&length, 1, MPI_UINT64_T, lengths.data(), 1, MPI_UINT64_T, collective_.get()), "MPI_Allgather");
    std::uint64_t total = 0;
    for (std::uint64_t const n : lengths) total += n;
    std::vector<Bytes> all(ranks);
    if (total > piece_size) {
      all[static_cast<std::size_t>(rank_)] = mine;
      for (int root = 0; root != size_; ++root) broadcast(all[static_cast<std::size_t>(root)], root);
      return all;
    }
    std::vector<int> counts(ranks), starts(ranks);
    for (std::size_t r = 0, at = 0; r != ranks; at += lengths[r++]) {
      counts[r] = static_cast<int>(lengths[r]);
      starts[r] = static_cast<int>(at);
    }
    Bytes joined(total);
    check(MPI_Allgatherv(mine.data(), static_cast<int>(length), MPI_BYTE, joined.data(), counts.data(), starts.data(),
                         MPI_BYTE, collective_.get()),
          "MPI_Allgatherv");
    for (std::size_t r = 0; r != ranks; ++r)
      all[r].assign(joined.begin() + starts[r], joined.begin() + starts[r] + counts[r]);
    return all;
  }

  std::vector<Message> deliver(std::vector<Message> outgoing) override {
    std::vector<int> to(static_cast<std::size_t>(size_)), from(static_cast<std::size_t>(size_));
    for (Message const& message : outgoing) {
      expect_rank(message.rank);
      ++to[static_cast<std::size_t>(message.rank)];
    }
    check(MPI_Alltoall(to.data(), 1, MPI_INT, from.data(), 1, MPI_INT, mail_.get()), "MPI_Alltoall");
    Exchange sending(outgoing.size());
    for (Message const& message : outgoing)
      if (message.rank != rank_) post(sending, message.data, message.rank, mail_tag);
    std::vector<Message> received;
    for (int source = 0; source != size_; ++source) {
      if (source == rank_) {
        for (Message& message : outgoing)
          if (message.rank == rank_) received.push_back(std::move(message));
        continue;
      }
      for (int k = 0; k != from[static_cast<std::size_t>(source)]; ++k)
        received.push_back({source, collect(source, mail_tag)});
    }
    sending.finish();
    return received;
  }

  std::unique_ptr<Pending> start(std::span<Send const> sends, std::span<Receive const> receives, int tag) override {
    auto exchange = std::make_unique<Exchange>(sends.size() + receives.size());
    for (Receive const& receive : receives) {
      expect_rank(receive.rank);
      exchange->receive(exchange_.get(), receive.data, receive.rank, tag);
    }
    for (Send const& send : sends) {
      expect_rank(send.rank);
      exchange->send(exchange_.get(), send.data, send.rank, tag);
    }
    return exchange;
  }

  [[noreturn]] void abort(int exit_code) override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

  void* native() override { return collective_.address(); }

 private:
  void expect_rank(int rank) const {
    require(rank >= 0 && rank < size_, Failure::internal,
            "a message to or from rank " + std::to_string(rank) + " of " + std::to_string(size_));
  }

  void reduce(void* values, std::size_t count, MPI_Datatype type, MPI_Op op) {
    check(MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(count), type, op, collective_.get()), "MPI_Allreduce");
  }

  void extreme(std::span<double> values, MPI_Op op, std::int64_t nan_key) {
    std::vector<std::int64_t> keys;
    keys.reserve(values.size());
    for (double const x : values) keys.push_back(x != x ? nan_key : as_ordered(x));
    reduce(keys.data(), keys.size(), MPI_INT64_T, op);
    for (std::size_t k = 0; k != keys.size(); ++k)
      values[k] = keys[k] == nan_key ? std::numeric_limits<double>::quiet_NaN() : from_ordered(keys[k]);
  }

  /// A message whose receiver does not know its length: see `collect`.
  void post(Exchange& sending, Bytes const& data, int rank, int tag) {
    sending.send(mail_.get(), data, rank, tag);
    if (!data.empty() && data.size() % piece_size == 0) sending.send(mail_.get(), {}, rank, tag);
  }

  Bytes collect(int source, int tag) {
    Bytes data;
    for (std::size_t got = piece_size; got == piece_size;) {
      MPI_Message message;
      MPI_Status status;
      check(MPI_Mprobe(source, tag, mail_.get(), &message, &status), "MPI_Mprobe");
      int count = 0;
      check(MPI_Get_count(&status, MPI_BYTE, &count), "MPI_Get_count");
      std::size_t const at = data.size();
      got = static_cast<std::size_t>(count);
      data.resize(at + got);
      check(MPI_Mrecv(data.data() + at, count, MPI_BYTE, &message, &status), "MPI_Mrecv");
    }
    return data;
  }

  Channel collective_, mail_, exchange_;
  int rank_ = 0, size_ = 1;
};

}  // namespace

std::unique_ptr<Comm> world(int& argc, char**& argv) {
  static Session const session(argc, argv);
  return std::make_unique<Mpi>();
}

}  // namespace brisance::parallel
