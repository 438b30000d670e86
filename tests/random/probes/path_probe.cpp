// SPDX-License-Identifier: BSD-2-Clause
// ProbeLightPaths traces paths from the lights and computes again the densities of their vertices,
// in the direction of the path and in reverse: the density of the BSDF at the vertex between, times
// the cosine at the other vertex, over the squared distance.
#include <cmath>

#include "core/math/sampling/sampling.h"
#include "integrators/lightpaths/light_path.h"
#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kLightPaths = 24, kMostVertices = 5;
constexpr Real kLeastDistance = Real(.05), kLeastCosine = Real(.05);

// Returns the density per area at `to` with which a path that arrives at `from` along wo goes
// there. Returns a negative number where rounding makes it too inaccurate.
double DensityAt(const ShadingPoint& to, const ShadingPoint& from, const Vector3& wo,
                 LobeSet lobes) {
  const Vector3 step = to.surface.p - from.surface.p;
  const Real distance = Length(step);
  if (distance < kLeastDistance) return -1;
  const Vector3 w = step / distance;
  const Real cosine = AbsDot(w, to.surface.ng);
  if (cosine < kLeastCosine || AbsDot(w, from.surface.ng) < kLeastCosine) return -1;
  return double(from.bsdf.Pdf(wo, w, lobes)) * double(cosine) / std::pow(double(distance), 2);
}

void ExpectDensity(double found, double expected, const char* check, Findings* findings) {
  if (expected < 1e-3) return;
  findings->Expect(std::abs(found - expected) < .02 * expected, check, found, expected);
}

void CheckPath(const LightPath& path, LobeSet lobes, Findings* findings) {
  for (std::size_t i = 1; i + 1 < path.vertices.size(); ++i) {
    const LightPathVertex& before = path.vertices[i - 1];
    const LightPathVertex& middle = path.vertices[i];
    const LightPathVertex& after = path.vertices[i + 1];
    if (middle.densities.isSpecular) continue;
    const Point3& p = middle.point.surface.p;
    const Vector3 back = Normalize(before.point.surface.p - p);
    const Vector3 on = Normalize(after.point.surface.p - p);
    ExpectDensity(after.densities.fromLight, DensityAt(after.point, middle.point, back, lobes),
                  "forward density of a light path", findings);
    ExpectDensity(before.densities.fromCamera, DensityAt(before.point, middle.point, on, lobes),
                  "reverse density of a light path", findings);
  }
}

}  // namespace

void ProbeLightPaths(const ProbedScene& scene, Findings* findings) {
  const LightPathTracer tracer(scene.World(), true);
  if (tracer.IsEmpty()) return;
  const bool hasSpecular = scene.World().Features().Needs(Feature::Specular);
  const LobeSet lobes = hasSpecular ? LobeSet::All : LobeSet::NonSpecular;
  const Interval times = scene.World().Exposure();
  RandomStream random = scene.Stream(33);
  Arena arena;
  RayCounters rays;
  LightPath path;
  for (int i = 0; i < kLightPaths; ++i) {
    LightPathTracer::Emission emission;
    emission.light = random.Uniform();
    emission.position = NextPoint(&random);
    emission.direction = NextPoint(&random);
    emission.part = random.Uniform();
    emission.time = Lerp(random.Uniform(), times.min, times.max);
    tracer.Trace(emission, kMostVertices, {RandomStream(random.Bits()), &arena, &rays}, &path);
    CheckPath(path, lobes, findings);
  }
}

}  // namespace exphoton::random_scenes
