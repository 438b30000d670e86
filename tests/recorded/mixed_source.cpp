// SPDX-License-Identifier: BSD-2-Clause
// MixedScenes draws scenes that have many features at once: odd materials, textures, bumps, holes,
// lamps, media, motions, instances and views, with settings of every integrator. The parts are the
// lines of mixed_parts.txt. Integrators are taken in turn, everything else at random.
#include <map>
#include <string>
#include <vector>

#include "tests/recorded/draw.h"
#include "tests/recorded/scene_list.h"

namespace exphoton::recorded {
namespace {

using Parts = std::map<std::string, std::vector<std::string>>;  // texts, by kind

const Parts& AllParts() {
  static const Parts parts = [] {
    Parts map;
    for (const std::string& line : LinesOf("mixed_parts.txt")) {
      const std::size_t blank = line.find(' ');
      map[line.substr(0, blank)].push_back(line.substr(blank + 1));
    }
    return map;
  }();
  return parts;
}

constexpr const char* kTextures =
    "Texture \"board\" \"color\" \"checkerboard\" \"float uscale\" 5 \"float vscale\" 3 "
    "\"color tex1\" [.9 .6 .3] \"color tex2\" [.2 .4 .7]\n"
    "Texture \"picture\" \"color\" \"imagemap\" \"string filename\" \"scenes/parts/painting.png\" "
    "\"float uscale\" 2.3 \"float vscale\" 1.4 \"float udelta\" .2\n"
    "Texture \"stone\" \"color\" \"marble\" \"float scale\" 3 \"integer octaves\" 3\n"
    "Texture \"waves\" \"float\" \"wrinkled\" \"integer octaves\" 2\n"
    "Texture \"steps\" \"float\" \"bilerp\" \"float v00\" .05 \"float v01\" .3 \"float v10\" .2 "
    "\"float v11\" .1\n"
    "Texture \"rather\" \"float\" \"checkerboard\" \"float tex1\" 1.3 \"float tex2\" 1.7\n"
    "Texture \"cut\" \"float\" \"dots\" \"float uscale\" 4 \"float vscale\" 3 \"float inside\" 0 "
    "\"float outside\" 1\n"
    "MakeNamedMaterial \"dull\" \"string type\" \"matte\" \"color Kd\" [.5 .7 .3]\n"
    "MakeNamedMaterial \"shiny\" \"string type\" \"plastic\" \"color Kd\" [.3 .2 .5] "
    "\"color Ks\" [.4 .5 .3] \"texture bumpmap\" \"waves\"\n"
    "MakeNamedMaterial \"clear\" \"string type\" \"glass\" \"float index\" 1.3\n";

class Mixer {
 public:
  explicit Mixer(std::uint64_t seed) : draw_(seed + 5000), seed_(seed) {}

  RecordedScene Scene() {
    const Parts& parts = AllParts();
    const std::vector<std::string>& integrators = parts.at("integrator");
    std::string text = "Film \"image\" " + Of("film") + "\nSurfaceIntegrator " +
                       integrators[std::size_t(seed_ % integrators.size())] +
                       "\nVolumeIntegrator " + Of("volumeintegrator") + "\nSampler " +
                       Of("sampler") + "\nPixelFilter " + Of("filter") + "\nAccelerator " +
                       Of("accelerator") + "\nTransformTimes 0 1.2\n" + Of("view") + "\nCamera " +
                       Of("camera") + "\nWorldBegin\n";
    text += kTextures;
    for (std::uint64_t lights = 1 + draw_.Below(3); lights > 0; --lights)
      text += Of("light") + "\n";
    if (draw_.Below(3) == 0) text += Of("volume") + "\n";
    text += Of("ground") + "\n";
    for (std::uint64_t things = 2 + draw_.Below(3); things > 0; --things) text += Thing();
    RecordedScene scene{"mixed/" + std::to_string(seed_), text + "WorldEnd\n", {}};
    std::string unknown;
    if (draw_.Below(3) == 0) scene.aovs = ParseAovs(Of("aovs"), &unknown).value();
    return scene;
  }

 private:
  const std::string& Of(const std::string& kind) { return draw_.From(AllParts().at(kind)); }

  std::string Motion() {
    return "ActiveTransform EndTime " + Of("motion") + " ActiveTransform All\n";
  }
  // A shape with its material, which may move, be turned inside out, or glow.
  std::string Body() {
    std::string text = Of("material") + "\n";
    if (draw_.Below(8) == 0) text += "ReverseOrientation\n";
    if (draw_.Below(12) == 0) text += "AreaLightSource \"area\" \"color L\" [.7 .4 .9]\n";
    if (draw_.Below(4) == 0) text += Motion();
    return text + Of("shape") + "\n";
  }
  std::string Thing() {
    if (draw_.Below(4) != 0)
      return "AttributeBegin\n" + Of("place") + "\n" + Body() + "AttributeEnd\n";
    // A body in an object, with other shapes, as one or two instances.
    const std::string name = "\"object " + std::to_string(++objects_) + "\"\n";
    std::string text = "ObjectBegin " + name + Body();
    if (draw_.Below(2) == 0) text += Of("place") + "\n" + Body();
    text += "ObjectEnd\n";
    for (std::uint64_t instances = 1 + draw_.Below(2); instances > 0; --instances)
      text += "AttributeBegin\n" + Of("place") + "\n" + (draw_.Below(3) == 0 ? Motion() : "") +
              "ObjectInstance " + name + "AttributeEnd\n";
    return text;
  }

  Draw draw_;
  std::uint64_t seed_;
  int objects_ = 0;
};

}  // namespace

std::vector<RecordedScene> MixedScenes(std::uint64_t firstSeed, std::uint64_t lastSeed) {
  return OfSeeds(firstSeed, lastSeed, [](std::uint64_t seed) { return Mixer(seed).Scene(); });
}

}  // namespace exphoton::recorded
