// SPDX-License-Identifier: BSD-2-Clause
// StateScenes draws sequences of directives that change, save and restore the graphics state, with
// shapes between them. The pictures show which state each shape has: its transformation, motion,
// material, textures, orientation and emission. Half of the scenes have a wrong directive as well,
// so that messages depend on the state.
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "tests/recorded/draw.h"
#include "tests/recorded/scene_list.h"

namespace exphoton::recorded {
namespace {

constexpr const char* kHeader =
    "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 8\n"
    "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 2\nPixelFilter \"box\"\n";

constexpr std::array<const char*, 4> kStateIntegrators{
    "\"directlighting\"", "\"path\" \"integer maxdepth\" 2",
    "\"exphotonmap\" \"integer indirectphotons\" 100 \"integer causticphotons\" 50 "
    "\"integer finalgathersamples\" 3 \"integer maxphotonpaths\" 2000",
    "\"whitted\""};

constexpr std::array<const char*, 8> kTransforms{
    "Translate .3 -.1 .2", "Translate -.5 .2 0",
    "Rotate 40 0 1 .3",    "Rotate -25 1 0 0",
    "Scale .8 1.1 .9",     "ConcatTransform [1 0 0 0 .2 1 0 0 0 .1 1 0 .1 .2 0 1]",
    "Scale -1 1 1",        "CoordSysTransform \"here\""};

constexpr std::array<const char*, 8> kStates{
    "ReverseOrientation",
    "Material \"matte\" \"texture Kd\" \"t\"",
    "Material \"mirror\" \"color Kr\" [.4 .6 .8]",
    "Material \"uber\" \"color Kd\" [.2 .5 .3] \"float opacity\" .5",
    "NamedMaterial \"n\"",
    "AreaLightSource \"area\" \"color L\" [2 1 3]",
    "CoordinateSystem \"here\"",
    "LightSource \"point\" \"color I\" [1 2 1]"};

constexpr std::array<const char*, 6> kDefinitions{
    "Texture \"t\" \"color\" \"checkerboard\" \"float uscale\" 4 \"color tex1\" [.9 .2 .1]",
    "Texture \"t\" \"color\" \"bilerp\" \"color v00\" [.1 .9 .3] \"color v11\" [.8 .3 .7]",
    "Texture \"u\" \"color\" \"scale\" \"texture tex1\" \"t\" \"color tex2\" [.5 .7 .9]",
    "MakeNamedMaterial \"n\" \"string type\" \"matte\" \"texture Kd\" \"t\"",
    "MakeNamedMaterial \"n\" \"string type\" \"plastic\" \"color Kd\" [.1 .2 .6]",
    "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string namedmaterial1\" \"n\" "
    "\"string namedmaterial2\" \"n\""};

// Shapes of equal place and size test which of two equally near surfaces is seen.
constexpr std::array<const char*, 6> kShapes{
    "Shape \"sphere\" \"float radius\" .5",
    "Shape \"disk\" \"float radius\" .6 \"float height\" -.1",
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-.5 -.5 0 .5 -.5 .1 .5 "
    ".5 0 -.5 .5 .1] \"float uv\" [0 0 1 0 1 1 0 1]",
    "Shape \"trianglemesh\" \"integer indices\" [2 1 0] \"point P\" [-.5 -.5 0 .5 -.5 .1 .5 .5 0]",
    "Shape \"cylinder\" \"float radius\" .4 \"float zmin\" -.3 \"float zmax\" .3 "
    "\"float phimax\" 200",
    "Shape \"sphere\" \"float radius\" .5 \"float zmax\" .2"};

constexpr std::array<const char*, 10> kMistakes{"Shape \"sphere\" \"float radius\" -1",
                                                "Shape \"sphere\" \"float raduis\" 1",
                                                "AttributeEnd",
                                                "TransformEnd",
                                                "ObjectEnd",
                                                "NamedMaterial \"missing\"",
                                                "CoordSysTransform \"nowhere\"",
                                                "Material \"matte\" \"texture Kd\" \"unknown\"",
                                                "ObjectInstance \"unknown\"",
                                                "Film \"image\""};

// Writes the directives of one scene.
class StateText {
 public:
  explicit StateText(std::uint64_t seed) : draw_(seed) {}

