// SPDX-License-Identifier: Apache-2.0
// Containers, JSON, data URIs and files that are not what they seem, beyond those of gltf_bad_test.cpp.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <clocale>
#include <locale>

#include "refusal.h"

namespace umbrix::io {
namespace {

using testing::expect_refused;
using testing::Gltf;
using testing::TempFolder;

std::string u32(std::size_t n) { return testing::bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(n)}); }

std::string chunk(const std::string& type, const std::string& bytes) { return u32(bytes.size()) + type + bytes; }

std::string container(const std::string& chunks, std::size_t version = 2) {
  return "glTF" + u32(version) + u32(12 + chunks.size()) + chunks;
}

const std::string kBin("BIN\0", 4);
const std::string kEmptyScene = R"({"asset":{"version":"2.0"}} )";  // 28 bytes

TEST(HostileFiles, ContainersThatLie) {
  const TempFolder folder;
  const std::string json = chunk("JSON", kEmptyScene), bin = chunk(kBin, "12345678");
  SceneFile scene;
  for (const std::string& chunks : {json, json + bin, json + bin + chunk("XYZW", "1234")}) {
    const Status status = load_scene(folder.write("good.glb", container(chunks)), scene);
    EXPECT_TRUE(status.ok()) << status.message();
  }
  const auto refused = [&](const std::string& bytes, const char* what) {
    SCOPED_TRACE(what);
    expect_refused(folder.write("bad.glb", bytes), StatusCode::bad_input, what);
  };
  refused(container(bin + json), "wrong type");
  refused(container(json + json), "wrong type");
  refused(container(json + bin + bin), "wrong type");
  refused(container(json + chunk("XYZW", "") + bin), "wrong type");
  refused(container(chunk("JSON", "")), "empty JSON");
  refused(container(chunk("JSON", kEmptyScene + "  ")), "multiple of 4");
  refused(container(json, 1), "version 1");
  refused(container(json, 3), "version 3");
  refused(container(json) + "1", "header says");
  refused(container(json).substr(0, 39), "header says");
  for (const std::size_t length : {28u, 32u, 0x7FFFFFFCu, 0xFFFFFFFCu, 0xFFFFFFFFu}) {
    std::string lying = container(json + bin);
    lying.replace(12, 4, u32(length + 4));
    refused(lying, "chunk");
  }
  // A buffer that is longer than the chunk it lies in.
  Gltf g = testing::one_triangle();
  std::string short_bin = g.glb();
  const std::size_t at = short_bin.find("\"byteLength\":44");
  ASSERT_NE(at, std::string::npos);
  refused(short_bin.replace(at, 15, "\"byteLength\":99"), "yteLength");
}

TEST(HostileFiles, JsonThatIsOddButRight) {
  const TempFolder folder;
  SceneFile scene;
  for (const std::string& text :
       {"\xEF\xBB\xBF" + kEmptyScene, "\r\n" + kEmptyScene + "\r\n\r\n",
        std::string(R"({"asset":{"version":"1.0"},"asset":{"version":"2.0"}})"),
        std::string(R"({"asset":{"version":"2.0"},"nodes":[{"translation":[-0,-0.0,0e400]}]})"),
        std::string("{\"asset\":{\"version\":\"2.0\",\"generator\":\"\\ud83d\\ude00\\u0000\"}}")}) {
    SCOPED_TRACE(text);
    const Status status = load_scene(folder.write("odd.gltf", text), scene);
    EXPECT_TRUE(status.ok()) << status.message();
  }
}

