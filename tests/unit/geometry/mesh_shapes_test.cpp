// SPDX-License-Identifier: BSD-2-Clause
// These tests check shapes that make meshes: the checks of trianglemesh, every form of PLY file,
// faulty PLY files, and Loop subdivision against limits known in closed form.
#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "shapes/mesh/loop_subdivision.h"
#include "shapes/mesh/ply_reader.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

std::unique_ptr<TriangleMesh> MakeMesh(TestPlugins& plugins, const std::string& text,
                                       const Transform& toWorld = {}) {
  return std::move(std::get<std::unique_ptr<TriangleMesh>>(plugins.MakeShape(text, toWorld)));
}

TEST(Trianglemesh, RefusesWrongIndicesAndCounts) {
  TestPlugins plugins;
  const std::string p = R"("point P" [0 0 0  1 0 0  0 1 0] )";
  for (const std::string rest :
       {R"("integer indices" [0 1 -1])", R"("integer indices" [0 1 3])",
        R"("integer indices" [0 1 2 0])", R"("integer indices" [0 1 2] "normal N" [0 0 1])",
        R"("integer indices" [0 1 2] "float uv" [0 0 1 0])",
        R"("integer indices" [0 1 2] "vector S" [1 0 0  1 0 0])"}) {
    EXPECT_THROW(MakeMesh(plugins, R"("trianglemesh" )" + p + rest), Error) << rest;
  }
  EXPECT_THROW(MakeMesh(plugins, R"("trianglemesh" "integer indices" [0 1 2])"), Error);
}

TEST(Trianglemesh, DropsDegenerateTrianglesWithOneWarning) {
  TestPlugins plugins;
  const auto mesh = MakeMesh(plugins, R"("trianglemesh" "integer indices" [0 1 2 0 0 1 0 1 3]
      "point P" [0 0 0  1 0 0  0 1 0  3 0 0])");
  EXPECT_EQ(mesh->TriangleCount(), 1u);
  EXPECT_EQ(plugins.GetLog().WarningCount(), 1);
  EXPECT_NE(plugins.GetLog().Messages().at(0).find("2 of 3 triangles"), std::string::npos);
}

TEST(Trianglemesh, WarnsOnceOfUselessNormalsAndTangents) {
  TestPlugins plugins;
  MakeMesh(plugins, R"("trianglemesh" "integer indices" [0 1 2] "point P" [0 0 0 1 0 0 0 1 0]
      "normal N" [0 0 0  0 0 1  0 0 1] "vector S" [0 0 1  0 0 1  1 0 0])");
  EXPECT_EQ(plugins.GetLog().WarningCount(), 1);
}

TEST(Trianglemesh, MirroringKeepsTheOutside) {
  TestPlugins plugins;
  const std::string text =
      R"("trianglemesh" "integer indices" [0 1 2] "point P" [0 0 0 1 0 0 0 1 0])";
  const auto plain = MakeMesh(plugins, text);
  const auto mirrored = MakeMesh(plugins, text, *Transform::Scale(-1, 1, 1));
  const auto turned = MakeMesh(plugins, text, *Transform::Scale(1, 1, -1));
  EXPECT_EQ(TriangleSurface(*plain, 0, 0, 0).ng, Normal3(0, 0, 1));
  EXPECT_EQ(TriangleSurface(*mirrored, 0, 0, 0).ng, Normal3(0, 0, 1));
  EXPECT_EQ(TriangleSurface(*turned, 0, 0, 0).ng, Normal3(0, 0, -1));
}

