// SPDX-License-Identifier: BSD-2-Clause
// PhotonTracer::Path follows one photon path to its end, and stores photons for the open maps in a
// chunk. With photonroulette "constant" a path may branch: a step draws several candidates, and
// each accepted candidate continues on its own.
#pragma once

#include <vector>

#include "core/transport/shading_point.h"
#include "integrators/photon/shooting/photon_chunk.h"
#include "integrators/photon/shooting/photon_path_sampler.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// PhotonBranch is the state of a photon between two surfaces.
struct PhotonBranch {
  RayDifferential ray;
  Spectrum alpha;
  Real distance = 0;            // since the light or the last non-specular scattering
  int hits = 1;                 // number of the next surface of the path
  bool isSpecularPath = false;  // every bounce so far was specular
  bool isOfMedia = false;  // a medium emitted the photon, or scattered it on its way from the light
};

// PhotonSinks holds where a path puts its results. `branches` is working space.
struct PhotonSinks {
  const PhotonBatch& batch;
  PhotonChunk* chunk;
  std::vector<PhotonBranch>* branches;
};

class PhotonTracer::Path {
 public:
  Path(const PhotonTracer& tracer, const PhotonPathSequences& sequences, std::uint64_t index,
       const PhotonSinks& sinks)
      : tracer_(tracer),
        index_(index),
        samples_(sequences, index),
        batch_(sinks.batch),
        chunk_(sinks.chunk),
        branches_(sinks.branches) {}

  void Trace(Arena* arena, RayCounters* rays);
  void AddTo(std::span<LightTally> lights) const;

 private:
  struct Source {
    const Light* light;  // null: media
    Real probability;    // guided: times the density of the emission numbers
    Real uBox;           // media only
  };

  EmissionNumbers DrawEmissionNumbers();
  Source ChooseSource(EmissionNumbers* u);
  // Reports the path to the training of the guide.
  void Record(const Source& source, const EmissionNumbers& u) const;
  // Emits one photon, sets its ray in now_, and returns its power; nullopt: nothing is emitted.
  std::optional<Spectrum> Emit(const Source& source, const EmissionNumbers& u);
  // Sets the emitted power. Returns false if there is nothing to trace.
  bool Begin(const Spectrum& power);
  // Emits the candidates of "constant".
  void EmitCopies(const Source& source, EmissionNumbers u);

  // Follows now_ until it ends or branches.
  void Follow(Arena* arena, RayCounters* rays);
  bool IsSkipped();
  // Ends the path before it is emitted, if it is for caustics only and its light makes none.
  bool IsOutOfReach(const Source& source);
  bool Absorb(const Point3& p);
  bool ScatterInMedia(const Point3* end);
  Real Time(Real u) const;

  void Store(PhotonKind kind, const ShadingPoint& point);
  bool HasNegativeSign() const { return (HashKey({tracer_.seed_, kSignKey, index_}) & 1) != 0; }
  void Drop();
  bool IsOnlyOpen(PhotonKind kind) const;
  bool IsWantedAfter(bool isSpecular) const;

  bool Scatter(const ShadingPoint& point);
  void ScatterCopies(const ShadingPoint& point);
  std::optional<Spectrum> SampleBsdf(const ShadingPoint& point, Real uLobe, Point2 u,
                                     PhotonBranch* next) const;
  bool IsCut(const Spectrum& power);
  // Accepts or rejects a candidate of "constant", and counts it.
  std::optional<Spectrum> Accept(const Spectrum& power, int copies, Real u);
  bool HasTooManyBranches();
  Real SurvivalProbability(const Spectrum& scattered) const;
  bool IsHalved() const;

  static constexpr std::uint64_t kSignKey = 0x7369676eull;  // "sign" in ASCII

  const PhotonTracer& tracer_;
  std::uint64_t index_;
  PhotonPathSampler samples_;
  const PhotonBatch& batch_;
  PhotonChunk* chunk_;
  std::vector<PhotonBranch>* branches_;
  PhotonBranch now_;
  int light_ = 0;  // -1: the path began in a medium
  int branchCount_ = 0;
  bool hasHit_ = false;
  bool isSkipped_ = false;
  std::int64_t stored_ = 0;  // photon count
  std::int64_t caustic_ = 0;
  std::array<bool, kPhotonKindCount> hasStored_{};
  double emitted_ = 0;  // luminance of the power that left the light
  Real maxEmitted_ = 0;
};

}  // namespace exphoton
