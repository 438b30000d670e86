// SPDX-License-Identifier: BSD-2-Clause
// CheckObjLines: each line is a keyword and words. Only v, vt, vn, f, g and o have a meaning here.
#include "shapes/mesh/obj_lines.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/params/suggestions.h"

namespace exphoton {
namespace {

constexpr std::string_view kObjBlanks = " \t\r\v\f";

// The lists that a corner of a face refers to, in the order of a corner: 7/3/5.
enum ObjList { kPositions, kCoordinates, kNormals };
constexpr std::array<const char*, 3> kObjListNames{"vertices", "texture coordinates", "normals"};

std::string Count(std::int64_t count, const char* of) {
  return count == 1 ? "1 entry in the list of " + std::string(of)
                    : std::to_string(count) + " " + of;
}

class ObjChecker {
 public:
  explicit ObjChecker(const std::string& group) : group_(group) {}

  ObjLines Run(std::string_view bytes) {
    while (!bytes.empty()) {
      TakeLine(&bytes);
      if (!words_.empty()) CheckLine();
    }
    if (counts_[kPositions] == 0)
      throw ObjError("it has no vertices (lines that begin with \"v\")");
    for (std::size_t list = 0; list < 3; ++list) {
      if (largest_[list] <= counts_[list]) continue;
      line_ = largestLine_[list];
      Fail("names number " + std::to_string(largest_[list]) + " of " +
           Count(counts_[list], kObjListNames[list]));
    }
    if (!group_.empty() && !hasGroup_) FailGroup();
    return std::move(result_);
  }

 private:
  [[noreturn]] void Fail(const std::string& text) const {
    throw ObjError("line " + std::to_string(line_) + " " + text);
  }

  [[noreturn]] void FailGroup() const {
    std::string text = "it has no group or object \"" + group_ + "\"";
    const std::size_t shown = std::min<std::size_t>(groups_.size(), 10);
    for (std::size_t i = 0; i < shown; ++i)
      text += (i == 0 ? "; it has \"" : "\", \"") + groups_[i];
    if (shown > 0) text += shown < groups_.size() ? "\" and others" : "\"";
    const std::string hint = DidYouMean(group_, groups_);
    throw ObjError(hint.empty() ? text : text + "; " + hint);
  }

  // Reads the words of a line. A backslash at its end joins the next line to it.
  void TakeLine(std::string_view* bytes) {
    words_.clear();
    for (bool isJoined = true; isJoined && !bytes->empty();) {
      ++line_;
      const std::size_t end = std::min(bytes->find('\n'), bytes->size());
      std::string_view line = bytes->substr(0, end);
      bytes->remove_prefix(std::min(end + 1, bytes->size()));
      line = line.substr(0, line.find('#'));
      line = line.substr(0, line.find_last_not_of(kObjBlanks) + 1);
      isJoined = line.ends_with('\\');
      if (isJoined) line.remove_suffix(1);
      while (true) {
        line.remove_prefix(std::min(line.find_first_not_of(kObjBlanks), line.size()));
        if (line.empty()) break;
        const std::string_view word = line.substr(0, line.find_first_of(kObjBlanks));
        words_.push_back(word);
        line.remove_prefix(word.size());
      }
    }
  }

  void CheckLine() {
    const std::string_view key = words_[0];
    if (key == "v") return CheckNumbers(kPositions, 3, 8);
    if (key == "vt") return CheckNumbers(kCoordinates, 1, 3);
    if (key == "vn") return CheckNumbers(kNormals, 3, 3);
    if (key == "f") return CheckFace();
    if (key == "g" || key == "o") return ChooseGroup();
    if (key == "usemtl" || key == "mtllib") result_.namesMaterials = true;
    if (key == "surf" || key == "curv" || key == "curv2")
      Fail("has a free-form curve or surface, which is not read; expected polygons");
  }

