// SPDX-License-Identifier: BSD-2-Clause
// RunSelf uses fork, exec and wait4. The parent polls a pipe that the child holds open while it
// lives, so that it notices both the child's end and a request to stop.
#include "core/app/process/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/app/process/signals.h"
#include "core/base/error.h"
#include "core/files/temporary_file.h"

namespace exphoton::cli {
namespace {

[[noreturn]] void Fail(const std::string& what) {
  throw Error(ExitStatus::Resource, what + ": " + std::strerror(errno));
}

void Redirect(const char* path, int flags, int target) {
  const int file = open(path, flags, 0666);
  if (file < 0 || dup2(file, target) < 0) _exit(125);
  if (file != target) close(file);
}

// Runs in the child between fork and exec, so it must not allocate memory.
[[noreturn]] void Become(const char* program, char* const* arguments, const char* log) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);  // Ctrl-C then reaches only the parent, which kills the child
  RestoreSignals();
  Redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  Redirect(log, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  if (dup2(STDOUT_FILENO, STDERR_FILENO) < 0) _exit(125);
  execv(program, arguments);
  _exit(126);
}

// Waits up to 0.1 s. Returns true once the other end of the pipe is closed.
bool IsClosed(int pipe) {
  constexpr int kMilliseconds = 100;
  pollfd poll{pipe, POLLIN, 0};
  return ::poll(&poll, 1, kMilliseconds) > 0;
}

double Seconds(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

std::string TakeFile(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return text.str();
}

}  // namespace

std::string OwnProgram() {
  std::error_code error;
  const std::string path = std::filesystem::read_symlink("/proc/self/exe", error).string();
  if (error) throw Error(ExitStatus::Internal, "cannot find the program: " + error.message());
  return path;
}

ChildResult RunSelf(const std::vector<std::string>& arguments, const std::string& logFile,
                    const std::atomic<bool>& stop) {
  const std::string program = OwnProgram();
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) Fail("cannot make a pipe");
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);

  const auto start = std::chrono::steady_clock::now();
  const pid_t child = [&] {
    const SignalBlock block;  // a handler in the child would remove the parent's files
    const pid_t process = fork();
    if (process == 0) Become(program.c_str(), argv.data(), logFile.c_str());
    SetWorkingChild(process);
    return process;
  }();
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    Fail("cannot start a process");
  }
  ChildResult result;
  while (!IsClosed(ends[0])) {
    if (!stop || result.wasInterrupted) continue;
    result.wasInterrupted = true;
    kill(child, SIGKILL);
  }
  close(ends[0]);
  SetWorkingChild(0);  // the child has ended; after wait4, another process can get its PID
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  result.wallSeconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  result.cpuSeconds = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  result.peakMemory = 1024. * double(usage.ru_maxrss);
  result.messages = TakeFile(logFile);
  return result;
}

std::vector<std::string> WarningsIn(const std::string& messages) {
  std::vector<std::string> warnings;
  std::istringstream text(messages);
  bool isWarning = false;
  for (std::string line; std::getline(text, line);) {
    const bool continues = line.starts_with("    ");
    if (!continues) isWarning = line.find(": warning: ") != std::string::npos;
    if (!isWarning) continue;
    if (continues)
      warnings.back() += "\n" + line;
    else
      warnings.push_back(line);
  }
  return warnings;
}

}  // namespace exphoton::cli
