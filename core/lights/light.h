// SPDX-License-Identifier: BSD-2-Clause
// Light is the interface of every emitter. Directions have unit length and are in world space. Each
// density states its measure. A light is prepared once with the bounding sphere of the scene. It is
// then immutable and shared between threads.
#pragma once

#include <optional>

#include "core/geometry/shape.h"
#include "core/math/spectrum.h"

namespace exphoton {

// LightLiSample is a sample of the light that arrives at a point, at the point's time.
struct LightLiSample {
  Vector3 wi;     // from the point towards the light
  Spectrum Li;    // radiance arriving along wi if nothing blocks it; delta lights: the irradiance
                  // on a plane perpendicular to wi
  Real pdf = 0;   // per solid angle, > 0; 1 for a delta light
  Ray shadowRay;  // occluders lie in 0 < t < tMax
};

// LightLeSample is a ray that leaves the light and carries power.
struct LightLeSample {
  Ray ray;         // direction unit; origin offset from the light's own surface
  Spectrum power;  // Le |cos| / (pdfPosition pdfDirection); its mean is Power(). If a moving light
                   // changes its size, Power() is approximately the mean over time.
  Real pdfPosition = 0;   // per area (of the light, or of the disk that covers the scene);
                          // 1 for a light at a point
  Real pdfDirection = 0;  // per solid angle; 1 for a single direction
};

class Light {
 public:
  virtual ~Light() = default;

  // Receives the bounding sphere of the world, with radius 0 for an empty world. It is called once,
  // before all other methods.
  virtual void Prepare(const Sphere3& world) { (void)world; }

  virtual bool IsDelta() const { return false; }     // no ray can hit it
  virtual bool IsInfinite() const { return false; }  // Le gives the radiance of escaping rays
  // Returns a box that contains every emitting point at all times, or nullopt for a distant light.
  virtual std::optional<Bounds3> Bounds() const { return std::nullopt; }
  // Returns whether this is a distant light. Its photons start on a disk that covers the scene,
  // with the same distribution at all points of the disk.
  virtual bool IsDistant() const { return false; }
  virtual bool IsProvablyBlack() const = 0;      // emits nothing at all
  virtual int SampleCount() const { return 1; }  // shadow rays per shading point ("nsamples")

  // Returns the total power emitted in this scene, per channel. It is an estimate only for textured
  // emission.
  virtual Spectrum Power() const = 0;

  // Samples the light that arrives at ref. Returns nullopt if nothing arrives (behind an area
  // light, outside a spot's cone).
  virtual std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2 u,
                                                    Real uSubLight) const = 0;
  // Returns the density per solid angle at ref with which SampleDirect makes wi. `on` is the point
  // of this light that the ray from ref along wi hit, or null for a ray that escaped. The density
  // is 0 for delta lights.
  virtual Real PdfDirect(const SurfacePoint& ref, const Vector3& wi,
                         const SurfacePoint* on) const = 0;

  // Returns whether a ray may end on this light (or escape to it). It is false only if the ray
  // provably does not. Direct lighting then does not trace the ray, which saves most BSDF samples.
  virtual bool MayMeet(const Ray& ray) const { return (void)ray, true; }

  // Returns the radiance seen by a ray that escapes in direction w.
  virtual Spectrum Le(const Vector3& w) const {
    (void)w;
    return {};
  }

  // Samples a ray that leaves the light at `time`. nullopt is a sample without light, which still
  // counts as a path.
  virtual std::optional<LightLeSample> SampleEmission(Point2 uPosition, Point2 uDirection,
                                                      Real uSubLight, Real time) const = 0;
  // Returns a bound on the luminance of LightLeSample::power over all samples of SampleEmission, or
  // nullopt if none is known. The call may be slow, so keep the result.
  virtual std::optional<Real> EmissionBound() const { return std::nullopt; }
  // EmissionPdf has the densities with which SampleEmission makes a ray that leaves `from` in
  // direction w, for tests. They are defined as in LightLeSample, but are 0 for deltas.
  struct EmissionPdf {
    Real position = 0, direction = 0;
  };
  virtual EmissionPdf PdfEmission(const SurfacePoint& from, const Vector3& w) const {
    (void)from, (void)w;
    return {};
  }
};

// AreaLight is a light that lies on a surface, so that rays can hit it.
class AreaLight : public Light {
 public:
  // Returns the radiance leaving the point in direction w; 0 on the back.
  virtual Spectrum L(const SurfacePoint& on, Point2 uv, const Vector3& w) const = 0;
};

}  // namespace exphoton
