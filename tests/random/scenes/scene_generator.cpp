// SPDX-License-Identifier: BSD-2-Clause
// SceneGenerator combines generators of the parts of a scene. Shrinking drops elements of lists and
// moves each number to the first value of its table.
#include "tests/random/scenes/scene_generator.h"

#include <algorithm>
#include <initializer_list>

namespace exphoton::random_scenes {
namespace {

namespace gen = rc::gen;

// Draws one of the values; repeated values are more likely. Shrinks to the first value.
template <class Value>
rc::Gen<Value> Of(std::initializer_list<Value> values) {
  const std::vector<Value> table(values);
  return gen::map(gen::inRange(0, int(table.size())),
                  [table](int i) { return table[std::size_t(i)]; });
}

// Draws a value of an enumeration; every second draw is the first value. Shrinks to the first
// value.
template <class Value>
rc::Gen<Value> Kind(int count) {
  return gen::map(gen::inRange(0, 2 * count),
                  [count](int i) { return Value(i < count ? 0 : i - count); });
}

template <class Value>
rc::Gen<Value> EvenKind(int count) {
  return gen::map(gen::inRange(0, count), [](int i) { return Value(i); });
}

rc::Gen<Colour> AnyColour() {
  const auto channel = [] { return Of({5, 5, 5, 0, 0, 9, 2}); };
  const auto grey = gen::map(Of({5, 5, 9, 2, 0}), [](int v) { return Colour{v, v, v}; });
  const auto mixed =
      gen::build<Colour>(gen::set(&Colour::red, channel()), gen::set(&Colour::green, channel()),
                         gen::set(&Colour::blue, channel()));
  return gen::oneOf(grey, mixed);
}

rc::Gen<Colour> LightColour() {
  return gen::oneOf(gen::just(Colour{}), gen::just(Colour{9, 9, 9}), AnyColour());
}

rc::Gen<TextureModel> AnyTexture() {
  return gen::build<TextureModel>(gen::set(&TextureModel::kind, Kind<TextureKind>(kTextureKinds)),
                                  gen::set(&TextureModel::first, AnyColour()),
                                  gen::set(&TextureModel::second, AnyColour()));
}

// Replaces medium channel values by the largest, so that glossy lobes are strong.
rc::Gen<TextureModel> BrightTexture() {
  return gen::map(AnyTexture(), [](TextureModel t) {
    for (Colour* colour : {&t.first, &t.second})
      for (int* channel : {&colour->red, &colour->green, &colour->blue})
        if (*channel == 5) *channel = 9;
    return t;
  });
}

rc::Gen<MaterialModel> AnyMaterial() {
  using M = MaterialModel;
  return gen::build<M>(gen::set(&M::kind, EvenKind<MaterialKind>(kMaterialKinds)),
                       gen::set(&M::diffuse, AnyTexture()), gen::set(&M::glossy, BrightTexture()),
                       gen::set(&M::mirror, AnyTexture()), gen::set(&M::share, Of({0, 1, 2, 2})),
                       gen::set(&M::roughness, Of({0, 0, 1, 2, 3})),
                       gen::set(&M::opacity, Of({0, 0, 1, 2, 3, 4})),
                       gen::set(&M::bump, Of({0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4})),
                       gen::set(&M::isPhysical, Of({0, 1})));
}

rc::Gen<Place> AnyPlace() {
  const auto step = [] { return Of({0, 1, -1, 2, -2, 3, -3, 4, -4}); };
  return gen::build<Place>(gen::set(&Place::x, step()), gen::set(&Place::y, step()),
                           gen::set(&Place::z, step()));
}

rc::Gen<BodyModel> AnyBody() {
  using B = BodyModel;
  return gen::build<B>(
      gen::set(&B::kind, Kind<BodyKind>(kBodyKinds)), gen::set(&B::place, AnyPlace()),
      gen::set(&B::size, Of({0, 1, 2})), gen::set(&B::turn, Of({0, 0, 1, 2, 5})),
      gen::set(&B::stretch, Of({0, 0, 0, 1, 2})),
      gen::set(&B::motion, Of({0, 0, 0, 0, 0, 1, 2, 3})), gen::set(&B::reverse, Of({0, 0, 0, 1})),
      gen::set(&B::isInstance, Of({0, 0, 0, 0, 1, 2})), gen::set(&B::last, Of({0, 0, 0, 1, 2, 3})),
      gen::set(&B::emission, Of({0, 0, 0, 1, 1, 2, 3})), gen::set(&B::light, LightColour()),
      gen::set(&B::material, AnyMaterial()));
}

rc::Gen<LightModel> AnyLight() {
  using L = LightModel;
  return gen::build<L>(
      gen::set(&L::kind, EvenKind<LightKind>(kLightKinds)), gen::set(&L::colour, LightColour()),
      gen::set(&L::place, AnyPlace()), gen::set(&L::isBlackbody, Of({0, 0, 0, 0, 1, 2})),
      gen::set(&L::isInsideAShape, Of({0, 0, 0, 1})), gen::set(&L::cone, Of({0, 1, 2})));
}

rc::Gen<MediumModel> AnyMedium() {
  using M = MediumModel;
  return gen::build<M>(gen::set(&M::kind, Of({0, 0, 1, 2})), gen::set(&M::absorbed, AnyColour()),
                       gen::set(&M::scattered, AnyColour()), gen::set(&M::emitted, AnyColour()),
                       gen::set(&M::parts, Of({0, 1, 2, 3})), gen::set(&M::size, Of({0, 1})),
                       gen::set(&M::phase, Of({0, 0, 1, 2})), gen::set(&M::place, AnyPlace()));
}

rc::Gen<CameraModel> AnyCamera() {
  using C = CameraModel;
  return gen::build<C>(
      gen::set(&C::kind, Of({0, 0, 0, 1, 2})), gen::set(&C::lens, Of({0, 0, 0, 1})),
      gen::set(&C::motion, Of({0, 0, 0, 0, 1, 2})), gen::set(&C::shutter, Of({0, 0, 0, 1, 2})),
      gen::set(&C::times, Of({0, 0, 0, 1, 2})), gen::set(&C::place, Of({0, 0, 1, 2})));
}

// Draws up to three elements. At least 10 - `often` of ten lists are empty.
template <class Value>
rc::Gen<std::vector<Value>> List(std::size_t often, rc::Gen<Value> element) {
  const auto some =
      gen::resize(3, gen::container<std::vector<Value>>(gen::resize(rc::kNominalSize, element)));
  return gen::weightedOneOf<std::vector<Value>>(
      {{often, some}, {10 - often, gen::just(std::vector<Value>{})}});
}

}  // namespace

rc::Gen<SceneModel> SceneGenerator() {
  using S = SceneModel;
  return gen::build<S>(
      gen::set(&S::room, Kind<RoomKind>(kRoomKinds)), gen::set(&S::walls, AnyMaterial()),
      gen::set(&S::bodies, List(10, AnyBody())), gen::set(&S::lights, List(9, AnyLight())),
      gen::set(&S::media, List(4, AnyMedium())), gen::set(&S::volumeIntegrator, Of({0, 1, 2})),
      gen::set(&S::camera, AnyCamera()), gen::set(&S::sampler, Of({0, 0, 0, 1, 2})),
      gen::set(&S::filter, Of({0, 0, 0, 1, 2})),
      gen::set(&S::integrator, gen::inRange(0, int(kIntegrators.size()))));
}

rc::Shrinkable<SceneModel> SceneOfSeed(std::uint64_t seed) {
  static const rc::Gen<SceneModel> generator = SceneGenerator();
  return generator(rc::Random(seed), rc::kNominalSize);
}

}  // namespace exphoton::random_scenes
