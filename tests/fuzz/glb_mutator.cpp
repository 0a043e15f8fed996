// SPDX-License-Identifier: Apache-2.0
// Mutates a .glb chunk by chunk and writes the lengths anew, so that most mutants get past the container. One in eight
// is left as libFuzzer makes it.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

struct Glb {
  std::string json, binary;
};

std::uint32_t read_u32(const std::uint8_t* p) {
  std::uint32_t value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

std::string u32(std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

Glb split(const std::uint8_t* data, std::size_t size) {
  if (size < 20) return {"{\"asset\":{\"version\":\"2.0\"}}", ""};
  const std::size_t length = std::min<std::size_t>(read_u32(data + 12), size - 20);
  const char* json = reinterpret_cast<const char*>(data) + 20;
  const std::size_t rest = 20 + length + 8;
  return {std::string(json, length), rest < size ? std::string(json + length + 8, size - rest) : std::string()};
}

std::string join(Glb glb) {
  glb.json.resize((glb.json.size() + 3) / 4 * 4, ' ');
  glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
  std::string chunks = u32(glb.json.size()) + "JSON" + glb.json;
  if (!glb.binary.empty()) chunks += u32(glb.binary.size()) + std::string("BIN\0", 4) + glb.binary;
  return "glTF" + u32(2) + u32(12 + chunks.size()) + chunks;
}

void mutate(std::string& part, std::size_t room) {
  std::string grown = part;
  grown.resize(part.size() + room);
  const std::size_t size = LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(grown.data()), part.size(), grown.size());
  part = grown.substr(0, size);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  if (seed % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  Glb glb = split(data, size);
  constexpr std::size_t kOverhead = 12 + 8 + 8 + 6;
  const std::size_t used = glb.json.size() + glb.binary.size() + kOverhead;
  if (used > max_size) return LLVMFuzzerMutate(data, size, max_size);
  mutate(seed / 8 % 3 == 0 ? glb.binary : glb.json, max_size - used);
  const std::string mutant = join(std::move(glb));
  if (mutant.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, mutant.data(), mutant.size());
  return mutant.size();
}
