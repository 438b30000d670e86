// SPDX-License-Identifier: BSD-2-Clause
// BoxMedium is the base of the medium plugins: a box from p0 to p1 in the space of the Volume
// directive, with constant coefficients times a density that the plugin defines.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/plugin.h"

namespace exphoton {

struct MediumSettings {
  Spectrum absorption{0}, scattering{0}, emission{0};
  Real g = 0;
  Point3 p0{0, 0, 0}, p1{1, 1, 1};
};

inline const ParamTable<MediumSettings>& MediumParameters() {
  using S = MediumSettings;
  static const ParamTable<S> table{
      Param("sigma_a", &S::absorption, "absorption").AtLeast(0).Unit("1/scene unit"),
      Param("sigma_s", &S::scattering, "scattering").AtLeast(0).Unit("1/scene unit"),
      Param("Le", &S::emission, "radiance emitted per unit of length").AtLeast(0),
      Param("g", &S::g, "forward (1) or backward (-1) scattering; Henyey and Greenstein")
          .Above(-1)
          .Below(1),
      Param("p0", &S::p0, "a corner of the box that it fills"),
      Param("p1", &S::p1, "the opposite corner")};
  return table;
}

// Density provides At(p), the density at a point of the box, and Integral(o, d, part), the integral
// of the density over t along o + t d, for a part inside the box. Both are in the space of the box.
// IsZero() returns whether the density is 0 at all points.
template <class Density>
class BoxMedium final : public Medium {
 public:
  BoxMedium(const MediumSettings& settings, const MediumContext& context, Density density)
      : settings_(settings),
        box_(settings.p0, settings.p1),
        bounds_(context.mediumToWorld.ApplyBounds(box_)),
        toMedium_(context.mediumToWorld.Inverted()),
        density_(std::move(density)) {}

  Bounds3 Bounds() const override { return bounds_; }
  bool Emits() const override { return MayBePositive(settings_.emission); }
  bool Scatters() const override { return MayBePositive(settings_.scattering); }
  bool Absorbs() const override { return MayBePositive(settings_.absorption); }

  // Without the margin of IntersectBox, which would add to the optical depth.
  std::optional<Interval> Overlap(const Ray& ray) const override {
    const Point3 o = toMedium_.ApplyPoint(ray.o);
    const Vector3 d = toMedium_.ApplyVector(ray.d);
    double first = 0, last = double(ray.tMax);
    for (int axis = 0; axis < 3; ++axis) {
      const double from = double(box_.min[axis]) - double(o[axis]);
      const double to = double(box_.max[axis]) - double(o[axis]);
      if (d[axis] == 0) {
        if (!(from <= 0 && to >= 0)) return std::nullopt;
        continue;
      }
      const double a = from / double(d[axis]), b = to / double(d[axis]);
      first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
    }
    const Interval part{Real(first), Real(last)};
    if (!(part.max > part.min) || !std::isfinite(part.max)) return std::nullopt;
    return part;
  }

  MediumPoint At(const Point3& world) const override {
    const Point3 p = toMedium_.ApplyPoint(world);
    if (!box_.Contains(p)) return {};
    // A coefficient of 0 times an infinite density would not be 0.
    const auto density = Real(std::min(density_.At(p), kDensest));
    return {settings_.absorption * density, settings_.scattering * density,
            settings_.emission * density};
  }

  Spectrum OpticalDepth(const Ray& ray, Interval part) const override {
    const auto inside = Overlap(ray);
    if (!inside) return {};
    part = {std::max(part.min, inside->min), std::min(part.max, inside->max)};
    if (!(part.max > part.min)) return {};
    const double along =
        density_.Integral(toMedium_.ApplyPoint(ray.o), toMedium_.ApplyVector(ray.d), part);
    const Real depth = Real(along * double(Length(ray.d)));
    // Per channel, so that a coefficient of 0 times an infinite depth gives 0.
    const auto channel = [&](Real coefficient) {
      return coefficient > 0 ? coefficient * depth : 0;
    };
    const Spectrum sum = settings_.absorption + settings_.scattering;
    return {channel(sum.r), channel(sum.g), channel(sum.b)};
  }

  Real Phase(const Vector3& wo, const Vector3& wi) const override {
    return HenyeyGreenstein(settings_.g, wo, wi);
  }

 private:
  static constexpr double kDensest = 1e20;

  bool MayBePositive(const Spectrum& coefficient) const {
    return !coefficient.IsBlack() && !density_.IsZero();
  }

  MediumSettings settings_;
  Bounds3 box_, bounds_;  // in medium space and in world space
  Transform toMedium_;
  Density density_;
};

}  // namespace exphoton
