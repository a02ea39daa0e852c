#include "parallel/part_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "parallel/error.hpp"

namespace brisance::parallel {
namespace {

[[noreturn]] void fail(char const* what, int code) {
  throw Error(Failure::system, std::string(what) + ": " + std::generic_category().message(code));
}

/// A file descriptor. Errors of `close` count: some file systems report a failed write only there.
class Descriptor {
 public:
  Descriptor(std::string const& path, int flags) : id_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (id_ < 0) fail("cannot open it", errno);
  }
  ~Descriptor() {
    if (id_ >= 0) ::close(id_);
  }
  Descriptor(Descriptor const&) = delete;
  Descriptor& operator=(Descriptor const&) = delete;
  int get() const { return id_; }
  void sync() const {
    while (::fsync(id_) != 0)
      if (errno != EINTR) fail("cannot flush it to the disk", errno);
  }
  void close() {
    int const id = id_;
    id_ = -1;
    if (::close(id) != 0) fail("cannot close it", errno);
  }

 private:
  int id_;
};

}  // namespace

std::string part_name(std::string const& path) { return path + ".part"; }

void survive_size_limit() { std::signal(SIGXFSZ, SIG_IGN); }

void create_part(std::string const& part) {
  Descriptor file(part, O_RDWR | O_CREAT | O_TRUNC);
  file.close();
}

void reserve(std::string const& part, std::int64_t bytes) {
  Descriptor file(part, O_RDWR);
  struct stat about {};
  if (::fstat(file.get(), &about) != 0) fail("cannot inspect it", errno);
  while (::fallocate(file.get(), 0, about.st_size, bytes) != 0) {
    if (errno == EOPNOTSUPP || errno == ENOSYS) break;  // no promise to be had; the writes themselves will tell
    if (errno != EINTR) fail("cannot get space for it", errno);
  }
  file.close();
}

void write_part(std::string const& part, std::string const& content) {
  Descriptor file(part, O_WRONLY);
  for (std::size_t at = 0; at != content.size();) {
    ssize_t const written = ::write(file.get(), content.data() + at, content.size() - at);
    if (written >= 0) at += static_cast<std::size_t>(written);
    if (written < 0 && errno != EINTR) fail("cannot write it", errno);
  }
  file.sync();
  file.close();
}

void sync_part(std::string const& part) {
  Descriptor file(part, O_RDWR);
  file.sync();
  file.close();
}

void publish(std::string const& part, std::string const& path) {
  if (std::rename(part.c_str(), path.c_str()) != 0) fail("cannot give it its name", errno);
  std::size_t const slash = path.rfind('/');
  Descriptor folder(slash == std::string::npos ? "." : path.substr(0, slash + 1), O_RDONLY | O_DIRECTORY);
  folder.sync();
  folder.close();
}

void remove_part(std::string const& part) noexcept { ::unlink(part.c_str()); }

}  // namespace brisance::parallel
