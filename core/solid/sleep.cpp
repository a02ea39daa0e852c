#include "core/solid/sleep.hpp"

#include <algorithm>

namespace brisance::solid {
namespace {

constexpr std::size_t blocks_per_chunk = 8;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Adds [first, end) to the list, or makes its last range longer.
template <class Range, class Number>
void append(std::vector<Range>& list, Number first, Number end) {
  if (!list.empty() && list.back().end == first)
    list.back().end = end;
  else
    list.push_back({first, end});
}

}  // namespace

Sleep::Sleep(LinkStore const& links, Index count) : count_(count), blocks_(links.all().end) {
  moved_.assign(at((count + chunk - 1) / chunk), 0);
  awake_ = moved_;
  for (std::size_t from = 0; from < blocks_; from += blocks_per_chunk) {
    first_touched_.push_back(touched_.size());
    std::vector<Index> here;
    for (std::size_t b = from; b < std::min(from + blocks_per_chunk, blocks_); ++b)
      for (auto const& ends : {links.block(b).i, links.block(b).j})
        for (Index const p : ends)
          if (p < count) here.push_back(p / chunk);  // not the wall
    std::sort(here.begin(), here.end());
    here.erase(std::unique(here.begin(), here.end()), here.end());
    touched_.insert(touched_.end(), here.begin(), here.end());
  }
  first_touched_.push_back(touched_.size());
}

Sleep::Particles Sleep::particles(Index c) const { return {c * chunk, std::min((c + 1) * chunk, count_)}; }

void Sleep::wake(Index c) {
  if (moved(c)) return;
  moved_[at(c)] = 1;
  changed_ = true;
}

void Sleep::update() {
  if (!changed_) return;
  changed_ = false;
  opening_.clear(), pulling_.clear(), strained_.clear(), awake_particles_.clear();
  std::vector<char> strained(moved_.size(), 0);
  std::size_t const link_chunks = first_touched_.size() - 1;
  auto const chunks_at = [&](std::size_t l) {
    return std::span(touched_).subspan(first_touched_[l], first_touched_[l + 1] - first_touched_[l]);
  };
  auto const any = [](std::span<Index const> chunks, std::vector<char> const& of) {
    return std::any_of(chunks.begin(), chunks.end(), [&](Index c) { return of[at(c)] != 0; });
  };
  auto const add_links = [&](std::vector<LinkStore::Range>& list, std::size_t l) {
    append(list, l * blocks_per_chunk, std::min((l + 1) * blocks_per_chunk, blocks_));
  };
  for (std::size_t l = 0; l < link_chunks; ++l)
    if (any(chunks_at(l), moved_)) {
      add_links(opening_, l);
      for (Index const c : chunks_at(l)) strained[at(c)] = 1;
    }
  awake_ = moved_;
  for (std::size_t l = 0; l < link_chunks; ++l)
    if (any(chunks_at(l), strained)) {
      add_links(pulling_, l);
      for (Index const c : chunks_at(l)) awake_[at(c)] = 1;
    }
  for (Index c = 0; c < chunks(); ++c) {
    Particles const p = particles(c);
    if (strained[at(c)]) append(strained_, p.first, p.end);
    if (awake_[at(c)]) append(awake_particles_, p.first, p.end);
  }
}

std::int64_t Sleep::pulling_links() const {
  std::int64_t sum = 0;
  for (LinkStore::Range const& r : pulling_) sum += static_cast<std::int64_t>(r.end - r.first) * lanes;
  return sum;
}

}  // namespace brisance::solid
