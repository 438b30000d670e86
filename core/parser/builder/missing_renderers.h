// SPDX-License-Identifier: BSD-2-Clause
// kMissingRenderers lists the renderers of version 2 that are not available, with the integrators
// that are used in their place.
#pragma once

namespace exphoton {

struct MissingRenderer {
  const char* name;
  const char* integrator;  // used in its place; null: the file's
  const char* loss;        // what the user loses, for a warning
};
inline constexpr MissingRenderer kMissingRenderers[] = {
    {"metropolis", "path", "hidden light is noisier"},
    {"createprobes", nullptr, "no probes are written; the picture is rendered"},
    {"surfacepoints", nullptr, "no points are written; the picture is rendered"},
    {"aggregatetest", nullptr, "nothing is tested; the picture is rendered"}};

}  // namespace exphoton
