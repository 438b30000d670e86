// SPDX-License-Identifier: BSD-2-Clause
// ProbeMedia checks media along the rays to the hits: optical depth against sums over points,
// transmittance, and the phase function.
#include <array>
#include <cmath>

#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

// Returns the sum of absorption and scattering over points of the interval, times its length.
double SummedDepth(const Medium& medium, const Ray& ray, Interval part) {
  // The edges of a medium cost a step: at a corner of a box, 400 points were too few.
  constexpr int kPoints = 4000;
  double sum = 0;
  const double width = double(part.max - part.min) / kPoints;
  for (int i = 0; i < kPoints; ++i) {
    const MediumPoint at = medium.At(ray(part.min + Real((i + .5) * width)));
    sum += double((at.absorption + at.scattering).Y());
  }
  return sum * width * double(Length(ray.d));
}

void CheckDepth(const Medium& medium, const Ray& ray, Interval part, Findings* findings) {
  const double depth = double(medium.OpticalDepth(ray, part).Y());
  const double summed = SummedDepth(medium, ray, part);
  findings->Expect(std::abs(depth - summed) < .02 * summed + 2e-3, "optical depth", depth, summed);
  const auto inside = medium.Overlap(ray);
  for (const Real t : {part.min, (part.min + part.max) / 2, part.max}) {
    const MediumPoint at = medium.At(ray(t));
    const bool isInside = inside && t > inside->min - Real(1e-3) && t < inside->max + Real(1e-3);
    const double sum = double((at.absorption + at.scattering + at.emission).Y());
    findings->Expect(isInside || sum == 0, "a medium is empty outside its box", sum, 0);
  }
}

void CheckPhase(const Medium& medium, const Vector3& wo, Findings* findings) {
  constexpr int kRows = 24, kColumns = 48;
  double sum = 0;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const double z = 1 - 2 * (i + .5) / kRows, r = std::sqrt(1 - z * z);
      const double phi = 2 * double(kPi) * (j + .5) / kColumns;
      const Vector3 wi{Real(r * std::cos(phi)), Real(r * std::sin(phi)), Real(z)};
      sum += double(medium.Phase(wo, wi));
    }
  sum *= 4 * double(kPi) / (kRows * kColumns);
  findings->Expect(std::abs(sum - 1) < .03, "sum of a phase function", sum, 1);
}

// The density at the middle of a cell of a grid is the cell's.
void CheckGrid(const MediumModel& model, const Medium& medium, Findings* findings) {
  const double half = model.size == 0 ? 2 : .7;
  const Place place = model.size == 0 ? Place{} : model.place;
  constexpr std::array<double, 4> kDensities{1, 0, .5, 2};
  double first = 0;
  for (int cell = 0; cell < 4; ++cell) {
    const Point3 p(Real(.3 * place.x + half * (cell % 2 - .5)), Real(.3 * place.y),
                   Real(.3 * place.z + half * (cell / 2 - .5)));
    const MediumPoint at = medium.At(p);
    const double density = double((at.absorption + at.scattering + at.emission).Y());
    if (cell == 0) first = density;
    const double expected = kDensities[std::size_t(cell)] * first;
    findings->Expect(std::abs(density - expected) <= 1e-3 * (first + density),
                     "density in the middle of a cell", density, expected);
  }
}

}  // namespace

void ProbeMedia(const SceneModel& model, const ProbedScene& scene, Findings* findings) {
  if (!scene.World().HasMedia()) return;
  RandomStream random = scene.Stream(6);
  for (std::size_t i = 0; i < std::min<std::size_t>(24, scene.Sights().size()); ++i) {
    const Sight& sight = scene.Sights()[i];
    Ray ray = sight.ray;
    const Real scale = 1 + 2 * random.Uniform();
    ray.d = ray.d * scale;
    ray.tMax = sight.hit.hit.t / scale;
    const Real a = random.Uniform() * ray.tMax, b = random.Uniform() * ray.tMax;
    Spectrum depth;
    for (const auto& medium : scene.World().Media()) {
      CheckDepth(*medium, ray, {std::min(a, b), std::max(a, b)}, findings);
      depth += medium->OpticalDepth(ray, {0, ray.tMax});
    }
    const double expected = std::exp(-double(depth.r));
    const double passed = double(scene.World().Transmittance(ray).r);
    findings->Expect(std::abs(passed - expected) < 1e-3, "transmittance", passed, expected);
  }
  const auto& media = scene.World().Media();
  for (std::size_t i = 0; i < media.size() && media.size() == model.media.size(); ++i)
    if (model.media[i].kind == 2) CheckGrid(model.media[i], *media[i], findings);
  for (const auto& medium : media) CheckPhase(*medium, Vector3(0, Real(.6), Real(.8)), findings);
}

}  // namespace exphoton::random_scenes
