// SPDX-License-Identifier: BSD-2-Clause
// LightPathTracer traces paths from lights over surfaces. Unlike PhotonTracer, it keeps every
// vertex with its BSDF, so that a vertex can be connected to a point that the camera sees.
// Instant radiosity and bidirectional path tracing use it. Sources: Keller 1997, "Instant
// Radiosity"; Veach 1997, sections 5.3 (shading normals) and 10.2.
#pragma once

#include <vector>

#include "core/lights/selection/light_selection.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

// Densities of a path for multiple importance sampling. A vertex has density `fromCamera` if the
// camera path makes it, and `fromLight` if the light path does, both per unit of area. A vertex on
// an infinite light has densities per solid angle. Specular scattering counts with density 1.
struct VertexDensities {
  double fromCamera = 0, fromLight = 0;
  bool isSpecular = false;  // scatters at a specular lobe in this path
};

// A surface point of a light path. point.surface.wo points to the vertex before it.
struct LightPathVertex {
  ShadingPoint point;
  Spectrum alpha;  // power that arrives, divided by the density of the path; in watts
  VertexDensities densities;
  // |cos| / distance^2 at the vertex before this one: converts a density per solid angle here into
  // a density per area there. 1 if the vertex before is infinitely far away.
  double toPrevious = 1;
};

struct LightPath {
  const Light* light = nullptr;  // null: no light was emitted
  SurfacePoint onLight;          // of an area light
  bool isOnSurface = false;      // whether onLight is set
  VertexDensities origin;        // of the vertex on the light
  std::vector<LightPathVertex> vertices;
};

class LightPathTracer {
 public:
  LightPathTracer() = default;  // traces nothing
  // The scene must outlive this object. Lights are chosen by power. If isWeighted, the paths
  // compete with camera paths, and end where IsBetweenNormals holds.
  LightPathTracer(const Scene& scene, bool isWeighted);

  bool IsEmpty() const { return !scene_ || lights_->IsEmpty(); }

  // The uniform random numbers of an emission, in [0,1), and its time.
  struct Emission {
    Real light = 0;
    Point2 position, direction;
    Real part = 0;
    Real time = 0;
  };
  // The data that a thread uses while it traces a path.
  struct Workspace {
    RandomStream random;
    Arena* arena;  // for the BSDFs
    RayCounters* rays;
  };
  // Clears *path and traces a path with at most mostVertices surface points. Russian roulette
  // begins after three surface points.
  void Trace(const Emission& emission, int mostVertices, Workspace workspace,
             LightPath* path) const;

  // The densities of a path's beginning: of the vertex on the light, and of the next vertex x, the
  // latter per area at x. `on` is the point on an area light; null for other lights. w points from
  // the light to x, with length 1.
  struct BeginningDensities {
    double onLight = 0, next = 0;
  };
  BeginningDensities Beginning(const Light& light, const SurfacePoint* on, const Vector3& w,
                               const SurfacePoint& x, Real distance) const;

 private:
  bool Begin(const Light& light, const Ray& ray, const SurfaceInteraction& hit, RayCounters* rays,
             LightPath* path) const;
  bool Scatter(LightPath* path, RandomStream* random, Ray* ray, Spectrum* alpha, double* pdf) const;

  const Scene* scene_ = nullptr;
  bool isWeighted_ = true;
  LobeSet lobes_ = LobeSet::All;
  std::unique_ptr<const FixedLightSampler> lights_;
};

// Returns whether the geometric and the shading normal disagree about the side of w. Weighted light
// paths end where they do for a direction of the path; camera paths carry this light.
inline bool IsBetweenNormals(const Bsdf& bsdf, const Vector3& w) {
  return (Dot(w, bsdf.Ng()) > 0) != (Dot(w, bsdf.Ns()) > 0);
}

// Returns the density per solid angle with which a light path that arrives from toLight leaves in
// direction toCamera. Non-specular lobes only.
double DensityFromLight(const Bsdf& bsdf, const Vector3& toLight, const Vector3& toCamera,
                        LobeSet lobes);

// Returns the BSDF of a light path's vertex towards the camera, with the factor |wi.ns| / |wi.ng|
// of the power that arrives from its wo (Veach 1997, eq. 5.19). toCamera may lie between the two
// normals, as in Bsdf::f.
Spectrum AdjointBsdf(const ShadingPoint& vertex, const Vector3& toCamera, LobeSet lobes);

}  // namespace exphoton
