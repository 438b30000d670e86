// SPDX-License-Identifier: BSD-2-Clause
// SceneLimits holds totals beyond which a scene file is refused, because a few lines of text can
// request more work than any machine can do. The defaults lie far above real scenes. Limits of
// single values (depths, lengths) are constants in the code that checks them.
#pragma once

#include <cstdint>

namespace exphoton {

struct SceneLimits {
  std::int64_t includes = 100'000;        // files opened by Include; repeats count
  std::int64_t textureNodes = 1'000'000;  // textures that one lookup may evaluate
};

}  // namespace exphoton
