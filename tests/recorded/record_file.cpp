// SPDX-License-Identifier: BSD-2-Clause
// The format of the files of records, and the comparison with them.
#include "tests/recorded/record_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace exphoton::recorded {
namespace {

// The same program gives the same bits, so this is for the digits that a record leaves out.
constexpr double kTolerance = 6e-5;  // of the number, or of the mean over the picture

// The label of the channels R, G and B if they are equal. A channel A that is 1 is not written.
constexpr const char* kGrey = "RGB";

// The other labels are written small.
bool IsPicture(const std::string& label) {
  return std::isupper(label[0]) || label.find('.') != label.npos;
}

std::string Digits(const std::string& label, double value) {
  char text[32];
  std::snprintf(text, sizeof text, IsPicture(label) ? "%.5g" : "%.7g", value);
  std::string short_text = text;
  for (const char* zero : {"0.", "-0."})
    if (short_text.starts_with(zero)) short_text.erase(short_text.find('0'), 1);
  return short_text;
}

std::string NumbersText(const std::string& label, const std::vector<double>& numbers) {
  std::vector<std::string> digits;
  for (const double number : numbers) digits.push_back(Digits(label, number));
  if (std::all_of(digits.begin(), digits.end(), [&](const auto& d) { return d == digits[0]; }))
    digits.resize(1);
  std::string text;
  for (const std::string& d : digits) text += " " + d;
  return text;
}

double LargestMean(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += std::abs(number);
  return numbers.empty() ? 0 : sum / double(numbers.size());
}

bool AreEqual(double a, double b, double scale) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) == std::isnan(b);
  return a == b || std::abs(a - b) <= kTolerance * std::max(std::abs(a), scale);
}

std::string Place(const std::string& label, std::size_t i) {
  constexpr std::array<const char*, 4> kQuadrants{"upper left", "upper right", "lower left",
                                                  "lower right"};
  if (IsPicture(label)) return "picture " + label + ", " + kQuadrants[i % 4];
  if (label == "rays") return std::string(RayKindName(RayKind(i % kRayKindCount))) + " rays";
  return label + ", number " + std::to_string(i + 1);
}

std::string Change(const std::string& place, double before, double now) {
  char text[96];
  std::snprintf(text, sizeof text, ": %.6g was recorded, %.6g is measured", before, now);
  std::string line = place + text;
  if (before != 0 && std::isfinite(now)) {
    std::snprintf(text, sizeof text, " (%+.3g %%)", 100 * (now - before) / std::abs(before));
    line += text;
  }
  return line;
}

void CompareNumbers(const std::string& label, std::vector<double> before,
                    const std::vector<double>& now, std::vector<std::string>* differences) {
  if (before.size() == 1) before.resize(now.size(), before[0]);
  if (before.size() != now.size()) {
    differences->push_back(label + ": " + std::to_string(before.size()) +
                           " numbers were recorded, there are " + std::to_string(now.size()));
    return;
  }
  const double scale = IsPicture(label) ? LargestMean(before) : 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (!AreEqual(before[i], now[i], scale))
      differences->push_back(Change(Place(label, i), before[i], now[i]));
}

}  // namespace

std::string RecordPath(const std::string& group) {
  return std::string(EXPHOTON_SOURCE_DIR) + "/tests/recorded/records/" + group + ".txt";
}

std::string RecordText(const std::string& scene, const Measurement& measurement) {
  std::string text = scene + "\n";
  std::map<std::string, std::string> lines;
  for (const auto& [label, numbers] : measurement.numbers)
    if (!numbers.empty()) lines[label] = NumbersText(label, numbers);
  if (lines["A"] == " 1") lines.erase("A");
  if (lines["R"] == lines["G"] && lines["R"] == lines["B"] && lines["R"] != "") {
    lines[kGrey] = lines["R"];
    for (const char* channel : {"R", "G", "B"}) lines.erase(channel);
  }
  for (const auto& [label, line] : lines)
    if (!line.empty()) text += " " + label + line + "\n";
  text += " texts";
  for (const auto& [name, words] : measurement.texts)
    text += " " + name.substr(0, 1) + ShortHash(words);
  return text + "\n";
}

Records ReadRecords(const std::string& group) {
  Records records;
  Record* record = nullptr;
  std::ifstream file(RecordPath(group));
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] != ' ') {
      record = &records[line];
      continue;
    }
    std::istringstream words(line);
    std::string label, word;
    words >> label;
    if (label == "texts") {
      while (words >> word) record->texts[word.substr(0, 1)] = word.substr(1);
      continue;
    }
    std::vector<double> numbers;
    while (words >> word) numbers.push_back(std::strtod(word.c_str(), nullptr));
    if (IsPicture(label)) record->numbers.insert({"A", {1}});
    for (const std::string& channel :
         label == kGrey ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{label})
      record->numbers[channel] = numbers;
  }
  return records;
}

std::vector<std::string> Differences(const Record& record, const Measurement& measurement) {
  std::vector<std::string> differences;
  for (const auto& [label, numbers] : measurement.numbers) {
    const auto found = record.numbers.find(label);
    if (found != record.numbers.end())
      CompareNumbers(label, found->second, numbers, &differences);
    else if (!numbers.empty())
      differences.push_back(label + " was not recorded");
  }
  for (const auto& [label, numbers] : record.numbers)
    if (!measurement.numbers.contains(label)) differences.push_back(label + " is missing");
  for (const auto& [name, text] : measurement.texts) {
    const auto found = record.texts.find(name.substr(0, 1));
    if (found == record.texts.end() || found->second != ShortHash(text))
      differences.push_back("another text: " + name);
  }
  if (record.texts.size() > measurement.texts.size())
    differences.push_back(std::to_string(record.texts.size()) + " texts were recorded, there are " +
                          std::to_string(measurement.texts.size()));
  return differences;
}

}  // namespace exphoton::recorded
