// SPDX-License-Identifier: BSD-2-Clause
// RunFiles: every file that a run of the program reads or writes. It refuses, before anything is
// rendered, to write over a file that the run reads or writes otherwise, and to write where only a
// scene file, which may come from anybody, says so.
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
  std::string what;    // "the picture", "the preview (--preview)"
  std::string remedy;  // a hint: what to do where the name cannot be used
  // The scene file that names it; "": the user does, on the command line.
  std::string namedBy{};
};

class RunFiles {
 public:
  // The program itself is an input from the start.
  RunFiles();

  // `reader`: what reads it, for messages: "the scene \"a.pbrt\""; "" for the program itself.
  void AddInput(const std::string& path, const std::string& reader);
  // Of a scene: "-" is standard input.
  void AddScene(const std::string& path, const std::set<std::string>& inputs);
  void AddScene(const RenderSetup& setup);
  // Libraries that lie there are inputs.
  void AddPluginFolders(const std::vector<std::string>& folders);

  // `key` names the output within the run: one added again under its key replaces it.
  void AddOutput(const std::string& key, OutputFile output);

  // Throws Error(File) for a conflict, for an output that only a scene names and that may not be
  // written, and for one that cannot be written. Leaves nothing behind.
  void Check(Log& log);

  // Where an interrupted picture goes: "room.partial.exr" for "room.exr", or another name where
  // that one would replace something else.
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
  std::set<std::string> warned_;  // of hard links
};

// Whether the file is a picture that this program has written.
bool IsOwnPicture(const std::string& path);

}  // namespace exphoton::cli
