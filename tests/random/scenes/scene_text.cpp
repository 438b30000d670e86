// SPDX-License-Identifier: BSD-2-Clause
// SceneText writes the cameras, lights, media and shapes of random scenes as text.
#include "tests/random/scenes/scene_text.h"

#include <algorithm>
#include <cstdio>

namespace exphoton::random_scenes {
namespace {

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// Prints a power of two exactly, if it is not very small.
std::string PowerOfTwo(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string Triple(double x, double y, double z) {
  return Number(x) + " " + Number(y) + " " + Number(z);
}

std::string ScaleText(double size) {
  return size == 1 ? "" : "Scale " + Triple(size, size, size) + "\n";
}

constexpr double kStep = .3;
std::string PlaceText(const Place& p) { return Triple(kStep * p.x, kStep * p.y, kStep * p.z); }

// The faces of the box have normals that point inwards. kBoxTop is the top, which open rooms lack.
const std::string kBoxFaces = "0 1 3 0 3 2 4 6 7 4 7 5 0 4 5 0 5 1 0 2 6 0 6 4 1 5 7 1 7 3";
const std::string kBoxTop = " 2 3 7 2 7 6";
std::string BoxMesh(const std::string& indices, double half) {
  std::string points;
  for (int i = 0; i < 8; ++i)
    points += Triple(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half) + "  ";
  return "  Shape \"trianglemesh\" \"integer indices\" [" + indices + "] \"point P\" [" + points +
         "]\n";
}

std::string RoomText(RoomKind room) {
  switch (room) {
    case RoomKind::Box:
      return BoxMesh(kBoxFaces + kBoxTop, 2);
    case RoomKind::OpenBox:
      return BoxMesh(kBoxFaces, 2);
    case RoomKind::Sphere:
      return "  ReverseOrientation Shape \"sphere\" \"float radius\" 3\n";
    case RoomKind::Corner:
      return "  Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2 3 5 2 3 4 5] \"point P\" "
             "[-9 -2 -9  9 -2 -9  9 -2 2  -9 -2 2  -9 9 2  9 9 2]\n";
    case RoomKind::None:
      break;
  }
  return "";
}

std::string ShapeText(const BodyModel& body) {
  switch (body.kind) {
    case BodyKind::Sphere:
      return "  Shape \"sphere\"\n";
    case BodyKind::PartialSphere:
      return "  Shape \"sphere\" \"float zmin\" -.6 \"float zmax\" .8 \"float phimax\" 250\n";
    case BodyKind::Disk:
      return "  Shape \"disk\" \"float innerradius\" .2\n";
    case BodyKind::Cylinder:
      return "  Shape \"cylinder\" \"float phimax\" 300\n";
    case BodyKind::Quad:
      return "  Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
             "[-1 -1 0  1 -1 0  1 1 0  -1 1 0]\n";
    case BodyKind::SmoothMesh:
      return "  Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 0 3 1 1 3 2] \"point P\" "
             "[0 0 1  .9 0 -.4  -.5 .8 -.4  -.5 -.8 -.4] \"normal N\" "
             "[0 0 1  .9 0 -.4  -.5 .8 -.4  -.5 -.8 -.4] \"float uv\" [0 0 1 0 1 1 0 1]\n";
    case BodyKind::Subdivided:
      if (body.isOpenMesh)
        return "  Shape \"loopsubdiv\" \"integer nlevels\" 2 \"integer indices\" "
               "[0 1 2 0 2 3 0 3 4 0 4 5] \"point P\" "
               "[0 -.2 .3  1 -.2 0  .7 .6 .1  0 .9 0  -.7 .5 -.1  -1 -.3 0]\n";
      return "  Shape \"loopsubdiv\" \"integer nlevels\" 2 \"integer indices\" "
             "[0 1 2 0 2 3 0 3 1 1 3 2] \"point P\" [0 0 1  .9 0 -.4  -.5 .8 -.4  -.5 -.8 -.4]\n";
    case BodyKind::Cone:
      return "  Shape \"cone\" \"float height\" .9 \"float phimax\" 320\n";
    case BodyKind::Paraboloid:
      return "  Shape \"paraboloid\" \"float zmin\" .1\n";
    case BodyKind::Hyperboloid:
      return "  Shape \"hyperboloid\" \"point p1\" [.9 0 -.7] \"point p2\" [-.4 .6 .7]\n";
    case BodyKind::HeightField:
      return "  Translate -.8 -.8 0 Scale 1.6 1.6 .4\n  Shape \"heightfield\" \"integer nu\" 3 "
             "\"integer nv\" 4 \"float Pz\" [0 .5 0  1 -.5 .2  0 .8 .3  -.4 0 1]\n";
    case BodyKind::Nurbs:
      return "  Shape \"nurbs\" \"integer nu\" 3 \"integer nv\" 3 \"integer uorder\" 3 \"integer "
             "vorder\" 3 \"float uknots\" [0 0 0 1 1 1] \"float vknots\" [0 0 0 1 1 1] \"float "
             "Pw\" [-1 -1 0 1  0 -1.4 .8 1.4  1 -1 0 1  -1 0 .5 1  0 0 2 2  1 0 .5 1  -1 1 0 1  0 "
             ".6 .4 .6  1 1 0 1]\n";
    case BodyKind::Box:
      break;
  }
  return BoxMesh(kBoxFaces + kBoxTop, .8);
}

std::string MotionText(int motion, double share) {
  std::string text;
  if (motion & 1) text += " Translate " + Triple(.4 * share, .2 * share, -.1 * share);
  if (motion & 2) text += " Rotate " + Number(40 * share) + " 0 1 1";
  return text;
}

std::string MotionDirectives(int motion, const TextOptions& options) {
  if (options.stillAt) return " " + MotionText(motion, *options.stillAt);
  return "  ActiveTransform EndTime" + MotionText(motion, 1) + " ActiveTransform All";
}

std::string TransformText(const BodyModel& body, const TextOptions& options) {
  constexpr std::array<double, 3> kSizes{.5, .3, .8};
  constexpr std::array<double, 4> kLast{1, 2, .5, -1};
  std::string text = "  Translate " + PlaceText(body.place) + "\n";
  if (body.motion != 0) text += MotionDirectives(body.motion, options) + "\n";
  if (body.isGrowing) text += "  ActiveTransform EndTime Scale 1.2 .8 1 ActiveTransform All\n";
  if (body.turn != 0) text += "  Rotate " + std::to_string(25 * body.turn) + " 1 2 3\n";
  const double s = kSizes[std::size_t(body.size)];
  text += "  Scale " +
          (body.stretch == 0   ? Triple(s, s, s)
           : body.stretch == 1 ? Triple(1.5 * s, s, .5 * s)
                               : Triple(-s, s, s)) +
          "\n";
  if (body.last != 0 && options.keepsLastElements) {
    const std::string w = Number(kLast[std::size_t(body.last)]);
    text += "  ConcatTransform [" + w + " 0 0 0 0 " + w + " 0 0 0 0 " + w + " 0 0 0 0 " + w + "]\n";
  }
  return text;
}

std::string FurnaceLight(const MaterialModel& material) {
  const auto albedo = LargestAlbedo(material);
  return "  AreaLightSource \"area\" \"color L\" [" +
         Triple(1 - albedo[0], 1 - albedo[1], 1 - albedo[2]) + "]\n";
}

std::string EmissionText(const BodyModel& body, double power) {
  if (body.emission == 0) return "";
  return "  AreaLightSource \"area\" " +
         (body.emission == 1   ? "\"color L\" " + ColourText(body.light, 4, power)
          : body.emission == 2 ? "\"blackbody L\" [4000 " + Number(power) + "]"
                               : std::string("\"color L\" [0 0 0]")) +
         "\n";
}

std::string BodyText(const BodyModel& body, const TextOptions& options, int* next) {
  std::string text = "AttributeBegin\n" + MaterialText(body.material, !options.isFurnace, next);
  const std::string place = TransformText(body, options);
  // The normals of boxes point inwards.
  const bool reverses = (body.kind == BodyKind::Box) != (body.reverse != 0);
  const std::string shape = (reverses ? "  ReverseOrientation\n" : "") + ShapeText(body);
  if (body.isInstance != 0) {
    const std::string name = "\"o" + std::to_string((*next)++) + "\"";
    const bool movesPart = options.partsMove && body.motion != 0;
    const std::string part = movesPart ? MotionDirectives(body.motion, options) + "\n" : "";
    // The instance has the size already.
    text += "  ObjectBegin " + name + "\n" + options.objectScale + ScaleText(1 / options.size) +
            part + shape + "  ObjectEnd\n" + place + "  ObjectInstance " + name + "\n";
    if (body.isInstance == 2) text += "  Translate .3 .8 .5 ObjectInstance " + name + "\n";
  } else {
    text += (options.isFurnace ? FurnaceLight(body.material) : EmissionText(body, options.power)) +
            place + shape;
  }
  return text + "AttributeEnd\n";
}

// `intensity` multiplies the emission of a light at a point, `radiance` of a far one.
std::string LightText(const LightModel& light, const SceneModel& scene, double intensity,
                      double radiance) {
  constexpr std::array<const char*, kLightKinds> kNames{
      "point",      "spot",    "goniometric", "goniometric",   "projection",
      "projection", "distant", "infinite",    "infinitesample"};
  constexpr std::array<const char*, 3> kCones{"40", "10", "120"};
  const bool isFar = light.kind >= LightKind::Distant;
  const bool isSky = light.kind >= LightKind::Infinite;
  const bool isMapped = light.kind == LightKind::InfiniteMap ||
                        light.kind == LightKind::GoniometricMap ||
                        light.kind == LightKind::ProjectionMap;
  std::string text = "LightSource \"" + std::string(kNames[std::size_t(light.kind)]) + "\"";
  const std::string name = isFar ? "L" : "I";
  const double factor = isFar ? radiance : intensity;
  if (light.isBlackbody != 0)
    text += " \"blackbody " + name + "\" [4000 " + PowerOfTwo(light.isBlackbody == 1 ? factor : 0) +
            "]";
  else
    text += " \"color " + name + "\" " + ColourText(light.colour, isFar ? 1 : 3, factor);
  if (isMapped) text += " \"string mapname\" \"" + ImageFile() + "\"";
  if (isSky) return text + "\n";
  const bool isInside = light.isInsideAShape != 0 && !scene.bodies.empty();
  const Place& p = isInside ? scene.bodies.front().place : light.place;
  const double x = kStep * p.x + .02, y = kStep * p.y + .03, z = kStep * p.z + .05;
  if (light.kind >= LightKind::Goniometric && light.kind <= LightKind::ProjectionMap) {
    if (light.kind >= LightKind::Projection)
      text += std::string(" \"float fov\" ") + kCones[std::size_t(light.cone)];
    return "AttributeBegin Translate " + Triple(x, y, z) + " Rotate 70 1 0 .3\n  " + text +
           "\nAttributeEnd\n";
  }
  text += " \"point from\" [" + Triple(x, y, z) + "]";
  if (light.kind == LightKind::Point) return text + "\n";
  text += " \"point to\" [" + Triple(x + .1, y - 1, z + .3) + "]";
  if (light.kind == LightKind::Spot)
    text += std::string(" \"float coneangle\" ") + kCones[std::size_t(light.cone)];
  return text + "\n";
}

std::string MediumText(const MediumModel& medium, const TextOptions& options) {
  constexpr std::array<const char*, 3> kNames{"homogeneous", "exponential", "volumegrid"};
  const double half = medium.size == 0 ? 2 : .7;
  const Place& p = medium.size == 0 ? Place{} : medium.place;
  const double x = kStep * p.x, y = kStep * p.y, z = kStep * p.z;
  std::string text = "Volume \"" + std::string(kNames[std::size_t(medium.kind)]) +
                     "\" \"point p0\" [" + Triple(x - half, y - half, z - half) +
                     "] \"point p1\" [" + Triple(x + half, y + half, z + half) + "]";
  const auto part = [&](int number, const char* name, const Colour& colour) {
    const double scale = (*name == 'L' ? options.power : 1) / options.size;
    if (medium.parts == number || medium.parts == 3)
      text += " \"color " + std::string(name) + "\" " + ColourText(colour, .5, scale);
  };
  part(0, "sigma_a", medium.absorbed);
  part(1, "sigma_s", medium.scattered);
  if (!options.isFurnace) part(2, "Le", medium.emitted);
  if (options.isFurnace && !options.hasSky) part(0, "Le", medium.absorbed);
  if (medium.phase != 0) text += medium.phase == 1 ? " \"float g\" .6" : " \"float g\" -.4";
  if (medium.kind == 1) text += " \"float b\" .5";
  if (medium.kind == 2)
    text += " \"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 2 \"float density\" [1 0 .5 2]";
  return text + "\n";
}

std::string CameraText(const CameraModel& camera, const TextOptions& options) {
  const std::optional<double> stillAt = options.stillAt;
  constexpr std::array<const char*, 3> kPlaces{"-.1 -.2 1.9", "-.1 -.2 .1", "1.5 .1 1.2"};
  std::string text;
  if (camera.times != 0)
    text = camera.times == 1 ? "TransformTimes 0 .2\n" : "TransformTimes .3 .4\n";
  text += "Translate " + std::string(kPlaces[std::size_t(camera.place)]) + "\n";
  const double share = stillAt.value_or(1);
  const std::string moved = camera.motion == 1   ? "Translate " + Number(.3 * share) + " 0 0"
                            : camera.motion == 2 ? "Rotate " + Number(20 * share) + " 0 1 0"
                                                 : "";
  if (!moved.empty())
    text += stillAt ? moved + "\n" : "ActiveTransform EndTime " + moved + " ActiveTransform All\n";
  text += ScaleText(1 / options.size);
  text += camera.kind == 0   ? "Camera \"perspective\" \"float fov\" 80"
          : camera.kind == 1 ? "Camera \"orthographic\""
                             : "Camera \"environment\"";
  if (camera.lens && camera.kind != 2) text += " \"float lensradius\" .1 \"float focaldistance\" 2";
  if (camera.shutter == 1) text += " \"float shutteropen\" 0 \"float shutterclose\" 0";
  if (camera.shutter == 2) text += " \"float shutteropen\" .25 \"float shutterclose\" .5";
  return text + "\n";
}

std::string SamplerText(const SceneModel& scene, int samples) {
  constexpr std::array<const char*, 3> kFilters{"box", "gaussian", "triangle"};
  if (samples > 0)
    return "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" " +
           std::to_string(samples) + "\n";
  return "PixelFilter \"" + std::string(kFilters[std::size_t(scene.filter)]) + "\"\nSampler " +
         (scene.sampler == 0   ? "\"lowdiscrepancy\" \"integer pixelsamples\" 2"
          : scene.sampler == 1 ? "\"stratified\" \"integer xsamples\" 2 \"integer ysamples\" 1"
                               : "\"random\" \"integer xsamples\" 2 \"integer ysamples\" 1") +
         "\n";
}

std::string FilmText(const TextOptions& options) {
  std::string text = "Film \"image\" \"integer xresolution\" " + std::to_string(options.width) +
                     " \"integer yresolution\" " + std::to_string(options.height);
  const auto& c = options.crop;
  if (c != TextOptions{}.crop)
    text += " \"float cropwindow\" [" + Number(c[0]) + " " + Triple(c[1], c[2], c[3]) + "]";
  return text + "\n";
}

std::string IntegratorText(const SceneModel& scene, const TextOptions& options) {
  const std::string own = kIntegrators[std::size_t(scene.integrator)];
  std::string text = "SurfaceIntegrator " + (options.integrator.empty() ? own : options.integrator);
  if (text.find("photonmap") != std::string::npos) {
    const auto add = [&](const char* name, int value) {
      text += " \"integer " + std::string(name) + "\" " + std::to_string(value);
    };
    add("causticphotons", options.photons);
    add("indirectphotons", options.photons);
    add("maxphotonpaths", options.maxPhotonPaths);
    add("finalgathersamples", options.gatherRays);
  }
  if (text.find("guidedpath") != std::string::npos)
    text += " \"integer indirectphotons\" " + std::to_string(options.photons) +
            " \"integer maxphotonpaths\" " + std::to_string(options.maxPhotonPaths);
  text += options.ending;
  if (scene.volumeIntegrator == 0) return text + "\n";
  return text + "\nVolumeIntegrator " +
         (scene.volumeIntegrator == 1 ? "\"emission\"" : "\"single\"") + " \"float stepsize\" " +
         (options.size == 1 ? ".5" : Number(.5 * options.size)) + "\n";
}

}  // namespace

std::string SceneText(const SceneModel& scene, const TextOptions& options) {
  std::string text = IntegratorText(scene, options) + "Accelerator \"" + options.accelerator +
                     "\"\n" + SamplerText(scene, options.samples) + FilmText(options) +
                     CameraText(scene.camera, options) + "WorldBegin\n" + options.worldScale +
                     ScaleText(options.size);
  int next = 1;
  if (options.isFurnace && options.hasSky) text += "LightSource \"infinite\"\n";
  if (!options.isFurnace)
    for (const LightModel& light : scene.lights)
      text += LightText(light, scene, options.power * options.size * options.size, options.power);
  if (options.hasBlackLight) text += "LightSource \"point\" \"color I\" [0 0 0]\n";
  for (const MediumModel& medium : scene.media) text += MediumText(medium, options);
  if (scene.room != RoomKind::None)
    text += "AttributeBegin\n" + MaterialText(scene.walls, !options.isFurnace, &next) +
            (options.isFurnace ? FurnaceLight(scene.walls) : "") + RoomText(scene.room) +
            "AttributeEnd\n";
  for (const BodyModel& body : scene.bodies) text += BodyText(body, options, &next);
  return text + "WorldEnd\n";
}

}  // namespace exphoton::random_scenes
