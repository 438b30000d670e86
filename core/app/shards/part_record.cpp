// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/shards/part_record.h"

#include <cmath>
#include <limits>

#include "core/app/output/picture.h"
#include "core/base/log.h"
#include "core/files/byte_archive.h"

namespace exphoton::cli {
namespace {

void TransferPartFlag(ByteArchive* archive, bool* flag) {
  char value = *flag ? 1 : 0;
  archive->Values(&value);
  *flag = value != 0;
}

void TransferPartTexts(ByteArchive* archive, std::vector<std::string>* texts) {
  texts->resize(archive->Count(texts->size(), 8));
  for (std::string& text : *texts) archive->Text(&text);
}

void TransferOmissions(ByteArchive* archive, std::vector<OmittedEffect>* omitted) {
  omitted->resize(archive->Count(omitted->size(), 24));
  for (OmittedEffect& effect : *omitted) {
    archive->Text(&effect.name);
    archive->Values(&effect.bound, &effect.time);
    if (!std::isfinite(effect.bound) || !std::isfinite(effect.time))
      throw ArchiveError("its omissions are impossible");
  }
}

void TransferParameters(ByteArchive* archive, ParamSet* set) {
  std::vector<ParsedParam> all = set->All();
  all.resize(archive->Count(all.size(), 32));
  *set = {};
  for (ParsedParam& param : all) {
    archive->Text(&param.type);
    archive->Text(&param.name);
    archive->List(&param.numbers);
    TransferPartTexts(archive, &param.strings);
    set->Add(param);
  }
}

}  // namespace

PartRecord::PartRecord(const RenderCommand& command, const RenderSetup& setup, const Log& log)
    : scene(setup),
      passes(PassesOf(command)),
      seed(command.seed),
      footprintSamples(command.footprintSamples),
      aovs(AovNames(command)),
      premultipliesAlpha(setup.film.premultiplyAlpha),
      asHalf(command.asHalf),
      isReproducible(command.isReproducible),
      cameraDepth(setup.integrator->DepthLimits().camera),
      gatherDepth(setup.integrator->DepthLimits().gather),
      filter(setup.filterParameters),
      messages(log.Messages()) {
  if (!command.dial) return;
  choice = command.dial->text;
  omitted = command.dial->omitted;
  unseen = UnseenLight(command, setup);
  if (command.certifies) notCovered = NotCovered(setup, footprintSamples);
}

void PartRecord::Transfer(ByteArchive* archive) {
  scene.Transfer(archive);
  passes.Transfer(archive);
  archive->Values(&seed, &footprintSamples);
  archive->Text(&aovs);
  if (aovs.find("crypto") != std::string::npos) scene.names.Transfer(archive);
  for (bool* flag : {&premultipliesAlpha, &asHalf, &isReproducible})
    TransferPartFlag(archive, flag);
  archive->Text(&cameraDepth);
  archive->Text(&gatherDepth);
  TransferParameters(archive, &filter);
  archive->Text(&choice);
  TransferOmissions(archive, &omitted);
  for (std::vector<std::string>* texts : {&notCovered, &unseen, &messages})
    TransferPartTexts(archive, texts);
}

std::string PartName(const Shard& shard) {
  return "part-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".state";
}

}  // namespace exphoton::cli
