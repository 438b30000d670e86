// SPDX-License-Identifier: BSD-2-Clause
// These tests check meshes with holes ("alpha"): rays of all kinds pass the holes, with every
// accelerator, in instances and in motion, and a mesh without holes stays as it is.
#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// A square in the plane z = 0 whose texture coordinates run from 0 to 1. Alpha is 0 in the
// quarters where u and v lie on different sides of 1/2.
const std::string kTexture =
    "Texture \"holes\" \"float\" \"checkerboard\" \"float uscale\" 2 \"float vscale\" 2 "
    "\"float tex1\" 1 \"float tex2\" 0\n";
std::string Square(const std::string& alpha) {
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
         "\"point P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] \"float uv\" [0 0 1 0 1 1 0 1] " +
         alpha + "\n";
}
const std::string kHoles = kTexture + Square("\"texture alpha\" \"holes\"");

LoadedScene SceneOf(const std::string& world, const std::string& accelerator = "bvh",
                    const std::string& before = "") {
  return LoadSceneText("Accelerator \"" + accelerator + "\"\n" + before + "WorldBegin\n" + world +
                       "WorldEnd\n");
}

Ray Down(Real x, Real y, Real time = 0) {
  Ray ray;
  ray.o = Point3(x, y, 2);
  ray.d = Vector3(0, 0, -1);
  ray.time = time;
  return ray;
}

// Checks that rays meet two quarters of the square about (x, y, 0) and pass the others.
void ExpectHoles(const Scene& scene, Real x, Real y, Real time) {
  for (const Real sx : {Real(-.5), Real(.5)}) {
    for (const Real sy : {Real(-.5), Real(.5)}) {
      const Ray ray = Down(x + sx, y + sy + Real(.1), time);
      const bool isSurface = sx * sy > 0;
      EXPECT_EQ(scene.Intersect(ray).has_value(), isSurface) << sx << ' ' << sy;
      EXPECT_EQ(scene.IntersectPoint(ray).has_value(), isSurface) << sx << ' ' << sy;
      EXPECT_EQ(scene.Occluded(ray), isSurface) << sx << ' ' << sy;
    }
  }
}

TEST(CutOut, LetsRaysPassWithEveryAccelerator) {
  std::vector<std::string> accelerators{"bvh", "kdtree", "bruteforce"};
#ifdef EXPHOTON_EMBREE
  accelerators.push_back("embree");
#endif
  for (const std::string& accelerator : accelerators) {
    SCOPED_TRACE(accelerator);
    const LoadedScene scene = SceneOf(kHoles, accelerator);
    ExpectHoles(*scene.setup->scene, 0, 0, 0);
    const auto hit = scene.setup->scene->Intersect(Down(Real(.5), Real(.5)));
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->uv.x, .75, 1e-6);
    EXPECT_NEAR(hit->p.z, 0, 1e-6);
    EXPECT_EQ(hit->wo, Vector3(0, 0, 1));
    EXPECT_NE(hit->material, nullptr);
  }
}

TEST(CutOut, IsMetNearEachOfItsCorners) {
  const std::string opaque =
      "Texture \"opaque\" \"float\" \"checkerboard\" \"float tex1\" 1 \"float tex2\" .5\n";
  for (const char* order : {"0 1 2", "1 2 0", "2 0 1"}) {
    const LoadedScene scene = SceneOf(opaque +
                                      "Shape \"trianglemesh\" \"point P\" [-1 -1 0 1 -1 0 0 1 0] "
                                      "\"texture alpha\" \"opaque\" \"integer indices\" [" +
                                      order + "]\n");
    for (const Ray& ray :
         {Down(Real(-.9), Real(-.98)), Down(Real(.9), Real(-.98)), Down(0, Real(.9)), Down(0, 0)})
      EXPECT_TRUE(scene.setup->scene->Intersect(ray)) << order << ": " << ray.o.x << ' ' << ray.o.y;
  }
}

TEST(CutOut, ShowsWhatLiesBehind) {
  const LoadedScene scene = SceneOf(kHoles + "Translate 0 0 -1\n" + Square(""));
  EXPECT_NEAR(scene.setup->scene->Intersect(Down(Real(-.5), Real(.5)))->p.z, -1, 1e-6);
  EXPECT_NEAR(scene.setup->scene->Intersect(Down(Real(.5), Real(.5)))->p.z, 0, 1e-6);
}

