#include "core/solid/halo.hpp"

#include <algorithm>
#include <map>

namespace brisance::solid {
namespace {

constexpr std::size_t row = 13;  // x 3, q 4, v 3, omega 3
constexpr int tag = 301, rows_tag = 302;

}  // namespace

void Halo::connect(parallel::Comm& comm, std::span<Ghost const> ghosts, std::span<Index const> local) {
  std::map<int, parallel::Message> wanted;
  std::map<int, Partner> from;
  for (Ghost const& g : ghosts) {
    parallel::Message& m = wanted[g.owner];
    m.rank = g.owner;
    parallel::put(m.data, g.id);
    from[g.owner].particles.push_back(g.local);
  }
  std::vector<parallel::Message> outgoing;
  for (auto& [rank, message] : wanted) outgoing.push_back(std::move(message));
  to_.clear(), from_.clear();
  for (auto const& message : comm.deliver(std::move(outgoing))) {
    Partner p{message.rank, {}, {}};
    std::span<std::byte const> data = message.data;
    while (!data.empty()) p.particles.push_back(local[static_cast<std::size_t>(parallel::take<GlobalId>(data))]);
    p.buffer.resize(row * p.particles.size());
    to_.push_back(std::move(p));
  }
  for (auto& [rank, p] : from) {
    p.rank = rank;
    p.buffer.resize(row * p.particles.size());
    from_.push_back(std::move(p));
  }
}

void Halo::start(parallel::Comm& comm, std::span<Pose const> pose, std::span<HalfVelocity const> half) {
  if (to_.empty() && from_.empty()) return;
  std::vector<parallel::Comm::Send> sends;
  std::vector<parallel::Comm::Receive> receives;
  for (Partner& p : to_) {
    double* out = p.buffer.data();
    for (Index local : p.particles) {
      Pose const& a = pose[static_cast<std::size_t>(local)];
      HalfVelocity const& h = half[static_cast<std::size_t>(local)];
      for (double value : {a.x.x, a.x.y, a.x.z, a.q.w, a.q.v.x, a.q.v.y, a.q.v.z, h.v.x, h.v.y, h.v.z, h.omega.x,
                           h.omega.y, h.omega.z})
        *out++ = value;
    }
    sends.push_back({p.rank, std::as_bytes(std::span(p.buffer))});
  }
  for (Partner& p : from_) receives.push_back({p.rank, std::as_writable_bytes(std::span(p.buffer))});
  pending_ = comm.start(sends, receives, tag);
}

void Halo::finish(std::span<Pose> pose, std::span<HalfVelocity> half) {
  if (!pending_) return;
  pending_->finish();
  pending_.reset();
  for (Partner const& p : from_) {
    double const* in = p.buffer.data();
    for (Index local : p.particles) {
      Pose& a = pose[static_cast<std::size_t>(local)];
      HalfVelocity& h = half[static_cast<std::size_t>(local)];
      a.x = {in[0], in[1], in[2]};
      a.q = {in[3], {in[4], in[5], in[6]}};
      h.v = {in[7], in[8], in[9]};
      h.omega = {in[10], in[11], in[12]};
      in += row;
    }
  }
}

void Halo::exchange_rows(parallel::Comm& comm, std::span<double> rows, std::size_t width) {
  if (to_.empty() && from_.empty()) return;
  std::vector<std::vector<double>> out, in;
  for (Partner const& p : to_) {
    auto& buffer = out.emplace_back();
    buffer.reserve(width * p.particles.size());
    for (Index local : p.particles) {
      auto const row = rows.subspan(width * static_cast<std::size_t>(local), width);
      buffer.insert(buffer.end(), row.begin(), row.end());
    }
  }
  for (Partner const& p : from_) in.emplace_back(width * p.particles.size());
  std::vector<parallel::Comm::Send> sends;
  std::vector<parallel::Comm::Receive> receives;
  for (std::size_t n = 0; n < to_.size(); ++n) sends.push_back({to_[n].rank, std::as_bytes(std::span(out[n]))});
  for (std::size_t n = 0; n < from_.size(); ++n)
    receives.push_back({from_[n].rank, std::as_writable_bytes(std::span(in[n]))});
  comm.start(sends, receives, rows_tag)->finish();
  for (std::size_t n = 0; n < from_.size(); ++n) {
    double const* row = in[n].data();
    for (Index local : from_[n].particles) {
      std::copy_n(row, width, rows.begin() + static_cast<std::ptrdiff_t>(width * static_cast<std::size_t>(local)));
      row += width;
    }
  }
}

}  // namespace brisance::solid
