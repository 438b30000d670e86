// SPDX-License-Identifier: BSD-2-Clause
#include "tests/benchmark/rooms/embree_room.h"

#include <stdexcept>
#include <string>

namespace exphoton {
namespace {

// Rays start at this t, as Embree's users set it. Embree has no other protection against hits on
// the surface that a ray leaves.
constexpr float kStart = 1e-5f;

RTCRay Converted(const Ray& ray) {
  RTCRay r;
  r.org_x = ray.o.x, r.org_y = ray.o.y, r.org_z = ray.o.z;
  r.dir_x = ray.d.x, r.dir_y = ray.d.y, r.dir_z = ray.d.z;
  r.tnear = kStart, r.tfar = ray.tMax, r.time = 0;
  r.mask = ~0u, r.id = 0, r.flags = 0;
  return r;
}

}  // namespace

EmbreeRoom::EmbreeRoom(const PrimitiveSet& set, bool isRobust, int threads) {
  device_ = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  if (!device_) throw std::runtime_error("Embree makes no device");
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, isRobust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t count = set.TriangleCount();
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
  for (std::uint32_t id = 0; id < count; ++id) {
    const auto& corners = set.TriangleVertices(id);
    for (unsigned v = 0; v < 3; ++v) {
      *indices++ = 3 * id + v;
      for (int axis = 0; axis < 3; ++axis) *vertices++ = corners[v][axis];
    }
  }
  rtcCommitGeometry(geometry_);
  rtcAttachGeometry(scene_, geometry_);
  rtcCommitScene(scene_);
}

EmbreeRoom::~EmbreeRoom() {
  rtcReleaseGeometry(geometry_);
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeRoom::Build() {
  rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(geometry_);
  rtcCommitScene(scene_);
}

Hit EmbreeRoom::Intersect(const Ray& ray) const {
  RTCRayHit query;
  query.ray = Converted(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &query);
  Hit hit;
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.t = query.ray.tfar;
  hit.uv = {query.hit.u, query.hit.v};
  hit.primitive = query.hit.primID;
  return hit;
}

bool EmbreeRoom::Occluded(const Ray& ray) const {
  RTCRay query = Converted(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_, &context, &query);
  return query.tfar < 0;
}

}  // namespace exphoton