TEST(CutOut, WorksInInstancesAndInMotion) {
  const LoadedScene instance = SceneOf("ObjectBegin \"o\"\n" + kHoles +
                                       "ObjectEnd\nTranslate 5 0 0\nObjectInstance \"o\"\n");
  ExpectHoles(*instance.setup->scene, 5, 0, 0);
  const LoadedScene moving =
      SceneOf("ActiveTransform EndTime Translate 4 0 0 ActiveTransform All\n" + kHoles, "bvh",
              "Camera \"perspective\" \"float shutteropen\" 0 \"float shutterclose\" 1\n");
  ExpectHoles(*moving.setup->scene, 0, 0, 0);
  ExpectHoles(*moving.setup->scene, 2, 0, Real(.5));
}

TEST(CutOut, OfAConstantLeavesAWholeMeshOrNone) {
  const LoadedScene whole = SceneOf(Square("\"float alpha\" .5"));
  EXPECT_EQ(whole.setup->scene->Primitives().TriangleCount(), 2u);
  const LoadedScene none = SceneOf(Square("\"float alpha\" 0"));
  EXPECT_EQ(none.setup->scene->Primitives().Count(), 0u);
  EXPECT_EQ(SceneOf(kHoles).setup->scene->Primitives().TriangleCount(), 0u);
}

TEST(CutOut, DoesNotApplyToEmitters) {
  const LoadedScene scene = SceneOf("AreaLightSource \"area\"\n" + kHoles);
  EXPECT_TRUE(scene.setup->scene->Occluded(Down(Real(-.5), Real(.5))));
  EXPECT_EQ(scene.setup->scene->Lights().size(), 1u);
}

// A floor under the square, lit from above: light falls through the holes only. With "show" the
// photon map alone makes the picture.
TEST(CutOut, LetsLightAndPhotonsThrough) {
  const std::string scene =
      "LookAt 0 0 .8 0 0 0 0 1 0\nCamera \"orthographic\" \"float screenwindow\" [-1 1 -1 1] "
      "\"float yon\" 10\n"
      "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
      "PixelFilter \"box\"\nSampler \"stratified\"\nWorldBegin\n"
      "LightSource \"distant\" \"point from\" [0 0 1] \"point to\" [0 0 0]\n" +
      std::string("AttributeBegin\nTranslate 0 0 1\n") + kHoles + "AttributeEnd\n" + Square("") +
      "WorldEnd\n";
  for (const char* integrator : {"directlighting", "exphotonmap"}) {
    SCOPED_TRACE(integrator);
    TestRenderOptions options;
    options.load.integrator = integrator;
    if (std::string(integrator) == "exphotonmap")
      options.load.parameters = {{"SurfaceIntegrator", "show", "directphotons"},
                                 {"SurfaceIntegrator", "maxdist", "0.1"}};
    const Image image = RenderSceneText(scene, options).image;
    double lit = 0;
    for (const auto& [x, y] : {std::pair{1, 1}, {1, 6}, {6, 1}, {6, 6}}) {
      const float value = image.At(x, y, 0);
      // The camera sees the floor with x to the left or right; the diagonal decides.
      lit += double(value);
      EXPECT_EQ(value > 0, image.At(7 - x, 7 - y, 0) > 0);
      EXPECT_NE(value > 0, image.At(7 - x, y, 0) > 0);
    }
    EXPECT_NEAR(lit / 2, 1 / M_PI, .1);
  }
}

TEST(DegenerateUvs, AreDiscardedOnRequest) {
  const std::string mesh =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-1 -1 0 1 -1 0 1 1 0] "
      "\"float uv\" [0 0 .5 .5 .5 .5] ";
  const auto uv = [&](const std::string& text) {
    return SceneOf(text).setup->scene->Intersect(Down(Real(.9), Real(-.8)))->uv.x;
  };
  EXPECT_LT(uv(mesh), Real(.5));
  EXPECT_GT(uv(mesh + "\"bool discarddegenerateUVs\" \"true\""), Real(.9));
}

}  // namespace
}  // namespace exphoton
