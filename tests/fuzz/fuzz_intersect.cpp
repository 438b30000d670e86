// SPDX-License-Identifier: BSD-2-Clause
// fuzz_intersect traces any ray against any finite triangles. Accelerators must agree with brute
// force, and t must be a valid number.
#include "tests/fuzz/input.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

using namespace exphoton;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  Ray ray;
  ray.o = input.AnyPoint();
  const Point3 towards = input.AnyPoint();
  ray.d = {towards.x, towards.y, towards.z};
  const Real tMax = Real(input.Float());
  if (tMax > 0) ray.tMax = tMax;
  TriangleList triangles;
  while (!input.IsEmpty() && triangles.size() < 64) {
    const Point3 a = input.AnyPoint(), b = input.AnyPoint(), c = input.AnyPoint();
    const auto isFine = [](const Point3& p) {
      return IsFinite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < Real(1e15);
    };
    if (isFine(a) && isFine(b) && isFine(c)) triangles.push_back({a, b, c});
  }
  static TestPlugins* const plugins = new TestPlugins;
  const auto set = TriangleSet(triangles);
  const Hit expected = plugins->MakeAccelerator("\"bruteforce\"", *set)->Intersect(ray);
  if (expected.IsHit()) {
    fuzz::Require(expected.t > 0 && expected.t < ray.tMax, "0 < t < tMax");
    fuzz::Require(std::isfinite(expected.uv.x) && std::isfinite(expected.uv.y), "finite weights");
  }
  for (const char* name : {"\"kdtree\"", "\"bvh\""}) {
    const Hit found = plugins->MakeAccelerator(name, *set)->Intersect(ray);
    fuzz::Require(found.IsHit() == expected.IsHit(), "the same hit or miss");
    if (found.IsHit()) fuzz::Require(found.t == expected.t, "the same t");
  }
  return 0;
}
