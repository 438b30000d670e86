// SPDX-License-Identifier: BSD-2-Clause
// fuzz_scene checks that any text is a scene that renders to a finite image, or gives an error.
// Large scenes would only cost time: they are not rendered, and photon counts are replaced by small
// ones.
#include <string>
#include <vector>

#include "core/base/error.h"
#include "tests/fuzz/input.h"
#include "tests/support/test_scene.h"

using namespace exphoton;

namespace {

constexpr int kMaxPixels = 64, kMaxSamples = 16;

bool IsCheap(const RenderSetup& setup) {
  return std::int64_t(setup.crop.Width()) * setup.crop.Height() <= kMaxPixels &&
         setup.sampler->SamplesPerPixel() <= kMaxSamples;
}

// Overrides the photon counts in the text. An integrator without these parameters would fail, so
// only a text that seems to contain a photon integrator gets them.
std::vector<ParameterOverride> FewPhotons(const std::string& text) {
  const std::string directive = "SurfaceIntegrator";
  if (text.find("photonmap\"") == std::string::npos) return {};
  return {{directive, "indirectphotons", "200"},
          {directive, "causticphotons", "200"},
          {directive, "directphotons", "500"},
          {directive, "maxphotonpaths", "20000"},
          {directive, "finalgathersamples", "4"}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  TestRenderOptions options;
  options.load.parameters = FewPhotons(text);
  try {
    LoadedScene scene = LoadSceneText(text, options.load);
    if (IsCheap(*scene.setup)) RenderLoaded(scene, options);
  } catch (const Error& error) {
    fuzz::Require(error.Status() != ExitStatus::Internal, "no error is an internal one");
  } catch (const std::runtime_error&) {  // no scene in the text
  }
  return 0;
}