TEST(HostileFiles, JsonThatIsWrong) {
  const TempFolder folder;
  const std::string asset = R"({"asset":{"version":"2.0"},)";
  for (const std::string& text :
       {std::string("{"), std::string("\0\0\0\0", 4), "\xFF\xFE{" + kEmptyScene, kEmptyScene + "}", kEmptyScene + "{}",
        asset + "\"a\":\"\xC3\x28\"}", asset + "\"a\":\"\xED\xA0\x80\"}", asset + R"("a":"\ud800"})",
        asset + "\"a\":\"\n\"}", asset + "\"a\":01}", asset + "\"a\":.5}", asset + "\"a\":1,}", asset + "'a':1}",
        asset + "/**/\"a\":1}", asset + "\"a\":" + std::string(100, '9') + "e999}"}) {
    SCOPED_TRACE(text);
    expect_refused(folder.write("bad.gltf", text), StatusCode::bad_input, "JSON");
  }
  // Whole numbers are written as such.
  for (const char* index :
       {"1.0", "0.0", "1e0", "-1", "\"0\"", "true", "null", "[0]", "4294967296", "18446744073709551616"}) {
    SCOPED_TRACE(index);
    expect_refused(folder.write("bad.gltf", asset + "\"scenes\":[{}],\"scene\":" + index + "}"), StatusCode::bad_input,
                   "scene");
  }
  expect_refused(folder.write("deep.gltf", asset + "\"extras\":" + std::string(1'000'000, '[')), StatusCode::bad_input,
                 "nested");
  std::string objects = asset + "\"extras\":";
  for (int i = 0; i < 200; ++i) objects += "{\"a\":";
  expect_refused(folder.write("deep.gltf", objects), StatusCode::bad_input, "nested");
}

TEST(HostileFiles, DataUrisThatLie) {
  const TempFolder folder;
  Gltf g = testing::one_triangle();
  const std::string right = testing::base64(g.bin), octets = "data:application/octet-stream;base64,";
  std::string unknown_digit = right;
  unknown_digit[5] = '*';
  for (const std::string& uri :
       {octets, octets + "=", octets + right.substr(0, right.size() - 8), octets + unknown_digit,
        "data:image/png;base64," + right, "data:application/octet-stream," + right, "data:;base64," + right,
        std::string("data:"), octets + std::string(300000, 'A')}) {
    SCOPED_TRACE(uri.substr(0, 120));
    g.json["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", uri}}};
    expect_refused(folder.write("s.gltf", g.json.dump()), StatusCode::bad_input, "");
  }
  // No memory for what is only claimed.
  g.json["buffers"] = {{{"byteLength", 1ull << 53}, {"uri", octets + right}}};
  expect_refused(folder.write("s.gltf", g.json.dump()), StatusCode::bad_input, "");
}

TEST(HostileFiles, NamesThatLeadOutOrNowhere) {
  const TempFolder outside, folder;
  Gltf g = testing::one_triangle();
  outside.write("secret.bin", g.bin);
  std::filesystem::create_directory(folder.path("sub"));
  std::filesystem::create_directory_symlink(std::filesystem::path(outside.path("")), folder.path("away"));
  std::filesystem::create_symlink("loop.bin", folder.path("loop.bin"));
  std::filesystem::create_symlink("/dev/zero", folder.path("zero.bin"));
  std::filesystem::create_symlink("/proc/self/mem", folder.path("memory.bin"));
  folder.write("good.bin", g.bin);
  for (const std::string& uri : {std::string("away/secret.bin"),
                                 std::string("sub/../away/secret.bin"),
                                 std::string("loop.bin"),
                                 std::string("zero.bin"),
                                 std::string("memory.bin"),
                                 std::string("sub"),
                                 std::string("."),
                                 std::string(".."),
                                 std::string("/etc/passwd"),
                                 std::string("%2Fetc%2Fpasswd"),
                                 std::string("//host/share/a.bin"),
                                 std::string("\\\\host\\a.bin"),
                                 std::string("..\\good.bin"),
                                 std::string("good.bin%00.txt"),
                                 std::string("good.bin?x"),
                                 std::string("good%2"),
                                 std::string("$HOME/a.bin"),
                                 std::string("`id`"),
                                 std::string("*.bin"),
                                 std::string("~/a.bin"),
                                 std::string(5000, 'a'),
                                 "FILE://" + folder.path("good.bin"),
                                 std::string("data%3Aapplication/octet-stream;base64,AAAA")}) {
    SCOPED_TRACE(uri.substr(0, 80));
    g.json["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", uri}}};
    expect_refused(folder.write("s.gltf", g.json.dump()), StatusCode::bad_input, "buffers[0]");
  }
  for (const char* uri : {"good.bin", "./good.bin", "sub/../good.bin", "%67ood.bin"}) {
    SCOPED_TRACE(uri);
    g.json["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", uri}}};
    SceneFile scene;
    const Status status = load_scene(folder.write("s.gltf", g.json.dump()), scene);
    EXPECT_TRUE(status.ok()) << status.message();
  }
}

