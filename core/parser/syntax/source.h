// SPDX-License-Identifier: BSD-2-Clause
// SceneSource supplies the text of scene files: from the file system (plain or gzip, "-" for
// standard input) or, in tests, from a table in memory. The tokenizer (tokenizer.h) reads it.
#pragma once

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace exphoton {

// SourceError says why a text cannot be read, without its name: "no such file", "is a directory".
class SourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class SceneSource {
 public:
  virtual ~SceneSource() = default;

  // Returns the whole text, decompressed. An included file must be a regular file, so that a device
  // or pipe named by mistake does not block. Throws SourceError.
  virtual std::string Read(const std::string& path, bool isIncluded) = 0;

  // Returns the paths of all files read so far; empty if the text does not come from files.
  virtual std::set<std::string> FilesRead() const { return {}; }

  // Returns whether Read may succeed for this path.
  virtual bool Has(const std::string& path) const = 0;

  // Returns one canonical name for all spellings of a path, to detect a file that includes itself.
  virtual std::string Identity(const std::string& path) const { return path; }
};

class FileSource : public SceneSource {
 public:
  // Streams holds texts by path. If `streams` is given, Read stores text there that can be read
  // only once (standard input, pipes), and returns the stored text in later calls.
  using Streams = std::map<std::string, std::string>;
  explicit FileSource(Streams* streams = nullptr) : streams_(streams ? streams : &ownStreams_) {}

  std::string Read(const std::string& path, bool isIncluded) override;
  bool Has(const std::string& path) const override;
  std::string Identity(const std::string& path) const override;
  std::set<std::string> FilesRead() const override { return filesRead_; }

 private:
  std::set<std::string> filesRead_;
  Streams ownStreams_;
  Streams* streams_;  // not null
};

class MemorySource : public SceneSource {
 public:
  explicit MemorySource(std::map<std::string, std::string> files) : files_(std::move(files)) {}
  std::string Read(const std::string& path, bool isIncluded) override;
  bool Has(const std::string& path) const override { return files_.contains(path); }

 private:
  std::map<std::string, std::string> files_;
};

bool IsGzip(std::string_view bytes);         // tests the magic number
std::string Gunzip(std::string_view bytes);  // all members; throws SourceError

}  // namespace exphoton
