// SPDX-License-Identifier: BSD-2-Clause
// DirectionHistogram is the guiding distribution of Jensen 1995 ("Importance Driven Path Tracing
// using the Photon Map"). The hemisphere is divided into cells of equal projected solid angle. Each
// cell is chosen in proportion to the number of photons that come from it. All photons have nearly
// the same power. The histogram of a surface that transmits has a second hemisphere.
#pragma once

#include <algorithm>
#include <array>

#include "core/math/sampling/sampling.h"
#include "integrators/photon/gather/cone_mixture.h"

namespace exphoton {

class DirectionHistogram {
 public:
  static constexpr int kRings = 6, kSectors = 16;

  // Directions are relative to the normal n, which is a unit vector.
  explicit DirectionHistogram(const Normal3& n) : frame_(Frame::FromZ(Vector3(n))) {}

  void Add(const Vector3& w) {
    ++counts_[CellOf(frame_.ToLocal(w))];
    ++photons_;
  }
  bool IsEmpty() const { return photons_ == 0; }

  // Draws a direction: uCell picks the cell, u the direction in it. There must be a photon.
  ConeMixture::Sample Draw(Real uCell, Point2 u) const {
    const Real at = uCell * Real(photons_);
    std::size_t cell = 0, last = 0;
    int before = 0;
    for (; cell < kCells; ++cell) {
      if (counts_[cell] > 0) last = cell;
      if (at < Real(before + counts_[cell])) break;
      before += counts_[cell];
    }
    cell = std::min(cell, last);  // rounding may pass the last photon
    const Vector3 w = Within(cell, u);
    return {frame_.ToWorld(w), Density(cell, std::abs(w.z))};
  }
  // Returns the density of Draw per solid angle.
  Real Pdf(const Vector3& w) const {
    const Vector3 local = frame_.ToLocal(w);
    return Density(CellOf(local), std::abs(local.z));
  }

 private:
  static constexpr std::size_t kOneSide = kRings * kSectors, kCells = 2 * kOneSide;

  // Rings are equal parts of sin^2 of the angle to the normal.
  static std::size_t CellOf(const Vector3& w) {
    const Real sin2 = std::min(w.x * w.x + w.y * w.y, Real(1));
    const Real turn = std::atan2(w.y, w.x) / (2 * kPi);
    const int ring = std::min(int(sin2 * kRings), kRings - 1);
    const int sector = std::min(int((turn < 0 ? turn + 1 : turn) * kSectors), kSectors - 1);
    return std::size_t(ring * kSectors + sector) + (w.z < 0 ? kOneSide : 0);
  }
  static Vector3 Within(std::size_t cell, Point2 u) {
    const auto place = int(cell % kOneSide);
    const Real sin2 = (Real(place / kSectors) + u.x) / kRings;
    const Real phi = 2 * kPi * (Real(place % kSectors) + u.y) / kSectors;
    const Real r = std::sqrt(sin2);
    // At the horizon the cosine rounds to 0. The smallest step keeps the density positive.
    const Real z = std::sqrt(std::max(1 - sin2, kMachineEpsilon));
    return {r * std::cos(phi), r * std::sin(phi), cell < kOneSide ? z : -z};
  }
  Real Density(std::size_t cell, Real absCos) const {
    return Real(counts_[cell]) / Real(photons_) * (Real(kOneSide) * kInvPi) * absCos;
  }

  Frame frame_;
  std::array<int, kCells> counts_{};
  int photons_ = 0;
};

}  // namespace exphoton
