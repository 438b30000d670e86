// SPDX-License-Identifier: BSD-2-Clause
// fuzz_photons checks that a file of photons gives maps that can be searched, or an error, and that
// a share of photons gives chunks, or an error. The input says which of them is meant and how a
// valid file is changed.
#include "core/base/log.h"
#include "core/base/progress.h"
#include "integrators/photon/files/photon_file.h"
#include "integrators/photon/files/photon_part.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "tests/fuzz/state_edits.h"

using namespace exphoton;

namespace {

const PhotonIdentity kIdentity{{"--seed", "7"}};

// Returns photons on a square, with a site at every tenth.
PhotonPassResult MakePhotons() {
  PhotonPassResult photons;
  photons.lights.resize(2);
  photons.paths = 100;
  for (int i = 0; i < 100; ++i) {
    Photon photon;
    photon.p = {Real(i % 10), Real(i / 10), 0};
    photon.wi = {0, 0, 1};
    photon.alpha = Spectrum(1);
    photons.buffers[std::size_t(i % kPhotonKindCount)].Add(photon);
    RadiancePhotonSite site;
    site.p = photon.p;
    site.n = {0, 0, 1};
    if (i % 10 == 0) photons.sites.Append({&site, 1});
  }
  for (PhotonBuffer& buffer : photons.buffers) buffer.paths = 100;
  return photons;
}

fuzz::EditableState MakeFile(const std::string& path) {
  PhotonPassResult photons = MakePhotons();
  ThreadPool threads(1);
  WritePhotons(path, kIdentity, &photons, threads);
  return fuzz::EditableState(path);
}

// Builds the maps and estimates the irradiance at some places.
void Search(PhotonPassResult photons) {
  ThreadPool threads(1);
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  PreprocessContext context{threads, 0, log, progress, statistics, false, nullptr, {}, nullptr};
  const PhotonMapSet maps(&photons, PhotonSettings(), 10, context);
  Arena arena;
  for (const Real x : {Real(-5), Real(0), Real(4.5), Real(1e9)})
    maps.EstimateIrradiance({x, 3, 0}, {0, 0, 1}, &arena);
}

fuzz::EditableState MakeShare(const std::string& path) {
  ChunkMemo memo;
  PhotonChunk chunk;
  Photon photon;
  photon.wi = {0, 0, 1};
  for (auto& photons : chunk.photons) photons.assign(20, PhotonRecord(photon));
  chunk.sites.resize(3);
  chunk.lights.emplace_back(1, LightTally());
  for (const std::int64_t first : {64, 128}) memo.Add(first, {{true, false, true}, 0}, chunk);
  WritePhotonPart(path, kIdentity, &memo);
  return fuzz::EditableState(path);
}

// All chunks that are read can be taken.
void TakeAll(const std::string& path) {
  ChunkMemo memo;
  ReadPhotonPart(path, kIdentity, 2, &memo);
  for (auto& [first, entry] : memo.Entries()) {
    PhotonChunk chunk;
    fuzz::Require(memo.Take(first, ChunkState(entry.state), &chunk), "a chunk that is there");
    for (const auto& [light, tally] : chunk.lights)
      fuzz::Require(light >= 0 && light < 2, "a light that exists");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::TemporaryFolder folder;
  const std::string path = folder.File("photons");
  static const fuzz::EditableState whole = MakeFile(path);
  static const fuzz::EditableState share = MakeShare(folder.File("share"));
  fuzz::Input input(data, size);
  const bool isShare = input.Byte() % 2 == 1;
  fuzz::EditableState file = isShare ? share : whole;
  file.Edit(input);
  file.Write(path);
  try {
    if (isShare) return TakeAll(path), 0;
    Search(ReadPhotons(path, kIdentity));
  } catch (const Error& error) {
    fuzz::Require(error.Status() != ExitStatus::Internal, "no error is an internal one");
  }
  return 0;
}