TEST(Trianglemesh, TakesTextureCoordinatesByEitherName) {
  TestPlugins plugins;
  const std::string mesh =
      R"("trianglemesh" "integer indices" [0 1 2] "point P" [0 0 0 1 0 0 0 1 0] )";
  const auto uvOf = [&](const std::string& rest) { return MakeMesh(plugins, mesh + rest)->uv; };
  const std::vector<Point2> first{{.5, 0}, {1, .25}, {0, 2}}, second{{3, 0}, {1, 4}, {0, 5}};
  const std::string uv = R"("float uv" [.5 0 1 .25 0 2])", st = R"("float st" [3 0 1 4 0 5])";
  EXPECT_EQ(uvOf(uv), first);
  EXPECT_EQ(uvOf(st), second);
  EXPECT_EQ(uvOf(st + uv), first);
}

// --- PLY -----------------------------------------------------------------------------------------

const char* const kAsciiPly =
    "ply\nformat ascii 1.0\ncomment made by hand\n"
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty float nx\nproperty float ny\nproperty float nz\n"
    "property float s\nproperty float t\n"
    "element other 2\nproperty list uchar int things\nproperty short one\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 255 0 0 1 0 0\n1 0 0 255 0 0 1 1 0\n1 1 0 255 0 0 1 1 1\n0 1 0 255 0 0 1 0 1\n"
    "2 7 8 9\n0 -3\n"
    "3 0 1 2\n4 0 1 2 3\n";

void ExpectTheMesh(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.p.size(), 4u);
  EXPECT_EQ(mesh.p[2], Point3(1, 1, 0));
  ASSERT_EQ(mesh.TriangleCount(), 3u);
  EXPECT_EQ(mesh.indices[2], (std::array<std::uint32_t, 3>{0, 2, 3}));
  ASSERT_EQ(mesh.n.size(), 4u);
  EXPECT_EQ(mesh.n[3], Normal3(0, 0, 1));
  ASSERT_EQ(mesh.uv.size(), 4u);
  EXPECT_EQ(mesh.uv[3], Point2(0, 1));
}

template <class T>
void Append(std::string* out, T value, bool isBig) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (isBig == (std::endian::native == std::endian::little)) std::reverse(raw, raw + sizeof(T));
  out->append(raw, sizeof(T));
}

std::string BinaryPly(bool isBig) {
  std::string text =
      std::string("ply\r\nformat binary_") + (isBig ? "big" : "little") +
      "_endian 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty float32 y\r\n"
      "property float z\r\nproperty float nx\r\nproperty float ny\r\n"
      "property float nz\r\nproperty float u\r\nproperty float v\r\n"
      "element face 2\r\nproperty list uint8 uint vertex_index\r\n"
      "property uchar flags\r\nend_header\r\n";
  const float xy[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& p : xy) {
    Append(&text, double(p[0]), isBig);
    for (const float f : {p[1], 0.f, 0.f, 0.f, 1.f, p[0], p[1]}) Append(&text, f, isBig);
  }
  for (const std::uint32_t corners : {3u, 4u}) {
    Append(&text, std::uint8_t(corners), isBig);
    for (std::uint32_t i = 0; i < corners; ++i) Append(&text, i, isBig);
    Append(&text, std::uint8_t(9), isBig);
  }
  return text;
}

TEST(Ply, ReadsAsciiAndBothByteOrders) {
  ExpectTheMesh(*ParsePly(kAsciiPly));
  ExpectTheMesh(*ParsePly(BinaryPly(false)));
  ExpectTheMesh(*ParsePly(BinaryPly(true)));
}

// Another list follows the vertex numbers of each face.
TEST(Ply, SkipsOtherListsOfAFace) {
  std::string text = kAsciiPly;
  const std::string list = "property list uchar int vertex_indices\n";
  text.replace(text.find(list), list.size(), list + "property list uchar float more\n");
  text.replace(text.find("3 0 1 2\n"), 8, "3 0 1 2 2 7 8\n");
  text.replace(text.find("4 0 1 2 3\n"), 10, "4 0 1 2 3 0\n");
  ExpectTheMesh(*ParsePly(text));
}

