// SPDX-License-Identifier: Apache-2.0
// SIGKILL at any time: files are as they were or complete, and what is left beside them goes with the next run.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "fault_test.h"

namespace umbrix::app {
namespace {

class Kill : public FaultTest {};

TEST_F(Kill, FilesAreOldOrComplete) {
  make_expected();
  FaultRow row("SIGKILL at a random time of a render");
  std::size_t left = 0;
  for (int i = 0, count = fault_runs(10, 200); i < count; ++i) {
    for (const char* name : {"out.exr", "out.png"}) write(name, "precious");
    const pid_t process = start(render_arguments());
    sleep_for_some(1.2 * seconds_);
    kill(process, SIGKILL);
    wait(process);
    const std::vector<std::string> names = temporaries();
    const bool good = is_whole("out.exr") && is_whole("out.png") && names.size() <= 1;
    EXPECT_TRUE(good) << "run " << i << ": " << testing::PrintToString(files());
    row.add(good);
    left += names.empty() ? 0 : 1;
    age_temporaries();  // the next run takes it
  }
  row.remark(std::to_string(left) + " left a temporary");
  ASSERT_EQ(run(render_arguments()).code, 0);
  EXPECT_TRUE(is_new("out.exr") && is_new("out.png"));
  EXPECT_EQ(temporaries(), std::vector<std::string>());
}

TEST_F(Kill, OnlyWhatADeadProcessLeftIsSwept) {
  write("out.exr.umbrix-1-0", "left long ago");
  write("out.exr.umbrix-2-0", "locked");
  write("out.exr.umbrix-backup", "not ours");
  write("other.exr.umbrix-1-0", "of another file");
  age_temporaries();
  write("out.exr.umbrix-3-0", "new");
  const int file = open(path("out.exr.umbrix-2-0").c_str(), O_RDONLY);
  ASSERT_EQ(flock(file, LOCK_EX), 0);
  EXPECT_EQ(run(render_arguments()).code, 0);
  const std::vector<std::string> kept = {"other.exr.umbrix-1-0", "out.exr.umbrix-2-0", "out.exr.umbrix-3-0",
                                         "out.exr.umbrix-backup"};
  EXPECT_EQ(temporaries(), kept);
  close(file);
}

}  // namespace
}  // namespace umbrix::app
