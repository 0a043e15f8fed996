// SPDX-License-Identifier: Apache-2.0
// The page of `umbrix-bench error`, as a reader's browser shows it: everything is there, and its numbers are those of
// the report. A script is added to a copy of the page that writes down what it finds.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

namespace umbrix {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kObserver = R"(<pre id="observed"></pre><script>
window.addEventListener("load", () => {
  const size = (e) => [e.getBoundingClientRect().width, e.getBoundingClientRect().height];
  const link = document.querySelector("a[download]");
  const observed = {
    title: document.title,
    language: document.documentElement.lang,
    charts: [...document.querySelectorAll("svg")].map((e) => ({
      size: size(e), label: e.getAttribute("aria-label"), shapes: e.querySelectorAll("*").length,
      outside: [...e.querySelectorAll("*")].filter((s) => {
        const inner = s.getBoundingClientRect(), outer = e.getBoundingClientRect();
        return inner.right > outer.right + 1 || inner.bottom > outer.bottom + 1 || inner.left < outer.left - 1 ||
          inner.top < outer.top - 1;
      }).map((s) => s.outerHTML)})),
    pictures: [...document.images].map((e) => e.naturalWidth),
    anchors: [...document.querySelectorAll("nav a")].map((a) => document.querySelector(a.getAttribute("href")) !== null),
    numbers: [...document.querySelectorAll("[data-source]")].map((e) => [e.dataset.source, e.textContent]),
    overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth,
    requests: performance.getEntriesByType("resource").map((e) => e.name),
    report: JSON.parse(atob(link.getAttribute("href").split(",")[1]))
  };
  document.getElementById("observed").textContent = JSON.stringify(observed);
});
</script>)";

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string find_browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (run(std::string("command -v ") + name + " > /dev/null 2>&1") == 0) return name;
  }
  return {};
}

/// Opens the page and returns what the observer wrote; what the browser itself says goes to `messages`.
json observe(const std::string& browser, const fs::path& folder, std::string& messages) {
  std::string page = read_file(folder / "index.html");
  page.insert(page.rfind("</body>"), kObserver);
  std::ofstream(folder / "observed.html", std::ios::binary) << page;
  const std::string in_folder = "'" + folder.string() + "/";
  run(browser +
      " --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking"
      " --disable-component-update --disable-sync --enable-logging=stderr --window-size=1200,1000 --timeout=20000"
      " --user-data-dir=" +
      in_folder + "profile' --dump-dom 'file://" + folder.string() +
      "/observed.html'"
      " > " +
      in_folder + "dom' 2> " + in_folder + "messages'");
  messages = read_file(folder / "messages");
  const std::string dom = read_file(folder / "dom"), start = "<pre id=\"observed\">";
  const std::size_t begin = dom.find(start), end = dom.find("</pre>", begin);
  if (begin == std::string::npos) return {};
  std::string text = dom.substr(begin + start.size(), end - begin - start.size());
  for (const auto& [entity, sign] : {std::pair<std::string, std::string>{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}) {
    for (std::size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1))
      text.replace(at, entity.size(), sign);
  }
  return json::parse(text, nullptr, false);
}

/// Whether the text is the number, rounded to three digits (counts and large numbers to the unit).
bool shows(const std::string& text, const json& value) {
  char* end = nullptr;
  const double shown = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !value.is_number()) return false;
  const double exact = value.get<double>();
  if (value.is_number_integer()) return shown == exact;
  return std::abs(shown - exact) <= std::max(0.00501 * std::abs(exact), 0.0) &&
         (std::abs(exact) < 1000 || std::abs(shown - exact) <= 0.5);
}

class ErrorPage : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "umbrix-page-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(ErrorPage, IsWholeAndTrue) {
  const std::string in_folder = "'" + folder_.string() + "/";
  ASSERT_EQ(run(UMBRIX_BENCH_PATH " error '" UMBRIX_SCENE
                                  "' --kernels standard,beam,auto --size 32 --adversarial 200 --rounds 1 --samples 1,4"
                                  " --seeds 2 --reference 64 --image-size 16 --json " +
                in_folder + "error.json' --out '" + folder_.string() + "' > " + in_folder + "log'"),
            0)
      << read_file(folder_ / "log");
  const json report = json::parse(read_file(folder_ / "error.json"));
  const std::string page = read_file(folder_ / "index.html");
  EXPECT_EQ(page.find("src="), std::string::npos) << "nothing from outside";
  EXPECT_EQ(page.find("<script"), std::string::npos) << "works without scripts";
  for (const char* file : {"cornell-ordinary.svg", "cornell-adversarial.svg", "cornell-rmse.svg", "cornell-relmse.svg"})
    EXPECT_TRUE(fs::exists(folder_ / file)) << file;

  const std::string browser = find_browser();
  if (browser.empty()) GTEST_SKIP() << "no browser";
  std::string messages;
  const json observed = observe(browser, folder_, messages);
  ASSERT_TRUE(observed.is_object()) << messages;
  EXPECT_EQ(messages.find("CONSOLE"), std::string::npos) << messages;
  EXPECT_EQ(observed.at("title"), "Umbrix: run time against error");
  EXPECT_EQ(observed.at("language"), "en");
  ASSERT_EQ(observed.at("charts").size(), 4u);
  for (const json& chart : observed.at("charts")) {
    EXPECT_GT(chart.at("size")[0].get<double>(), 300);
    EXPECT_GT(chart.at("size")[1].get<double>(), 150);
    EXPECT_GT(chart.at("label").get<std::string>().size(), 40u);
    EXPECT_GT(chart.at("shapes").get<int>(), 20);
    EXPECT_TRUE(chart.at("outside").empty()) << chart.at("outside");
  }
  for (const json& width : observed.at("pictures")) EXPECT_GT(width.get<int>(), 0);
  for (const json& found : observed.at("anchors")) EXPECT_TRUE(found.get<bool>());
  EXPECT_LE(observed.at("overflow").get<int>(), 0) << "the page is wider than its window";
  for (const json& request : observed.at("requests")) EXPECT_EQ(request.get<std::string>().rfind("data:", 0), 0u);
  EXPECT_EQ(observed.at("report"), report) << "the download";

  EXPECT_GT(observed.at("numbers").size(), 8 * report.at("rows").size());
  for (const json& number : observed.at("numbers")) {
    const json::json_pointer pointer(number[0].get<std::string>());
    EXPECT_TRUE(shows(number[1], report.at(pointer))) << number << " is " << report.at(pointer);
  }
}

TEST_F(ErrorPage, IsMadeAgainFromTheReport) {
  const std::string in_folder = "'" + folder_.string() + "/";
  const std::string bench = UMBRIX_BENCH_PATH " error ";
  ASSERT_EQ(run(bench + "'" UMBRIX_SCENE "' --kernels beam --size 16 --adversarial 0 --rounds 1 --samples 0 --json " +
                in_folder + "error.json' --html " + in_folder + "first.html' > " + in_folder + "log'"),
            0);
  ASSERT_EQ(run(bench + "--from " + in_folder + "error.json' --html " + in_folder + "again.html'"), 0);
  EXPECT_EQ(read_file(folder_ / "first.html"), read_file(folder_ / "again.html"));
  EXPECT_EQ(run(bench + "--from " + in_folder + "first.html' 2> " + in_folder + "log'"), 3) << "not a report";
  EXPECT_NE(read_file(folder_ / "log").find("first.html: is not a report"), std::string::npos);
  EXPECT_EQ(run(bench + "2> " + in_folder + "log'"), 2) << "nothing to do";
}

}  // namespace
}  // namespace umbrix