// Each type of whole numbers holds its largest value.
TEST(Ply, ReadsLargeNumbersOfEveryType) {
  const auto mesh = [](const std::string& type, auto last) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(last + 1) +
        "\nproperty float x\nproperty float y\nproperty char z\nelement face 1\nproperty list "
        "uchar " +
        type + " vertex_indices\nend_header\n";
    for (std::int64_t i = 0; i <= std::int64_t(last); ++i) {
      for (const float f : {float(i), float(i % 7)}) Append(&text, f, false);
      Append(&text, std::int8_t(-1), false);
    }
    Append(&text, std::uint8_t(3), false);
    for (int i = 2; i >= 0; --i) Append(&text, decltype(last)(last - i), false);
    return ParsePly(text);
  };
  const auto expectLast = [&](const std::string& type, auto last) {
    const auto found = mesh(type, last);
    EXPECT_EQ(found->indices[0][2], std::uint32_t(last)) << type;
    EXPECT_EQ(found->p[0].z, -1) << type;
  };
  for (const char* type : {"uchar", "uint8"}) expectLast(type, std::uint8_t(255));
  for (const char* type : {"char", "int8"}) expectLast(type, std::int8_t(127));
  for (const char* type : {"ushort", "uint16"}) expectLast(type, std::uint16_t(65535));
  for (const char* type : {"short", "int16"}) expectLast(type, std::int16_t(32767));
  for (const char* type : {"int", "int32", "uint", "uint32"}) expectLast(type, std::int32_t(70000));
}

TEST(Ply, SmallCompressedFilesDoNotFillTheMemory) {
  const auto folder = std::filesystem::temp_directory_path() / "exphoton_ply_bomb_test";
  std::filesystem::create_directories(folder);
  const std::string packed = (folder / "bomb.ply.gz").string();
  gzFile file = gzopen(packed.c_str(), "wb9");
  ASSERT_TRUE(file);
  const std::string blanks(std::size_t(1) << 20, ' ');
  for (int i = 0; i < 8; ++i) gzwrite(file, blanks.data(), unsigned(blanks.size()));
  gzclose(file);
  EXPECT_LT(std::filesystem::file_size(packed), 20000u);
  std::string error;
  try {
    ReadPly(packed, 4 << 20);
  } catch (const PlyError& problem) {
    error = problem.what();
  }
  EXPECT_EQ(error, "it is longer than the limit of 4 MiB, decompressed");
  std::filesystem::remove_all(folder);
}

TEST(Ply, ReadsCompressedFilesAndSaysWhatIsWrongWithOthers) {
  const auto folder = std::filesystem::temp_directory_path() / "exphoton_ply_test";
  std::filesystem::create_directories(folder);
  const std::string packed = (folder / "mesh.ply.gz").string();
  const std::string bytes = BinaryPly(true);
  gzFile file = gzopen(packed.c_str(), "wb");
  ASSERT_TRUE(file);
  gzwrite(file, bytes.data(), unsigned(bytes.size()));
  gzclose(file);
  ExpectTheMesh(*ReadPly(packed));

  std::string raw;
  {
    std::ifstream in(packed, std::ios::binary);
    raw.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string cut = (folder / "cut.ply.gz").string();
  std::ofstream(cut, std::ios::binary) << raw.substr(0, raw.size() / 2);
  EXPECT_THROW(ReadPly(cut), PlyError);
  EXPECT_THROW(ReadPly((folder / "none.ply").string()), PlyError);
  EXPECT_THROW(ReadPly(folder.string()), PlyError);

  TestPlugins plugins;
  EXPECT_EQ(MakeMesh(plugins, R"("plymesh" "string filename" ")" + packed + "\"")->TriangleCount(),
            3u);
  EXPECT_THROW(MakeMesh(plugins, R"("plymesh" "string filename" ")" + cut + "\""), Error);
  std::filesystem::remove_all(folder);
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(Ply, RefusesBrokenFiles) {
  const std::string good = kAsciiPly;
  const std::pair<const char*, const char*> changes[] = {
      {"ply\n", "plx\n"},
      {"format ascii 1.0", "format ascii 2.0"},
      {"format ascii 1.0\n", ""},
      {"element vertex 4", "element vertex 4000000000000"},
      {"element vertex 4", "element vertex -1"},
      {"element face 2", "element face 99999999"},
      {"element face", "element fase"},
      {"property float x", "property float w"},
      {"property float x", "property quad x"},
      {"vertex_indices", "corners"},
      {"end_header", "end_heade"},
      {"3 0 1 2", "3 0 1 4"},
      {"3 0 1 2", "3 0 1 -1"},
      {"3 0 1 2", "3 0 1 1.5"},
      {"3 0 1 2", "5 0 1 2 3 0"},
      {"3 0 1 2", "2 0 1"},
      {"3 0 1 2", "1e30 0 1"},
      {"1 1 0 255", "1 nan 0 255"},
      {"1 1 0 255", "1 1e309 0 255"},
      {"1 1 0 255", "1 one 0 255"},
      {"4 0 1 2 3\n", "4 0 1"},
  };
  for (const auto& [from, to] : changes) {
    const std::string bad = Replaced(good, from, to);
    ASSERT_NE(bad, good);
    EXPECT_THROW(ParsePly(bad), PlyError) << from << " -> " << to;
  }
  const std::string binary = BinaryPly(false);
  for (std::size_t size = 0; size < binary.size(); size += 7)
    EXPECT_THROW(ParsePly(binary.substr(0, size)), PlyError) << size;
}

