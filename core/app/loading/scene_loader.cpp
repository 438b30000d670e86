// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/loading/scene_loader.h"

#include <utility>

#include "core/app/dial/dial.h"
#include "core/app/identity/state_identity.h"
#include "core/app/process/signals.h"

namespace exphoton::cli {

SceneLoader::Setups SceneLoader::LoadFile(const std::string& path, RenderSetup* known) {
  LoadOptions options = command_.load;
  options.stop = &StopFlag();
  options.threads = command_.threadCount;
  options.known = known;
  if (std::exchange(hasShownWorld_, true)) options.sceneLog = &silent_;
  FileSource source(streams_);
  return LoadScenes(source, path, options, log_);
}

SceneLoader::Setups SceneLoader::Load(const std::string& path, Begin* begin) {
  const bool chooses = command_.accuracy && !command_.dial && command_.mode == RenderMode::Render;
  if (chooses) {
    pilots_ = TurnDial(&command_, path, streams_, log_);
    hasShownWorld_ = true;
    begin->EndPilots();
  }
  Setups setups = LoadFile(path, chooses ? pilots_->Known() : nullptr);
  if (chooses && ContinueChoice(setups)) setups = LoadAgain(path, std::move(setups));
  preparedSeed_.reset();
  if (pilots_ && setups.size() == 1)
    preparedSeed_ = pilots_->Give(*command_.dial, setups.front().get());
  if (command_.dial) Omit(command_.dial->omitted, *setups.front());
  begin->EndLoading();
  return setups;
}

// Loads the scene with other settings.
SceneLoader::Setups SceneLoader::LoadAgain(const std::string& path, Setups setups) {
  RenderSetup& first = *setups.front();
  RenderSetup* const known = PilotRenderer::HasWholeScene(first) ? &first : nullptr;
  // The integrators refer to the scene, so they go first.
  first.integrator.reset();
  first.volumeIntegrator.reset();
  return LoadFile(path, known);
}

// Returns whether the scene must be loaded again, with other settings than the pilots suggest.
// Throws Error if the render with these settings cannot continue from the state. A file that is no
// state of such a render is an error later, when the render continues from it.
bool SceneLoader::ContinueChoice(const Setups& setups) {
  if (!command_.resumes || setups.size() != 1) return false;
  const std::string state = names_.State(setups.front()->film.filename);
  if (!IsStateFile(state)) return false;
  const StateFile file(state);
  const auto stopped = StateIdentity::Of(file).Choice();
  RenderCommand continued = command_;
  Log silent(Log::Level::Quiet, Log::Sink::Memory);
  if (!stopped || !cli::ContinueChoice(*stopped, &continued, silent)) return false;
  StateIdentity(continued, *setups.front()).Check(file);
  return cli::ContinueChoice(*stopped, &command_, log_);
}

}  // namespace exphoton::cli
