// SPDX-License-Identifier: BSD-2-Clause
// fuzz_photons checks that a file of photons gives maps that can be searched, or an error. The
// input says how a valid file is changed.
#include "core/base/log.h"
#include "core/base/progress.h"
#include "integrators/photon/files/photon_file.h"
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::TemporaryFolder folder;
  const std::string path = folder.File("photons");
  static const fuzz::EditableState whole = MakeFile(path);
  fuzz::EditableState file = whole;
  file.Edit(fuzz::Input(data, size));
  file.Write(path);
  try {
    Search(ReadPhotons(path, kIdentity));
  } catch (const Error& error) {
    fuzz::Require(error.Status() != ExitStatus::Internal, "no error is an internal one");
  }
  return 0;
}