// --- Loop subdivision ----------------------------------------------------------------------------

SubdivisionMesh Tetrahedron() {
  return {{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}},
          {{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}}};
}

TEST(LoopSubdivision, TetrahedronHasItsKnownLimitAtEveryLevel) {
  for (int level = 0; level < 5; ++level) {
    const LimitMesh limit = LoopSubdivide(Tetrahedron(), level);
    EXPECT_EQ(limit.mesh.faces.size(), 4u << (2 * level));
    for (std::size_t i = 0; i < 4; ++i) {
      // For valence 3, the limit is 2/5 of the vertex plus 1/5 of each neighbour. The neighbours
      // sum to the negative of the vertex.
      const Vec3d expected = Tetrahedron().positions[i] * 0.2;
      EXPECT_LT(Length(limit.mesh.positions[i] - expected), 1e-14);
      EXPECT_NEAR(std::abs(Dot(limit.normals[i], NormalizeOrZero(expected))), 1, 1e-12);
    }
  }
}

TEST(LoopSubdivision, NormalsAreThoseOfTheFineMesh) {
  const LimitMesh limit = LoopSubdivide(Tetrahedron(), 5);
  double worst = 1;
  for (const auto& f : limit.mesh.faces) {
    const auto& p = limit.mesh.positions;
    const Vec3d face = NormalizeOrZero(Cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]));
    for (const std::uint32_t v : f) worst = std::min(worst, Dot(face, limit.normals[v]));
  }
  EXPECT_GT(worst, 0.98);
}

// Limits do not depend on the level: refining further changes neither the vertices nor
// their normals.
TEST(LoopSubdivision, NormalsDoNotDependOnTheLevel) {
  SubdivisionMesh bent = Tetrahedron();
  bent.positions[0] = {3, 1, 0.5};
  bent.positions[2] = {1, -2, -0.3};
  for (int level = 0; level < 4; ++level) {
    const LimitMesh coarse = LoopSubdivide(bent, level), fine = LoopSubdivide(bent, level + 1);
    for (std::size_t i = 0; i < coarse.normals.size(); ++i) {
      EXPECT_LT(Length(coarse.mesh.positions[i] - fine.mesh.positions[i]), 1e-12);
      EXPECT_GT(Dot(coarse.normals[i], fine.normals[i]), 1 - 1e-12) << level << " " << i;
    }
  }
}

