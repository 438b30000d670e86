// SPDX-License-Identifier: BSD-2-Clause
// RunProcess uses fork and wait4. A child beyond its time limit is killed with its process group.
#include "tests/support/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace exphoton {
namespace {

constexpr const char* kInputName = ".stdin";
constexpr const char* kOutName = ".stdout";
constexpr const char* kErrName = ".stderr";
constexpr std::array kOwnNames{kInputName, kOutName, kErrName};

void Redirect(const char* path, int flags, int target) {
  const int file = open(path, flags, 0600);
  if (file < 0 || dup2(file, target) < 0) _exit(125);
  close(file);
}

[[noreturn]] void Become(const ProcessCommand& command, const std::vector<char*>& argv) {
  setpgid(0, 0);
  for (int number = 1; number < NSIG; ++number) std::signal(number, SIG_DFL);
  if (chdir(command.folder.c_str()) != 0) _exit(125);
  Redirect(kInputName, O_RDONLY, STDIN_FILENO);
  Redirect(kOutName, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  Redirect(kErrName, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  for (const auto& variable : command.environment) putenv(const_cast<char*>(variable.c_str()));
  execvp(argv[0], argv.data());
  _exit(126);
}

}  // namespace

pid_t StartProcess(const ProcessCommand& command) {
  std::vector<char*> argv;
  for (const auto& word : command.words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  WriteFile(command.folder + "/" + kInputName, command.input);
  unlink((command.folder + "/" + kErrName).c_str());  // left by an earlier process
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) Become(command, argv);
  return child;
}

ProcessResult WaitForProcess(pid_t process, const std::string& folder, double timeLimit) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  ProcessResult result;
  int status = 0;
  rusage usage{};
  while (wait4(process, &status, WNOHANG, &usage) == 0) {
    if (elapsed() > timeLimit && !result.isLate) {
      result.isLate = true;
      kill(-process, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(elapsed() < 0.2 ? 1 : 10));
  }
  result.seconds = elapsed();
  result.megabytes = double(usage.ru_maxrss) / 1024;
  result.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  result.out = ReadFile(folder + "/" + kOutName);
  result.err = ReadFile(folder + "/" + kErrName);
  return result;
}

ProcessResult RunProcess(const ProcessCommand& command) {
  return WaitForProcess(StartProcess(command), command.folder, command.timeLimit);
}

std::string ReadFile(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void WriteFile(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TestFolder::TestFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "exphoton-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TestFolder::~TestFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TestFolder::Names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    if (std::find(kOwnNames.begin(), kOwnNames.end(), name) == kOwnNames.end())
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string TestFolder::StandardOutput() const { return ReadFile(File(kOutName)); }
std::string TestFolder::StandardError() const { return ReadFile(File(kErrName)); }

}  // namespace exphoton
