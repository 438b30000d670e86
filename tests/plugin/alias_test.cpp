// SPDX-License-Identifier: BSD-2-Clause
// These tests check that other names of plugins belong to one kind.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/plugins/search.h"

namespace exphoton {
namespace {

TEST(PluginAliases, AreFoundInTheirKindsAlone) {
  const auto all = AllPluginAliases();
  ASSERT_FALSE(all.empty());
  for (const PluginAlias& each : all) {
    for (int i = 0; i < kPluginKindCount; ++i) {
      const auto kind = PluginKind(i);
      const auto wanted = std::find_if(all.begin(), all.end(), [&](const PluginAlias& alias) {
        return alias.kind == kind && std::string(alias.alias) == each.alias;
      });
      const PluginAlias* found = FindPluginAlias(kind, each.alias);
      EXPECT_EQ(found, wanted == all.end() ? nullptr : &*wanted)
          << PluginKindName(kind) << " \"" << each.alias << '"';
    }
  }
}

}  // namespace
}  // namespace exphoton
