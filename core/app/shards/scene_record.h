// SPDX-License-Identifier: BSD-2-Clause
// SceneRecord describes a scene that was rendered, for pictures and statistics. Unlike the scene it
// can be saved, so that a merge of parts need not load the scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/imaging/image.h"
#include "core/scene/scene_names.h"

namespace exphoton {
class ByteArchive;
struct RenderSetup;
}  // namespace exphoton

namespace exphoton::cli {

struct SceneRecord {
  struct Effect {
    std::string name;
    bool on = false;
    std::string reason;
  };

  SceneRecord() = default;
  explicit SceneRecord(const RenderSetup& setup);
  void Transfer(ByteArchive* archive);  // saves or loads

  // Returns the effects that the scene requires: "indirect, filtering"; "none".
  std::string EffectNames() const;

  std::string name;
  std::uint64_t hash = 0;
  std::string integrator, sampler, filter, camera, accelerator;
  PixelBounds full, crop;
  std::vector<Effect> effects;
  float exposureTime = 0;
  std::vector<float> worldToCamera, worldToNdc;  // as OpenEXR stores them
  SceneNames names;  // not saved by Transfer: only Cryptomatte needs them
};

std::string EffectNames(const RenderSetup& setup);

std::string HashText(std::uint64_t hash);  // 16 hexadecimal digits

}  // namespace exphoton::cli
