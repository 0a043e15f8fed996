// SPDX-License-Identifier: Apache-2.0
// A real file system that is full, or read-only.
#include <sys/mount.h>

#include <cerrno>
#include <fstream>
#include <iterator>

#include "fault_test.h"

namespace umbrix::app {
namespace {

class DiskFull : public FaultTest {
 protected:
  void TearDown() override {
    if (mounted_) umount(path("disk").c_str());
    FaultTest::TearDown();
  }

  bool mount_disk(std::size_t kilobytes) {
    std::filesystem::create_directory(path("disk"));
    const std::string size = "size=" + std::to_string(kilobytes) + "k";
    mounted_ = mount("tmpfs", path("disk").c_str(), "tmpfs", 0, size.c_str()) == 0;
    if (mounted_) write("disk/out.exr", "precious");
    return mounted_;
  }
  void unmount_disk() {
    ASSERT_EQ(umount(path("disk").c_str()), 0);
    mounted_ = false;
  }

  Outcome render_to_disk() {
    return run({"render", path("scene.gltf"), "-q", "-o", path("disk/out.exr"), "--overwrite", "--size", "400x200",
                "--float", "-j", "2"});
  }

  std::size_t files_on_disk() const {
    using Entries = std::filesystem::directory_iterator;
    return static_cast<std::size_t>(std::distance(Entries(path("disk")), Entries()));
  }

  bool mounted_ = false;
};

TEST_F(DiskFull, IsFourAndTheOldFileStays) {
  make_expected();
  FaultRow row("disk full: tmpfs from 8 KB to the image and more");
  const int count = fault_runs(6, 200);
  const std::size_t most = exr_.size() / 1024 + 32;
  for (int i = 0; i < count; ++i) {
    const std::size_t size =
        8 + (most - 8) * static_cast<std::size_t>(i) / static_cast<std::size_t>(std::max(1, count - 1));
    if (!mount_disk(size)) GTEST_SKIP() << "no right to mount: " << errno;
    const Outcome outcome = render_to_disk();
    const bool full = outcome.code == 4 && read("disk/out.exr") == "precious" &&
                      outcome.err.find("disk/out.exr: No space left") != std::string::npos;
    const bool complete = outcome.code == 0 && read("disk/out.exr") == exr_;
    const bool good = (full || complete) && files_on_disk() == 1 && (i > 0 || full) && (i + 1 < count || complete);
    EXPECT_TRUE(good) << size << " KB: " << outcome.code << " " << outcome.err;
    row.add(good);
    unmount_disk();
  }
}

TEST_F(DiskFull, ReadOnlyIsFour) {
  if (!mount_disk(4096)) GTEST_SKIP() << "no right to mount: " << errno;
  ASSERT_EQ(mount(nullptr, path("disk").c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
  const Outcome outcome = render_to_disk();
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("disk/out.exr"), std::string::npos) << outcome.err;
  EXPECT_EQ(read("disk/out.exr"), "precious");
}

}  // namespace
}  // namespace umbrix::app
