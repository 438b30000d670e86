// SPDX-License-Identifier: BSD-2-Clause
// Sums over groups of passes are kept in a limited number of places, which limits memory.
#pragma once

namespace exphoton {

// Returns the place of a group. Groups with a number above the last place share the places by
// turns. A first place that holds joined groups (JoinGroups) is not shared: it would otherwise
// contain later groups, which are independent of the joined ones. places: at least 2.
constexpr int PlaceOfGroup(int group, int places, bool isFirstJoined) {
  const int first = isFirstJoined ? 1 : 0;
  return group < places ? group : first + (group - first) % (places - first);
}

}  // namespace exphoton
