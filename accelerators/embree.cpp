// SPDX-License-Identifier: BSD-2-Clause
// embree uses Intel's ray tracing kernels (version 3) as an accelerator. Embree proposes triangles
// with its own rounding. The core's triangle test decides each proposal, as in the other
// accelerators, so a ray never hits the surface that it leaves. Shapes and instances are user
// geometry. Hits may differ from those of the other accelerators where a ray touches an edge of a
// box or where two surfaces lie at the same distance. The build needs the Embree library.
//
// Embree ignores boxes beyond 1.8e18, and its products overflow and underflow much earlier.
// Coordinates and directions are therefore scaled by powers of two to size 1, which gives Embree
// the range of the other accelerators. Scaling by a power of two changes no rounding.
#include "core/plugin.h"

#if defined(EXPHOTON_EMBREE) && !defined(EXPHOTON_DOUBLE)
#include <embree3/rtcore.h>

#include <atomic>
#endif

namespace exphoton {
namespace {

struct Settings {
  bool isRobust = true;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("robust", &Settings::isRobust, "Embree's flag: no ray slips between two triangles")};
  return table;
}

#if defined(EXPHOTON_EMBREE) && !defined(EXPHOTON_DOUBLE)

// Returns the power of two that scales numbers up to `largest` to [.5, 1], or 1 for 0 and infinity.
double ScaleToOne(Real largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  int exponent;
  std::frexp(double(largest), &exponent);
  return std::ldexp(1.0, -exponent);
}

// ScaledSet holds the primitives and the scale at which Embree sees them.
struct ScaledSet {
  const PrimitiveSet& primitives;
  double scale;

  explicit ScaledSet(const PrimitiveSet& set) : primitives(set), scale(1) {
    const Bounds3 world = set.WorldBounds();
    if (!world.IsEmpty())
      scale = ScaleToOne(std::max(MaxComponent(Abs(world.min)), MaxComponent(Abs(world.max))));
  }
  float Scaled(Real x) const { return float(double(x) * scale); }
};

// Query holds the data of the current ray for the callbacks. Embree passes a pointer to the first
// member to each callback.
struct Query {
  RTCIntersectContext context;
  const PrimitiveSet& primitives;
  const TraceRay trace;
  const double directionScale, tScale;  // Embree's t is t * tScale
  Hit hit;

  Query(const ScaledSet& set, const Ray& ray)
      : primitives(set.primitives),
        trace(ray),
        directionScale(ScaleToOne(MaxComponent(Abs(ray.d)))),
        tScale(set.scale / directionScale) {
    rtcInitIntersectContext(&context);
    hit.t = ray.tMax;
  }
  static Query& Of(RTCIntersectContext* context) { return *reinterpret_cast<Query*>(context); }

  // Intersects primitive `id` and returns whether it became the nearest hit.
  bool Improves(std::uint32_t id) {
    const Hit before = hit;
    primitives.Intersect(id, trace, &hit);
    return hit.primitive != before.primitive || hit.instance != before.instance ||
           hit.t != before.t;
  }
};

// Embree calls a filter to ask whether a triangle that it has hit counts.
void FilterClosest(const RTCFilterFunctionNArguments* arguments) {
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (!Query::Of(arguments->context).Improves(hit->primID)) arguments->valid[0] = 0;
}
void FilterAny(const RTCFilterFunctionNArguments* arguments) {
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  const Query& query = Query::Of(arguments->context);
  if (!query.primitives.Occludes(hit->primID, query.trace)) arguments->valid[0] = 0;
}

// The user geometry holds the shapes and instances, which follow the triangles in the set's
// numbering.
void OtherBounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& set = *static_cast<const ScaledSet*>(arguments->geometryUserPtr);
  const Bounds3 bounds = set.primitives.Bounds(set.primitives.TriangleCount() + arguments->primID);
  RTCBounds& out = *arguments->bounds_o;
  out = {1, 1, 1, 0, -1, -1, -1, 0};  // for an empty instance: Embree skips an empty box
  if (bounds.IsEmpty()) return;
  // Rounding in an intersection test shifts a hit by less than this fraction of the primitive's
  // size.
  const Real margin = Gamma(16) * MaxComponent(bounds.Diagonal());
  const auto below = [&](Real x) { return NextDown(set.Scaled(NextDown(x - margin))); };
  const auto above = [&](Real x) { return NextUp(set.Scaled(NextUp(x + margin))); };
  out.lower_x = below(bounds.min.x), out.upper_x = above(bounds.max.x);
  out.lower_y = below(bounds.min.y), out.upper_y = above(bounds.max.y);
  out.lower_z = below(bounds.min.z), out.upper_z = above(bounds.max.z);
}
void OtherClosest(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  Query& query = Query::Of(arguments->context);
  auto& rayHit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  if (!query.Improves(query.primitives.TriangleCount() + arguments->primID)) return;
  rayHit.ray.tfar = float(double(query.hit.t) * query.tScale);
  rayHit.hit.geomID = arguments->geomID;
  rayHit.hit.primID = arguments->primID;
}
void OtherAny(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const Query& query = Query::Of(arguments->context);
  auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  if (query.primitives.Occludes(query.primitives.TriangleCount() + arguments->primID, query.trace))
    ray.tfar = -std::numeric_limits<float>::infinity();
}