  std::string Scene() {
    const bool isMistaken = draw_.Below(5) == 0;
    Line("SurfaceIntegrator " + std::string(draw_.From(kStateIntegrators)));
    if (draw_.Below(3) == 0) Line("TransformTimes .1 .9");
    if (draw_.Below(3) == 0) Transformation(6);
    Line("LookAt 0 .5 -3 0 0 0 .1 1 0\nCamera \"perspective\" \"float fov\" 60");
    Line("WorldBegin\nLightSource \"infinite\" \"color L\" [.3 .4 .5]");
    Line("LightSource \"point\" \"color I\" [3 2 1] \"point from\" [1 2 -2]");
    Line("CoordinateSystem \"here\"");
    for (const char* definition : {kDefinitions[0], kDefinitions[3]}) Line(definition);
    const std::uint64_t wrongAt = isMistaken ? draw_.Below(20) : 99;
    for (std::uint64_t i = 0; i < 20; ++i) {
      if (i == wrongAt) Line(draw_.From(kMistakes));
      Step();
    }
    while (!open_.empty()) Close();
    Line("Shape \"sphere\" \"float radius\" .3\nWorldEnd");
    return kHeader + text_;
  }

 private:
  void Line(const std::string& line) { text_ += line + "\n"; }
  // A mirroring one cannot be at one end of the exposure alone.
  void Transformation(std::uint64_t count) {
    const std::uint64_t kind = draw_.Below(3);
    if (kind > 0) Line(kind == 1 ? "ActiveTransform EndTime" : "ActiveTransform StartTime");
    Line(kTransforms[draw_.Below(kind > 0 ? 6 : count)]);
    if (kind > 0 && draw_.Below(4) > 0) Line("ActiveTransform All");
  }
  void Open() {
    constexpr std::array<const char*, 3> kBlocks{"Attribute", "Transform", "Object"};
    const std::string block =
        isInObject_ ? kBlocks[draw_.Below(2)] : std::string(draw_.From(kBlocks));
    isInObject_ = isInObject_ || block == "Object";
    Line(block + "Begin" + (block == "Object" ? " \"body\"" : ""));
    open_.push_back(block);
  }
  void Close() {
    const std::string block = open_.back();
    open_.pop_back();
    if (block == "Object") Line(draw_.From(kShapes));
    Line(block + "End");
    if (block != "Object") return;
    isInObject_ = false;
    isKnown_ = true;
  }
  void Step() {
    switch (draw_.Below(8)) {
      case 0:
        if (open_.size() < 3) Open();
        break;
      case 1:
        if (!open_.empty()) Close();
        break;
      case 2:
        Transformation(kTransforms.size());
        break;
      case 3:
        Line(draw_.From(kStates));
        break;
      case 4:
        Line(draw_.From(kDefinitions));
        break;
      case 5:
        if (isKnown_ && !isInObject_) Line("ObjectInstance \"body\"");
        [[fallthrough]];
      default:
        Line(draw_.From(kShapes));
    }
  }

  Draw draw_;
  std::string text_;
  std::vector<std::string> open_;
  bool isInObject_ = false, isKnown_ = false;
};

}  // namespace

std::vector<RecordedScene> StateScenes(std::uint64_t firstSeed, std::uint64_t lastSeed) {
  std::string unknown;
  const AovSet aovs = ParseAovs("P,N,Ng,Z,objectId,materialId", &unknown).value();
  return OfSeeds(firstSeed, lastSeed, [&](std::uint64_t seed) {
    return RecordedScene{"state/" + std::to_string(seed), StateText(seed).Scene(), aovs};
  });
}

}  // namespace exphoton::recorded
