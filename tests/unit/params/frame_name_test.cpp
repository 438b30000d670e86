// SPDX-License-Identifier: BSD-2-Clause
// These tests check how the number of a frame gets into a file's name.
#include "core/parser/frame_name.h"

#include <gtest/gtest.h>

namespace exphoton {
namespace {

TEST(FrameNameTest, NumbersReplaceEveryPlace) {
  EXPECT_EQ(FrameName("a%d.exr", 7), "a7.exr");
  EXPECT_EQ(FrameName("a%03d/%d.exr", 7), "a007/7.exr");
  EXPECT_EQ(FrameName("%02d", 123), "123");
  EXPECT_EQ(FrameName("%d%d", 5), "55");
  EXPECT_EQ(FrameName("", 5), "");
}

TEST(FrameNameTest, OtherPerCentSignsStay) {
  for (const char* name : {"a.exr", "50%.exr", "%", "%0", "%03", "%3d", "%x", "%0xd", "a%%"}) {
    EXPECT_FALSE(HasFrameNumber(name)) << name;
    EXPECT_EQ(FrameName(name, 7), name);
  }
  EXPECT_TRUE(HasFrameNumber("%x%d"));
  EXPECT_EQ(FrameName("%x%d", 7), "%x7");
}

TEST(FrameNameTest, WithoutNumberDropsThePlace) {
  EXPECT_EQ(NameWithoutNumber("room%03d.exr"), "room.exr");
  EXPECT_EQ(NameWithoutNumber("room.exr"), "room.exr");
}

TEST(FrameNameTest, FormatIsThatOfPrintf) {
  EXPECT_EQ(FrameFormat("50%/%x%03d.exr"), "50%%/%%x%03d.exr");
  char name[64];
  std::snprintf(name, sizeof name, FrameFormat("50%/%x%03d.exr").c_str(), 12);
  EXPECT_EQ(name, FrameName("50%/%x%03d.exr", 12));
}

}  // namespace
}  // namespace exphoton
