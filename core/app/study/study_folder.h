// SPDX-License-Identifier: BSD-2-Clause
// StudyFolder manages the folder of a study's results. It keeps a list of the files that studies
// have written there and never changes other files. Unfinished files are kept in a subfolder.
//
//   DIR/.exphoton-study/files.txt   first line: format; then each written file, relative to DIR
//   DIR/.exphoton-study/running/    files of the current render; emptied at the start and the end
#pragma once

#include <memory>
#include <set>
#include <string>

#include "core/files/open_file.h"
#include "core/files/temporary_file.h"

namespace exphoton::cli {

// kStudyResults names the files computed from all renders, at the top of the folder.
inline constexpr const char* kStudyResults[] = {"results.json", "results.csv", "summary.csv",
                                                "report.html"};

class StudyFolder {
 public:
  // Makes the folder, or continues in the folder of an earlier study. Locks the folder against
  // other processes. Throws Error(File) if the folder is in use or holds files of other origin.
  explicit StudyFolder(const std::string& path);
  ~StudyFolder();

  const std::string& Path() const { return path_; }

  // Returns the path of DIR/NAME and adds it to the list, before the file is written. Throws
  // Error(File) if no study has written an existing file, or if a link leads out of the folder.
  std::string Claim(const std::string& name);

  // Copies a file to DIR/NAME, as a whole or not at all.
  void Take(const std::string& from, const std::string& name);

  // Removes DIR/NAME if a study has written it.
  void Remove(const std::string& name) const;

  // Returns a path for an unfinished file.
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
