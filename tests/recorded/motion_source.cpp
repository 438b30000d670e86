// SPDX-License-Identifier: BSD-2-Clause
// MotionScenes combines every kind of motion with everything that can move: a shape, a lamp, a part
// of an object, an instance, both, and the camera. The body that moves is a coarse mesh with smooth
// normals that is diffuse and a mirror, so directions between its two normals are frequent.
#include <array>
#include <string>

#include "tests/recorded/scene_list.h"

namespace exphoton::recorded {
namespace {

struct Motion {
  const char* name;
  const char* pose;    // at both ends of the exposure
  const char* change;  // at its end alone
};

constexpr std::array<Motion, 4> kMotions{{{"shift", "Translate .1 0 0", "Translate .4 .2 -.1"},
                                          {"turn", "Rotate 25 0 1 1", "Rotate 50 1 .2 0"},
                                          {"grow", "Scale 1 .9 1.1", "Scale 1.6 .8 1.3"},
                                          {"all", "Rotate 30 1 0 1 Scale .9 1 1",
                                           "Translate -.3 .1 .2 Rotate 35 0 1 0 Scale .7 1.4 1"}}};

constexpr std::array<const char*, 4> kIntegrators{
    "\"path\" \"integer maxdepth\" 3",
    "\"exphotonmap\" \"integer indirectphotons\" 300 \"integer causticphotons\" 80 "
    "\"integer finalgathersamples\" 6 \"integer maxphotonpaths\" 3000",
    "\"photonmap\" \"bool finalgather\" \"false\" \"bool directwithphotons\" \"true\" "
    "\"integer directphotons\" 200 \"integer indirectphotons\" 200 \"integer maxphotonpaths\" 3000",
    "\"bidirectional\" \"integer maxdepth\" 3"};

constexpr std::array<const char*, 7> kCarriers{
    "shape", "lamp", "part", "instance", "part of moving instance", "part of two instances",
    "camera"};

constexpr const char* kBody =
    "Material \"uber\" \"color Kd\" [.5 .3 .2] \"color Kr\" [.3 .4 .5]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]"
    " \"point P\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1]"
    " \"normal N\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1]"
    " \"float uv\" [0 0 1 0 .5 1 .5 0 0 1 1 1]\n"
    "Material \"matte\" \"color Kd\" [.2 .6 .3]\n"
    "Translate .9 -.5 -.6 Shape \"sphere\" \"float radius\" .4\n";

std::string Moving(const Motion& motion) {
  return std::string(motion.pose) + "\nActiveTransform EndTime " + motion.change +
         "\nActiveTransform All\n";
}

std::string BodyText(const std::string& carrier, const std::string& moving) {
  if (carrier == "shape") return moving + kBody;
  const bool isPartMoving = carrier.starts_with("part");
  const bool isInstanceMoving = carrier == "instance" || carrier == "part of moving instance";
  if (!isPartMoving && !isInstanceMoving) return kBody;
  std::string text = "ObjectBegin \"body\"\n" + (isPartMoving ? moving : "") + kBody +
                     "ObjectEnd\nTranslate -.2 .1 .3 Rotate 20 0 0 1 Scale 1.1 .9 1\n";
  if (isInstanceMoving) text += moving;
  text += "ObjectInstance \"body\"\n";
  if (carrier == "part of two instances")
    text += "Translate .2 1.2 .7 Rotate 70 1 1 0 Scale .5 .5 .5\nObjectInstance \"body\"\n";
  return text;
}

std::string Text(const Motion& motion, const std::string& carrier, const char* integrator) {
  const std::string moving = Moving(motion);
  std::string text =
      "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 8\n"
      "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 2\n"
      "PixelFilter \"box\"\nSurfaceIntegrator " +
      std::string(integrator) + "\nTransformTimes 0 .8\n";
  if (carrier == "camera") text += moving;
  text +=
      "LookAt .3 .8 -4 0 0 0 0 1 0\n"
      "Camera \"perspective\" \"float fov\" 48 \"float shutteropen\" .1\n"
      "WorldBegin\nAttributeBegin\n"
      "AreaLightSource \"area\" \"color L\" [9 7 5]\nTranslate -.5 2.4 -.4\n" +
      (carrier == "lamp" ? moving : "") +
      "Shape \"sphere\" \"float radius\" .4\nAttributeEnd\nAttributeBegin\n"
      "AreaLightSource \"area\" \"color L\" [3 4 9]\nTranslate 2 1 -1 Rotate 60 1 2 0\n" +
      (carrier == "lamp" ? moving : "") +
      "Shape \"cylinder\" \"float radius\" .3 \"float zmin\" 0 \"float zmax\" .5\n"
      "AttributeEnd\nMaterial \"matte\" \"color Kd\" [.7 .6 .5]\n"
      "AttributeBegin\nTranslate 0 -1.1 0 Rotate -90 1 0 0\n"
      "Shape \"disk\" \"float radius\" 5\nAttributeEnd\nAttributeBegin\n" +
      BodyText(carrier, moving) + "AttributeEnd\nWorldEnd\n";
  return text;
}

}  // namespace

std::vector<RecordedScene> MotionScenes() {
  std::vector<RecordedScene> scenes;
  std::string unknown;
  const AovSet aovs = ParseAovs("Z,N,P,objectId,materialId", &unknown).value();
  for (const Motion& motion : kMotions)
    for (const char* carrier : kCarriers)
      for (const char* integrator : kIntegrators) {
        const std::string name(integrator + 1);
        scenes.push_back({"motion/" + std::string(motion.name) + " of " + carrier + ", " +
                              name.substr(0, name.find('"')),
                          Text(motion, carrier, integrator), aovs});
      }
  return scenes;
}

}  // namespace exphoton::recorded
