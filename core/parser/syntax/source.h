// SPDX-License-Identifier: BSD-2-Clause
// SceneSource: where the text of scene files comes from: the file system (plain or gzip, "-" for
// standard input) or a table in memory, for tests. Tokens are made from it in tokenizer.h.
#pragma once

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace exphoton {

// Why a text cannot be had, without its name: "no such file", "is a directory".
class SourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class SceneSource {
 public:
  virtual ~SceneSource() = default;

  // The whole text, decompressed. An included file must be a regular one, so that a device or a
  // pipe named by mistake does not hang. Throws SourceError.
  virtual std::string Read(const std::string& path, bool isIncluded) = 0;

  // The paths of all files that have been read; none where the text is not in files.
  virtual std::set<std::string> FilesRead() const { return {}; }

  // The path that `name` stands for in the file `from`: relative to that file's folder.
  virtual std::string Resolve(const std::string& name, const std::string& from) const;

  // One name for each file, however it is spelt: to recognise a file that includes itself.
  virtual std::string Identity(const std::string& path) const { return path; }
};

class FileSource : public SceneSource {
 public:
  // Texts by path. What can be read only once (standard input, pipes) is kept there, if given.
  using Streams = std::map<std::string, std::string>;
  explicit FileSource(Streams* streams = nullptr) : streams_(streams) {}

  std::string Read(const std::string& path, bool isIncluded) override;
  std::string Identity(const std::string& path) const override;
  std::set<std::string> FilesRead() const override { return filesRead_; }

 private:
  std::set<std::string> filesRead_;
  Streams* streams_;
};

class MemorySource : public SceneSource {
 public:
  explicit MemorySource(std::map<std::string, std::string> files) : files_(std::move(files)) {}
  std::string Read(const std::string& path, bool isIncluded) override;

 private:
  std::map<std::string, std::string> files_;
};

bool IsGzip(std::string_view bytes);         // by its magic number
std::string Gunzip(std::string_view bytes);  // all members, one after the other; SourceError

}  // namespace exphoton
