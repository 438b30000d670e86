// SPDX-License-Identifier: BSD-2-Clause
// SceneLimits: totals beyond which a scene file is refused, because a few lines of it can ask for
// more work than any machine does. They lie far above real scenes. Limits of single values (depths,
// lengths) are constants where they are checked.
#pragma once

#include <cstdint>

namespace exphoton {

struct SceneLimits {
  std::int64_t includes = 100'000;        // files that Include opens, each counted every time
  std::int64_t textureNodes = 1'000'000;  // textures that one lookup may evaluate
};

}  // namespace exphoton
