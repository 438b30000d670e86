// SPDX-License-Identifier: BSD-2-Clause
// PartRecord holds what a merge needs to know about the render of a part, besides its sums: the
// scene, the filter and the settings of the picture's file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/app/options/options.h"
#include "core/app/shards/scene_record.h"
#include "core/params/param_set.h"
#include "core/render/shards/picture_passes.h"
#include "core/transport/integrator.h"

namespace exphoton::cli {

struct PartRecord {
  PartRecord() = default;
  PartRecord(const RenderCommand& command, const RenderSetup& setup, const Log& log);
  void Transfer(ByteArchive* archive);  // saves or loads

  SceneRecord scene;
  PicturePasses passes;
  std::uint64_t seed = 0;
  std::int64_t footprintSamples = 0;
  std::string aovs;  // "albedo, N"
  bool premultipliesAlpha = true, asHalf = true, isReproducible = false;
  std::string cameraDepth, gatherDepth;  // of DepthParameters
  ParamSet filter;
  // Of a picture for an accuracy: what was chosen and left out, and phrases for what its
  // certificate does not cover and its error does not contain.
  std::string choice;
  std::vector<OmittedEffect> omitted;
  std::vector<std::string> notCovered, unseen;
  std::vector<std::string> messages;
};

inline constexpr const char* kPartSection = "part";

// Returns the name of a part's file: "part-3-of-16.state".
std::string PartName(const Shard& shard);

}  // namespace exphoton::cli
