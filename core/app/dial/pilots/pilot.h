// SPDX-License-Identifier: BSD-2-Clause
// PilotRenderer renders a scene small, in two halves, to learn what an accuracy costs. The results
// depend on scene, options and seed only. Pilots with the same settings share their photons.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/app/dial/dial_settings.h"
#include "core/app/dial/omitted_effect.h"
#include "core/app/dial/pilots/counted_cost.h"
#include "core/app/dial/pilots/small_scene.h"
#include "core/app/effects/light_parts.h"
#include "core/app/options/options.h"
#include "core/app/output/picture.h"
#include "core/app/quote/mean_light.h"
#include "core/app/quote/price_model.h"
#include "core/parser/syntax/source.h"
#include "core/render/certificate/certificate.h"
#include "core/render/passes/pass_sum.h"

namespace exphoton::cli {

struct PilotRequest {
  std::string integrator;
  int samples = 2;  // a pixel
  DialSettings settings = {};
  std::vector<OmittedEffect> omitted = {};
  bool estimatesBias = false;  // the rays of the estimate are counted as samples
  // Whether the bias of shared gathers is estimated. The render then does not check them, which
  // saves a little time.
  bool estimatesSharing = true;
  bool isRough = false;  // with a sixteenth of the pixels and a tenth of the photons
};

constexpr double kFewPhotons = .1;  // of PilotRequest::isRough
constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

struct PilotPicture {
  Pilot pilot;
  CountedCost cost;
  CountedCost cpuSeconds;  // the same by the clock
  int mapCount = 0;        // sets of maps that were made for this pilot
  bool isCutOff = false;   // a rough pilot with too few photons (PilotRenderer::LimitRoughPaths)
  double seconds = 0;      // CPU time of everything
  double pixels = 0;
  double noiseOfPicture = 1;  // expected with the pixels of the picture; relative to the pilot's
  SharingBias sharing;        // expected with the pixels of the picture
  MeanLight light;
  std::vector<MeasuredLight> parts;        // of the light; none: the integrator does not divide it
  double gatherRays = 0;                   // of the whole picture
  DialSettings settings;                   // the request's, with the photons of the scene
  bool hasBias = false;                    // whether the integrator can estimate it
  double guessedBias = 0;                  // of the scene's photons, to a factor of 2
  std::optional<Certificate> certificate;  // for the blocks that certify the least bias
  std::vector<std::string> messages;       // of the render, as they would be printed
};

class PilotRenderer {
 public:
  struct Surroundings {
    const char* option;  // for a message about a file with several scenes
    FileSource::Streams* streams;
    Log* log;                    // receives a verbose line for each pilot
    bool isForPicture = false;   // a picture follows and takes the scene of the pilots if possible
    bool showsMessages = false;  // about the text and the world of the scene
  };
  // Scenes lose lights and media that are switched off, or that their integrator does not compute
  // (Scene::SetFeatures).
  static bool HasWholeScene(const RenderSetup& setup);

  // Loads the scene once at its own resolution. Throws Error.
  PilotRenderer(const RenderCommand& command, std::string scene, Surroundings surroundings);
  PilotRenderer(const PilotRenderer&) = delete;
  PilotRenderer& operator=(const PilotRenderer&) = delete;

  // Returns light that the integrator of the pilot never finds. Throws Error.
  std::vector<std::string> UnseenLight(const PilotRequest& request);
  // Throws Error.
  PilotPicture Render(const PilotRequest& request);

  // Names the integrators of later pilots (LoadOptions::comparedIntegrators).
  void Compare(const std::vector<std::string>& integrators) {
    small_.comparedIntegrators = fewer_.comparedIntegrators = integrators;
  }
  // Ends the photons of later rough pilots after about this number of paths.
  void LimitRoughPaths(double paths);

  // One render with 1000 to 3000 camera samples.
  struct OnePass {
    std::vector<double> values;  // three channels per pixel, row by row
    CountedCost cost;
  };
  // Loan is the scene at the resolution of pilots, with a tenth of the photons. Its features may
  // change. Meanwhile no other pilots can be rendered. Afterwards the last pilot still has its
  // photons.
  class Loan {
   public:
    // Throws Error.
    Loan(PilotRenderer* pilots, const std::string& integrator, DialSettings settings);
    ~Loan();
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    const RenderSetup& Setup() const { return *setup_; }

