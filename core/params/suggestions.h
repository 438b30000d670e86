// SPDX-License-Identifier: BSD-2-Clause
// "Did you mean": finds the known name nearest to an unknown name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace exphoton {

// Returns the number of insertions, deletions, replacements and swaps of neighbours between two
// words (optimal string alignment). Case is ignored.
int EditDistance(std::string_view a, std::string_view b);

// Returns the nearest of `known`; ties go to the first. Returns nullopt if more than a third of the
// letters of the nearest name differ; a single difference is always accepted.
std::optional<std::string> Nearest(std::string_view name, const std::vector<std::string>& known);

// Returns "did you mean \"perspective\"?", or "" if no name is near.
std::string DidYouMean(std::string_view name, const std::vector<std::string>& known);

}  // namespace exphoton
