// SPDX-License-Identifier: BSD-2-Clause
// RunFiles records every file that a run reads or writes. Before rendering, it refuses to overwrite
// a file that the run reads or also writes otherwise. It also restricts output names that come from
// a scene file, because scene files can come from untrusted sources.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/files/file_identity.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {

struct OutputFile {
  std::string path;
  std::string what;    // for example "the picture"
  std::string remedy;  // hint: what to do if the name cannot be used
  // The scene file that names this output; "": the user named it on the command line.
  std::string namedBy{};
};

class RunFiles {
 public:
  // Adds the program and its core library as inputs.
  RunFiles();

  // `reader` names the reader in messages: "the scene \"a.pbrt\""; "" for the program itself.
  void AddInput(const std::string& path, const std::string& reader);
  // Adds a scene file ("-" is standard input) and the files that it reads.
  void AddScene(const std::string& path, const std::set<std::string>& inputs);
  void AddScene(const RenderSetup& setup);
  // Libraries (.so) in these folders must not be overwritten.
  void AddPluginFolders(const std::vector<std::string>& folders);

  // `key` names the output within the run. A second output with the same key replaces the first.
  void AddOutput(const std::string& key, OutputFile output);

  // Throws Error(File) for a conflict between files, for a forbidden output name from a scene file
  // and for a file that cannot be written. Leaves no files behind.
  void Check(Log& log);

  // Returns the name for an interrupted picture: "room.partial.exr" for "room.exr", or a variant if
  // that name would overwrite another file.
  std::string PartialPicture(const std::string& path) const;

 private:
  void CheckInputs(const OutputFile& output) const;
  void WarnOfHardLinks(const OutputFile& output, Log& log);
  void CheckOthers() const;
  bool IsPlugin(const std::string& path) const;

  struct Input {
    std::string path, reader;
  };
  std::map<FileIdentity, Input> inputs_;
  std::vector<std::string> pluginFolders_;
  std::map<std::string, OutputFile> outputs_;
  std::set<std::string> warned_;  // paths with a warning about hard links
};

// Returns whether this program wrote the file.
bool IsOwnPicture(const std::string& path);

}  // namespace exphoton::cli
