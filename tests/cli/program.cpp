// SPDX-License-Identifier: BSD-2-Clause
// ProgramTest starts the program of this build with the process helpers of tests/support.
#include "tests/cli/program.h"

#include <chrono>
#include <filesystem>
#include <thread>

namespace exphoton {
namespace {

constexpr double kTimeLimit = 600;  // seconds; enough for a sanitizer build on a busy machine

}  // namespace

pid_t ProgramTest::Start(const std::vector<std::string>& arguments,
                         const std::string& input) const {
  ProcessCommand command;
  command.words = {std::string(EXPHOTON_BINARY_DIR) + "/bin/exphoton"};
  command.words.insert(command.words.end(), arguments.begin(), arguments.end());
  command.folder = folder_.Path();
  command.input = input;
  return StartProcess(command);
}

ProgramResult ProgramTest::Wait(pid_t process) const {
  return WaitForProcess(process, folder_.Path(), kTimeLimit);
}

ProgramResult ProgramTest::Run(const std::vector<std::string>& arguments,
                               const std::string& input) const {
  return Wait(Start(arguments, input));
}

bool ProgramTest::WaitForMessage(const std::string& text) const {
  for (int i = 0; i < 600; ++i) {
    if (folder_.StandardError().find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

void ProgramTest::Write(const std::string& name, const std::string& text) const {
  WriteFile(Path(name), text);
}

std::string ProgramTest::Read(const std::string& name) const { return ReadFile(Path(name)); }

bool ProgramTest::Exists(const std::string& name) const {
  return std::filesystem::exists(Path(name));
}

std::string SmallScene(const std::string& options, const std::string& world) {
  return "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 6 \"string filename\" "
         "\"out.exr\"\nAccelerator \"bruteforce\"\nCamera \"perspective\"\n" +
         options + "\nWorldBegin\nLightSource \"point\"\n" + world +
         "\nTranslate 0 0 4 Shape \"sphere\"\nWorldEnd\n";
}

std::string SmallRoom() {
  return "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16\n"
         "Camera \"perspective\"\nPixelFilter \"box\"\n"
         "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 500\n"
         "WorldBegin\nMaterial \"matte\" \"color Kd\" [.3 .3 .3]\nAttributeBegin AreaLightSource "
         "\"area\" \"color L\" [5 5 5]\n"
         "Translate 0 3 4 Shape \"sphere\" AttributeEnd\nTranslate 0 0 4 Shape \"sphere\"\n"
         "ReverseOrientation Shape \"sphere\" \"float radius\" 6\nWorldEnd\n";
}

std::string RoomWithAHiddenLamp() {
  return "Film \"image\" \"integer xresolution\" 96 \"integer yresolution\" 72\n"
         "Camera \"perspective\" \"float fov\" 60\nPixelFilter \"box\"\n"
         "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 400000\n"
         "\"integer causticphotons\" 5000 \"integer maxphotonpaths\" 2000000\nWorldBegin\n"
         "Material \"matte\" \"color Kd\" [0 0 0]\n"
         "AttributeBegin AreaLightSource \"area\" \"color L\" [600 600 600]\n"
         "Translate 0 0 -3.5 Shape \"sphere\" \"float radius\" .1 AttributeEnd\n"
         "Shape \"cylinder\" \"float radius\" .3 \"float zmin\" -4.5 \"float zmax\" -3\n"
         "AttributeBegin Translate 0 0 -3 Shape \"disk\" \"float radius\" .3 AttributeEnd\n"
         "Material \"mirror\" \"color Kr\" [1 1 1]\n"
         "AttributeBegin Translate 0 0 -5.2 Shape \"disk\" \"float radius\" .9 AttributeEnd\n"
         "Material \"matte\" \"color Kd\" [.3 .3 .3]\n"
         "AttributeBegin AreaLightSource \"area\" \"color L\" [5 5 5]\n"
         "Translate 0 3 4 Shape \"sphere\" AttributeEnd\n"
         "ReverseOrientation Shape \"sphere\" \"float radius\" 6\nWorldEnd\n";
}

}  // namespace exphoton
