// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/loading/scene_loader.h"

#include <algorithm>
#include <utility>

#include "core/app/dial/dial.h"
#include "core/app/identity/state_identity.h"
#include "core/app/process/signals.h"
#include "core/base/format.h"
#include "core/render/passes/render_passes.h"

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
  const bool isFirstChoice = chooses && !asked_;
  if (chooses) Choose(path, begin);
  Setups setups = LoadFile(path, chooses ? pilots_->Known() : nullptr);
  const auto stopped = isFirstChoice ? StoppedChoice(setups) : std::nullopt;
  if (stopped && stopped->givenUp.size() > command_.givenUp.size()) {
    log_.Notice("the stopped render had begun again with another choice");
    setups.clear();
    ForgetChoice(stopped->givenUp);
    Choose(path, begin);
    setups = LoadFile(path, pilots_->Known());
  }
  if (stopped && ContinueChoice(setups, *stopped)) setups = LoadAgain(path, std::move(setups));
  preparedSeed_.reset();
  if (pilots_ && setups.size() == 1)
    preparedSeed_ = pilots_->Give(*command_.dial, setups.front().get());
  if (command_.dial) Omit(command_.dial->omitted, *setups.front());
  begin->EndLoading();
  return setups;
}

void SceneLoader::Choose(const std::string& path, Begin* begin) {
  if (!asked_) asked_ = command_;
  if (pilots_) earlierWork_.Add(pilots_->Work());
  begin->BeginPilots();
  pilots_ = TurnDial(&command_, path, streams_, log_);
  hasShownWorld_ = true;
  begin->EndPilots();
}

void SceneLoader::ForgetChoice(std::vector<GivenUp> givenUp) {
  command_ = *asked_;
  command_.givenUp = std::move(givenUp);
}

void SceneLoader::GiveUp(const std::string& reason, double neededSamples, int looks) {
  std::vector<GivenUp> all = command_.givenUp;
  const double samples = std::min(neededSamples, double(StoppingRule::kMaxSamples));
  const std::string integrator = *command_.load.integrator;
  log_.Notice("the picture of " + integrator + " " + reason + " " + Plain(samples, 3) +
              " samples a pixel instead of about " + Plain(command_.dial->expectedSamples, 3) +
              ", so another choice is made");
  all.push_back({integrator, samples, looks});
  ForgetChoice(std::move(all));
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

// Returns what the stopped render has chosen; nullopt: there is none. A file that is no state of
// such a render is an error later, when the render continues from it.
std::optional<LaterChoice> SceneLoader::StoppedChoice(const Setups& setups) const {
  if (!command_.resumes || setups.size() != 1) return std::nullopt;
  const std::string state = names_.State(setups.front()->film.filename);
  if (!IsStateFile(state)) return std::nullopt;
  return StateIdentity::Of(StateFile(state)).Choice();
}

// Returns whether the scene must be loaded again, with other settings than the pilots suggest.
// Throws Error if the render with these settings cannot continue from the state.
bool SceneLoader::ContinueChoice(const Setups& setups, const LaterChoice& stopped) {
  RenderCommand continued = command_;
  Log silent(Log::Level::Quiet, Log::Sink::Memory);
  if (!cli::ContinueChoice(stopped, &continued, silent)) return false;
  const StateFile file(names_.State(setups.front()->film.filename));
  StateIdentity(continued, *setups.front()).Check(file);
  return cli::ContinueChoice(stopped, &command_, log_);
}

}  // namespace exphoton::cli
