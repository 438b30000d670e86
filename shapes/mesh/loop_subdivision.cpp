// SPDX-License-Identifier: BSD-2-Clause
// LoopSubdivide adds a vertex on every edge and moves the old vertices, level by level. At the end,
// all vertices move to their limit positions.
#include "shapes/mesh/loop_subdivision.h"

#include <algorithm>
#include <numbers>
#include <tuple>

namespace exphoton {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t(0);

struct Edge {
  std::uint32_t a, b;                          // a < b
  std::uint32_t opposite[2] = {kNone, kNone};  // third vertices of its faces
  bool IsBoundary() const { return opposite[1] == kNone; }
};

// Edges lists the edges of a mesh, and the edge of each side of a face (side i: corner i to the
// next).
struct Edges {
  std::vector<Edge> edges;
  std::vector<std::array<std::uint32_t, 3>> ofFace;
  bool isManifold = true;

  explicit Edges(const SubdivisionMesh& mesh) : ofFace(mesh.faces.size()) {
    struct Side {
      std::uint32_t a, b, face, side;
    };
    std::vector<Side> sides;
    sides.reserve(mesh.faces.size() * 3);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh.faces[f][i], b = mesh.faces[f][(i + 1) % 3];
        if (a == b) isManifold = false;
        sides.push_back({std::min(a, b), std::max(a, b), f, i});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      return std::tie(x.a, x.b, x.face, x.side) < std::tie(y.a, y.b, y.face, y.side);
    });
    for (const Side& side : sides) {
      if (edges.empty() || edges.back().a != side.a || edges.back().b != side.b)
        edges.push_back({side.a, side.b});
      Edge& edge = edges.back();
      const std::uint32_t opposite = mesh.faces[side.face][(side.side + 2) % 3];
      if (edge.opposite[0] == kNone) {
        edge.opposite[0] = opposite;
      } else if (edge.opposite[1] == kNone) {
        edge.opposite[1] = opposite;
      } else {
        isManifold = false;
      }
      ofFace[side.face][side.side] = std::uint32_t(edges.size() - 1);
    }
  }
};

// Surroundings sums the neighbours of each vertex, and separately the boundary neighbours.
struct Surroundings {
  struct Vertex {
    Vec3d sum, boundarySum;
    int valence = 0, boundaryValence = 0;
    bool IsBoundary() const { return boundaryValence > 0; }
  };
  std::vector<Vertex> vertices;

  Surroundings(const SubdivisionMesh& mesh, const Edges& edges) : vertices(mesh.positions.size()) {
    for (const Edge& edge : edges.edges) {
      Add(edge.a, mesh.positions[edge.b], edge.IsBoundary());
      Add(edge.b, mesh.positions[edge.a], edge.IsBoundary());
    }
  }

 private:
  void Add(std::uint32_t vertex, const Vec3d& neighbour, bool isBoundary) {
    Vertex& v = vertices[vertex];
    v.sum = v.sum + neighbour;
    ++v.valence;
    if (!isBoundary) return;
    v.boundarySum = v.boundarySum + neighbour;
    ++v.boundaryValence;
  }
};

// Returns the weight of each neighbour when an interior vertex moves (Warren 1995).
double Beta(int valence) { return valence == 3 ? 3.0 / 16 : 3.0 / (8.0 * valence); }

// Returns (1 - n weight) p + weight * (sum of n neighbours).
Vec3d Blend(const Vec3d& p, const Vec3d& sum, int count, double weight) {
  return p * (1 - count * weight) + sum * weight;
}

SubdivisionMesh Refine(const SubdivisionMesh& mesh) {
  const Edges edges(mesh);
  const Surroundings surroundings(mesh, edges);
  const auto& p = mesh.positions;
  SubdivisionMesh fine;
  fine.positions.reserve(p.size() + edges.edges.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto& v = surroundings.vertices[i];
    if (v.valence == 0) {
      fine.positions.push_back(p[i]);
    } else if (v.IsBoundary()) {
      fine.positions.push_back(
          Blend(p[i], v.boundarySum, v.boundaryValence, 1.0 / (4 * v.boundaryValence)));
    } else {
      fine.positions.push_back(Blend(p[i], v.sum, v.valence, Beta(v.valence)));
    }
  }
  for (const Edge& edge : edges.edges) {
    const Vec3d ends = p[edge.a] + p[edge.b];
    fine.positions.push_back(
        edge.IsBoundary() ? ends * 0.5
                          : ends * 0.375 + (p[edge.opposite[0]] + p[edge.opposite[1]]) * 0.125);
  }
  fine.faces.reserve(mesh.faces.size() * 4);
  const auto firstNew = std::uint32_t(p.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& v = mesh.faces[f];
    const std::uint32_t ab = firstNew + edges.ofFace[f][0], bc = firstNew + edges.ofFace[f][1],
                        ca = firstNew + edges.ofFace[f][2];
    fine.faces.push_back({v[0], ab, ca});
    fine.faces.push_back({ab, v[1], bc});
    fine.faces.push_back({ca, bc, v[2]});
    fine.faces.push_back({ab, bc, ca});
  }
  return fine;
}

