// SPDX-License-Identifier: BSD-2-Clause
// Noise blends eight gradients, one a corner of the unit cube around the point. The permutation is
// the one that Perlin published with his reference implementation.
#include "materials/textures/noise/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/vec3d.h"

namespace exphoton {
namespace {

constexpr std::array<unsigned char, 256> kPermutation{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

// The gradients point to the middles of a cube's edges. Four of the twelve occur twice, so that
// four bits choose one.
constexpr signed char kGradients[16][3] = {
    {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
    {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {-1, 1, 0}, {0, 1, -1}, {0, -1, -1}};

unsigned Permuted(unsigned i) { return kPermutation[i & 255]; }

// Returns the product of a corner's gradient and the vector from the corner.
double Corner(unsigned x, unsigned y, unsigned z, const Vec3d& d) {
  const auto& g = kGradients[Permuted(Permuted(Permuted(x) + y) + z) & 15];
  return g[0] * d.x + g[1] * d.y + g[2] * d.z;
}

// Perlin's quintic, whose first and second derivatives vanish at 0 and 1.
double Fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double Mix(double t, double a, double b) { return a + t * (b - a); }

double SmoothStep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0., 1.);
  return t * t * (3 - 2 * t);
}

// Returns the cell of x modulo 256, and x within it. If x is not finite, these are 0 and NaN.
unsigned Cell(double x, double* within) {
  const double cell = std::floor(x), rest = cell - 256 * std::floor(cell / 256);
  *within = x - cell;
  return rest >= 0 ? unsigned(rest) : 0;
}

template <class F>
double SumOctaves(const TexturePoint3& at, const FractalNoise& noise, F&& shape) {
  constexpr double kLacunarity = 1.99;  // not 2, so that the zeros of the octaves do not coincide
  const double footprint2 = std::max(double(Dot(at.dpdx, at.dpdx)), double(Dot(at.dpdy, at.dpdy)));
  double octaves = noise.octaves;
  if (footprint2 > 0) octaves = std::clamp(1 - std::log2(footprint2) / 2, 0., octaves);
  const int whole = int(octaves);
  const auto octave = [&](double frequency) {
    return shape(
        Noise(frequency * double(at.p.x), frequency * double(at.p.y), frequency * double(at.p.z)));
  };
  double sum = 0, frequency = 1, amplitude = 1;
  for (int i = 0; i < whole; ++i) {
    sum += amplitude * octave(frequency);
    frequency *= kLacunarity;
    amplitude *= noise.roughness;
  }
  const double fade = SmoothStep(.3, .7, octaves - whole);
  return fade > 0 ? sum + amplitude * fade * octave(frequency) : sum;
}

}  // namespace

double Noise(double x, double y, double z) {
  double dx, dy, dz;
  const unsigned ix = Cell(x, &dx), iy = Cell(y, &dy), iz = Cell(z, &dz);
  const double u = Fade(dx), v = Fade(dy), w = Fade(dz);
  const auto alongX = [&](unsigned j, unsigned k) {
    const double ey = dy - j, ez = dz - k;
    return Mix(u, Corner(ix, iy + j, iz + k, {dx, ey, ez}),
               Corner(ix + 1, iy + j, iz + k, {dx - 1, ey, ez}));
  };
  return Mix(w, Mix(v, alongX(0, 0), alongX(1, 0)), Mix(v, alongX(0, 1), alongX(1, 1)));
}

double FbmAt(const TexturePoint3& at, const FractalNoise& noise) {
  return SumOctaves(at, noise, [](double value) { return value; });
}

double TurbulenceAt(const TexturePoint3& at, const FractalNoise& noise) {
  return SumOctaves(at, noise, [](double value) { return std::abs(value); });
}

TexturePoint3 Scaled(const TexturePoint3& at, Real factor) {
  return {Point3(at.p.x * factor, at.p.y * factor, at.p.z * factor), at.dpdx * factor,
          at.dpdy * factor};
}

}  // namespace exphoton
