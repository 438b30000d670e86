// SPDX-License-Identifier: BSD-2-Clause
// These tests check OBJ files: vertices, normals, texture coordinates, polygons, groups, and the
// errors of damaged files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "shapes/mesh/obj_reader.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string ErrorOf(const std::string& text, const std::string& group = "") {
  try {
    ParseObj(text, group);
  } catch (const ObjError& error) {
    return error.what();
  }
  return "no error";
}

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

double AreaOf(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& v : mesh.indices)
    area += double(Length(Cross(mesh.p[v[1]] - mesh.p[v[0]], mesh.p[v[2]] - mesh.p[v[0]]))) / 2;
  return area;
}

TEST(Obj, HasVerticesWithNormalsAndTextureCoordinatesFromTheTop) {
  const ObjMesh obj = ParseObj(
      "# a comment\r\nv 1 2 3\r\nv +4 5e0 .6 1 \r\nv 7 8 9 .1 .2 .3\n"
      "vt .25 .75\nvt 1 0 0\nvn 0 0 2\ns off\nf 1/1/1 2/2/1 3/1/1 # last\n",
      "");
  const TriangleMesh& mesh = *obj.mesh;
  ASSERT_EQ(mesh.TriangleCount(), 1u);
  ASSERT_EQ(mesh.p.size(), 3u);
  EXPECT_EQ(mesh.p[mesh.indices[0][0]], Point3(1, 2, 3));
  EXPECT_EQ(mesh.p[mesh.indices[0][1]], Point3(4, 5, Real(.6)));
  EXPECT_EQ(mesh.p[mesh.indices[0][2]], Point3(7, 8, 9));
  EXPECT_EQ(mesh.uv[mesh.indices[0][0]], Point2(Real(.25), Real(.25)));
  EXPECT_EQ(mesh.uv[mesh.indices[0][1]], Point2(1, 1));
  EXPECT_EQ(mesh.n[0], Normal3(0, 0, 2));
  EXPECT_FALSE(obj.namesMaterials);
}

TEST(Obj, SharesVerticesOfEqualNumbersAndSplitsOthers) {
  const ObjMesh plain = ParseObj(std::string(kSquare) + "f 1 2 3\nf 1 3 4\n", "");
  EXPECT_EQ(plain.mesh->p.size(), 4u);
  EXPECT_TRUE(plain.mesh->n.empty());
  EXPECT_TRUE(plain.mesh->uv.empty());
  const ObjMesh split =
      ParseObj(std::string(kSquare) + "vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4\n", "");
  EXPECT_EQ(split.mesh->p.size(), 5u);
  EXPECT_EQ(split.mesh->n.size(), 5u);
  EXPECT_EQ(split.mesh->n[split.mesh->indices[1][0]], Normal3(0, 1, 0));
  EXPECT_EQ(split.mesh->n[split.mesh->indices[1][2]], Normal3());  // the geometric one is used
}

TEST(Obj, CutsPolygonsIntoTrianglesThatCoverThem) {
  EXPECT_NEAR(AreaOf(*ParseObj(std::string(kSquare) + "f -4 -3 -2 -1\n", "").mesh), 1, 1e-6);
  // An arrow that is not convex: a triangle of area 4 without one of area 1.
  const ObjMesh arrow = ParseObj("v 0 0 0\nv 2 1 0\nv 4 0 0\nv 2 2 0\nv 2 2 0\nf 1 2 3 4\n", "");
  ASSERT_EQ(arrow.mesh->TriangleCount(), 2u);
  EXPECT_NEAR(AreaOf(*arrow.mesh), 2, 1e-6);
  const ObjMesh ell =
      ParseObj("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 \\\n 4 5 6\n", "");
  ASSERT_EQ(ell.mesh->TriangleCount(), 4u);
  EXPECT_NEAR(AreaOf(*ell.mesh), 3, 1e-6);
}

TEST(Obj, TakesTheFacesOfAGroupOrAnObject) {
  const std::string text =
      std::string(kSquare) + "f 1 2 3\ng low wall\nusemtl red\nf 1 2 4\nf 2 3 4\no box\nf 1 3 4\n";
  EXPECT_EQ(ParseObj(text, "").mesh->TriangleCount(), 4u);
  EXPECT_EQ(ParseObj(text, "wall").mesh->TriangleCount(), 3u);  // the group goes on in the box
  EXPECT_EQ(ParseObj(text, "low").mesh->TriangleCount(), 3u);
  const ObjMesh box = ParseObj(text, "box");
  EXPECT_EQ(box.mesh->TriangleCount(), 1u);
  EXPECT_EQ(box.mesh->p.size(), 3u);
  EXPECT_TRUE(box.namesMaterials);
  EXPECT_EQ(ErrorOf(text, "walls"),
            "it has no group or object \"walls\"; it has \"low\", \"wall\", \"box\"; did you mean "
            "\"wall\"?");
}

TEST(Obj, HasGroupsWithinItsObjects) {
  const std::string text = std::string(kSquare) +
                           "o Chair\ng Seat\nf 1 2 3\ng Back\nf 1 3 4\nf 2 3 4\n"
                           "o Table\ng Plate\nf 1 2 4\n";
  const auto count = [&](const char* group) { return ParseObj(text, group).mesh->TriangleCount(); };
  EXPECT_EQ(count("Chair"), 3u);
  EXPECT_EQ(count("Seat"), 1u);
  EXPECT_EQ(count("Back"), 2u);
  EXPECT_EQ(count("Table"), 1u);
  EXPECT_EQ(count("Plate"), 1u);
}

