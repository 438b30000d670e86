// SPDX-License-Identifier: BSD-2-Clause
// Render runs the integrator's preprocessing and then renders every pixel of the film on all
// threads. The picture depends on scene, integrator, sampler, filter, camera and seed only. It
// never depends on threads, tiles or crop.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/statistics.h"
#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/camera.h"
#include "core/imaging/film/film.h"
#include "core/render/sharing/sharing_estimate.h"
#include "core/sampling/filter.h"
#include "core/sampling/sampler.h"
#include "core/transport/integrator.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

class Checkpoints;
class Corrections;
class GatherFragments;
struct SharingChange;
class PhotonNoise;
class ShardWriter;
class StateFile;
class StateWriter;

// Scattered: successive tiles lie all over the picture, so that the tiles so far show how long the
// others take.
enum class TileOrder { Scanline, Reversed, Scattered };

// RenderView sees parts of a picture that are rendered, while others are not.
class RenderView {
 public:
  virtual ~RenderView() = default;
  // Called by any thread that renders, so it must return soon. The sums of the pixels in `part` do
  // not change meanwhile. Light that pixels get from others comes with the last call.
  virtual void Show(const Film& film, const PixelBounds& part) = 0;
};

struct RenderOptions {
  std::uint64_t seed = 0;
  int tileSize = 16;
  TileOrder tileOrder = TileOrder::Scattered;
  bool isStrict = false;                     // a non-finite sample throws Error(Internal)
  const std::atomic<bool>* stop = nullptr;   // set from outside (a signal): stop at the next pixel
  std::atomic<bool>* pixelsBegun = nullptr;  // Render sets it once there may be pixels to keep
  AovFilm* aovs = nullptr;                   // filled beside the film; null: no AOVs
  // Textures are filtered, and bump maps differenced, over the footprint of a sample when a pixel
  // takes this number of samples. 0 means the number of the sampler. Renders that are compared with
  // each other need the same footprint.
  std::int64_t footprintSamples = 0;
  // The memory for the gathers of one band of rows (core/render/sharing/sharing_bands.h), in bytes.
  double sharingMemory = 0x1p28;
  Checkpoints* checkpoints = nullptr;  // receives the state of the render; null: none
  // The state of a stopped render that this one continues. The render releases it.
  StateFile* resumed = nullptr;
  // If not null, the render is one shard of a picture, and its sums go here. The films are not
  // complete then.
  ShardWriter* shard = nullptr;
  const PhotonFileUse* photonFile = nullptr;  // see PreprocessContext
  // The seed of the integrator's last preprocessing, by an earlier PassRenderer of the same
  // objects. Passes with this seed use its photons. Nullopt: there was none.
  std::optional<std::uint64_t> preparedSeed{};
  // Receives the corrections of each pass, whose end the caller reports. Null: no certificate.
  Corrections* corrections = nullptr;
  // Receives what shared gathers change in each pass, whose end the caller reports. Passes share
  // alone or leave it to the caller (RenderPass::gathers), and their samples are not splatted.
  // Null: it is not wanted.
  SharingChange* sharingChange = nullptr;
  RenderView* view = nullptr;  // sees finished tiles and passes; null: none
};

struct RenderJob {
  const Scene& scene;
  SurfaceIntegrator& integrator;
  const Sampler& sampler;
  const Filter& filter;
  const Camera& camera;
  Film& film;
  ThreadPool& threads;
  Log& log;
  ProgressReporter& progress;
  Statistics& statistics;
  VolumeIntegrator* volume = nullptr;  // light from media; null: none
  std::string integratorName{};        // for warnings
};

struct RenderResult {
  bool isComplete = true;                     // false if stopped
  std::int64_t nonFiniteSamples = 0;          // dropped, counted as black
  std::vector<std::string> nonFiniteReports;  // the first few: pixel, sample, seed
  std::optional<SharingBias> sharingBias;     // of shared gathers; the mean of all passes
};

RenderResult Render(const RenderJob& job, const RenderOptions& options);

// Returns the number of samples a pixel for whose footprint textures are filtered.
std::int64_t FootprintSamples(const RenderJob& job, const RenderOptions& options);

// One pass over the image: the range of samples of each pixel, and their seeds.
struct RenderPass {
  std::uint64_t preprocessSeed =
      0;                         // for photons; the photons of the last pass stay if it is equal
  std::uint64_t sampleSeed = 0;  // for camera samples
  std::int64_t firstSample = 0, sampleCount = 0;
  // Whether pixels share the gathers of this pass alone, or those of a batch of successive passes
  // with equal preprocessing. The film of a pass in a batch must be empty before it. It receives
  // the difference that the pass makes to the picture of its batch.
  enum class Sharing { Alone, BeginsBatch, ContinuesBatch };
  Sharing sharing = Sharing::Alone;
  // As in PreprocessContext. The windows of shared gathers shrink by the same factor of area.
  double diskArea = 1;
  std::optional<Real> time{};          // of camera rays and photons
  PhotonNoise* photonNoise = nullptr;  // receives signed light; null: it is not wanted
  // Receives the gathers of a pass that shares alone. All of them are then in memory at once. If
  // the pass is not stopped, the film receives their own light, and the caller shares them. Null:
  // they are not wanted. Samples must not be splatted.
  GatherFragments* gathers = nullptr;
};

// Renders pass by pass. Passes may differ in every member of RenderPass. Statistics and warnings
// cover all passes together.
class PassRenderer {
 public:
  // The job's film is not used, because each pass names its film. Both arguments must outlive this
  // object.
  PassRenderer(const RenderJob& job, const RenderOptions& options);
  ~PassRenderer();

  // Runs the preprocessing and adds the samples of the pass to the film. Only the first
  // preprocessing logs messages. Returns false if stopped; some pixels then lack samples.
  bool Run(const RenderPass& pass, const Sampler& sampler, Film* film);
  // Makes later passes share no gathers, and drops the estimate of the bias.
  void StopSharing();
  // Fills the job's statistics and logs warnings. Must be called once, at the end.
  RenderResult Finish();

  // Returns the estimate from neighbouring pixels for the passes so far, without a batch that may
  // go on; nullopt if no gathers are shared, or if RenderOptions::sharingChange is given.
  std::optional<SharingBias> MeanSharingBias() const;

  // Saves what all passes have in common, and the current batch.
  void SaveTotals(StateWriter* writer) const;

  double PreprocessSeconds() const;  // wall-clock time of the last pass
  double RenderSeconds() const;      // the same, for rendering without preprocessing

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace exphoton
