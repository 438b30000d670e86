// SPDX-License-Identifier: BSD-2-Clause
// By fork and wait4; a child that is late is killed with its whole process group.
#include "tests/hardcases/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace exphoton::hardcases {
namespace {

constexpr const char* kOutName = ".stdout";
constexpr const char* kErrName = ".stderr";

void Redirect(const std::string& path, int flags, int target) {
  const int file = open(path.c_str(), flags, 0600);
  if (file < 0 || dup2(file, target) < 0) _exit(125);
  close(file);
}

[[noreturn]] void Become(const Command& command, std::vector<char*>& argv) {
  setpgid(0, 0);
  for (const int number : {SIGINT, SIGTERM, SIGPIPE}) std::signal(number, SIG_DFL);
  if (chdir(command.folder.c_str()) != 0) _exit(125);
  Redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  Redirect(kOutName, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  Redirect(kErrName, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  for (const auto& variable : command.environment) putenv(const_cast<char*>(variable.c_str()));
  execvp(argv[0], argv.data());
  _exit(126);
}

}  // namespace

Outcome Execute(const Command& command) {
  std::vector<char*> argv;
  for (const auto& word : command.words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) Become(command, argv);
  Outcome outcome;
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    if (elapsed() > command.timeLimit && !outcome.isLate) {
      outcome.isLate = true;
      kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(elapsed() < 0.2 ? 1 : 10));
  }
  outcome.seconds = elapsed();
  outcome.megabytes = double(usage.ru_maxrss) / 1024;
  outcome.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  outcome.out = ReadFile(command.folder + "/" + kOutName);
  outcome.err = ReadFile(command.folder + "/" + kErrName);
  return outcome;
}

std::string ReadFile(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void WriteFile(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "hardcase-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> Folder::Names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    if (name != kOutName && name != kErrName) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace exphoton::hardcases
