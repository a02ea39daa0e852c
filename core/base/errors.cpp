#include "core/base/errors.hpp"

#include <algorithm>

namespace brisance {

int edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table of optimal string alignment: row i holds the distances of a[0, i) to all prefixes of b.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      int const replaced = last[j - 1] + (a[i - 1] != b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      bool const swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest(std::string_view word, std::vector<std::string> const& known) {
  std::string best;
  int best_distance = -1;
  for (std::string const& candidate : known) {
    int const distance = edit_distance(word, candidate);
    if (best_distance < 0 || distance < best_distance) best = candidate, best_distance = distance;
  }
  return best;
}

std::string joined(std::vector<std::string> const& words, std::string_view separator) {
  std::string text;
  for (std::string const& word : words) {
    if (&word != &words.front()) text += separator;
    text += word;
  }
  return text;
}

void scene_error(Location const& at, std::string const& message) {
  throw Error(Failure::scene, at.text() + ": " + message);
}

}  // namespace brisance
