// SPDX-License-Identifier: BSD-2-Clause
// MediaPhotons samples emission from a grid of boxes over each medium, and scattering at a uniform
// distance within the media.
#include "integrators/photon/shooting/media_photons.h"

#include <algorithm>

#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

// Most boxes for all media together, and per axis of one medium. Emission varies little in a box.
constexpr int kMaxBoxes = 1 << 16;
constexpr int kMaxPerAxis = 16;
// Share of the choices that is uniform over the boxes, for emission that the box centres miss.
constexpr double kUniformShare = 0.1;

double Volume(const Bounds3& box) {
  const Vector3 d = box.max - box.min;
  return double(d.x) * double(d.y) * double(d.z);
}

Point3 PointIn(const Bounds3& box, const Point3& u) {
  Point3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = Lerp(u[axis], box.min[axis], box.max[axis]);
  return p;
}

}  // namespace

MediaPhotons::MediaPhotons(const Scene& scene, const VolumeIntegrator* volume) : scene_(&scene) {
  if (!scene.HasMedia()) return;
  int emitting = 0;
  for (const auto& medium : scene.Media()) {
    emitting += medium->Emits();
    scatters_ = scatters_ || medium->Scatters();
  }
  scatters_ = scatters_ && volume && volume->ScattersLight();
  if (emitting == 0 || !volume) return;
  int perAxis = kMaxPerAxis;
  while (perAxis > 1 && std::int64_t(emitting) * perAxis * perAxis * perAxis > kMaxBoxes) --perAxis;
  std::vector<double> luminances;
  for (const auto& medium : scene.Media())
    if (medium->Emits()) AddCells(*medium, perAxis, &luminances);
  for (const double luminance : luminances) power_ += luminance;
  // Adding this constant to every box makes kUniformShare of the choices uniform.
  const double uniform =
      power_ > 0 ? kUniformShare / (1 - kUniformShare) * power_ / double(boxes_.size()) : 1.0;
  for (double& luminance : luminances) luminance += uniform;
  if (!boxes_.empty()) cells_ = DiscreteDistribution(luminances);
}

void MediaPhotons::AddCells(const Medium& medium, int perAxis, std::vector<double>* luminances) {
  const Bounds3 bounds = medium.Bounds();
  const double cellVolume = Volume(bounds) / (double(perAxis) * perAxis * perAxis);
  if (!(cellVolume > 0) || !std::isfinite(cellVolume)) return;
  const auto corner = [&](int x, int y, int z) {
    return PointIn(bounds, Point3(Real(x), Real(y), Real(z)) / Real(perAxis));
  };
  for (int z = 0; z < perAxis; ++z)
    for (int y = 0; y < perAxis; ++y)
      for (int x = 0; x < perAxis; ++x) {
        const Bounds3 box(corner(x, y, z), corner(x + 1, y + 1, z + 1));
        const Point3 middle = PointIn(box, Point3(Real(.5), Real(.5), Real(.5)));
        const double luminance = double(medium.At(middle).emission.Y());
        boxes_.push_back({&medium, box});
        luminances->push_back(std::isfinite(luminance) ? 4 * double(kPi) * cellVolume * luminance
                                                       : 0);
      }
}

MediaPhotons::Photon MediaPhotons::SampleEmission(Real uBox, const Point3& uPosition,
                                                  Point2 uDirection, Real time) const {
  const auto choice = cells_.Sample(uBox);
  const Cell& cell = boxes_[std::size_t(choice.index)];
  const Point3 p = PointIn(cell.box, uPosition);
  const Ray ray{p, SampleUniformSphere(uDirection), kInfinity, time};
  // Emission is a radiance per unit length, the same in all directions, so the power per unit
  // volume is 4 pi times the emission.
  const auto factor = Real(4 * double(kPi) * Volume(cell.box) / double(choice.probability));
  return {ray, cell.medium->At(p).emission * factor};
}

MediaPhotons::Passage MediaPhotons::Pass(const Ray& ray, Real end, const Spectrum& alpha,
                                         Point2 uDistanceChoice, Point2 uDirection) const {
  Ray stretch = ray;
  stretch.tMax = end;
  const Spectrum passed = std::isfinite(end) ? alpha * scene_->Transmittance(stretch) : Spectrum();
  Interval inside{kInfinity, 0};
  for (const auto& medium : scene_->Media()) {
    const auto overlap = medium->Scatters() ? medium->Overlap(stretch) : std::nullopt;
    if (!overlap) continue;
    inside = {std::min(inside.min, overlap->min), std::max(inside.max, overlap->max)};
  }
  if (!(inside.max > inside.min)) return {std::nullopt, passed};
  const Real t = Lerp(uDistanceChoice.x, inside.min, inside.max);
  const Point3 p = ray(t);
  stretch.tMax = t;
  const Vector3 w = SampleUniformSphere(uDirection);
  Spectrum scattering, phase;
  for (const auto& medium : scene_->Media()) {
    const Spectrum sigma = medium->At(p).scattering;
    scattering += sigma;
    phase += sigma * (medium->Phase(w, -ray.d) * (4 * kPi));
  }
  const Spectrum weight = alpha * scene_->Transmittance(stretch) * (inside.max - inside.min);
  // The choice must not depend on the sampled direction, so it uses the light scattered in all
  // directions together.
  const Real scatteredY = (weight * scattering).Y();
  const Real probability = SafeDivide(scatteredY, scatteredY + passed.Y(), Real(0));
  if (!(uDistanceChoice.y < probability)) return {std::nullopt, passed / (1 - probability)};
  return {Ray{p, w, kInfinity, ray.time}, weight * phase / probability};
}

}  // namespace exphoton
