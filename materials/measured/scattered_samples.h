// SPDX-License-Identifier: BSD-2-Clause
// ScatteredSamples is a BRDF measured at irregular pairs of directions.
//
// The file is text: numbers between white space, and comments from # to the end of a line. The
// first number is the count n of wavelengths, and n wavelengths in nanometres follow, rising. Each
// sample is the polar angle and azimuth of wi, those of wo (radians), and n values of the BRDF per
// steradian.
//
// An isotropic, reciprocal BRDF depends on three numbers that are the same for (wo, wi) and
// (wi, wo): the dot product and the absolute cross product of the two directions projected to the
// surface, and the product of the cosines. They are the coordinates of a sample. f is the weighted
// mean of the eight nearest samples, by the weights ((R - d) / (R d))^2. Here d is the distance of
// the sample, and R is the distance of the ninth (Franke and Little's form of Shepard's
// interpolation). The mean is continuous and has the measured value at a sample.
#pragma once

#include "core/spatial/point_tree.h"
#include "materials/measured/measured_brdf.h"

namespace exphoton {

class ScatteredSamples final : public MeasuredValues {
 public:
  // Throws MeasurementError.
  explicit ScatteredSamples(const std::string& path);

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;

 private:
  PointTree<PointBlock> tree_;  // `direction` of a point is the index of its sample
  std::vector<Spectrum> values_;
};

}  // namespace exphoton
