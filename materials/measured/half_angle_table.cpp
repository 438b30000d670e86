// SPDX-License-Identifier: BSD-2-Clause
// HalfAngleTable reads the binary file and interpolates between cells.
#include "materials/measured/half_angle_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/files/input_file.h"

namespace exphoton {
namespace {

constexpr double kPiDouble = 3.14159265358979323846;
constexpr std::size_t kCells = std::size_t(HalfAngleTable::kHalfAngles) *
                               HalfAngleTable::kDifferenceAngles *
                               HalfAngleTable::kDifferenceAzimuths;
constexpr std::uintmax_t kHeaderBytes = 12, kFileBytes = kHeaderBytes + 3 * 8 * kCells;

std::ifstream OpenTable(const std::string& path) {
  try {
    RequireRegularFile(path);
  } catch (const InputFileError& error) {
    throw MeasurementError(path + ": " + error.what());
  }
  std::ifstream file(path, std::ios::binary);
  std::error_code problem;
  const std::uintmax_t bytes = std::filesystem::file_size(path, problem);
  std::int32_t size[3] = {};
  file.read(reinterpret_cast<char*>(size), sizeof size);
  if (!file || problem || size[0] != HalfAngleTable::kHalfAngles ||
      size[1] != HalfAngleTable::kDifferenceAngles ||
      size[2] != HalfAngleTable::kDifferenceAzimuths)
    throw MeasurementError(path +
                           ": no table of measurements: expected the sizes 90, 90 and 180 at the "
                           "beginning (or text with samples in a file named .brdf)");
  if (bytes != kFileBytes)
    throw MeasurementError(path + ": has " + std::to_string(bytes) +
                           " bytes; a table of 90 x 90 x "
                           "180 cells has " +
                           std::to_string(kFileBytes));
  return file;
}

// Position between the centres of cells: cells `low` and `high`, and the share of `high`.
struct Between {
  int low, high;
  double share;
};
Between Clamped(double position, int count) {
  const double x = std::clamp(position - .5, 0., double(count - 1));
  const int low = std::min(int(x), count - 1);
  return {low, std::min(low + 1, count - 1), x - low};
}
Between Wrapped(double position, int count) {
  const double x = position - .5, floor = std::floor(x);
  const int low = (int(floor) % count + count) % count;
  return {low, (low + 1) % count, x - floor};
}

}  // namespace

HalfAngleTable::HalfAngleTable(const std::string& path) : cells_(kCells) {
  constexpr double kScale[3] = {1. / 1500, 1.15 / 1500, 1.66 / 1500};
  std::ifstream file = OpenTable(path);
  std::vector<double> row(kDifferenceAzimuths * kDifferenceAngles);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t first = 0; first < kCells; first += row.size()) {
      if (!file.read(reinterpret_cast<char*>(row.data()), std::streamsize(8 * row.size())))
        throw MeasurementError(path + ": cannot be read to its end");
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double value = row[i] * kScale[channel];
        const bool isValue = value >= 0 && value < 1e30;
        cells_[first + i][channel] = isValue ? float(value) : -1.f;
      }
    }
  }
}

// In the frame of the half vector h, the x axis points away from the normal. If wi and wo change
// places, the azimuth turns by half a circle, which the table counts as the same.
Spectrum HalfAngleTable::f(const Vector3& wo, const Vector3& wi) const {
  const Vector3 h = NormalizeOr(wo + wi, {0, 0, 1});
  const Real sine = std::hypot(h.x, h.y);
  const Vector3 y = sine > 0 ? Vector3(-h.y / sine, h.x / sine, 0) : Vector3(0, 1, 0);
  const Vector3 x = Cross(y, h);
  const double halfAngle = std::atan2(double(sine), double(h.z));
  const double dx = double(Dot(wi, x)), dy = double(Dot(wi, y));
  const double difference = std::atan2(std::hypot(dx, dy), double(Dot(wi, h)));
  double azimuth = std::atan2(dy, dx);
  if (azimuth < 0) azimuth += kPiDouble;

  const Between i = Clamped(std::sqrt(halfAngle / (kPiDouble / 2)) * kHalfAngles, kHalfAngles);
  const Between j = Clamped(difference / (kPiDouble / 2) * kDifferenceAngles, kDifferenceAngles);
  const Between k = Wrapped(azimuth / kPiDouble * kDifferenceAzimuths, kDifferenceAzimuths);
  double sum[3] = {}, weights[3] = {};
  for (int corner = 0; corner < 8; ++corner) {
    const double weight = (corner & 1 ? i.share : 1 - i.share) *
                          (corner & 2 ? j.share : 1 - j.share) *
                          (corner & 4 ? k.share : 1 - k.share);
    const auto& cell =
        Cell(corner & 1 ? i.high : i.low, corner & 2 ? j.high : j.low, corner & 4 ? k.high : k.low);
    for (std::size_t c = 0; c < 3; ++c) {
      if (cell[c] < 0) continue;
      sum[c] += weight * double(cell[c]);
      weights[c] += weight;
    }
  }
  Spectrum f;
  for (int c = 0; c < 3; ++c)
    if (weights[c] > 0) f[c] = Real(sum[c] / weights[c]);
  return f;
}

}  // namespace exphoton
