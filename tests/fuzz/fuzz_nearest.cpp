// SPDX-License-Identifier: BSD-2-Clause
// fuzz_nearest checks that the searches agree with brute force for any finite points.
#include "tests/fuzz/input.h"
#include "tests/support/point_trees.h"

using namespace exphoton;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  NearestQuery query;
  query.k = 1 + input.Byte() % 64;
  query.p = input.AnyPoint();
  // Beyond this limit squared distances overflow in every search.
  const auto isNear = [](const Point3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < Real(1e18);
  };
  std::vector<Point3> points;
  while (!input.IsEmpty() && points.size() < 2000) {
    const Point3 p = input.AnyPoint();
    if (IsFinite(p) && isNear(p)) points.push_back(p);
  }
  const TestPointTree tree(points);
  if (IsFinite(query.p) && !isNear(query.p)) return 0;
  const auto expected = tree.NearestByBruteForce(query);
  for (const NearestSearch* search : AvailableNearestSearches())
    fuzz::Require(tree.Nearest(*search, query) == expected, "the nearest");
  return 0;
}
