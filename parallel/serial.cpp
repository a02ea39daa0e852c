// The form of Comm for one rank without MPI.
#include <algorithm>
#include <cstdlib>

#include "parallel/comm.hpp"
#include "parallel/error.hpp"

namespace brisance::parallel {
namespace {

class Done final : public Comm::Pending {
 public:
  void finish() override {}
};

class Serial final : public Comm {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }

  void min(std::span<double>) override {}
  void max(std::span<double>) override {}
  void sum(std::span<std::int64_t>) override {}
  void bit_or(std::span<std::uint64_t>) override {}
  void sum(std::span<ExactSum>) override {}
  void sum(Digest&) override {}
  void barrier() override {}
  void broadcast(Bytes&, int) override {}
  std::vector<Bytes> gather(Bytes const& mine, int) override { return {mine}; }
  std::vector<Bytes> all_gather(Bytes const& mine) override { return {mine}; }

  std::vector<Message> deliver(std::vector<Message> outgoing) override {
    for (Message const& message : outgoing) expect_myself(message.rank);
    return outgoing;
  }

  std::unique_ptr<Pending> start(std::span<Send const> sends, std::span<Receive const> receives, int) override {
    require(sends.size() == receives.size(), Failure::internal, "exchange: sends and receives do not pair");
    for (std::size_t k = 0; k != sends.size(); ++k) {
      expect_myself(sends[k].rank);
      expect_myself(receives[k].rank);
      require(sends[k].data.size() == receives[k].data.size(), Failure::internal,
              "exchange: sizes of send and receive differ");
      std::copy(sends[k].data.begin(), sends[k].data.end(), receives[k].data.begin());
    }
    return std::make_unique<Done>();
  }

  [[noreturn]] void abort(int exit_code) override { std::_Exit(exit_code); }

 private:
  static void expect_myself(int rank) {
    require(rank == 0, Failure::internal, "a message to rank " + std::to_string(rank) + " of 1");
  }
};

}  // namespace

std::unique_ptr<Comm> serial() { return std::make_unique<Serial>(); }

}  // namespace brisance::parallel
