// SPDX-License-Identifier: BSD-2-Clause
// MeasuredBrdf is a tabulated isotropic BRDF with the data to sample it. Directions are local, with
// z the normal, and both are above the surface.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/math/sampling/distribution.h"
#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

// An error in a file of measurements. The message names the file.
class MeasurementError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// MeasuredValues is the table itself.
class MeasuredValues {
 public:
  virtual ~MeasuredValues() = default;
  // Returns the BRDF per steradian, never negative. It is symmetric in the two directions.
  virtual Spectrum f(const Vector3& wo, const Vector3& wi) const = 0;
};

// Reads a file by its name: ".brdf" is text with samples at irregular directions, and every other
// name is a binary table over half-angle and difference-angle. Throws MeasurementError.
std::unique_ptr<const MeasuredValues> ReadMeasuredValues(const std::string& path);

class MeasuredBrdf {
 public:
  explicit MeasuredBrdf(std::unique_ptr<const MeasuredValues> values);

  Spectrum f(const Vector3& wo, const Vector3& wi) const { return values_->f(wo, wi); }
  // Samples a direction for wo: half of the samples have the density cos / pi, and half reflect wo
  // at half vectors that follow the table. Returns a direction below the surface for no sample.
  Vector3 Sample(const Vector3& wo, Point2 u) const;
  Real Pdf(const Vector3& wo, const Vector3& wi) const;  // per solid angle
  // Returns the hemispherical-hemispherical reflectance, from 8192 samples.
  const Spectrum& Rho() const { return rho_; }

 private:
  Real HalfVectorPdf(const Vector3& h) const;
  Spectrum MeanAlbedo() const;

  std::unique_ptr<const MeasuredValues> values_;
  // Half vectors fall into rings about the normal. Their density in a ring is proportional to the
  // cosine.
  DiscreteDistribution rings_;
  std::vector<double> sin2_;  // squared sine of the edge of each ring
  Spectrum rho_;
};

}  // namespace exphoton
