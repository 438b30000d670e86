// SPDX-License-Identifier: BSD-2-Clause
// fuzz_params loads a valid scene in which the first byte selects one plugin and the rest is its
// parameters.
#include <array>
#include <string>

#include "core/base/error.h"
#include "tests/fuzz/input.h"
#include "tests/support/test_scene.h"

using namespace exphoton;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  static constexpr std::array<const char*, 5> kBefore{"SurfaceIntegrator ", "Sampler ",
                                                      "PixelFilter ", "Camera ", "Accelerator "};
  static constexpr std::array<const char*, 4> kWithin{"Material ", "LightSource ", "Shape ",
                                                      "AreaLightSource "};
  const std::size_t choice = data[0] % (kBefore.size() + kWithin.size());
  const std::string rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (rest.find('\0') != std::string::npos) return 0;
  const bool isBefore = choice < kBefore.size();
  const std::string line =
      (isBefore ? kBefore[choice] : kWithin[choice - kBefore.size()]) + rest + "\n";
  const std::string text = "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2\n" +
                           (isBefore ? line : "") +
                           "WorldBegin LightSource \"point\" Translate 0 0 3\n" +
                           (isBefore ? "" : line) + "Shape \"sphere\"\nWorldEnd\n";
  try {
    LoadSceneText(text);
  } catch (const Error& error) {
    fuzz::Require(error.Status() != ExitStatus::Internal, "no error is an internal one");
  } catch (const std::runtime_error&) {  // the text ended the scene or began another
  }
  return 0;
}
