// SPDX-License-Identifier: BSD-2-Clause
// StudyFolder locks its file list while a study runs. A file is listed before it is written. If a
// study is killed in between, the list has a name without a file, but no file is missing from the
// list.
#include "core/app/study/study_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "core/app/analysis/results.h"
#include "core/app/output/output_files.h"
#include "core/app/study/study_scene.h"
#include "core/base/error.h"
#include "core/files/file_identity.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;
constexpr const char* kOwnFolder = ".exphoton-study";
constexpr const char* kFolderFormat = "exphoton study 1";

[[noreturn]] void Fail(const std::string& path, const std::string& why,
                       const std::string& hint = {}) {
  throw Error(ExitStatus::File, "cannot use \"" + path + "\" for a study: " + why, SourceLocation(),
              hint);
}
[[noreturn]] void FailBySystem(const std::string& path) { Fail(path, std::strerror(errno)); }

// Opens a folder that is not a link, and makes it if necessary.
std::unique_ptr<Descriptor> OpenOwnFolder(int parent, const char* name, const std::string& path) {
  if (mkdirat(parent, name, 0777) != 0 && errno != EEXIST) FailBySystem(path);
  constexpr int kFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  auto folder = std::make_unique<Descriptor>(openat(parent, name, kFlags));
  if (!folder->IsOpen()) FailBySystem(path);
  return folder;
}

bool HoldsAnything(const std::string& path) {
  for (const auto& entry : fs::directory_iterator(path))
    if (entry.path().filename() != kOwnFolder) return true;
  return false;
}

}  // namespace

StudyFolder::StudyFolder(const std::string& path) : path_(path) {
  MakeFolder(path);
  const bool isNew = !fs::exists(fs::symlink_status(path + "/" + kOwnFolder));
  if (isNew) CheckIsAStudy();
  Open();
  ReadList();
  if (written_.empty()) AdoptOlderStudy();
  RemoveRunning();
}

StudyFolder::~StudyFolder() {
  RemoveRunning();
  if (own_) unlinkat(own_->Get(), "running", AT_REMOVEDIR);
}

// Studies of earlier versions have no file list, but a valid results.json.
void StudyFolder::CheckIsAStudy() {
  if (!HoldsAnything(path_)) return;
  try {
    study::FromJson(ReadTextFile(path_ + "/results.json"));
  } catch (const std::runtime_error&) {
    Fail(path_, "it contains files, but it is not the folder of a study",
         "--out FOLDER names a new or an empty folder, or one of an earlier study");
  }
}

void StudyFolder::Open() {
  const std::string own = path_ + "/" + kOwnFolder;
  const Descriptor folder(open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.IsOpen()) FailBySystem(path_);
  own_ = OpenOwnFolder(folder.Get(), kOwnFolder, own);
  constexpr int kFlags = O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  list_ = std::make_unique<Descriptor>(openat(own_->Get(), "files.txt", kFlags, 0666));
  struct stat status;
  if (!list_->IsOpen() || fstat(list_->Get(), &status) != 0) FailBySystem(own + "/files.txt");
  if (!S_ISREG(status.st_mode)) Fail(own + "/files.txt", "it is not a regular file");
  if (flock(list_->Get(), LOCK_EX | LOCK_NB) != 0)
    Fail(path_, "another study is running there", "wait for it, or name another folder");
  running_ = OpenOwnFolder(own_->Get(), "running", own + "/running");
  guard_ = std::make_unique<ScratchFolderGuard>(running_->Get());
}

void StudyFolder::ReadList() {
  std::string text;
  char block[4096];
  for (ssize_t count; (count = read(list_->Get(), block, sizeof block)) > 0;)
    text.append(block, std::size_t(count));
  if (text.empty()) return Append(kFolderFormat);
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  if (line != kFolderFormat)
    Fail(path_ + "/" + kOwnFolder + "/files.txt",
         "it has another format than \"" + std::string(kFolderFormat) + '"');
  while (std::getline(lines, line)) written_.insert(line);
}

void StudyFolder::AdoptOlderStudy() {
  try {
    const study::Results results = study::FromJson(ReadTextFile(path_ + "/results.json"));
    for (const char* name : kStudyResults) written_.insert(name);
    for (const study::RunRow& row : results.runs) {
      written_.insert(row.image);
      written_.insert(fs::path(row.image).replace_extension(".json").string());
    }
    written_.insert({results.reference.a, results.reference.b, "reference/state.txt"});
  } catch (const std::runtime_error&) {
    return;  // a new study
  }
  for (const std::string& name : written_) Append(name);
}

void StudyFolder::Append(const std::string& line) {
  const std::string text = line + "\n";
  if (write(list_->Get(), text.data(), text.size()) != ssize_t(text.size()) ||
      (fsync(list_->Get()) != 0 && errno != EINVAL))
    FailBySystem(path_ + "/" + kOwnFolder + "/files.txt");
}

std::string StudyFolder::Claim(const std::string& name) {
  const std::string file = path_ + "/" + name;
  if (!LiesIn(file, path_)) Fail(file, "it is a link to a place outside the study's folder");
  const bool isListed = written_.contains(name);
  if (!isListed && fs::exists(fs::symlink_status(file)))
    Fail(file, "no study has written this file", "move it away, or name another folder");
  if (!isListed) {
    Append(name);
    written_.insert(name);
  }
  return file;
}

void StudyFolder::Take(const std::string& from, const std::string& name) {
  const std::string copy = Running("copy"), to = Claim(name);
  std::error_code error;
  fs::copy_file(from, copy, fs::copy_options::overwrite_existing, error);
  if (!error) fs::rename(copy, to, error);
  if (error)
    throw Error(ExitStatus::File,
                "cannot copy \"" + from + "\" to \"" + to + "\": " + error.message());
}

void StudyFolder::Remove(const std::string& name) const {
  std::error_code ignored;
  if (written_.contains(name) && LiesIn(path_ + "/" + name, path_))
    fs::remove(path_ + "/" + name, ignored);
}

std::string StudyFolder::Running(const std::string& name) const {
  return path_ + "/" + kOwnFolder + "/running/" + name;
}

void StudyFolder::RemoveRunning() const {
  if (!running_) return;
  std::error_code ignored;
  const std::string folder = "/proc/self/fd/" + std::to_string(running_->Get());
  for (const auto& entry : fs::directory_iterator(folder, ignored)) fs::remove(entry, ignored);
}

}  // namespace exphoton::cli
