// SPDX-License-Identifier: Apache-2.0
// Surroundings that batch systems and containers have: the picture is the same.
#include <sys/wait.h>

#include <cstdlib>

#include "program.h"

namespace umbrix::app {
namespace {

class Environment : public ProgramTest {
 protected:
  /// The exit code of a shell command, in which $umbrix renders the scene to the image that follows it.
  int shell(const std::string& command) {
    const std::string umbrix =
        std::string("umbrix='") + UMBRIX_PROGRAM + " render --quiet --size 64x32 " + path("scene.gltf") + " -o'; ";
    const int status = std::system(("cd '" + folder_.string() + "'; " + umbrix + command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

TEST_F(Environment, NoVariablesFewFilesAndALocaleOfItsOwnChangeNothing) {
  write_scene();
  ASSERT_EQ(shell("$umbrix plain.png"), 0);
  EXPECT_EQ(shell("env -i $umbrix bare.png"), 0);
  EXPECT_EQ(shell("ulimit -n 16; $umbrix few.png"), 0);
  EXPECT_EQ(shell("LC_ALL=de_DE.UTF-8 TZ= HOME=/nowhere $umbrix comma.png"), 0);
  EXPECT_EQ(shell("LC_ALL=nonsense $umbrix nonsense.png"), 0);
  for (const char* name : {"bare.png", "few.png", "comma.png", "nonsense.png"}) {
    EXPECT_EQ(read(name), read("plain.png")) << name;
  }
}

// Three standard streams leave no room for the scene.
TEST_F(Environment, NoFilesAtAllIsACleanError) {
  write_scene();
  const int code = shell("(ulimit -n 4; $umbrix out.png) 2>/dev/null");
  EXPECT_TRUE(code == 3 || code == 4 || code == 127 || code == 1) << code;
  EXPECT_FALSE(exists("out.png"));
}

}  // namespace
}  // namespace umbrix::app
