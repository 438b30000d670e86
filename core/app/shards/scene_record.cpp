// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/shards/scene_record.h"

#include "core/base/format.h"
#include "core/files/byte_archive.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {
namespace {

// OpenEXR uses row vectors, so its matrices are the transpose of ours.
std::vector<float> MatrixAttribute(const Matrix4& matrix) {
  std::vector<float> values;
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row) values.push_back(float(matrix.m[row][column]));
  return values;
}

}  // namespace

SceneRecord::SceneRecord(const RenderSetup& setup)
    : name(setup.sceneName),
      hash(setup.sceneHash),
      integrator(setup.integratorName),
      sampler(setup.samplerName),
      filter(setup.filterName),
      camera(setup.cameraName),
      accelerator(setup.acceleratorName),
      full(setup.film.Full()),
      crop(setup.crop),
      worldToCamera(MatrixAttribute(setup.camera->CameraToWorld().InverseMatrix())),
      worldToNdc(MatrixAttribute(setup.camera->WorldToNdc())),
      names(setup.names) {
  for (int i = 0; i < kFeatureCount; ++i) {
    const RequiredFeatures::Row& row = setup.scene->Features().Get(Feature(i));
    const bool isNeeded = setup.scene->Features().Needs(Feature(i));
    effects.push_back({FeatureName(Feature(i)), row.on && isNeeded, row.reason});
  }
  const Interval shutter = setup.camera->Shutter();
  exposureTime = float(shutter.max - shutter.min);
}

void SceneRecord::Transfer(ByteArchive* archive) {
  archive->Text(&name);
  archive->Values(&hash);
  for (std::string* text : {&integrator, &sampler, &filter, &camera, &accelerator})
    archive->Text(text);
  for (PixelBounds* bounds : {&full, &crop})
    archive->Values(&bounds->x0, &bounds->y0, &bounds->x1, &bounds->y1);
  effects.resize(archive->Count(effects.size(), 17));
  for (Effect& effect : effects) {
    char on = effect.on ? 1 : 0;
    archive->Text(&effect.name);
    archive->Values(&on);
    archive->Text(&effect.reason);
    effect.on = on != 0;
  }
  archive->Values(&exposureTime);
  archive->List(&worldToCamera);
  archive->List(&worldToNdc);
}

std::string SceneRecord::EffectNames() const {
  std::string names;
  for (const Effect& effect : effects)
    if (effect.on) names += (names.empty() ? "" : ", ") + effect.name;
  return names.empty() ? "none" : names;
}

std::string EffectNames(const RenderSetup& setup) { return SceneRecord(setup).EffectNames(); }

std::string HashText(std::uint64_t hash) {
  return Format("%016llx", static_cast<unsigned long long>(hash));
}

}  // namespace exphoton::cli
