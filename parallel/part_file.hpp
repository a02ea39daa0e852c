// The temporary file beside a final name, and what makes it durable. Functions of one process; every failure is an
// Error(system) with the cause.
#pragma once
#include <cstdint>
#include <string>

namespace brisance::parallel {

/// The name a file has until it is complete: in the same folder, so that a rename is atomic.
std::string part_name(std::string const& path);
/// From now on a write beyond the limit on file sizes is an error of this process instead of its end.
void survive_size_limit();
/// Creates or empties the file.
void create_part(std::string const& part);
/// Asks the file system for `bytes` behind the present end, where it can promise them: a full disk shows here.
void reserve(std::string const& part, std::int64_t bytes);
void write_part(std::string const& part, std::string const& content);
/// Waits until the content is on the disk. With data written from several nodes, each calls it.
void sync_part(std::string const& part);
/// Renames to the final name and makes the rename durable.
void publish(std::string const& part, std::string const& path);
void remove_part(std::string const& part) noexcept;

}  // namespace brisance::parallel
