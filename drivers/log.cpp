#include "drivers/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace brisance::drivers {
namespace {

/// Plain messages on stdout; warnings and errors belong to stderr.
class OutputSink final : public spdlog::sinks::stdout_sink_mt {
 public:
  void log(spdlog::details::log_msg const& message) override {
    if (message.level < spdlog::level::warn) spdlog::sinks::stdout_sink_mt::log(message);
  }
};

}  // namespace

void start_log(parallel::Comm const& comm, bool quiet) {
  auto const output = std::make_shared<OutputSink>();
  output->set_pattern("%v");
  output->set_level(quiet ? spdlog::level::off : spdlog::level::info);
  auto const errors = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  errors->set_pattern("brisance: %l: %v");
  errors->set_level(spdlog::level::warn);
  auto const logger = std::make_shared<spdlog::logger>("brisance", spdlog::sinks_init_list{output, errors});
  logger->set_level(comm.rank() == 0 ? spdlog::level::info : spdlog::level::off);
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

void log_to_file(std::string const& path) {
  auto const logger = spdlog::default_logger();
  if (logger->level() == spdlog::level::off) return;
  auto const file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path);
  file->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  logger->sinks().push_back(file);
}

}  // namespace brisance::drivers
