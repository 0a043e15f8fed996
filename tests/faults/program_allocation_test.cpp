// SPDX-License-Identifier: Apache-2.0
// One request for memory fails, or that one and all after it, for every request in turn of the whole program, with all
// libraries that it uses.
#include <climits>
#include <csignal>
#include <filesystem>

#include "fault_test.h"

namespace umbrix::app {
namespace {

class ProgramAllocation : public FaultTest {
 protected:
  Outcome run_failing(const std::string& which, const std::vector<std::string>& arguments) {
    return wait(
        start_command(with_environment({"LD_PRELOAD=" UMBRIX_ALLOCATION_FAULTS, "UMBRIX_FAIL_ALLOCATION=" + which,
                                        "UMBRIX_FAIL_COUNT=" + path("count")},
                                       program(arguments))));
  }

  long count_requests(const std::vector<std::string>& arguments) {
    EXPECT_EQ(run_failing(std::to_string(LONG_MAX), arguments).code, 0);
    return std::stol(read("count"));
  }

  void fail_evenly(const std::vector<std::string>& arguments, int runs, FaultRow& row) {
    const long requests = count_requests(arguments);
    const long step = std::max(1L, requests / runs);
    int survived = 0, crashed = 0;
    for (long n = 1 + static_cast<long>(random_() % static_cast<unsigned long>(step)); n <= requests; n += step) {
      for (const char* name : {"out.exr", "out.png"}) write(name, "precious");
      const Outcome outcome = run_failing(std::to_string(n) + (n % 2 == 0 ? "+" : ""), arguments);
      // Some libraries do without what they cannot have.
      const bool done = outcome.code == 0 && (arguments[0] != "render" || (is_new("out.exr") && is_new("out.png")));
      // libpng tells of a lack of memory as of any other failure to write.
      const bool told = (outcome.code == 6 || outcome.code == 4) && !outcome.err.empty();
      const bool whole = is_whole("out.exr") && is_whole("out.png");
      // OpenImageIO 2.4 does not look whether it got memory for attributes of more than 16 bytes (docs/reliability.md).
      const bool died = outcome.code == 128 + SIGSEGV;
      const bool good = whole && (died || (temporaries().empty() && (done || told)));
      for (const std::string& name : temporaries()) std::filesystem::remove(path(name));
      survived += done ? 1 : 0;
      crashed += died ? 1 : 0;
      EXPECT_TRUE(good) << "request " << n << " of " << requests << ": " << outcome.code << " " << outcome.err;
      row.add(good);
    }
    EXPECT_LE(crashed, 1 + runs / 100);
    row.remark("of " + std::to_string(requests) + " requests; " + std::to_string(survived) + " did without; " +
               std::to_string(crashed) + " crashed in an encoder");
  }
};

TEST_F(ProgramAllocation, OfARender) {
  make_expected();
  FaultRow row("a request for memory fails in `umbrix render`");
  std::vector<std::string> arguments = render_arguments();
  arguments.back() = "1";
  fail_evenly(arguments, fault_runs(10, 400), row);
}

TEST_F(ProgramAllocation, OfInfo) {
  make_expected();
  FaultRow row("a request for memory fails in `umbrix info`");
  fail_evenly({"info", path("scene.gltf"), "--json"}, fault_runs(6, 400), row);
}

}  // namespace
}  // namespace umbrix::app
