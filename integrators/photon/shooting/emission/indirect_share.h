// SPDX-License-Identifier: BSD-2-Clause
// This header measures how much of the light is indirect where the camera looks and where gather
// rays end. In an open scene it may be a hundredth, and then few indirect photons are enough.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "integrators/photon/maps/photon.h"
#include "integrators/photon/shooting/visible_points.h"

namespace exphoton {

// SomePhotons holds the first photons of one map, and the number of paths that have left them.
class SomePhotons {
 public:
  // More photons are not used.
  static constexpr std::size_t kMost = 8192;

  void Add(std::span<const PhotonRecord> photons);
  void AddPaths(std::int64_t paths) { paths_ += double(paths); }
  std::size_t Size() const { return records_.size(); }
  // A young guide leaves few photons, of which few are heavy. These say little.
  bool AreMany() const { return Size() >= 256; }
  std::span<const PhotonRecord> Records() const { return records_; }
  // Returns the number by which sums over these photons are divided.
  double Paths() const { return paths_ * double(Size()) / total_; }

 private:
  std::vector<PhotonRecord> records_;
  double total_ = 0, paths_ = 0;
};

// IndirectShare knows the direct light and the caustics at visible points.
class IndirectShare {
 public:
  explicit IndirectShare(std::span<const VisiblePoint> points);

  // Adds light that is not indirect. Its paths should not be guided, so that weak light has
  // photons.
  void AddLight(const Scene& scene, const SomePhotons& photons, ThreadPool& threads);
  // Returns an upper bound of the root of the mean square of E_i / E over the points that light
  // reaches. E is the irradiance of all light, and E_i is the part of these indirect photons. Four
  // points that no ray has met count as if they had indirect light alone: a small dark room. In
  // [0,1]. The photons must be many.
  double UpperBound(const SomePhotons& indirect, ThreadPool& threads) const;

 private:
  struct Place {
    VisiblePoint point;
    double otherLight = 0;  // luminance of irradiance
  };
  std::vector<Place> places_;
};

// Returns the number of indirect photons that resolve the light well enough, where `wanted` would
// resolve it if all light were indirect (docs/theory/exphotonmap.md, eq. 7e).
std::int64_t EnoughIndirectPhotons(double share, std::int64_t wanted);

}  // namespace exphoton
