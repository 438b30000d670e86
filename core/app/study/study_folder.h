// SPDX-License-Identifier: BSD-2-Clause
// StudyFolder: the folder of a study's results. It keeps a list of what studies have written there
// and never touches anything else. Unfinished files lie in a folder of their own.
//
//   DIR/.exphoton-study/files.txt   first line: format; then each written file, relative to DIR
//   DIR/.exphoton-study/running/    of the render under way; emptied at the start and the end
#pragma once

#include <memory>
#include <set>
#include <string>

#include "core/files/open_file.h"
#include "core/files/temporary_file.h"

namespace exphoton::cli {

// What is made from all renders, at the top of the folder.
inline constexpr const char* kStudyResults[] = {"results.json", "results.csv", "summary.csv",
                                                "report.html"};

class StudyFolder {
 public:
  // Makes the folder or goes on in one that a study has made, alone: another process may not use it
  // at the same time. Throws Error(File) for a folder that holds other things.
  explicit StudyFolder(const std::string& path);
  ~StudyFolder();

  const std::string& Path() const { return path_; }

  // The path of DIR/NAME, which is about to be written. Throws Error(File) where something is there
  // that no study has written, or a link that leads out of the folder.
  std::string Claim(const std::string& name);

  // Removes DIR/NAME if a study has written it.
  void Remove(const std::string& name) const;

  // A path for an unfinished file.
  std::string Running(const std::string& name) const;
  void RemoveRunning() const;

 private:
  void Open();
  void ReadList();
  void Append(const std::string& line);
  void CheckIsAStudy();
  void AdoptOlderStudy();

  std::string path_;
  std::unique_ptr<Descriptor> own_, list_, running_;
  std::unique_ptr<ScratchFolderGuard> guard_;
  std::set<std::string> written_;
};

}  // namespace exphoton::cli
