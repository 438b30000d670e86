// SPDX-License-Identifier: BSD-2-Clause
// RightLight is an even sky that is right except for what a derived class changes, for plugins that
// `exphoton check-plugin` must refuse.
#pragma once

#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {

class RightLight : public Light {
 public:
  void Prepare(const Sphere3& world) override { world_ = world; }
  bool IsInfinite() const override { return true; }
  bool IsDistant() const override { return true; }
  bool IsProvablyBlack() const override { return false; }
  Spectrum Power() const override {
    return Spectrum(4 * kPi * kPi * world_.radius * world_.radius);
  }
  Spectrum Le(const Vector3&) const override { return Spectrum(1); }
  std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2 u,
                                            Real) const override {
    const Vector3 wi = SampleUniformSphere(u);
    return LightLiSample{wi, Spectrum(1), kUniformSpherePdf, SpawnRay(ref, wi)};
  }
  Real PdfDirect(const SurfacePoint&, const Vector3&, const SurfacePoint*) const override {
    return kUniformSpherePdf;
  }
  std::optional<LightLeSample> SampleEmission(Point2 uPosition, Point2 uDirection, Real,
                                              Real time) const override {
    const Vector3 d = SampleUniformSphere(uDirection);
    const Frame frame = Frame::FromZ(d);
    const Point2 disk = SampleDisk(uPosition) * world_.radius;
    const Point3 o = world_.center - d * (2 * world_.radius) + frame.x * disk.x + frame.y * disk.y;
    const Real pdfPosition = kInvPi / (world_.radius * world_.radius);
    return LightLeSample{{o, d, kInfinity, time}, Power(), pdfPosition, kUniformSpherePdf};
  }
  EmissionPdf PdfEmission(const SurfacePoint&, const Vector3&) const override {
    return {kInvPi / (world_.radius * world_.radius), kUniformSpherePdf};
  }

 private:
  Sphere3 world_;
};

struct NoSettings {};

}  // namespace exphoton
