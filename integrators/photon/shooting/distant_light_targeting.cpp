// SPDX-License-Identifier: BSD-2-Clause
// DistantLightTargeting builds the hierarchy of bounding spheres, and samples photon starts on
// their projected disks.
#include "integrators/photon/shooting/distant_light_targeting.h"

#include <algorithm>
#include <cmath>

#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

// Fewer points do not show where photons are wanted.
constexpr std::size_t kMinPoints = 16;
// Radii are enlarged by this factor, because the points are only a sample of the wanted region.
constexpr Real kMargin = Real(1.5);
// Radii shrink at most by this factor from level to level, or the density would jump.
constexpr Real kMinShrink = Real(.25);
constexpr int kMaxLevels = 64;

Bounds3 BoundsOf(std::span<const Point3> points) {
  Bounds3 bounds;
  for (const Point3& p : points) bounds.Extend(p);
  return bounds;
}

// Partitions the points at the median along the axis.
void Halve(std::span<Point3> points, int axis) {
  std::nth_element(points.begin(), points.begin() + std::ptrdiff_t(points.size() / 2), points.end(),
                   [axis](const Point3& a, const Point3& b) { return a[axis] < b[axis]; });
}

double DiskArea(Real radius) { return double(kPi) * double(radius) * double(radius); }

}  // namespace

DistantLightTargeting::DistantLightTargeting(std::vector<Point3> wanted, const Sphere3& world,
                                             double minShare)
    : world_(world) {
  if (wanted.size() < kMinPoints || !(world.radius > 0)) return;
  AddLevels(wanted, std::max(minShare, double(kMinPoints) / double(wanted.size())));
  std::vector<double> shares{1};  // the world sphere
  for (const TargetSphere& sphere : spheres_) shares.push_back(sphere.share);
  shares_ = DiscreteDistribution(shares);
  for (TargetSphere& sphere : spheres_) sphere.share /= shares_.Sum();
  gain_ = Gain(wanted);
}

// A set of points that fits a much smaller sphere gets a chain of shrinking spheres first. Then it
// is halved, unless a half would hold less than minShare of the points.
void DistantLightTargeting::AddLevels(std::span<Point3> wanted, double minShare) {
  struct Part {
    std::span<Point3> points;
    Real parentRadius;
  };
  std::vector<Part> parts{{wanted, world_.radius}};
  for (int level = 1; level <= kMaxLevels && !parts.empty(); ++level) {
    std::vector<Part> next;
    for (const auto& [points, parentRadius] : parts) {
      const Bounds3 bounds = BoundsOf(points);
      const Sphere3 sphere = BoundingSphere(bounds);
      const Real fitting = sphere.radius * kMargin, smallest = parentRadius * kMinShrink;
      const Real radius = std::clamp(fitting, smallest, parentRadius);
      const double share = double(points.size()) / double(wanted.size());
      spheres_.push_back({sphere.center - world_.center, radius, share});
      if (fitting < smallest) {
        next.push_back({points, radius});
      } else if (share / 2 >= minShare) {
        Halve(points, bounds.LongestAxis());
        next.push_back({points.first(points.size() / 2), radius});
        next.push_back({points.subspan(points.size() / 2), radius});
      }
    }
    parts = std::move(next);
  }
}

double DistantLightTargeting::TargetSphere::Density(Real distance2) const {
  if (!(distance2 < radius * radius)) return 0;
  return 2 * double(1 - distance2 / (radius * radius)) * share / DiskArea(radius);
}

double DistantLightTargeting::WorldDensity() const {
  return double(shares_.Probability(0)) / DiskArea(world_.radius);
}

double DistantLightTargeting::Density(const Vector3& offset, const Frame& frame) const {
  const Real x = Dot(offset, frame.x), y = Dot(offset, frame.y);
  double density = WorldDensity();
  for (const TargetSphere& sphere : spheres_) {
    const Real dx = x - Dot(sphere.center, frame.x), dy = y - Dot(sphere.center, frame.y);
    density += sphere.Density(dx * dx + dy * dy);
  }
  return density;
}

void DistantLightTargeting::Redirect(LightLeSample* emission, Point2 u) const {
  const Vector3 toLight = -emission->ray.d;
  const Frame frame = Frame::FromZ(toLight);
  const auto choice = shares_.Sample(u.x);
  Vector3 onPlane;
  if (choice.index == 0) {
    const Point2 d = SampleDisk({choice.remapped, u.y});
    onPlane = (frame.x * d.x + frame.y * d.y) * world_.radius;
  } else {
    // The CDF over the squared relative radius s is 2 s - s^2.
    const TargetSphere& sphere = spheres_[std::size_t(choice.index - 1)];
    const Real d = sphere.radius * SafeSqrt(1 - SafeSqrt(1 - choice.remapped));
    const Real phi = 2 * kPi * u.y;
    onPlane = frame.x * (Dot(sphere.center, frame.x) + d * std::cos(phi)) +
              frame.y * (Dot(sphere.center, frame.y) + d * std::sin(phi));
  }
  const double density = Density(onPlane, frame);
  // Start slightly outside the world sphere, so that rounding never starts a photon inside a wall
  // that touches the sphere.
  emission->ray.o = world_.center + onPlane + toLight * (world_.radius * Real(1.001));
  emission->power *= Real(double(emission->pdfPosition) / density);
  emission->pdfPosition = Real(density);
}

// Returns the median gain of the wanted points. Distances in space replace distances on the
// projected disks, so that the result does not depend on the direction of light.
double DistantLightTargeting::Gain(std::span<const Point3> wanted) const {
  std::vector<double> gains;
  for (const Point3& p : wanted) {
    double density = WorldDensity();
    for (const TargetSphere& sphere : spheres_)
      density += sphere.Density(LengthSquared(p - world_.center - sphere.center));
    gains.push_back(density * DiskArea(world_.radius));
  }
  const auto middle = gains.begin() + std::ptrdiff_t(gains.size() / 2);
  std::nth_element(gains.begin(), middle, gains.end());
  return *middle;
}

}  // namespace exphoton
