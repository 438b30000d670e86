// SPDX-License-Identifier: BSD-2-Clause
// MediaPhotons creates the photons that participating media send to surfaces: photons that media
// emit, and photons of lights that media scatter once. Multiple scattering is left out, because no
// volume integrator computes it. Sources: Chandrasekhar 1960, chapter 1; Jensen and Christensen
// 1998, "Efficient simulation of light transport in scenes with participating media".
#pragma once

#include <optional>
#include <vector>

#include "core/math/sampling/distribution.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

class MediaPhotons {
 public:
  // Without media nothing is emitted or scattered.
  MediaPhotons() = default;
  // `volume` decides whether media scatter light. If it is null, they neither scatter nor emit.
  MediaPhotons(const Scene& scene, const VolumeIntegrator* volume);

  bool Emit() const { return !cells_.IsEmpty(); }
  bool Scatter() const { return scatters_; }
  // Luminance of the power that all media emit, in watts, estimated from one point in each of many
  // small boxes.
  double EmittedPower() const { return power_; }

  struct Photon {
    Ray ray;
    Spectrum power;  // divided by the density of the sample
  };
  // Samples a photon that a medium emits. The density of its origin is constant within each box and
  // follows the emission at the centre of the box.
  Photon SampleEmission(Real uBox, const Point3& uPosition, Point2 uDirection, Real time) const;

  // Sends a photon of power `alpha`, which left a light along `ray` (unit direction), through the
  // media. The photon is either scattered by a medium or reaches the surface at distance `end`
  // (infinity: there is none). One of the two is chosen in proportion to the light that it carries,
  // so that the path does not branch. uDistanceChoice and uDirection are uniform in [0,1)^2.
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
