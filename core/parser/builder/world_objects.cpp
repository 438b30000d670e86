// SPDX-License-Identifier: BSD-2-Clause
// WorldBuilder makes objects, their instances and accelerators, and returns the finished world.
#include <utility>

#include "core/base/log.h"
#include "core/params/suggestions.h"
#include "core/parser/builder/world_builder.h"

namespace exphoton {

std::unique_ptr<Aggregate> WorldBuilder::MakeAggregate(PrimitiveSet& set) {
  const PhaseTimer timer(times_, "accelerator");
  set.Finish();
  return registry_.Create<PluginKind::Accelerator>(
      accelerator_.name, accelerator_.params,
      Bind(PluginKind::Accelerator, accelerator_.name, nullptr),
      AcceleratorContext{set, log_, accelerator_.threads});
}

void WorldBuilder::BeginObject(const Directive& directive) {
  if (object_)
    FailAt(directive.Where(),
           "ObjectBegin inside the object that begins at " + LocationText(object_->where));
  const std::string& name = directive.strings[0];
  // Instances made before a redefinition keep the old object's geometry.
  objects_[name] = ObjectDefinition();
  object_ = &objects_[name];
  object_->where = directive.Where();
}

void WorldBuilder::EndObject() { object_ = nullptr; }

void WorldBuilder::AddInstance(const Directive& directive, const GraphicsState& state) {
  const std::string& name = directive.strings[0];
  const auto found = objects_.find(name);
  if (object_ && found != objects_.end() && &found->second == object_)
    FailAt(directive.Where(), "object \"" + name + "\" contains an instance of itself");
  if (object_) FailAt(directive.Where(), "an object cannot contain instances of other objects");
  if (found == objects_.end()) {
    std::vector<std::string> known;
    for (const auto& [other, definition] : objects_) known.push_back(other);
    FailDependent(directive.Where(), "no object \"" + name + "\" has been defined",
                  DidYouMean(name, known));
  }
  ObjectDefinition& object = found->second;
  if (!object.geometry) object.geometry = MakeObject(std::move(object.set));
  const AnimatedTransform place =
      MotionBetween(state.transform, transformTimes_, "\"" + name + "\"", directive.Where(), log_);
  const std::uint32_t id = ++objectCount_;
  names_.AddObject(name);
  if (object.geometry->Set().Count() > 0)
    parts_.primitives->AddInstance({place.Start(), object.geometry,
                                    place.Moves() ? std::make_shared<const Motion>(place) : nullptr,
                                    id});
  for (const Instance& part : object.moving) {
    const auto motion = std::make_shared<const Motion>(part.motion->PlacedBy(place));
    parts_.primitives->AddInstance({motion->Start(), part.object, motion, id});
  }
}

const ObjectGeometry* WorldBuilder::MakeObject(std::unique_ptr<PrimitiveSet> set) {
  std::unique_ptr<Aggregate> aggregate = MakeAggregate(*set);
  parts_.objects.push_back(std::make_unique<ObjectGeometry>(std::move(set), std::move(aggregate)));
  return parts_.objects.back().get();
}

SceneParts WorldBuilder::Take() {
  parts_.aggregate = MakeAggregate(*parts_.primitives);
  return std::move(parts_);
}

}  // namespace exphoton
