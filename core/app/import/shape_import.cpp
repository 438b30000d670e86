// SPDX-License-Identifier: BSD-2-Clause
// ImportShape passes most shapes on as they are. Bilinear patches become two triangles each.
#include "core/app/import/shape_import.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/app/import/directive_text.h"
#include "core/app/import/reading/later_params.h"

namespace exphoton::cli {
namespace {

// Returns the place of the first number of a vertex in a list with `size` numbers a vertex. An
// index that no list can hold gives the largest place.
std::size_t FirstOf(double index, std::size_t size) {
  constexpr double kMost = 1e15;
  return index >= 0 && index < kMost ? std::size_t(index) * size : std::size_t(kMost) * size;
}

class ShapeImporter {
 public:
  ShapeImporter(const Directive& directive, bool emits, const ImportContext& context)
      : type_(directive.strings[0]),
        emits_(emits),
        context_(context),
        params_(directive.params, "Shape " + QuotedText(type_), context.report) {}

  std::string Run() {
    std::string text;
    if (type_ == "trianglemesh") {
      text = TriangleMesh();
    } else if (type_ == "plymesh") {
      text = PlyMesh();
    } else if (type_ == "loopsubdiv") {
      text = LoopSubdiv();
    } else if (type_ == "bilinearmesh") {
      text = BilinearMesh();
    } else if (IsSame()) {
      text = Same();
    } else {
      context_.report.LeftOut(params_.Subject() + " is left out", params_.Where());
      return "";
    }
    params_.ReportRest();
    return text;
  }

 private:
  bool IsSame() const {
    for (const char* name : {"sphere", "disk", "cylinder", "cone", "paraboloid", "hyperboloid",
                             "heightfield", "nurbs"})
      if (type_ == name) return true;
    return false;
  }

  void Copy(const char* name, DirectiveText* text) {
    if (const ParsedParam* param = params_.Take(name)) text->Copy(*param, name);
  }
  std::vector<double> TakeNumbers(const char* name) {
    const ParsedParam* param = params_.Take(name);
    return param ? param->numbers : std::vector<double>();
  }
  [[noreturn]] void Fail(const std::string& text) const {
    throw Error(ExitStatus::Scene, params_.Subject() + " " + text, params_.Where());
  }

  std::string Same() {
    DirectiveText text("Shape", {type_});
    for (const char* name :
         {"radius", "innerradius", "height", "zmin", "zmax",   "phimax", "p1",
          "p2",     "nu",          "nv",     "Pz",   "uorder", "vorder", "uknots",
          "vknots", "u0",          "u1",     "v0",   "v1",     "P",      "Pw"})
      Copy(name, &text);
    Alpha(nullptr);
    return text.Text();
  }

  // Writes the opening. Shapes without a parameter for it are whole.
  void Alpha(DirectiveText* text) {
    params_.Ignore({"shadowalpha"});
    const ParsedParam* alpha = params_.Take("alpha");
    if (!alpha || alpha->numbers == std::vector<double>{1}) return;
    if (text) {
      text->Copy(*alpha, "alpha");
    } else {
      params_.LeftOut(*alpha, "this shape has no holes here");
    }
  }

  std::string PlyMesh() {
    DirectiveText text("Shape", {type_});
    const std::string file = params_.TakeString("filename", "");
    text.String("string filename", FileNameFor(file, params_.Where(), context_));
    Alpha(nullptr);
    return text.Text();
  }

  std::string LoopSubdiv() {
    DirectiveText text("Shape", {type_});
    const char* levels = params_.Has("levels") ? "levels" : "nlevels";
    if (const ParsedParam* param = params_.Take(levels)) text.Copy(*param, "nlevels");
    Copy("indices", &text);
    Copy("P", &text);
    Copy("scheme", &text);
    return text.Text();
  }

  std::string TriangleMesh() {
    DirectiveText text("Shape", {type_});
    std::vector<double> indices = TakeNumbers("indices"), points = TakeNumbers("P");
    const std::vector<double> normals = TakeNumbers("N");
    // Version 4 needs no indices for a single triangle.
    if (indices.empty() && points.size() == 9) indices = {0, 1, 2};
    if (emits_) TurnToNormals(points, normals, &indices);
    text.Numbers("integer indices", indices).Numbers("point P", points);
    if (!normals.empty()) text.Numbers("normal N", normals);
    Copy("S", &text);
    if (const ParsedParam* uv = params_.Take(params_.Has("st") ? "st" : "uv"))
      text.Numbers("float uv", uv->numbers);
    Alpha(&text);
    params_.Ignore({"faceIndices"});
    return text.Text();
  }

