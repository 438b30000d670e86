// SPDX-License-Identifier: BSD-2-Clause
// EditDistance by dynamic programming over three rows, and the suggestions based on it.
#include "core/params/suggestions.h"

#include <algorithm>

namespace exphoton {
namespace {

constexpr std::size_t kMaxSuggestedLength = 64;  // longer names are not typing mistakes

char Lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

}  // namespace

int EditDistance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = int(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = int(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const char x = Lower(a[i - 1]), y = Lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (x == y ? 0 : 1)});
      if (i > 1 && j > 1 && x == Lower(b[j - 2]) && Lower(a[i - 2]) == y)
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> Nearest(std::string_view name, const std::vector<std::string>& known) {
  if (name.size() > kMaxSuggestedLength) return std::nullopt;
  std::optional<std::string> nearest;
  int best = std::max(1, int(name.size()) / 3) + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() > kMaxSuggestedLength) continue;
    const int distance = EditDistance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string DidYouMean(std::string_view name, const std::vector<std::string>& known) {
  const std::optional<std::string> nearest = Nearest(name, known);
  return nearest ? "did you mean \"" + *nearest + "\"?" : std::string();
}

}  // namespace exphoton
