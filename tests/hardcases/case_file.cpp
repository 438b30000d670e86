// SPDX-License-Identifier: BSD-2-Clause
// ReadCatalogue reads lines, each with a keyword and its words. A line that begins with | is text
// that belongs to the keyword above it.
#include "tests/hardcases/case_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <stdexcept>

namespace exphoton::hardcases {
namespace {

struct Template {
  Values defaults;
  std::string text;
};

// Draft is a run before its lists of values are expanded to one run per combination.
struct Draft {
  Run run;
  Values values;
  struct Each {
    std::vector<std::string> keys;
    std::vector<std::vector<std::string>> rows;
  };
  std::vector<Each> lists;
};

// Splits a line at blanks. "..." or '...' keeps blanks and the other quotes within a word.
std::vector<std::string> Words(const std::string& line) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == ' ') {
      ++i;
      continue;
    }
    std::string word;
    for (char quote = 0; i < line.size() && (quote || line[i] != ' '); ++i) {
      const bool isMark = quote ? line[i] == quote : line[i] == '"' || line[i] == '\'';
      if (isMark) {
        quote = quote ? char(0) : line[i];
      } else {
        word += line[i];
      }
    }
    words.push_back(word);
  }
  return words;
}

std::string Rest(const std::string& line) {
  const std::size_t blank = line.find(' ');
  return blank == std::string::npos ? "" : line.substr(line.find_first_not_of(' ', blank));
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

// Replaces {key} by its value. Braces round anything else stay, so the scene parser reports a
// misspelt key.
std::string Fill(std::string text, const Values& values) {
  for (int depth = 0; depth < 4; ++depth) {
    for (const auto& [key, value] : values) {
      const std::string mark = "{" + key + "}";
      for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += value.size())
        text.replace(at, mark.size(), value);
    }
  }
  return text;
}

// {beyond} in a table is a number that Real cannot hold.
#ifdef EXPHOTON_DOUBLE
const Values kConstants{{"beyond", "1e309"}};
#else
const Values kConstants{{"beyond", "1e39"}};
#endif

class Reader {
 public:
  std::vector<Group> groups;

