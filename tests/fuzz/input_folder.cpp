// SPDX-License-Identifier: Apache-2.0
#include "input_folder.h"

#include <unistd.h>

#include <fstream>

#include "promise.h"

namespace umbrix::fuzz {

namespace fs = std::filesystem;

InputFolder::InputFolder() {
  std::error_code error;
  const fs::path memory = "/dev/shm";
  const bool in_memory = fs::is_directory(memory, error) && ::access(memory.c_str(), W_OK) == 0;
  std::string pattern = ((in_memory ? memory : fs::temp_directory_path()) / "umbrix-fuzz-XXXXXX").string();
  promise(::mkdtemp(pattern.data()) != nullptr, "a folder for inputs can be made");
  folder_ = pattern;
}

InputFolder::~InputFolder() {
  std::error_code error;
  fs::remove_all(folder_, error);
}

std::string InputFolder::write(const std::string& name, const void* bytes, std::size_t size) const {
  std::ofstream file(folder_ / name, std::ios::binary | std::ios::trunc);
  file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  file.close();
  promise(file.good(), "an input file can be written");
  return path(name);
}

}  // namespace umbrix::fuzz
