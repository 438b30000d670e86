// SPDX-License-Identifier: BSD-2-Clause
// These tests check the atomic writing of files, temporary files, and the identity of the file that
// a path names.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "core/base/error.h"
#include "core/files/atomic_file.h"
#include "core/files/file_identity.h"
#include "core/files/input_file.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class Files : public testing::Test {
 protected:
  std::string Path(const std::string& name) const { return folder_.File(name); }
  void Put(const std::string& name, const std::string& text) const { WriteFile(Path(name), text); }
  std::string Get(const std::string& name) const { return ReadFile(Path(name)); }
  void Link(const std::string& to, const std::string& name) const {
    fs::create_symlink(to, Path(name));
  }
  static void Write(const std::string& path, const std::string& text) {
    AtomicFile file(path);
    file.Write(text.data(), text.size());
    file.Commit();
  }
  mode_t Mode(const std::string& name) const {
    struct stat status {};
    stat(Path(name).c_str(), &status);
    return status.st_mode & 07777;
  }
  const TestFolder folder_;
};

TEST_F(Files, AreReplacedInOneStepOrNotAtAll) {
  Put("a", "old");
  {
    AtomicFile file(Path("a"));
    file.Write("new", 3);
    EXPECT_EQ(Get("a"), "old");
    EXPECT_EQ(folder_.Names().size(), 2u);
  }
  EXPECT_EQ(Get("a"), "old");
  EXPECT_EQ(folder_.Names(), Names{"a"});
  Write(Path("a"), "new");
  EXPECT_EQ(Get("a"), "new");
  EXPECT_EQ(folder_.Names(), Names{"a"});
}

TEST_F(Files, APictureWithMode600IsNotReplacedByOneThatAllCanRead) {
  Put("a", "old");
  for (const mode_t mode : {mode_t(0600), mode_t(0640), mode_t(0444), mode_t(0755)}) {
    chmod(Path("a").c_str(), mode);
    Write(Path("a"), "new");
    EXPECT_EQ(Mode("a"), mode);
  }
}

TEST_F(Files, AreNotReadableByOthersWhileTheyAreWritten) {
  Put("a", "old");
  chmod(Path("a").c_str(), 0600);
  const AtomicFile file(Path("a"));
  for (const std::string& name : folder_.Names()) EXPECT_EQ(Mode(name), 0600u) << name;
}

TEST_F(Files, OwnersAreKeptWhereThatIsPermitted) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may give files away";
  Put("a", "old");
  ASSERT_EQ(chown(Path("a").c_str(), 1234, 2345), 0);
  Write(Path("a"), "new");
  struct stat status {};
  stat(Path("a").c_str(), &status);
  EXPECT_EQ(status.st_uid, 1234u);
  EXPECT_EQ(status.st_gid, 2345u);
}

TEST_F(Files, AccessControlListsAreKept) {
  struct Entry {
    std::uint16_t tag, permissions;
    std::uint32_t id;
  };
  struct {
    std::uint32_t version = 2;
    Entry entries[5] = {{1, 6, ~0u}, {2, 4, 1234}, {4, 4, ~0u}, {16, 4, ~0u}, {32, 0, ~0u}};
  } list;
  const char* const name = "system.posix_acl_access";
  Put("a", "old");
  if (setxattr(Path("a").c_str(), name, &list, sizeof list, 0) != 0)
    GTEST_SKIP() << "this file system has no access control lists";
  Write(Path("a"), "new");
  char kept[sizeof list] = {};
  ASSERT_EQ(getxattr(Path("a").c_str(), name, kept, sizeof kept), ssize_t(sizeof list));
  EXPECT_EQ(std::memcmp(kept, &list, sizeof list), 0);
}

TEST_F(Files, TwoDanglingLinksLeadToTheFileAtTheirEnd) {
  fs::create_directory(Path("sub"));
  Link("second", "first");
  Link("sub/third", "second");
  Write(Path("first"), "new");
  EXPECT_TRUE(fs::is_symlink(Path("first")));
  EXPECT_TRUE(fs::is_symlink(Path("second")));
  EXPECT_EQ(Get("sub/third"), "new");
  Write(Path("first"), "newer");
  EXPECT_EQ(Get("sub/third"), "newer");
  EXPECT_TRUE(fs::is_symlink(Path("second")));
}

TEST_F(Files, LinksInACircleAreAnError) {
  Link("b", "a");
  Link("a", "b");
  EXPECT_THROW(Write(Path("a"), "x"), Error);
  EXPECT_EQ(folder_.Names(), (Names{"a", "b"}));
}

