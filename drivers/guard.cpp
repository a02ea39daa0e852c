#include "drivers/guard.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>

#include "parallel/error.hpp"

namespace brisance::drivers {
namespace {

struct Trouble {
  int code = 1;
  std::string message;
};

std::optional<Trouble> attempt(std::function<int()> const& body, int& result) {
  try {
    result = body();
    return std::nullopt;
  } catch (Error const& error) {
    return Trouble{error.exit_code(), error.what()};
  } catch (std::bad_alloc const&) {
    return Trouble{static_cast<int>(Failure::system), "out of memory: use more ranks or a coarser scene"};
  } catch (std::system_error const& error) {  // std::filesystem throws it too
    return Trouble{static_cast<int>(Failure::system), error.what()};
  } catch (std::exception const& error) {
    return Trouble{static_cast<int>(Failure::internal), std::string("internal error: ") + error.what()};
  }
}

/// Ends all ranks after a while, unless it is destroyed before.
class Watchdog {
 public:
  Watchdog(parallel::Comm& comm, Trouble const& trouble) : thread_([this, &comm, &trouble] { watch(comm, trouble); }) {}
  ~Watchdog() {
    {
      std::lock_guard const lock(mutex_);
      done_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  Watchdog(Watchdog const&) = delete;
  Watchdog& operator=(Watchdog const&) = delete;

 private:
  void watch(parallel::Comm& comm, Trouble const& trouble) {
    constexpr std::chrono::seconds patience(
        5);  // ranks that fail together arrive within a collective call of each other
    std::unique_lock lock(mutex_);
    if (wake_.wait_for(lock, patience, [this] { return done_; })) return;
    std::fprintf(stderr, "brisance: error on rank %d alone: %s\n", comm.rank(), trouble.message.c_str());
    std::fflush(stderr);
    comm.abort(trouble.code);
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

/// Waits until all ranks are here, and returns the exit code of rank 0. Messages between two ranks with a tag of their
/// own: a collective call would meet the unrelated one in which a healthy rank may be waiting.
int meet(parallel::Comm& comm, int code) {
  constexpr int tag = 7777;
  std::vector<int> codes(static_cast<std::size_t>(comm.size()), code);
  auto const bytes = [&](int rank) {
    return std::as_writable_bytes(std::span(&codes[static_cast<std::size_t>(rank)], 1));
  };
  std::vector<parallel::Comm::Send> sends;
  std::vector<parallel::Comm::Receive> receives;
  if (comm.rank() != 0) {
    sends.push_back({0, bytes(comm.rank())});
    comm.start(sends, {}, tag)->finish();
    receives.push_back({0, bytes(0)});
    comm.start({}, receives, tag)->finish();
    return codes[0];
  }
  for (int rank = 1; rank < comm.size(); ++rank) receives.push_back({rank, bytes(rank)});
  comm.start({}, receives, tag)->finish();
  for (int rank = 1; rank < comm.size(); ++rank) sends.push_back({rank, bytes(0)});
  comm.start(sends, {}, tag)->finish();
  return code;
}

}  // namespace

int guarded(parallel::Comm& comm, std::function<int()> const& body) {
  int result = 0;
  std::optional<Trouble> const trouble = attempt(body, result);
  if (!trouble) return result;
  if (comm.size() > 1) {
    Watchdog const watchdog(comm, *trouble);
    result = meet(comm, trouble->code);
  } else {
    result = trouble->code;
  }
  spdlog::error("{}", trouble->message);
  return result;
}

}  // namespace brisance::drivers