  // Turns each triangle so that the normals of its vertices are on its outer side: that is the side
  // that shines in versions 3 and 4. Here the order of the vertices decides.
  static void TurnToNormals(const std::vector<double>& points, const std::vector<double>& normals,
                            std::vector<double>* indices) {
    const auto at = [](const std::vector<double>& list, double index, std::size_t axis) {
      const std::size_t i = FirstOf(index, 3) + axis;
      return i < list.size() ? list[i] : 0.;
    };
    for (std::size_t t = 0; t + 2 < indices->size() && !normals.empty(); t += 3) {
      const double a = (*indices)[t], b = (*indices)[t + 1], c = (*indices)[t + 2];
      double side = 0;
      for (std::size_t x = 0; x < 3; ++x) {
        const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
        const double cross =
            (at(points, b, y) - at(points, a, y)) * (at(points, c, z) - at(points, a, z)) -
            (at(points, b, z) - at(points, a, z)) * (at(points, c, y) - at(points, a, y));
        side += cross * (at(normals, a, x) + at(normals, b, x) + at(normals, c, x));
      }
      if (side < 0) std::swap((*indices)[t + 1], (*indices)[t + 2]);
    }
  }

  // Writes four vertices of their own for each patch, because the texture coordinates of a patch go
  // from 0 to 1 unless they are given.
  std::string BilinearMesh() {
    std::vector<double> indices = TakeNumbers("indices");
    const std::vector<double> points = TakeNumbers("P"), normals = TakeNumbers("N"),
                              uv = TakeNumbers("uv");
    if (indices.empty()) indices = {0, 1, 2, 3};
    if (indices.size() % 4 != 0) Fail("takes four indices a patch");
    const auto add = [&](const std::vector<double>& from, double vertex, std::size_t size,
                         std::vector<double>* to) {
      const std::size_t first = FirstOf(vertex, size);
      if (first + size > from.size()) Fail("has an index without a vertex");
      to->insert(to->end(), from.begin() + std::ptrdiff_t(first),
                 from.begin() + std::ptrdiff_t(first + size));
    };
    std::vector<double> triangles, p, n, st;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (i % 4 == 0)
        for (const std::size_t corner : {0, 1, 3, 0, 3, 2}) triangles.push_back(double(i + corner));
      add(points, indices[i], 3, &p);
      if (!normals.empty()) add(normals, indices[i], 3, &n);
      if (uv.empty()) {
        st.insert(st.end(), {double(i % 2), double(i % 4 / 2)});
      } else {
        add(uv, indices[i], 2, &st);
      }
    }
    if (emits_) TurnToNormals(p, n, &triangles);
    if (!IsFlat(p)) params_.Replaced("is replaced by two triangles a patch, but is not flat");
    DirectiveText text("Shape", {"trianglemesh"});
    text.Numbers("integer indices", triangles).Numbers("point P", p).Numbers("float uv", st);
    if (!n.empty()) text.Numbers("normal N", n);
    Alpha(&text);
    return text.Text();
  }

  // Returns whether the four corners of each patch lie in one plane, to rounding.
  static bool IsFlat(const std::vector<double>& p) {
    for (std::size_t i = 0; i + 12 <= p.size(); i += 12) {
      const auto edge = [&](std::size_t corner, std::size_t axis) {
        return p[i + 3 * corner + axis] - p[i + axis];
      };
      double volume = 0, size = 0;
      for (std::size_t x = 0; x < 3; ++x) {
        const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
        volume += edge(3, x) * (edge(1, y) * edge(2, z) - edge(1, z) * edge(2, y));
        for (std::size_t corner = 1; corner < 4; ++corner)
          size = std::max(size, std::abs(edge(corner, x)));
      }
      if (std::abs(volume) > 1e-5 * size * size * size) return false;
    }
    return true;
  }

  const std::string& type_;
  bool emits_;
  const ImportContext& context_;
  LaterParams params_;
};

}  // namespace

std::string ImportShape(const Directive& directive, bool emits, const ImportContext& context) {
  return ShapeImporter(directive, emits, context).Run();
}

}  // namespace exphoton::cli
