// SPDX-License-Identifier: BSD-2-Clause
// fuzz_part checks that exphoton merge makes a picture of a part (--shard), or gives an error. The
// input says how a valid part is changed.
#include <fstream>

#include "core/app/commands/render_command.h"
#include "core/app/shards/merge_command.h"
#include "core/base/error.h"
#include "tests/fuzz/state_edits.h"

using namespace exphoton;

namespace {

// The scene has shared gathers, splatted samples and AOVs, so that the part has all sections but
// those of an accuracy.
constexpr const char* kScene =
    "LookAt 0 0 -5 0 0 0 0 1 0 Camera \"perspective\"\n"
    "Film \"image\" \"integer xresolution\" 6 \"integer yresolution\" 4\n"
    "PixelFilter \"mitchell\" Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 2\n"
    "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 50\n"
    "\"integer causticphotons\" 0 \"integer finalgathersamples\" 2\n"
    "WorldBegin LightSource \"point\" \"point from\" [2 3 -3] Shape \"sphere\" WorldEnd\n";

fuzz::EditableState MakePart(const fuzz::TemporaryFolder& folder) {
  std::ofstream(folder.File("scene.pbrt")) << kScene;
  const cli::RenderCommand command = cli::ParseRenderCommand(
      {folder.File("scene.pbrt"), "--shard", "1/1", "-o", folder.File("parts"), "--aov",
       "albedo,variance,light", "--nthreads", "1", "--reproducible", "--quiet"},
      cli::RenderMode::Render);
  fuzz::Require(cli::RunRender(command) == 0, "the part is rendered");
  return fuzz::EditableState(folder.File("parts/part-1-of-1.state"));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::TemporaryFolder folder;
  static const fuzz::EditableState whole = MakePart(folder);
  fuzz::EditableState part = whole;
  part.Edit(fuzz::Input(data, size));
  const std::string path = folder.File("parts/part-1-of-1.state");
  part.Write(path);
  int status;
  {
    const fuzz::Silence silence;
    status = cli::RunMerge({path, "-o", folder.File("merged.exr"), "--quiet"}, "exphoton merge");
  }
  fuzz::Require(status != int(ExitStatus::Internal), "no error is an internal one");
  return 0;
}