  void CheckNumbers(ObjList list, std::size_t least, std::size_t most) {
    const std::size_t count = words_.size() - 1;
    if (count < least || count > most)
      Fail("has " + std::to_string(count) + " numbers after \"" + std::string(words_[0]) +
           "\"; expected " + std::to_string(least));
    for (std::size_t i = 1; i <= count; ++i) CheckNumber(words_[i]);
    ++counts_[list];
    Keep(std::min(count, least == 1 ? std::size_t(2) : std::size_t(3)));
  }

  void CheckNumber(std::string_view word) const {
    const bool hasPlus = word.starts_with('+') && !word.starts_with("+-");
    const char *begin = word.data() + (hasPlus ? 1 : 0), *end = word.data() + word.size();
    double value = 0;
    const auto read = std::from_chars(begin, end, value);
    const bool isTiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    const bool isRead =
        read.ec == std::errc() || (read.ec == std::errc::result_out_of_range && isTiny);
    if (read.ptr != end || !isRead || !(std::abs(value) <= 3e38))
      Fail("has \"" + std::string(word.substr(0, 40)) + "\" instead of a number");
  }

  void CheckFace() {
    if (words_.size() < 4)
      Fail("has a face of " + std::to_string(words_.size() - 1) + " corners; expected 3 or more");
    for (std::size_t i = 1; i < words_.size(); ++i) CheckCorner(words_[i]);
    if (group_.empty() || isInGroup_ || isInObject_) Keep(words_.size() - 1);
  }

  // A corner is 7, 7/3, 7//5 or 7/3/5.
  void CheckCorner(const std::string_view word) {
    std::string_view rest = word;
    for (std::size_t list = 0; list < 3; ++list) {
      const std::string_view number = rest.substr(0, rest.find('/'));
      rest.remove_prefix(number.size());
      if (!(number.empty() && list == kCoordinates)) CheckIndex(number, list, word);
      if (rest.empty()) return;
      rest.remove_prefix(1);
      if (rest.empty() && list < 2) break;
    }
    FailCorner(word);
  }

  [[noreturn]] void FailCorner(std::string_view word) const {
    Fail("has \"" + std::string(word.substr(0, 40)) +
         "\" for a corner of a face; expected 7, 7/3, 7//5 or 7/3/5");
  }

  void CheckIndex(std::string_view number, std::size_t list, std::string_view corner) {
    std::int32_t index = 0;
    const auto read = std::from_chars(number.begin(), number.end(), index);
    if (read.ec != std::errc() || read.ptr != number.end()) FailCorner(corner);
    if (index == 0) Fail("has the number 0 for a corner of a face; numbers begin with 1");
    if (index < 0 && -std::int64_t(index) > counts_[list])
      Fail("counts " + std::to_string(-std::int64_t(index)) + " back from " +
           Count(counts_[list], kObjListNames[list]));
    if (index <= largest_[list]) return;
    largest_[list] = index;
    largestLine_[list] = line_;
  }

  // A face belongs to the groups of the last g and to the object of the last o.
  void ChooseGroup() {
    bool& isIn = words_[0] == "g" ? isInGroup_ : isInObject_;
    isIn = false;
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const std::string name(words_[i]);
      isIn |= name == group_;
      hasGroup_ |= name == group_;
      constexpr std::size_t kMostNames = 1000;  // for a message
      if (groups_.size() < kMostNames &&
          std::find(groups_.begin(), groups_.end(), name) == groups_.end())
        groups_.push_back(name);
    }
  }

  // Appends the keyword and this number of words.
  void Keep(std::size_t count) {
    for (std::size_t i = 0; i <= count; ++i) {
      result_.text += words_[i];
      result_.text += i == count ? '\n' : ' ';
    }
  }

  const std::string& group_;
  ObjLines result_;
  std::int64_t line_ = 0;
  std::vector<std::string_view> words_;
  std::array<std::int64_t, 3> counts_{}, largest_{}, largestLine_{};
  bool isInGroup_ = false, isInObject_ = false, hasGroup_ = false;
  std::vector<std::string> groups_;
};

}  // namespace

ObjLines CheckObjLines(std::string_view bytes, const std::string& group) {
  return ObjChecker(group).Run(bytes);
}

}  // namespace exphoton