TEST(Obj, ThatIsDamagedIsAnErrorThatNamesTheLine) {
  const std::string square = kSquare;
  EXPECT_EQ(ErrorOf(""), "it has no vertices (lines that begin with \"v\")");
  EXPECT_EQ(ErrorOf("\x7f"
                    "ELF\n\n"),
            "it has no vertices (lines that begin with \"v\")");
  EXPECT_EQ(ErrorOf("v 1 2\n"), "line 1 has 2 numbers after \"v\"; expected 3");
  EXPECT_EQ(ErrorOf("\nv 1 x 3\n"), "line 2 has \"x\" instead of a number");
  for (const char* bad : {"1e999", "nan", "inf", "1,5", "0x1", "1.5.5", "--1", "+-1"})
    EXPECT_EQ(ErrorOf(std::string("v 0 0 ") + bad),
              std::string("line 1 has \"") + bad + "\" instead of a number");
  EXPECT_EQ(ErrorOf("v 0 0 1e-60\nf 1 1 1\n"), "no error");
  EXPECT_EQ(ErrorOf(square + "f 1 2\n"), "line 5 has a face of 2 corners; expected 3 or more");
  EXPECT_EQ(ErrorOf(square + "f 1 2 5\n"), "line 5 names number 5 of 4 vertices");
  EXPECT_EQ(ErrorOf(square + "f 1 2 -5\n"), "line 5 counts 5 back from 4 vertices");
  EXPECT_EQ(ErrorOf(square + "f 1 2 0\n"),
            "line 5 has the number 0 for a corner of a face; numbers begin with 1");
  EXPECT_EQ(ErrorOf(square + "vt 1 1\nf 1 2 3/2\n"),
            "line 6 names number 2 of 1 entry in the list of texture coordinates");
  EXPECT_EQ(ErrorOf(square + "f 1//1 2//1 3//1\n"), "line 5 names number 1 of 0 normals");
  for (const char* bad : {"3/", "/3", "3//", "3/1/1/1", "x", "3/x", "1.5", "99999999999"})
    EXPECT_EQ(ErrorOf(square + "vt 0 0\nvn 0 0 1\nf 1 2 " + bad),
              std::string("line 7 has \"") + bad +
                  "\" for a corner of a face; expected 7, 7/3, 7//5 or 7/3/5");
  EXPECT_EQ(ErrorOf(square + "surf 0 1 0 1\n"),
            "line 5 has a free-form curve or surface, which is not read; expected polygons");
}

// Counts of tags, which the library would allocate, are not passed to it.
TEST(Obj, WithTagsOfAnySizeIsHarmless) {
  const std::string text = std::string(kSquare) +
                           "t crease 2000000000/2000000000/2000000000\n"
                           "l 1 2\np 1\nvw 0 0 1\nf 1 2 3\n";
  EXPECT_EQ(ParseObj(text, "").mesh->TriangleCount(), 1u);
}

class ObjShape : public testing::Test {
 protected:
  void SetUp() override {
    path_ = (std::filesystem::path(testing::TempDir()) / "exphoton-shape.obj").string();
    std::ofstream(path_) << "v -1 -1 3\nv 1 -1 3\nv 1 1 3\nv -1 1 3\nmtllib x.mtl\n"
                            "g left\nf 1 2 4\ng right\nf 2 3 4\n";
  }
  TestRender Render(const std::string& parameters) const {
    return RenderSceneText(TestHeader("\"directlighting\"", 8, 8, 1) +
                           "WorldBegin LightSource \"point\"\n" + Shape(parameters) + "WorldEnd\n");
  }
  std::string Shape(const std::string& parameters) const {
    return "Shape \"obj\" \"string filename\" \"" + path_ + "\"" + parameters + "\n";
  }
  std::string path_;
};

TEST_F(ObjShape, IsRenderedWithOneNoticeAboutItsMaterials) {
  const TestRender render = Render("");
  EXPECT_GT(MeanRadiance(render.image), 0);
  EXPECT_TRUE(render.Says("the materials of \"" + path_ + "\" are not used"));
  const double all = MeanChannel(render.image, "A");
  EXPECT_NEAR(all, 1. / 9, .05);
  EXPECT_NEAR(MeanChannel(Render(" \"string group\" \"left\"").image, "A"), all / 2, .04);
  EXPECT_EQ(MeanChannel(Render(" \"float alpha\" 0").image, "A"), 0);
}

TEST_F(ObjShape, ThatCannotBeReadIsAnErrorAtItsParameter) {
  std::ofstream(path_) << "v 1 2 x\n";
  try {
    LoadSceneText("WorldBegin\n" + Shape("") + "WorldEnd\n");
    FAIL();
  } catch (const Error& error) {
    ASSERT_TRUE(error.Where());
    EXPECT_EQ(error.Where()->line, 2);
    EXPECT_NE(std::string(error.what()).find("line 1 has \"x\" instead of a number"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace exphoton