// All buffers together count, so that one file named a thousand times is no way to fill the memory.
TEST(HostileFiles, BufferFilesAreLimitedTogether) {
  const TempFolder folder;
  Gltf g = testing::one_triangle();
  folder.write("a.bin", std::string(1000, 'a'));
  g.json["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", "a.bin"}}};
  for (int i = 0; i < 20; ++i) g.json["buffers"].push_back(g.json["buffers"][0]);
  LoadLimits limits;
  limits.file_bytes = 19'500;
  const std::string path = folder.write("s.gltf", g.json.dump());
  ASSERT_LT(std::filesystem::file_size(path), limits.file_bytes);
  expect_refused(path, StatusCode::resource_limit, "buffers[19]", limits);
}

TEST(HostileFiles, SpecialFilesAreRefusedWithoutWaiting) {
  const TempFolder folder;
  for (const char* path : {"/dev/zero", "/dev/null", "/dev/tty", "/proc/self/mem", "/"}) {
    SCOPED_TRACE(path);
    SceneFile scene;
    EXPECT_EQ(load_scene(path, scene).code(), StatusCode::bad_input);
  }
  for (const std::string& path : {std::string(), std::string("a\0b", 3), std::string(100000, 'x')}) {
    SceneFile scene;
    EXPECT_EQ(load_scene(path, scene).code(), StatusCode::bad_input);
  }
}

// The kernel says 4096 bytes of such a file and gives fewer, as one that is cut while it is read.
TEST(HostileFiles, AFileThatIsShorterThanItSaid) {
  const char* const kShort = "/sys/kernel/mm/transparent_hugepage/enabled";
  if (::access(kShort, R_OK) != 0) GTEST_SKIP() << "needs " << kShort;
  expect_refused(kShort, StatusCode::bad_input, "shorter");
}

TEST(HostileFiles, NamesAreShownAsPlainText) {
  const TempFolder folder;
  // A terminal's commands in 7 bits, in UTF-8's 8 bits, in bare 8 bits; a turn of the writing direction.
  for (const char* name : {"\x1b[31m",
                           "\xC2\x9b"
                           "31m",
                           "\x9b"
                           "31m",
                           "\xE2\x80\xAE"
                           "fltg"}) {
    Gltf g = testing::one_triangle();
    SceneFile scene;
    Status status = load_scene(folder.path(name), scene);
    EXPECT_EQ(status.message().find(name), std::string::npos) << status.message();
    if (name[0] == '\x9b') continue;  // no text
    g.json["nodes"][0]["name"] = name;
    g.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
    status = load_scene(folder.write("s.gltf", g.text()), scene);
    EXPECT_EQ(status.code(), StatusCode::bad_input);
    EXPECT_EQ(status.message().find(name), std::string::npos) << status.message();
  }
  // Other writing is left as it is.
  SceneFile scene;
  const std::string greek = "\xCE\xB4\xCE\xBF\xE2\x82\xAC\xF0\x9F\x98\x80.glb";
  EXPECT_NE(load_scene(folder.path(greek), scene).message().find(greek), std::string::npos);
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// Numbers of files have points, and those of messages no groups, whatever the host's language has.
TEST(HostileFiles, ALocaleWithDecimalCommasChangesNothing) {
  // C's locale, if the machine has such a one, and C++'s.
  const bool is_set = std::setlocale(LC_ALL, "de_DE.UTF-8") || std::setlocale(LC_ALL, "fr_FR.UTF-8");
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  const TempFolder folder;
  Gltf g = testing::one_triangle();
  g.json["nodes"][0]["translation"] = {0.5, 1.25, -2.75};
  SceneFile scene;
  const Status status = load_scene(folder.write("s.gltf", g.text()), scene);
  g.json["accessors"][0]["count"] = 123456;
  const std::string path = folder.write("bad.gltf", g.text());
  SceneFile none;
  const std::string message = load_scene(path, none).message();
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  RecordProperty("c_locale_has_commas", is_set);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(scene.instances[0].to_world[0][3], 0.5);
  EXPECT_EQ(scene.instances[0].to_world[2][3], -2.75);
  EXPECT_NE(message.find("123456"), std::string::npos) << message;
}

}  // namespace
}  // namespace umbrix::io
