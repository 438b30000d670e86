// SPDX-License-Identifier: BSD-2-Clause
// RenderSetting renders one setting of a small scene with several seeds. The pictures depend on
// scene, options and seeds only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/app/budget/pair_products.h"
#include "core/app/dial/pilots/small_scene.h"
#include "core/base/statistics.h"
#include "core/render/certificate/corrections.h"

namespace exphoton::cli {

// The seeds of one picture. Successive pictures with equal photon seeds have the same photons.
struct PictureSeeds {
  std::uint64_t photons = 0, samples = 0;
};

struct SettingRequest {
  LoadOptions load;
  std::int64_t samples = 0;           // a pixel; 0: the scene's
  std::int64_t footprintSamples = 0;  // as in RenderOptions
  std::vector<PictureSeeds> pictures;
  double correctedShare = 0;  // of the gather rays; 0: no corrections
};

struct SettingRenders {
  std::vector<PictureValues> pictures;           // three channels per pixel, row by row
  std::vector<PictureValues> corrections;        // of each picture; empty: none were requested
  std::optional<Corrections> groups;             // the same, where each picture is a group
  RayCounters rays;                              // of all pictures
  double cameraSamples = 0;                      // of all pictures
  double storedPhotons = 0, causticPhotons = 0;  // of one set of maps
  // CPU time by the clock. Samples include the sharing of gathers.
  double mapSeconds = 0;     // of one set of maps
  double sampleSeconds = 0;  // of one picture

  // Camera rays that only read emission at the edges of lamps are not samples.
  double GatherRaysPerSample() const {
    return double(rays.counts[std::size_t(RayKind::Gather)]) / std::max(cameraSamples, 1.);
  }
};

// Throws Error, and LoadingStopped after a signal. threads: as in RenderCommand.
SettingRenders RenderSetting(const RenderSetup& setup, const SettingRequest& request, int threads);

}  // namespace exphoton::cli
