// SPDX-License-Identifier: BSD-2-Clause
// Processes and temporary folders by POSIX.
#include "tests/cli/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace exphoton {
namespace {

constexpr const char* kInputName = ".stdin";
constexpr const char* kOutName = ".stdout";
constexpr const char* kErrName = ".stderr";

void Redirect(const std::string& path, int flags, int target) {
  const int file = open(path.c_str(), flags, 0600);
  if (file < 0 || dup2(file, target) < 0) _exit(125);
  close(file);
}

}  // namespace

ProgramTest::ProgramTest() {
  std::string name = testing::TempDir() + "exphoton-XXXXXX";
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  folder_ = name;
  Write(kInputName, "");
}

ProgramTest::~ProgramTest() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

pid_t ProgramTest::Start(const std::vector<std::string>& arguments) const {
  const std::string program = std::string(EXPHOTON_BINARY_DIR) + "/bin/exphoton";
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  unlink(Path(kErrName).c_str());
  const pid_t process = fork();
  if (process != 0) return process;
  for (const int number : {SIGINT, SIGTERM, SIGPIPE}) std::signal(number, SIG_DFL);
  if (chdir(folder_.c_str()) != 0) _exit(125);
  Redirect(kInputName, O_RDONLY, STDIN_FILENO);
  Redirect(kOutName, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  Redirect(kErrName, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  execv(argv[0], argv.data());
  _exit(126);
}

ProgramResult ProgramTest::Wait(pid_t process) const {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  ProgramResult result;
  result.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  result.out = Read(kOutName);
  result.err = Read(kErrName);
  return result;
}

bool ProgramTest::WaitForMessage(const std::string& text) const {
  for (int i = 0; i < 600; ++i) {
    if (Read(kErrName).find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

ProgramResult ProgramTest::Run(const std::vector<std::string>& arguments,
                               const std::string& input) const {
  Write(kInputName, input);
  return Wait(Start(arguments));
}

void ProgramTest::Write(const std::string& name, const std::string& text) const {
  std::ofstream(Path(name), std::ios::binary) << text;
}

std::string ProgramTest::Read(const std::string& name) const {
  std::ostringstream text;
  text << std::ifstream(Path(name), std::ios::binary).rdbuf();
  return text.str();
}

bool ProgramTest::Exists(const std::string& name) const {
  return std::filesystem::exists(Path(name));
}

std::vector<std::string> ProgramTest::Files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name != kInputName && name != kOutName && name != kErrName) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string SmallScene(const std::string& options, const std::string& world) {
  return "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 6 \"string filename\" "
         "\"out.exr\"\nAccelerator \"bruteforce\"\nCamera \"perspective\"\n" +
         options + "\nWorldBegin\nLightSource \"point\"\n" + world +
         "\nTranslate 0 0 4 Shape \"sphere\"\nWorldEnd\n";
}

}  // namespace exphoton
