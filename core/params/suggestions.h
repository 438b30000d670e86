// SPDX-License-Identifier: BSD-2-Clause
// "Did you mean": the known name nearest to one that is not known.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace exphoton {

// Number of insertions, deletions, replacements and swaps of neighbours between two words (optimal
// string alignment), letters compared without regard to case.
int EditDistance(std::string_view a, std::string_view b);

// The nearest of `known`; nullopt where none is near enough to be what was meant: more than a third
// of the letters differ. Ties go to the first.
std::optional<std::string> Nearest(std::string_view name, const std::vector<std::string>& known);

// "did you mean \"perspective\"?", or "" where nothing is near.
std::string DidYouMean(std::string_view name, const std::vector<std::string>& known);

}  // namespace exphoton