TEST_F(Files, NamesAsLongAsTheSystemAllowsCanBeWritten) {
  const std::string name = std::string(251, 'x') + ".exr";
  Write(Path(name), "new");
  EXPECT_EQ(Get(name), "new");
  EXPECT_EQ(folder_.Names(), Names{name});
}

TEST_F(Files, OtherNamesOfAFileKeepItsOlderContent) {
  Put("a", "old");
  fs::create_hard_link(Path("a"), Path("b"));
  Write(Path("a"), "new");
  EXPECT_EQ(Get("a"), "new");
  EXPECT_EQ(Get("b"), "old");
}

// The existing file has the name that another process with the same process id would use.
TEST_F(Files, TemporariesOfOthersAreNeverRemoved) {
  Put("a." + std::to_string(getpid()) + ".partial", "of another process");
  Write(Path("a"), "new");
  EXPECT_EQ(Get("a." + std::to_string(getpid()) + ".partial"), "of another process");
  AtomicFile one(Path("a")), two(Path("a"));
  one.Write("one", 3);
  two.Write("two", 3);
  one.Commit();
  EXPECT_EQ(Get("a"), "one");
  two.Commit();
  EXPECT_EQ(Get("a"), "two");
}

TEST_F(Files, ASignalHandlerRemovesTemporariesAndAForkedChildDoesNot) {
  const pid_t child = fork();
  if (child == 0) {
    AtomicFile file(Path("a"));
    const pid_t grandchild = fork();
    if (grandchild == 0) {
      RemoveTemporaryFiles();
      _exit(0);
    }
    waitpid(grandchild, nullptr, 0);
    const bool isKept = folder_.Names().size() == 1;
    RemoveTemporaryFiles();
    _exit(isKept && folder_.Names().empty() ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(folder_.Names().empty());
}

TEST_F(Files, OneFileHasOneIdentityHoweverItIsSpelt) {
  fs::create_directory(Path("sub"));
  Put("a", "x");
  Put("b", "x");
  Link("a", "link");
  Link(Path("sub"), "folder");
  fs::create_hard_link(Path("a"), Path("hard"));
  const auto a = IdentifyFile(Path("a"));
  ASSERT_TRUE(a);
  for (const char* name : {"./a", "sub/../a", "folder/../a", "link", "hard"})
    EXPECT_EQ(IdentifyFile(Path(name)), a) << name;
  EXPECT_NE(IdentifyFile(Path("b")), a);
  // These paths name files that do not exist yet.
  Link("new", "dangling");
  const auto fresh = IdentifyFile(Path("new"));
  ASSERT_TRUE(fresh);
  EXPECT_EQ(IdentifyFile(Path("dangling")), fresh);
  EXPECT_EQ(IdentifyFile(Path("sub/../new")), fresh);
  EXPECT_EQ(IdentifyFile(Path("folder/new")), IdentifyFile(Path("sub/new")));
  EXPECT_NE(IdentifyFile(Path("sub/new")), fresh);
  EXPECT_FALSE(IdentifyFile(Path("nowhere/new")));
}

TEST_F(Files, HaveAFolderAndAName) {
  EXPECT_EQ(FolderOf("sub/deep/a"), "sub/deep");
  EXPECT_EQ(FolderOf("/sub/a"), "/sub");
  EXPECT_EQ(FolderOf("/a"), "/");
  EXPECT_EQ(FolderOf("a"), ".");
  EXPECT_EQ(NameOf("/a"), "a");
  EXPECT_EQ(NameOf("sub/a"), "a");
  EXPECT_EQ(NameOf("sub/"), "");
}

TEST_F(Files, LieInAFolderByWhereTheyAre) {
  fs::create_directories(Path("sub/deep"));
  fs::create_directory(Path("subway"));
  Link("/etc", "sub/out");
  EXPECT_TRUE(LiesIn(Path("sub/deep/new"), Path("sub")));
  EXPECT_TRUE(LiesIn(Path("sub"), Path("sub")));
  EXPECT_FALSE(LiesIn(Path("subway/new"), Path("sub")));
  EXPECT_FALSE(LiesIn(Path("sub/../new"), Path("sub")));
  EXPECT_FALSE(LiesIn(Path("sub/out/new"), Path("sub")));
  EXPECT_FALSE(LiesIn(Path("sub/out"), Path("sub")));
}

TEST_F(Files, OnlyRegularOnesAreReadWhereAFileNamesThem) {
  Put("a", "x");
  mkfifo(Path("pipe").c_str(), 0600);
  EXPECT_NO_THROW(RequireRegularFile(Path("a")));
  for (const std::string& path : {Path("pipe"), Path("."), std::string("/dev/zero"), Path("none")})
    EXPECT_THROW(RequireRegularFile(path), InputFileError) << path;
}

}  // namespace
}  // namespace exphoton
