// SPDX-License-Identifier: BSD-2-Clause
// Numbers are written as hexadecimal ones, so that they keep all of their bits.
#include "tests/rounding/measure/precisions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <istream>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "tests/rounding/measure/print.h"

namespace exphoton::rounding {
namespace {

constexpr std::size_t kChannels = 3;

std::vector<double> NumbersOf(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream words(line);
  for (std::string word; words >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
  return numbers;
}

}  // namespace

void Write(const ScenePictures& scene, std::ostream& out) {
  out << scene.name << '\n' << scene.pictures.size() << '\n';
  for (const std::vector<double>& picture : scene.pictures) {
    for (const double value : picture) out << Print("%a ", value);
    out << '\n';
  }
}

std::vector<ScenePictures> ReadPictures(std::istream& in) {
  std::vector<ScenePictures> scenes;
  for (std::string name, line; std::getline(in, name);) {
    if (!std::getline(in, line)) throw std::runtime_error(name + " has no pictures");
    ScenePictures scene{name, {}};
    for (int left = std::stoi(line); left > 0; --left) {
      if (!std::getline(in, line)) throw std::runtime_error(name + " lacks pictures");
      scene.pictures.push_back(NumbersOf(line));
    }
    scenes.push_back(scene);
  }
  return scenes;
}

Distance DistanceOf(const std::vector<std::vector<double>>& pictures,
                    const std::vector<double>& truth) {
  double mean = 0;
  for (const double value : truth) mean += std::abs(value) / double(truth.size());
  std::vector<double> errors;
  for (std::size_t pixel = 0; pixel < truth.size(); pixel += kChannels) {
    double most = 0;
    for (const std::vector<double>& picture : pictures)
      for (std::size_t i = pixel; i < pixel + kChannels; ++i)
        if (picture.at(i) != truth[i])
          most =
              std::max(most, std::abs(picture[i] - truth[i]) / (std::abs(truth[i]) + .01 * mean));
    errors.push_back(most);
  }
  if (errors.empty()) throw std::invalid_argument("a picture without pixels");
  std::sort(errors.begin(), errors.end());
  const auto shareAbove = [&](double limit) {
    const auto first = std::upper_bound(errors.begin(), errors.end(), limit);
    return double(errors.end() - first) / double(errors.size());
  };
  const double decided = shareAbove(kDecided);
  return {errors[errors.size() / 2], shareAbove(kRounded) - decided, decided};
}

double PrecisionRow::Shrinks() const {
  if (!(inFloat.median > 0 && inDouble.median > 0)) return 0;
  return std::log2(inDouble.median / inFloat.median);
}

std::vector<PrecisionRow> ComparePrecisions(const std::vector<ScenePictures>& inFloat,
                                            const std::vector<ScenePictures>& inDouble) {
  std::vector<PrecisionRow> rows;
  std::vector<bool> isTaken(inDouble.size());
  for (const ScenePictures& a : inFloat) {
    for (std::size_t i = 0; i < inDouble.size(); ++i) {
      const ScenePictures& b = inDouble[i];
      if (isTaken[i] || a.name != b.name) continue;
      isTaken[i] = true;
      const std::vector<double>& truth = b.pictures.at(0);
      if (a.pictures.at(0).size() != truth.size()) throw std::runtime_error(a.name + ": sizes");
      rows.push_back({a.name, DistanceOf({a.pictures[0]}, truth),
                      DistanceOf({b.pictures.begin() + 1, b.pictures.end()}, truth)});
      break;
    }
  }
  return rows;
}

std::string TextOf(const std::vector<PrecisionRow>& rows) {
  std::string text =
      "| scene | `float`: median | decided | `double`: median | between | decided | ratio |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const PrecisionRow& row : rows) {
    const double ratio = row.Shrinks();
    text += Print("| %s | %.2g | %.1f %% | %.2g | %.1f %% | %.1f %% | %s |\n", row.name.c_str(),
                  row.inFloat.median / 0x1p-23, 100 * row.inFloat.decided,
                  row.inDouble.median / 0x1p-52, 100 * row.inDouble.between,
                  100 * row.inDouble.decided, ratio == 0 ? "" : Print("2^%.1f", ratio).c_str());
  }
  return text;
}

}  // namespace exphoton::rounding
