// SPDX-License-Identifier: BSD-2-Clause
// ScatteredSamples reads the text file and interpolates between the nearest samples.
#include "materials/measured/scattered_samples.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "core/files/input_file.h"
#include "core/math/cie.h"
#include "core/spatial/nearest_search.h"

namespace exphoton {
namespace {

constexpr std::uint32_t kNeighbours = 8;
constexpr std::size_t kMaxWavelengths = 1000;
constexpr double kMaxPolar = 1.5709;  // pi / 2, rounded up
// A sample at a smaller squared distance is taken as it is.
constexpr Real kSame2 = Real(1e-12);

std::string TextOf(const std::string& path) {
  try {
    RequireRegularFile(path);
  } catch (const InputFileError& error) {
    throw MeasurementError(path + ": " + error.what());
  }
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw MeasurementError(path + ": cannot be read to its end");
  return text;
}

std::vector<double> NumbersOf(const std::string& path) {
  const std::string text = TextOf(path);
  std::vector<double> numbers;
  int line = 1;
  for (const char *at = text.data(), *end = at + text.size(); at != end;) {
    if (*at == '#') {
      while (at != end && *at != '\n') ++at;
    } else if (std::isspace(static_cast<unsigned char>(*at))) {
      line += *at++ == '\n';
    } else {
      if (*at == '+') ++at;
      double number = 0;
      const auto [rest, problem] = std::from_chars(at, end, number);
      if (problem != std::errc() || !std::isfinite(number))
        throw MeasurementError(path + ":" + std::to_string(line) +
                               ": expected a finite number, as in all of a .brdf file");
      numbers.push_back(number);
      at = rest;
    }
  }
  return numbers;
}

// The coordinates in which samples are near each other (see the header).
Point3 CoordinatesOf(const Vector3& a, const Vector3& b) {
  return {a.x * b.x + a.y * b.y, std::abs(a.x * b.y - a.y * b.x), a.z * b.z};
}

Vector3 DirectionOf(double polar, double azimuth) {
  return {Real(std::sin(polar) * std::cos(azimuth)), Real(std::sin(polar) * std::sin(azimuth)),
          Real(std::cos(polar))};
}

// Spectra outside the gamut of Rec. 709 have negative channels, which count as 0.
Spectrum Colour(const std::vector<SpectralSample>& samples) {
  const Spectrum rgb = RgbFromSamples(samples);
  return {std::max(rgb.r, Real(0)), std::max(rgb.g, Real(0)), std::max(rgb.b, Real(0))};
}

}  // namespace

ScatteredSamples::ScatteredSamples(const std::string& path) {
  const std::vector<double> numbers = NumbersOf(path);
  const double first = numbers.empty() ? 0 : numbers[0];
  if (!(first >= 1 && first <= double(kMaxWavelengths) && first == std::floor(first)))
    throw MeasurementError(path + ": must begin with the number of wavelengths, from 1 to " +
                           std::to_string(kMaxWavelengths));
  const auto wavelengths = std::size_t(first);
  const std::size_t perSample = 4 + wavelengths;
  if (numbers.size() < 1 + wavelengths + perSample ||
      (numbers.size() - 1 - wavelengths) % perSample != 0)
    throw MeasurementError(path + ": has " + std::to_string(numbers.size()) +
                           " numbers; expected 1, then " + std::to_string(wavelengths) +
                           " wavelengths, then " + std::to_string(perSample) + " for each sample");
  std::vector<SpectralSample> spectrum(wavelengths);
  for (std::size_t i = 0; i < wavelengths; ++i) {
    spectrum[i].wavelength = numbers[1 + i];
    if (!(numbers[1 + i] > (i == 0 ? 0 : numbers[i])))
      throw MeasurementError(path + ": the wavelengths must be positive and rise");
  }
  BlockStore<PointBlock> points;
  for (std::size_t at = 1 + wavelengths; at < numbers.size(); at += perSample) {
    for (std::size_t i = 0; i < wavelengths; ++i) spectrum[i].value = numbers[at + 4 + i];
    for (const double polar : {numbers[at], numbers[at + 2]})
      if (!(polar >= 0 && polar <= kMaxPolar))
        throw MeasurementError(path + ": sample " + std::to_string(values_.size() + 1) +
                               " has a polar angle that is not between 0 and pi / 2");
    const Vector3 wi = DirectionOf(numbers[at], numbers[at + 1]);
    const Vector3 wo = DirectionOf(numbers[at + 2], numbers[at + 3]);
    const OrientedPoint point{CoordinatesOf(wi, wo), std::uint32_t(values_.size())};
    points.Append({&point, 1});
    values_.push_back(Colour(spectrum));
  }
  ThreadPool thread(1);
  tree_ = PointTree<PointBlock>(std::move(points), thread);
}

Spectrum ScatteredSamples::f(const Vector3& wo, const Vector3& wi) const {
  constexpr std::uint32_t kFound = kNeighbours + 1;
  Real distances[NearBuffer::SizeFor(kFound)];
  std::uint32_t indices[NearBuffer::SizeFor(kFound)];
  NearBuffer buffer;
  buffer.distance2 = distances;
  buffer.index = indices;
  NearestQuery query;
  query.p = CoordinatesOf(wo, wi);
  query.k = kFound;
  const NearPoints found = FastestNearestSearch().nearest(tree_.View(), query, buffer);
  const Real farthest2 = found.distance2[found.farthest];
  const bool hasNinth = found.size() == kFound && farthest2 > kSame2;
  const Real inverseR = hasNinth ? 1 / std::sqrt(farthest2) : 0;
  Spectrum sum, exact;
  Real weights = 0;
  int exactCount = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const PointBlock& block = tree_.BlockOf(found.index[i]);
    const Spectrum& value = values_[block.direction[tree_.Lane(found.index[i])]];
    if (!(found.distance2[i] > kSame2)) {
      exact += value;
      ++exactCount;
      continue;
    }
    // (R - d) / (R d) = 1 / d - 1 / R.
    const Real weight = Square(std::max(1 / std::sqrt(found.distance2[i]) - inverseR, Real(0)));
    sum += value * weight;
    weights += weight;
  }
  if (exactCount > 0) return exact / Real(exactCount);
  if (weights > 0) return sum / weights;
  // All nine are equally distant.
  for (const std::uint32_t index : found.index)
    sum += values_[tree_.BlockOf(index).direction[tree_.Lane(index)]];
  return sum / Real(std::max<std::size_t>(found.size(), 1));
}

}  // namespace exphoton