   private:
    PilotRenderer& pilots_;
    std::optional<RequiredFeatures> plan_;  // of the pilots' scene; nullopt: it was not lent
    std::unique_ptr<RenderSetup> setup_;
  };
  // Renders a loan with random numbers of its own for each `number`. Throws LoadingStopped.
  OnePass RenderOnce(const RenderSetup& setup, std::uint64_t number);

  // Returns the setup of the last pilot, for LoadOptions::known; null: its scene is not whole. No
  // other pilots can be rendered once its scene has moved.
  RenderSetup* Known() const { return setup_ && HasWholeScene(*setup_) ? setup_.get() : nullptr; }
  // If the last pilot had this integrator, the settings and effects of the choice, and the photons
  // of the first pass of the picture, moves its scene (unless it has moved before) and its
  // integrator to `setup`, and returns the seed of the photons. They refer to this object.
  std::optional<std::uint64_t> Give(const DialChoice& choice, RenderSetup* setup);

  const std::string& SceneIntegrator() const { return sceneIntegrator_; }
  const Sampler& SceneSampler() const { return *sceneSampler_; }
  std::int64_t SceneSamples() const { return sceneSampler_->SamplesPerPixel(); }
  int SceneGatherRays() const { return sceneGatherRays_; }  // 0: the scene does not give them
  // Whether the scene's own integrator shares gathers.
  bool SceneSharesGathers() const { return sceneSharesGathers_; }
  // Whether mirrors or glass may matter with the integrator that was loaded first.
  bool HasSpecularSurfaces() const { return hasSpecularSurfaces_; }
  bool HasIndirectLight() const { return hasIndirectLight_; }
  bool GivesDirectPhotons() const { return sceneDirectPhotons_ > 0; }  // the scene does
  // Of the picture that is wanted.
  int Width() const { return width_; }
  int Height() const { return height_; }
  double Pixels() const { return double(width_) * double(height_); }
  // Samples per pixel of RenderOnce. Only pictures that are smaller than pilots have more than one.
  int OnceSamples() const { return std::max(int(1000 / pilotPixels_), 1); }
  // The price of RenderOnce relative to one sample per pixel of the picture.
  double OnceShare() const { return OnceSamples() * pilotPixels_ / Pixels(); }
  double LoadSeconds() const { return loadSeconds_; }  // CPU time
  const PilotWork& Work() const { return work_; }      // of all renders so far

 private:
  static std::string TextOf(const PilotRequest& request, const PilotPicture& picture);
  const RenderSetup& Load(const PilotRequest& request);
  double NoiseOfPicture(const RenderSetup& setup, double pixels) const;
  double SharingBiasOfPicture(double pixels) const;  // relative to the pilot's
  PassesResult RenderHalves(const RenderJob& job, bool estimatesSharing, PictureFilms* films,
                            PilotPicture* picture);

  std::uint64_t FirstSeed() const;
  std::int64_t FewPaths() const;  // the limit for the paths of kFewPhotons
  ParameterOverride LimitOfPaths() const;

  const RenderCommand command_;
  SmallScene scene_;
  Log& verbose_;
  std::string sceneIntegrator_;
  std::unique_ptr<const Sampler> sceneSampler_;
  int sceneGatherRays_ = 0;
  bool sceneSharesGathers_ = false, hasSpecularSurfaces_ = false, hasIndirectLight_ = false;
  double sceneUsedPhotons_ = 0;    // in a density estimate; 0: the scene does not give them
  double sceneDirectPhotons_ = 0;  // the same, of the direct map
  double scenePaths_ = 0;          // limit of the photon paths; 0: the scene does not give it
  int width_ = 0, height_ = 0;
  std::int64_t roughPaths_ = kNoLimit;  // limit of the photon paths of rough pilots
  double pilotPixels_ = 0;
  double loadSeconds_ = 0;
  PilotWork work_;
  LoadOptions small_;  // with the resolution of pilots
  LoadOptions fewer_;  // with the resolution of pilots of photon maps
  // Of the last pilot. All pilots have the scene that was loaded first.
  PilotRequest loaded_;
  std::unique_ptr<RenderSetup> setup_;
  std::optional<std::uint64_t> preparedSeed_;  // of the photons that the integrator has
};

}  // namespace exphoton::cli
