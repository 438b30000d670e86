// SPDX-License-Identifier: BSD-2-Clause
// These tests check the exit status for each kind of exception. The numbers are written out,
// because scripts rely on them.
#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "core/app/options/errors.h"
#include "core/app/options/option_parser.h"
#include "core/base/error.h"
#include "core/imaging/image.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {
namespace {

struct Outcome {
  int status;
  std::string out, message;
};

template <class Thrown>
Outcome OutcomeOf(const Thrown& thrown) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = Guarded([&] { throw thrown; });
  std::string out = testing::internal::GetCapturedStdout();
  return {status, std::move(out), testing::internal::GetCapturedStderr()};
}

template <class Thrown>
void ExpectStatus(int status, const Thrown& thrown, const std::string& said) {
  const Outcome outcome = OutcomeOf(thrown);
  EXPECT_EQ(outcome.status, status) << said;
  EXPECT_NE(outcome.message.find(said), std::string::npos) << outcome.message;
  EXPECT_EQ(outcome.out, "");
}

TEST(ExitStatus, OfWorkThatEndsWellIsZero) {
  EXPECT_EQ(Guarded([] {}), 0);
}

TEST(ExitStatus, OfAnErrorIsItsOwn) {
  ExpectStatus(1, Error(ExitStatus::CommandLine, "bad option"), "error: bad option");
  ExpectStatus(2, Error(ExitStatus::Scene, "bad scene", {"a.pbrt", 3, 4, "", {}}, "mend it"),
               "a.pbrt:3:4: error: bad scene");
  ExpectStatus(3, Error(ExitStatus::File, "bad file"), "error: bad file");
  ExpectStatus(4, Error(ExitStatus::Resource, "too large"), "error: too large");
  ExpectStatus(5, Error(ExitStatus::Internal, "bad luck"), "error: bad luck");
}

TEST(ExitStatus, OfPicturesAndFilesIsThree) {
  ExpectStatus(3, ImageError("no picture"), "error: no picture");
  ExpectStatus(3,
               std::filesystem::filesystem_error(
                   "status", std::make_error_code(std::errc::permission_denied)),
               "cannot use a file or folder");
}

TEST(ExitStatus, OfWhatTheMachineLacksIsFour) {
  const std::string lacks = "memory";
  ExpectStatus(4, std::bad_alloc(), lacks);
  ExpectStatus(4, std::bad_array_new_length(), lacks);
  ExpectStatus(4, std::length_error("vector::reserve"), "larger than the address space");
  const auto noMemory = std::make_error_code(std::errc::not_enough_memory);
  ExpectStatus(4, std::system_error(noMemory), lacks);
  ExpectStatus(4, std::filesystem::filesystem_error("read", noMemory), lacks);
  ExpectStatus(
      4,
      std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again), "thread"),
      "thread");
}

TEST(ExitStatus, OfEverythingElseIsFive) {
  ExpectStatus(5, std::logic_error("wrong"), "internal error: wrong");
  ExpectStatus(5, 42, "internal error of an unknown kind");
}

TEST(ExitStatus, OfHelpIsZeroAndOfAnInterruptNamesTheSignal) {
  const Outcome help = OutcomeOf(TextRequest{"usage\n"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.out, "usage\n");
  EXPECT_EQ(help.message, "");
  ExpectStatus(128, LoadingStopped(), "interrupted");  // 128 + 0, because no signal came
}

}  // namespace
}  // namespace exphoton::cli
