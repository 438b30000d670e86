// SPDX-License-Identifier: BSD-2-Clause
// QuadricShapes is the base class of tests that make quadric shapes from scene text.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <variant>

#include "core/geometry/shape.h"
#include "tests/support/test_plugin.h"

namespace exphoton {

class QuadricShapes : public testing::Test {
 protected:
  std::unique_ptr<Shape> Make(const std::string& text, const Transform& toWorld = {},
                              bool reverse = false) {
    ShapeGeometry geometry = plugins_.MakeShape(text, toWorld, reverse);
    return std::move(std::get<std::unique_ptr<Shape>>(geometry));
  }
  TestPlugins plugins_;
};

inline Ray RayFromTo(const Point3& o, const Point3& target) {
  Ray ray;
  ray.o = o;
  ray.d = target - o;
  return ray;
}

}  // namespace exphoton