RTCRay Converted(const Ray& ray, const ScaledSet& set, const Query& query) {
  RTCRay r;
  const auto scaled = [&](Real d) { return float(double(d) * query.directionScale); };
  r.org_x = set.Scaled(ray.o.x), r.org_y = set.Scaled(ray.o.y), r.org_z = set.Scaled(ray.o.z);
  r.dir_x = scaled(ray.d.x), r.dir_y = scaled(ray.d.y), r.dir_z = scaled(ray.d.z);
  r.tnear = 0, r.tfar = float(double(ray.tMax) * query.tScale);
  r.time = 0, r.mask = ~0u, r.id = 0, r.flags = 0;
  return r;
}

class EmbreeAccelerator final : public Aggregate {
 public:
  EmbreeAccelerator(const PrimitiveSet& primitives, const Settings& settings)
      : primitives_(primitives),
        scaled_(primitives),
        device_(rtcNewDevice("threads=1")) {  // one thread builds the same tree every time
    if (!device_) throw Error(ExitStatus::Resource, "Embree cannot start");
    rtcSetDeviceMemoryMonitorFunction(device_, CountBytes, &bytes_);
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, settings.isRobust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    AddTriangles();
    AddOthers();
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
      Release();
      throw Error(ExitStatus::Resource, "Embree cannot build its structure (out of memory?)");
    }
  }
  ~EmbreeAccelerator() override { Release(); }

  Hit Intersect(const Ray& ray) const override {
    if (!IsTraceable(ray)) return {};
    Query query(scaled_, ray);
    RTCRayHit rayHit;
    rayHit.ray = Converted(ray, scaled_, query);
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &query.context, &rayHit);
    return query.hit.IsHit() ? primitives_.Reported(query.trace, query.hit) : Hit();
  }
  bool Occluded(const Ray& ray) const override {
    if (!IsTraceable(ray)) return false;
    Query query(scaled_, ray);
    RTCRay r = Converted(ray, scaled_, query);
    rtcOccluded1(scene_, &query.context, &r);
    return r.tfar < 0;
  }
  std::size_t MemoryBytes() const override { return std::size_t(std::max(bytes_.load(), 0l)); }

 private:
  static bool CountBytes(void* sum, ssize_t bytes, bool) {
    *static_cast<std::atomic<long>*>(sum) += bytes;
    return true;
  }

  void AddTriangles() {
    const std::size_t count = primitives_.TriangleCount();
    if (count == 0) return;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
    for (std::uint32_t id = 0; vertex && index && id < count; ++id) {
      const auto& corners = primitives_.TriangleVertices(id);
      for (unsigned v = 0; v < 3; ++v) {
        *index++ = 3 * id + v;
        for (int axis = 0; axis < 3; ++axis) *vertex++ = scaled_.Scaled(corners[v][axis]);
      }
    }
    rtcSetGeometryIntersectFilterFunction(geometry, FilterClosest);
    rtcSetGeometryOccludedFilterFunction(geometry, FilterAny);
    Attach(geometry);
  }

  void AddOthers() {
    const std::uint32_t count = primitives_.Count() - primitives_.TriangleCount();
    if (count == 0) return;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, count);
    rtcSetGeometryUserData(geometry, &scaled_);
    rtcSetGeometryBoundsFunction(geometry, OtherBounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, OtherClosest);
    rtcSetGeometryOccludedFunction(geometry, OtherAny);
    Attach(geometry);
  }

  void Attach(RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }
  void Release() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  const PrimitiveSet& primitives_;
  ScaledSet scaled_;
  std::atomic<long> bytes_ = 0;
  RTCDevice device_;
  RTCScene scene_;
};

std::unique_ptr<Aggregate> Create(const Settings& settings, const AcceleratorContext& context) {
  return std::make_unique<EmbreeAccelerator>(context.primitives, settings);
}

#else

std::unique_ptr<Aggregate> Create(const Settings&, const AcceleratorContext&) {
  throw Error(ExitStatus::Scene,
              "this program was built without Embree: install libembree-dev and build it again, or "
              "use Accelerator \"bvh\"");
}

#endif

}  // namespace
}  // namespace exphoton

EXPHOTON_ACCELERATOR("embree", "Intel's Embree, where the program was built with it")
