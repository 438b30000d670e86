// SPDX-License-Identifier: BSD-2-Clause
// SceneModel is a random scene as a small structure of numbers. Rapidcheck draws and shrinks it,
// and scene_text.h writes it as a scene file. Most fields are indices into tables or counts of a
// fixed step. The first value of each is the simplest, so shrinking leads to simple scenes. The
// model has every kind of plugin, but only few values of each parameter.
#pragma once

#include <string>
#include <vector>

namespace exphoton::random_scenes {

struct Colour {
  int red = 5, green = 5, blue = 5;  // in tenths

  int Max() const;
};

enum class TextureKind {
  Constant,
  Scale,
  Mix,
  Checkerboard,
  CheckerboardOfSpace,
  Bilerp,
  Uv,
  Image,
  Nested,  // a mix of a scale of a checkerboard
  Fbm,
  Wrinkled,
  Windy,
  Marble,
  Dots,
};
inline constexpr int kTextureKinds = 14;

struct TextureModel {
  TextureKind kind = TextureKind::Constant;
  Colour first, second;
};

enum class MaterialKind {
  Matte,
  Mirror,
  Glass,
  Plastic,
  Metal,
  Substrate,
  Translucent,
  Uber,
  ShinyMetal,
  Fitted,  // bluepaint, brushedmetal, clay, felt, primer or skin
  Mix,     // of a matte and a mirror
  Measured,
};
inline constexpr int kMaterialKinds = 12;

struct MaterialModel {
  MaterialKind kind = MaterialKind::Matte;
  TextureModel diffuse, glossy, mirror;
  int share = 0;      // most light that diffuse lobes reflect: 0: .8, 1: .5, 2: .2
  int roughness = 0;  // 0: .1, 1: .3, 2: .02, 3: a texture; matte: 0, 15, 40 degrees
  // Of uber: 0: opaque, 1: .5, 2: red and green pass, 3: a texture, 4: a blend of 1 and 1.
  int opacity = 0;
  int bump = 0;  // 0: none, 1: constant, 2: checkerboard, 3: bilerp, 4: image
  int isPhysical = 0;
  bool isTransmittingOnly = false;  // of translucent; the generator does not set it

  int Fit() const { return share + 3 * isPhysical; }  // of a fitted material, by alphabet
};

enum class BodyKind {
  Box,
  Sphere,
  PartialSphere,
  Disk,
  Cylinder,
  Quad,
  SmoothMesh,  // with interpolated normals
  Subdivided,
  Cone,
  Paraboloid,
  Hyperboloid,
  HeightField,
  Nurbs,
};
inline constexpr int kBodyKinds = 13;

struct Place {
  int x = 0, y = 0, z = 0;  // in steps of .3 from the centre of the room
};

struct BodyModel {
  BodyKind kind = BodyKind::Box;
  Place place;
  int size = 0;     // 0: .5, 1: .3, 2: .8
  int turn = 0;     // steps of 25 degrees about (1 2 3)
  int stretch = 0;  // 0: none, 1: (1.5 1 .5), 2: mirrored in x
  int motion = 0;   // 0: none, 1: translation, 2: rotation, 3: both
  int reverse = 0;
  int isInstance = 0;  // 1: placed once, 2: placed twice
  int last = 0;        // last element of the matrix: 0: 1, 1: 2, 2: .5, 3: -1
  int emission = 0;    // 0: none, 1: a colour, 2: a black-body spectrum, 3: black
  Colour light;
  MaterialModel material;
  // The generator does not set these.
  bool isOpenMesh = false;  // of subdivided meshes
  bool isGrowing = false;   // of moving bodies: the axes grow differently
};

enum class LightKind {
  Point,
  Spot,
  Goniometric,
  GoniometricMap,
  Projection,
  ProjectionMap,
  Distant,
  Infinite,
  InfiniteMap,
};
inline constexpr int kLightKinds = 9;

struct LightModel {
  LightKind kind = LightKind::Point;
  Colour colour;
  Place place;
  int isBlackbody = 0;     // 1: a spectrum of 4000 K, 2: one scaled by 0
  int isInsideAShape = 0;  // at the centre of the first body
  int cone = 0;            // or field of view; 0: 40 degrees, 1: 10, 2: 120
};

struct MediumModel {
  int kind = 0;  // 0: homogeneous, 1: exponential, 2: volumegrid
  Colour absorbed, scattered, emitted;
  int parts = 0;  // 0: absorbs, 1: scatters, 2: emits, 3: all three
  int size = 0;   // 0: the room, 1: a part of it
  int phase = 0;  // phase function: 0: even, 1: forward, 2: backward
  Place place;
};

struct CameraModel {
  int kind = 0;  // 0: perspective, 1: orthographic, 2: environment
  int lens = 0;
  int motion = 0;   // 0: none, 1: translation, 2: rotation
  int shutter = 0;  // 0: from 0 to 1, 1: closed, 2: from .25 to .5
  int times = 0;    // of all motion: 0: from 0 to 1, 1: from 0 to .2, 2: from .3 to .4
  int place = 0;    // 0: at the front wall, 1: in the centre, 2: at the left
};

enum class RoomKind { Box, Sphere, OpenBox, Corner, None };
inline constexpr int kRoomKinds = 5;

struct SceneModel {
  RoomKind room = RoomKind::Box;
  MaterialModel walls;
  std::vector<BodyModel> bodies;
  std::vector<LightModel> lights;
  std::vector<MediumModel> media;
  int volumeIntegrator = 0;  // 0: not named, 1: emission, 2: single
  CameraModel camera;
  int sampler = 0;     // 0: lowdiscrepancy, 1: stratified, 2: random
  int filter = 0;      // 0: box, 1: gaussian, 2: triangle; none has negative lobes
  int integrator = 0;  // an index into kIntegrators
};

// The integrators for the test of invariances, with parameters.
extern const std::vector<std::string> kIntegrators;

}  // namespace exphoton::random_scenes
