// SPDX-License-Identifier: BSD-2-Clause
// PlacedLight is a light with only a place and a power, for tests of light selection.
#pragma once

#include "core/lights/light.h"

namespace exphoton {

class PlacedLight final : public Light {
 public:
  // A light without a place has no bounds.
  PlacedLight(std::optional<Point3> place, Real power, bool isBlack = false)
      : place_(place), power_(power), isBlack_(isBlack) {}

  bool IsProvablyBlack() const override { return isBlack_; }
  std::optional<Bounds3> Bounds() const override {
    return place_ ? std::optional<Bounds3>(Bounds3(*place_)) : std::nullopt;
  }
  Spectrum Power() const override { return Spectrum(power_); }
  std::optional<LightLiSample> SampleDirect(const SurfacePoint&, Point2, Real) const override {
    return std::nullopt;
  }
  Real PdfDirect(const SurfacePoint&, const Vector3&, const SurfacePoint*) const override {
    return 0;
  }
  std::optional<LightLeSample> SampleEmission(Point2, Point2, Real, Real) const override {
    return std::nullopt;
  }

 private:
  std::optional<Point3> place_;
  Real power_;
  bool isBlack_;
};

}  // namespace exphoton