// Returns a bent square of 3 x 3 vertices. Its corners have valence 2 and 3, and its
// sides valence 4.
SubdivisionMesh Patch(double bend) {
  SubdivisionMesh mesh;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) mesh.positions.push_back({double(x), double(y), bend * x * y});
  for (std::uint32_t y = 0; y < 2; ++y) {
    for (std::uint32_t x = 0; x < 2; ++x) {
      const std::uint32_t a = y * 3 + x;
      mesh.faces.push_back({a, a + 1, a + 4});
      mesh.faces.push_back({a, a + 4, a + 3});
    }
  }
  return mesh;
}

TEST(LoopSubdivision, LimitsOfABoundaryDoNotDependOnTheLevel) {
  const LimitMesh coarse = LoopSubdivide(Patch(0.3), 0);
  for (int level = 1; level < 5; ++level) {
    const LimitMesh fine = LoopSubdivide(Patch(0.3), level);
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_LT(Length(fine.mesh.positions[i] - coarse.mesh.positions[i]), 1e-12) << i;
      EXPECT_GT(Length(fine.normals[i]), 0.99);
    }
  }
  // A boundary is the cubic B-spline of the boundary vertices alone.
  EXPECT_LT(Length(coarse.mesh.positions[1] - Vec3d(1, 0, 0)), 1e-14);
}

TEST(LoopSubdivision, NormalsAtABoundaryAreThoseOfTheFineMesh) {
  const LimitMesh coarse = LoopSubdivide(Patch(0.3), 0), fine = LoopSubdivide(Patch(0.3), 7);
  const auto& p = fine.mesh.positions;
  for (const auto& f : fine.mesh.faces) {
    const Vec3d face = NormalizeOrZero(Cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]));
    for (const std::uint32_t v : f) {
      if (v < 9) {
        EXPECT_GT(Dot(face, coarse.normals[v]), 0.9998) << v;
        EXPECT_GT(Dot(face, fine.normals[v]), 0.9998) << v;
      }
    }
  }
}

TEST(LoopSubdivision, FlatStaysFlatAndFacesTheSameWay) {
  const LimitMesh limit = LoopSubdivide(Patch(0), 3);
  for (std::size_t i = 0; i < limit.normals.size(); ++i) {
    EXPECT_EQ(limit.mesh.positions[i].z, 0);
    EXPECT_NEAR(limit.normals[i].z, 1, 1e-12);
  }
}

TEST(LoopSubdivision, RefusesWhatIsNoSurface) {
  TestPlugins plugins;
  const std::string p = R"("point P" [0 0 0  1 0 0  0 1 0  0 0 1  1 1 1])";
  for (const std::string indices : {"[0 1 2  0 1 3  0 1 4]", "[0 0 1]", "[0 1 9]", "[0 1]"}) {
    EXPECT_THROW(MakeMesh(plugins, R"("loopsubdiv" "integer indices" )" + indices + p), Error);
  }
  EXPECT_THROW(
      MakeMesh(plugins, R"("loopsubdiv" "integer nlevels" 13 "integer indices" [0 1 2])" + p),
      Error);
  EXPECT_EQ(MakeMesh(plugins, R"("loopsubdiv" "integer nlevels" 2 "integer indices" [0 1 2])" + p)
                ->TriangleCount(),
            16u);
}

TEST(LoopSubdivision, ThatNeedsMoreMemoryThanThereIsIsRefusedBeforeItBegins) {
  const std::string problem = RefusalForMemory(
      R"("loopsubdiv" "integer nlevels" 12 "integer indices" [0 1 2]
         "point P" [0 0 0 1 0 0 0 1 0])",
      2048);
  EXPECT_NE(problem.find("subdivision with nlevels 12 needs about "), std::string::npos) << problem;
  EXPECT_NE(problem.find("and this process may use 2048 MB"), std::string::npos) << problem;
}

}  // namespace
}  // namespace exphoton