  void ReadFile(const std::string& path) {
    path_ = path;
    line_ = 0;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      ++line_;
      const std::size_t start = line.find_first_not_of(' ');
      if (start == std::string::npos || line[start] == '#') continue;
      Take(Fill(line.substr(start), kConstants));
    }
    FinishRun();
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw std::runtime_error(path_ + ":" + std::to_string(line_) + ": " + what);
  }

  void Take(const std::string& line) {
    if (line[0] == '|') {
      if (!text_) Fail("text of nothing");
      *text_ += line.substr(line.size() > 1 && line[1] == ' ' ? 2 : 1) + "\n";
      return;
    }
    const auto words = Words(line);
    const std::string& keyword = words[0];
    if (keyword == "group") {
      FinishRun();
      groups.push_back({Rest(line), {}});
    } else if (keyword == "template") {
      FinishRun();
      Template& made = templates_[Word(words, 1)];
      made = {};
      for (std::size_t i = 2; i < words.size(); ++i) Assign(words[i], &made.defaults);
      text_ = &made.text;
    } else if (keyword == "case") {
      StartCase(words, line);
    } else if (!TakeOfCase(keyword, words, line)) {
      if (!isInRun_) Fail("\"" + keyword + "\" stands outside of a run");
      TakeOfRun(keyword, words, line);
    }
  }

  void StartCase(const std::vector<std::string>& words, const std::string& line) {
    FinishRun();
    if (groups.empty()) Fail("a case without a group");
    if (!ids_.insert(Word(words, 1)).second) Fail("case " + words[1] + " is there twice");
    Case made;
    made.id = words[1];
    made.title = Rest(Rest(line));
    groups.back().cases.push_back(made);
  }

  bool TakeOfCase(const std::string& keyword, const std::vector<std::string>& words,
                  const std::string& line) {
    static const std::set<std::string> known{"expect", "note", "open", "test", "run", "script"};
    if (!isInRun_ && keyword == "slow") {
      groups.back().cases.back().isSlow = true;
      return true;
    }
    if (!known.contains(keyword)) return false;
    if (groups.empty() || groups.back().cases.empty()) Fail("this belongs into a case");
    FinishRun();
    Case& current = groups.back().cases.back();
    if (keyword == "expect") {
      current.expected = Rest(line);
    } else if (keyword == "note") {
      current.note += (current.note.empty() ? "" : " ") + Rest(line);
    } else if (keyword == "open") {
      current.open = Rest(line);
    } else if (keyword == "test") {
      for (std::size_t i = 2; i < words.size(); ++i)
        current.tests.push_back({Word(words, 1), words[i]});
    } else if (keyword == "run") {
      draft_ = {};
      draft_.run.name = Word(words, 1);
      isInRun_ = true;
    } else {
      current.scripts.push_back({Word(words, 1), "", words.size() > 2 ? Number(words[2]) : 60});
      text_ = &current.scripts.back().text;
    }
    return true;
  }

  void TakeOfRun(const std::string& keyword, const std::vector<std::string>& words,
                 const std::string& line) {
    Run& run = draft_.run;
    if (keyword == "use") {
      const auto found = templates_.find(Word(words, 1));
      if (found == templates_.end()) Fail("no template \"" + words[1] + "\"");
      run.scene = found->second.text;
      draft_.values = found->second.defaults;
      for (std::size_t i = 2; i < words.size(); ++i) Assign(words[i], &draft_.values);
    } else if (keyword == "scene") {
      text_ = &run.scene;
    } else if (keyword == "each") {
      TakeList(words);
    } else if (keyword == "args") {
      run.arguments.insert(run.arguments.end(), words.begin() + 1, words.end());
    } else if (keyword == "env") {
      run.environment.insert(run.environment.end(), words.begin() + 1, words.end());
    } else if (keyword == "slow") {
      run.isSlow = true;
    } else if (keyword == "lenient") {
      run.isStrict = false;
    } else if (keyword == "status") {
      run.status = int(Number(Word(words, 1)));
    } else if (keyword == "seeds") {
      run.seeds = int(Number(Word(words, 1)));
    } else if (keyword == "time") {
      run.timeLimit = Number(Word(words, 1));
    } else if (keyword == "memory") {
      run.memoryLimit = Number(Word(words, 1));
    } else {
      static const std::set<std::string> known{"says",    "silent", "warnings", "mean",   "region",
                                               "same",    "scaled", "near",     "equals", "spread",
                                               "atleast", "atmost", "permuted", "ratio"};
      if (!known.contains(keyword)) Fail("unknown word \"" + keyword + "\"");
      const bool isText = keyword == "says" || keyword == "silent";
      run.checks.push_back(
          {keyword, isText ? std::vector{Rest(line)}
                           : std::vector<std::string>(words.begin() + 1, words.end())});
      if (keyword == "mean" || keyword == "equals") run.seeds = std::max(run.seeds, 8);
    }
  }

  // Reads a list: "each a,b 1,2 3,4" gives two runs, the first with a = 1 and b = 2.
  void TakeList(const std::vector<std::string>& words) {
    Draft::Each list{Split(Word(words, 1), ','), {}};
    for (std::size_t i = 2; i < words.size(); ++i) {
      list.rows.push_back(list.keys.size() > 1 ? Split(words[i], ',')
                                               : std::vector<std::string>{words[i]});
      if (list.rows.back().size() != list.keys.size()) Fail("\"" + words[i] + "\" is no row");
    }
    draft_.lists.push_back(list);
  }

  void FinishRun() {
    text_ = nullptr;
    if (!isInRun_) return;
    isInRun_ = false;
    Multiply(0, draft_.values, draft_.run.name);
  }

  void Multiply(std::size_t index, const Values& values, const std::string& name) {
    if (index == draft_.lists.size()) {
      Run run = draft_.run;
      run.name = name;
      run.scene = Fill(run.scene, values);
      for (auto& argument : run.arguments) argument = Fill(argument, values);
      for (auto& check : run.checks)
        for (auto& argument : check.arguments) argument = Fill(argument, values);
      groups.back().cases.back().runs.push_back(run);
      return;
    }
    const auto& list = draft_.lists[index];
    for (const auto& row : list.rows) {
      Values more = values;
      for (std::size_t i = 0; i < row.size(); ++i) more[list.keys[i]] = row[i];
      Multiply(index + 1, more, name + "/" + row[0]);
    }
  }

  const std::string& Word(const std::vector<std::string>& words, std::size_t index) const {
    if (index >= words.size()) Fail("a word is missing after \"" + words.back() + "\"");
    return words[index];
  }
  double Number(const std::string& word) const {
    try {
      return std::stod(word);
    } catch (const std::exception&) {
      Fail("\"" + word + "\" is no number");
    }
  }
  void Assign(const std::string& word, Values* values) const {
    const std::size_t sign = word.find('=');
    if (sign == std::string::npos) Fail("\"" + word + "\" is no key=value");
    (*values)[word.substr(0, sign)] = word.substr(sign + 1);
  }

  std::string path_;
  int line_ = 0;
  std::map<std::string, Template> templates_;
  std::set<std::string> ids_;
  Draft draft_;
  bool isInRun_ = false;
  std::string* text_ = nullptr;
};

}  // namespace

std::vector<Group> ReadCatalogue(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".txt") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  Reader reader;
  for (const auto& file : files) reader.ReadFile(file);
  return reader.groups;
}

}  // namespace exphoton::hardcases
