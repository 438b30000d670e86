// SPDX-License-Identifier: BSD-2-Clause
// HalfAngleTable is the regular table of the MERL database: three channels over the angle of the
// half vector to the normal, and the direction of wi relative to the half vector. Source: Matusik,
// Pfister, Brand and McMillan 2003, "A Data-Driven Reflectance Model"; coordinates: Rusinkiewicz
// 1998, "A New Change of Variables for Efficient BRDF Representation".
//
// The file holds three 32-bit integers 90, 90, 180 and 3 * 90 * 90 * 180 doubles, little-endian:
// all of red, then green, then blue. Half angles are spaced by their square root. Values are scaled
// by 1/1500, 1.15/1500 and 1.66/1500. Negative values are missing.
//
// Values are linear between the centres of the cells in these three coordinates. Missing cells are
// left out of the interpolation.
#pragma once

#include <array>

#include "materials/measured/measured_brdf.h"

namespace exphoton {

class HalfAngleTable final : public MeasuredValues {
 public:
  static constexpr int kHalfAngles = 90, kDifferenceAngles = 90, kDifferenceAzimuths = 180;

  // Throws MeasurementError.
  explicit HalfAngleTable(const std::string& path);

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;

 private:
  const std::array<float, 3>& Cell(int half, int difference, int azimuth) const {
    return cells_[(std::size_t(half) * kDifferenceAngles + std::size_t(difference)) *
                      kDifferenceAzimuths +
                  std::size_t(azimuth)];
  }

  std::vector<std::array<float, 3>> cells_;  // per steradian; negative: missing
};

}  // namespace exphoton
