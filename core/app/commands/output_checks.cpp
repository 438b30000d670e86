// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/commands/output_checks.h"

#include "core/app/commands/scene_names.h"
#include "core/app/output/output_files.h"
#include "core/app/output/output_names.h"
#include "core/app/output/picture.h"
#include "core/app/output/png_output.h"
#include "core/app/process/interrupt_watch.h"
#include "core/app/process/signals.h"
#include "core/parser/scene_files.h"

namespace exphoton::cli {

void CheckAllOutputs(const RenderCommand& command, RunFiles* files, FileSource::Streams* streams,
                     Log& log) {
  if (command.mode != RenderMode::Render || command.scenes.size() < 2) return;
  const InterruptWatch watch(command.limits.seconds);
  const OutputNames names(command);
  LoadOptions options = command.load;
  options.stop = &StopFlag();
  for (std::size_t index = 0; index < command.scenes.size(); ++index) {
    FileSource source(streams);
    const SceneFiles scene = ScanScene(source, command.scenes[index], options);
    files->AddScene(command.scenes[index], scene.inputs);
    if (!scene.isWhole) continue;
    for (std::size_t i = 0; i < scene.pictures.size(); ++i)
      names.AddTo(*files, {index, i}, scene.pictures[i]);
  }
  files->Check(log);
}

void CheckOutputs(const RenderCommand& command,
                  const std::vector<std::unique_ptr<RenderSetup>>& setups, std::size_t index,
                  RunFiles* files, Log& log) {
  const OutputNames names(command);
  CheckSceneCount(command, index, setups.size());
  if (command.shard) MakeFolder(command.outfile);
  for (std::size_t i = 0; i < setups.size(); ++i) {
    CheckAovs(command, *setups[i]);
    CheckIntegrator(command, *setups[i]);
    files->AddScene(*setups[i]);
    if (!command.photonFile.empty()) files->AddInput(command.photonFile, "--photons");
    names.AddTo(*files, {index, i}, setups[i]->film.filename);
  }
  files->Check(log);
  names.CheckEndings();
  for (const auto& setup : setups) {
    const std::string& name = setup->film.filename;
    if (command.shard || names.NameFromUser() || IsExrName(name)) continue;
    log.Warning("the film's file \"" + name + "\" becomes \"" + ExrName(name) +
                    "\", because pictures of scenes are OpenEXR files",
                {}, "-o NAME.png writes a PNG");
  }
}

}  // namespace exphoton::cli
