// SPDX-License-Identifier: BSD-2-Clause
// Light: the interface of every emitter. Directions are unit and in world space; densities state
// their measure. A light is prepared once, with the sphere that bounds the scene, and is then
// immutable and shared between threads.
#pragma once

#include <optional>

#include "core/geometry/shape.h"
#include "core/math/spectrum.h"

namespace exphoton {

// One way to light a point, at the time of the point.
struct LightLiSample {
  Vector3 wi;     // from the point towards the light
  Spectrum Li;    // radiance arriving along wi if nothing blocks it; delta lights: the irradiance
                  // on a plane perpendicular to wi
  Real pdf = 0;   // per solid angle, > 0; 1 for a delta light
  Ray shadowRay;  // occluders lie in 0 < t < tMax
};

// A ray that leaves the light, carrying power.
struct LightLeSample {
  Ray ray;         // direction unit; origin offset from the light's own surface
  Spectrum power;  // Le |cos| / (pdfPosition pdfDirection): its mean is Power() (where a light
                   // changes its size as it moves, that is about the mean over time)
  Real pdfPosition = 0;   // per area (of the light, or of the disk that covers the scene);
                          // 1 for a light at a point
  Real pdfDirection = 0;  // per solid angle; 1 for a single direction
};

class Light {
 public:
  virtual ~Light() = default;

  // World bounds, radius 0 for an empty world. Called once, before anything else.
  virtual void Prepare(const Sphere3& world) { (void)world; }

  virtual bool IsDelta() const { return false; }     // no ray ever hits it
  virtual bool IsInfinite() const { return false; }  // answers Le for rays that escape
  // Holds every point that emits, at all times; nullopt for a light that is nowhere (far away).
  virtual std::optional<Bounds3> Bounds() const { return std::nullopt; }
  // Photons start on a disk that covers the scene, and are alike at all of its places.
  virtual bool IsFar() const { return false; }
  virtual bool IsProvablyBlack() const = 0;      // emits nothing at all
  virtual int SampleCount() const { return 1; }  // shadow rays a shading point ("nsamples")

  // Total emitted power in this scene, per channel. An estimate only for textured emission.
  virtual Spectrum Power() const = 0;

  // nullopt: nothing arrives (behind an area light, outside a spot's cone).
  virtual std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2 u,
                                                    Real uSubLight) const = 0;
  // Density per solid angle at ref of SampleDirect making wi. `on` is the point of this light that
  // the ray from ref along wi hit, null for a ray that escaped. 0 for delta lights.
  virtual Real PdfDirect(const SurfacePoint& ref, const Vector3& wi,
                         const SurfacePoint* on) const = 0;

  // Whether a ray may end on this light (or escape to it). False only where it provably does not:
  // it spares direct lighting the tracing of most BSDF samples.
  virtual bool MayMeet(const Ray& ray) const { return (void)ray, true; }

  // Radiance that a ray escaping in direction w sees.
  virtual Spectrum Le(const Vector3& w) const {
    (void)w;
    return {};
  }

  // A ray that leaves at a time. nullopt: a sample without light (counts as a path all the same).
  virtual std::optional<LightLeSample> SampleEmission(Point2 uPosition, Point2 uDirection,
                                                      Real uSubLight, Real time) const = 0;
  // The densities with which SampleEmission makes a ray that leaves `from` in direction w; for
  // tests. pdfPosition and pdfDirection as in LightLeSample; 0 where they are deltas.
  struct EmissionPdf {
    Real position = 0, direction = 0;
  };
  virtual EmissionPdf PdfEmission(const SurfacePoint& from, const Vector3& w) const {
    (void)from, (void)w;
    return {};
  }
};

// A light that lies on a surface and can be hit.
class AreaLight : public Light {
 public:
  // Radiance leaving the point in direction w; 0 on the back.
  virtual Spectrum L(const SurfacePoint& on, Point2 uv, const Vector3& w) const = 0;
};

}  // namespace exphoton