// Rings lists the neighbours of every vertex in winding order; at a boundary from one end to the
// other. A ring is empty if the faces around the vertex do not form one fan.
class Rings {
 public:
  explicit Rings(const SubdivisionMesh& mesh) : first_(mesh.positions.size() + 1, 0) {
    for (const auto& face : mesh.faces)
      for (const std::uint32_t v : face) ++first_[v + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    spokes_.resize(mesh.faces.size() * 3);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const auto& face : mesh.faces)
      for (std::size_t i = 0; i < 3; ++i)
        spokes_[next[face[i]]++] = {face[(i + 1) % 3], face[(i + 2) % 3]};
  }

  std::vector<std::uint32_t> Of(std::uint32_t vertex) const {
    const Spoke* begin = spokes_.data() + first_[vertex];
    const Spoke* end = spokes_.data() + first_[vertex + 1];
    if (begin == end) return {};
    std::vector<Spoke> sorted(begin, end);
    std::stable_sort(sorted.begin(), sorted.end(), IsBefore);
    Ring reached;
    reached.reserve(sorted.size());
    for (const Spoke* s = begin; s != end; ++s) reached.push_back(s->to);
    std::sort(reached.begin(), reached.end());
    // A ring at a boundary begins at a neighbour that no spoke leads to.
    std::uint32_t start = begin->from;
    for (const Spoke* s = begin; s != end; ++s)
      if (!std::binary_search(reached.begin(), reached.end(), s->from)) start = s->from;
    Ring ring{start};
    for (std::uint32_t at = start; ring.size() <= sorted.size();) {
      const auto s = std::lower_bound(sorted.begin(), sorted.end(), Spoke{at, 0}, IsBefore);
      if (s == sorted.end() || s->from != at) break;
      at = s->to;
      if (at == start) return ring.size() == sorted.size() ? ring : Ring();
      ring.push_back(at);
    }
    return ring.size() == sorted.size() + 1 ? ring : Ring();
  }

 private:
  using Ring = std::vector<std::uint32_t>;
  struct Spoke {  // the side of a face opposite to the vertex
    std::uint32_t from, to;
  };
  static bool IsBefore(const Spoke& a, const Spoke& b) { return a.from < b.from; }

  std::vector<std::size_t> first_;
  std::vector<Spoke> spokes_;
};

// Returns the tangent that points into the surface at a boundary vertex. Its weights are the left
// eigenvector of the subdivision about the vertex for the eigenvalue 3/8 + cos(theta)/4. Two and
// three faces have the weights of Hoppe et al. 1994, appendix A.
Vec3d InwardTangent(const Vec3d& p, const std::vector<Vec3d>& ring) {
  const std::size_t n = ring.size();
  if (n == 2) return ring[0] + ring[1] - p * 2;
  if (n == 3) return ring[1] - p;
  if (n == 4) return (ring[1] + ring[2]) * 2 - ring[0] - ring[3] - p * 2;
  const double theta = std::numbers::pi / double(n - 1);
  const double inner = 1 / std::tan(theta / 2);  // sum of the inner weights
  const double end = (std::sin(theta) - inner) / (2 * std::cos(theta) + 1);
  Vec3d tangent = (ring[0] + ring[n - 1]) * end - p * (inner + 2 * end);
  for (std::size_t i = 1; i + 1 < n; ++i) tangent = tangent + ring[i] * std::sin(theta * double(i));
  return tangent;
}

Vec3d LimitNormal(const Vec3d& p, const std::vector<Vec3d>& ring, bool isBoundary) {
  if (isBoundary) return NormalizeOrZero(Cross(ring.front() - ring.back(), InwardTangent(p, ring)));
  Vec3d s, t;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double angle = 2 * std::numbers::pi * double(i) / double(ring.size());
    s = s + ring[i] * std::cos(angle);
    t = t + ring[i] * std::sin(angle);
  }
  return NormalizeOrZero(Cross(s, t));
}

}  // namespace

bool IsManifold(const SubdivisionMesh& mesh) { return Edges(mesh).isManifold; }

LimitMesh LoopSubdivide(SubdivisionMesh mesh, int levels) {
  for (int level = 0; level < levels; ++level) mesh = Refine(mesh);
  const Surroundings surroundings(mesh, Edges(mesh));
  const Rings rings(mesh);
  LimitMesh limit;
  std::vector<Vec3d> ring;
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const auto& v = surroundings.vertices[i];
    const Vec3d& p = mesh.positions[i];
    Vec3d moved = p;
    if (v.IsBoundary()) {
      // A boundary is a cubic B-spline, with the limit weights 1/6, 2/3, 1/6.
      moved = Blend(p, v.boundarySum, v.boundaryValence, 1.0 / (3 * v.boundaryValence));
    } else if (v.valence > 0) {
      moved = Blend(p, v.sum, v.valence, 1 / (v.valence + 3 / (8 * Beta(v.valence))));
    }
    limit.mesh.positions.push_back(moved);
    ring.clear();
    for (const std::uint32_t neighbour : rings.Of(i)) ring.push_back(mesh.positions[neighbour]);
    limit.normals.push_back(ring.size() < 2 ? Vec3d() : LimitNormal(p, ring, v.IsBoundary()));
  }
  limit.mesh.faces = std::move(mesh.faces);
  return limit;
}

}  // namespace exphoton
