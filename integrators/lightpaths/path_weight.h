// SPDX-License-Identifier: BSD-2-Clause
// PathWeight computes the weight of one technique of bidirectional path tracing: the power
// heuristic over all techniques that make the same path (Veach 1997, section 10.2). Technique s
// takes s vertices from the light path and the others from the camera path.
#pragma once

#include <span>

#include "integrators/lightpaths/light_path.h"

namespace exphoton {

// A path from the camera to a light, without the camera. vertices[0] is the first surface point and
// the last vertex lies on the light.
struct WholePath {
  std::span<const VertexDensities> vertices;
  // Density with which direct lighting makes the vertex on the light, in the measure of the last
  // vertex's densities. Technique 1 uses it instead of `fromLight`.
  double direct = 0;
  bool isDeltaLight = false;   // technique 0 cannot hit the light
  bool hasLightPaths = false;  // whether techniques from 2 on are used
};

// Returns the weight of technique s, in [0,1]. The path has at least s + 1 vertices, since no
// technique connects a light path to the camera itself.
double PathWeight(const WholePath& path, int s);

}  // namespace exphoton
