// SPDX-License-Identifier: BSD-2-Clause
// MediaPhotons: photons that participating media send to surfaces: those that media emit, and those
// that leave a light and are scattered once. Light that media scatter more than once is not part of
// it, because no volume integrator computes it. Sources: Chandrasekhar 1960, chapter 1; Jensen and
// Christensen 1998, "Efficient simulation of light transport in scenes with participating media".
#pragma once

#include <optional>
#include <vector>

#include "core/math/sampling/distribution.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

class MediaPhotons {
 public:
  // No media: every answer is empty.
  MediaPhotons() = default;
  // `volume` decides whether light is scattered; null: it is not.
  MediaPhotons(const Scene& scene, const VolumeIntegrator* volume);

  bool Emit() const { return !cells_.IsEmpty(); }
  bool Scatter() const { return scatters_; }
  // Luminance of the power that all media emit, in watts; an estimate by a point in each of many
  // small boxes.
  double EmittedPower() const { return power_; }

  struct Photon {
    Ray ray;
    Spectrum power;  // divided by the density of the choice
  };
  // A photon that a medium emits. Its start has a density proportional to the emission, box by box.
  Photon SampleEmission(Real uBox, const Point3& uPosition, Point2 uDirection, Real time) const;

  // What becomes of a photon of power `alpha` that a light sends along `ray` (unit direction):
  // scattered within the media, or passed on towards the surface at distance `end` (infinity: it
  // meets none). One of both is chosen in proportion to the light that it carries, so that the path
  // does not branch. uDistance, uChoice, uDirection: uniform in [0,1).
  struct Passage {
    std::optional<Ray> scattered;  // nullopt: the photon goes on along its ray
    Spectrum alpha;                // at the point of scattering or at the surface; may be black
  };
  Passage Pass(const Ray& ray, Real end, const Spectrum& alpha, Point2 uDistanceChoice,
               Point2 uDirection) const;

 private:
  struct Cell {
    const Medium* medium;
    Bounds3 box;
  };
  void AddCells(const Medium& medium, int perAxis, std::vector<double>* luminances);

  const Scene* scene_ = nullptr;
  bool scatters_ = false;
  double power_ = 0;
  std::vector<Cell> boxes_;
  DiscreteDistribution cells_;
};

}  // namespace exphoton
