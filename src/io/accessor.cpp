// SPDX-License-Identifier: Apache-2.0
// Accessors after glTF 2.0, sections 3.6.2 (views, alignment, sparse) and 3.11 (normalised integers).

#include "io/accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/load_error.h"

namespace umbrix::io::detail {

// Where elements lie, already checked: element i is at data + i * stride.
struct AccessorReader::Bytes {
  const unsigned char* data = nullptr;
  std::size_t stride = 0;
};

// How an element is stored.
struct AccessorReader::Encoding {
  int component_type = 0;
  std::size_t component_bytes = 0;
  std::size_t components = 1;
  bool normalized = false;

  std::size_t bytes() const { return component_bytes * components; }
};

namespace {

// Elements that no bytes of the file stand behind (an accessor without a view is all zeros) cost a file nothing.
constexpr std::uint64_t kMostZeros = 1u << 24;

std::size_t component_bytes(int component_type, const std::string& label) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      bad_input("{}: componentType {} is not one of glTF's", label, component_type);
  }
}

template <class T>
T load(const unsigned char* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

// glTF 2.0, section 3.11: c / max, and for signed types not below -1.
template <class T>
float to_float(const unsigned char* p, bool normalized) {
  const auto value = static_cast<float>(load<T>(p));
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float component(const unsigned char* p, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return to_float<std::int8_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return to_float<std::uint8_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return to_float<std::int16_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return to_float<std::uint16_t>(p, normalized);
    default:
      return load<float>(p);
  }
}

std::uint32_t unsigned_component(const unsigned char* p, std::size_t bytes) {
  if (bytes == 1) return *p;
  return bytes == 2 ? load<std::uint16_t>(p) : load<std::uint32_t>(p);
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// What a refusal calls the use.
const char* use_name(AccessorUse use) {
  switch (use) {
    case AccessorUse::key:
    case AccessorUse::rotation:
    case AccessorUse::morph_weight:
      return "animation";
    case AccessorUse::inverse_bind:
      return "skin";
    case AccessorUse::placement:
    case AccessorUse::turn:
      return "instancing";
    default:
      return "attribute";
  }
}

// Uses for which KHR_mesh_quantization allows more.
bool can_be_quantized(AccessorUse use) {
  return use == AccessorUse::position || use == AccessorUse::normal || use == AccessorUse::texcoord;
}

// May a value be stored so? The small integers beyond core glTF need KHR_mesh_quantization.
bool allowed(AccessorUse use, int type, bool normalized, bool quantized) {
  const bool is_signed = type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT;
  const bool is_unsigned =
      type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  const bool is_float = type == TINYGLTF_COMPONENT_TYPE_FLOAT && !normalized;
  switch (use) {
    case AccessorUse::joint:
      return is_unsigned && !normalized;
    case AccessorUse::key:
    case AccessorUse::inverse_bind:
    case AccessorUse::placement:
      return is_float;
    case AccessorUse::weight:
      return is_float || (is_unsigned && normalized);
    case AccessorUse::rotation:
    case AccessorUse::morph_weight:
      return is_float || ((is_signed || is_unsigned) && normalized);
    case AccessorUse::turn:
      return is_float || (is_signed && normalized);
    case AccessorUse::color:
      return is_float || (is_unsigned && normalized);
    case AccessorUse::normal:
    case AccessorUse::tangent:
      return is_float || (quantized && is_signed && normalized);
    case AccessorUse::texcoord:
      return is_float || (is_unsigned && normalized) || (quantized && (is_signed || is_unsigned));
    case AccessorUse::position:
      return is_float || (quantized && (is_signed || is_unsigned));
  }
  return false;
}

// The accessor type of elements of N components.
struct ElementType {
  int type;
  const char* name;
};

template <std::size_t N>
constexpr ElementType element_type() {
  switch (N) {
    case 1:
      return {TINYGLTF_TYPE_SCALAR, "SCALAR"};
    case 2:
      return {TINYGLTF_TYPE_VEC2, "VEC2"};
    case 3:
      return {TINYGLTF_TYPE_VEC3, "VEC3"};
    case 4:
      return {TINYGLTF_TYPE_VEC4, "VEC4"};
    default:
      return {TINYGLTF_TYPE_MAT4, "MAT4"};
  }
}

// Where a view's bytes begin; all of them lie within its buffer.
const unsigned char* view_data(const tinygltf::Model& model, int view_number, const std::string& label) {
  if (view_number < 0 || static_cast<std::size_t>(view_number) >= model.bufferViews.size()) {
    bad_input("{}: bufferView {} does not exist", label, view_number);
  }
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_number)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
    bad_input("{}: the buffer of bufferView {} does not exist", label, view_number);
  }
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    bad_input("{}: bufferView {} lies beyond its buffer of {} bytes", label, view_number, data.size());
  }
  return data.data() + view.byteOffset;
}

}  // namespace

AccessorReader::AccessorReader(const tinygltf::Model& model, std::uint64_t byte_limit)
    : model_(model),
      bytes_left_(byte_limit),
      zeros_left_(kMostZeros),
      quantized_(std::count(model.extensionsUsed.begin(), model.extensionsUsed.end(), "KHR_mesh_quantization") > 0) {}

const tinygltf::Accessor& AccessorReader::accessor_at(int accessor) const {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model_.accessors.size()) {
    bad_input("accessor {} does not exist", accessor);
  }
  return model_.accessors[static_cast<std::size_t>(accessor)];
}

std::uint64_t AccessorReader::count(int accessor) const { return accessor_at(accessor).count; }

AccessorReader::Bytes AccessorReader::locate(int view_number, std::uint64_t offset, std::uint64_t count,
                                             const Encoding& encoding, const std::string& label) const {
  const unsigned char* const data = view_data(model_, view_number, label);
  const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(view_number)];
  const std::uint64_t stride = view.byteStride != 0 ? view.byteStride : encoding.bytes();
  if (stride < encoding.bytes() || stride % encoding.component_bytes != 0) {
    bad_input("{}: a stride of {} bytes does not fit elements of {}", label, stride, encoding.bytes());
  }
  if (offset % encoding.component_bytes != 0 || (offset + view.byteOffset) % encoding.component_bytes != 0) {
    bad_input("{}: byte offset {} is not a multiple of the component's {} bytes", label, offset + view.byteOffset,
              encoding.component_bytes);
  }
  // Divided, not multiplied, so that nothing can overflow.
  const std::uint64_t room = offset <= view.byteLength ? view.byteLength - offset : 0;
  if (count > 0 && (room < encoding.bytes() || (room - encoding.bytes()) / stride < count - 1)) {
    bad_input("{}: {} elements of {} bytes at offset {} lie beyond bufferView {} of {} bytes", label, count,
              encoding.bytes(), offset, view_number, view.byteLength);
  }
  return {data + (count > 0 ? offset : 0), static_cast<std::size_t>(stride)};
}

void AccessorReader::spend(std::uint64_t elements, std::size_t bytes_each, bool backed, const std::string& label) {
  if (elements > bytes_left_ / bytes_each) {
    over_limit("{}: {} elements of {} bytes, {} bytes are left of the limit", label, elements, bytes_each, bytes_left_);
  }
  bytes_left_ -= elements * bytes_each;
  if (backed) return;
  if (elements > zeros_left_) {
    over_limit("{}: {} elements without a bufferView, the limit is {}", label, elements, kMostZeros);
  }
  zeros_left_ -= elements;
}

template <std::size_t N>
std::vector<std::array<float, N>> AccessorReader::values(int number, AccessorUse use) {
  const tinygltf::Accessor& accessor = accessor_at(number);
  const std::string label = fmt::format("accessors[{}]", number);
  constexpr ElementType kType = element_type<N>();
  if (accessor.type != kType.type) bad_input("{}: must be of type {}", label, kType.name);
  const Encoding encoding{accessor.componentType, component_bytes(accessor.componentType, label), N,
                          accessor.normalized};
  if (!allowed(use, accessor.componentType, accessor.normalized, quantized_)) {
    bad_input("{}: componentType {}{} is not allowed for this {}{}", label, accessor.componentType,
              accessor.normalized ? " normalized" : "", use_name(use),
              quantized_ || !can_be_quantized(use) ? "" : " without KHR_mesh_quantization");
  }

  const bool backed = accessor.bufferView >= 0;
  Bytes bytes;
  if (backed) bytes = locate(accessor.bufferView, accessor.byteOffset, accessor.count, encoding, label);
  spend(accessor.count, sizeof(std::array<float, N>), backed, label);
  std::vector<std::array<float, N>> out(accessor.count, std::array<float, N>{});
  if (backed) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const unsigned char* element = bytes.data + i * bytes.stride;
      for (std::size_t c = 0; c < N; ++c) {
        out[i][c] = component(element + c * encoding.component_bytes, encoding.component_type, encoding.normalized);
      }
    }
  }
  if (accessor.sparse.isSparse) apply_sparse(accessor, encoding, label, out);
  return out;
}

template <std::size_t N>
void AccessorReader::apply_sparse(const tinygltf::Accessor& accessor, const Encoding& encoding,
                                  const std::string& label, std::vector<std::array<float, N>>& out) const {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 1 || static_cast<std::uint64_t>(sparse.count) > accessor.count) {
    bad_input("{}: sparse count {} is not from 1 to {}", label, sparse.count, accessor.count);
  }
  if (!is_index_type(sparse.indices.componentType)) {
    bad_input("{}: sparse indices of componentType {}", label, sparse.indices.componentType);
  }
  const auto count = static_cast<std::uint64_t>(sparse.count);
  const Encoding index_encoding{sparse.indices.componentType, component_bytes(sparse.indices.componentType, label), 1,
                                false};
  if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) bad_input("{}: negative sparse offset", label);
  const Bytes indices = locate(sparse.indices.bufferView, static_cast<std::uint64_t>(sparse.indices.byteOffset), count,
                               index_encoding, label + ".sparse.indices");
  const Bytes values = locate(sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset), count,
                              encoding, label + ".sparse.values");
  std::int64_t previous = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = unsigned_component(indices.data + i * indices.stride, index_encoding.component_bytes);
    if (index >= out.size() || index <= previous) {
      bad_input("{}: sparse index {} is not below {} and above the one before", label, index, out.size());
    }
    previous = index;
    const unsigned char* element = values.data + i * values.stride;
    for (std::size_t c = 0; c < N; ++c) {
      out[index][c] = component(element + c * encoding.component_bytes, encoding.component_type, encoding.normalized);
    }
  }
}

template std::vector<std::array<float, 1>> AccessorReader::values<1>(int, AccessorUse);
template std::vector<std::array<float, 2>> AccessorReader::values<2>(int, AccessorUse);
template std::vector<std::array<float, 3>> AccessorReader::values<3>(int, AccessorUse);
template std::vector<std::array<float, 4>> AccessorReader::values<4>(int, AccessorUse);
template std::vector<std::array<float, 16>> AccessorReader::values<16>(int, AccessorUse);

std::vector<std::array<float, 4>> AccessorReader::colors(int accessor) {
  if (accessor_at(accessor).type != TINYGLTF_TYPE_VEC3) return values<4>(accessor, AccessorUse::color);
  std::vector<std::array<float, 4>> out;
  for (const std::array<float, 3>& c : values<3>(accessor, AccessorUse::color)) out.push_back({c[0], c[1], c[2], 1});
  return out;
}

std::vector<std::uint32_t> AccessorReader::indices(int number, std::uint64_t vertex_count) {
  const tinygltf::Accessor& accessor = accessor_at(number);
  const std::string label = fmt::format("accessors[{}]", number);
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_index_type(accessor.componentType) || accessor.normalized) {
    bad_input("{}: indices must be unsigned integer scalars", label);
  }
  if (accessor.bufferView < 0 || accessor.sparse.isSparse) bad_input("{}: indices must lie in a bufferView", label);
  const Encoding encoding{accessor.componentType, component_bytes(accessor.componentType, label), 1, false};
  const Bytes bytes = locate(accessor.bufferView, accessor.byteOffset, accessor.count, encoding, label);
  spend(accessor.count, sizeof(std::uint32_t), true, label);
  std::vector<std::uint32_t> out(accessor.count);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = unsigned_component(bytes.data + i * bytes.stride, encoding.component_bytes);
    if (out[i] >= vertex_count) {
      bad_input("{}: index {} at {} is out of range, there are {} vertices", label, out[i], i, vertex_count);
    }
  }
  return out;
}

std::vector<unsigned char> view_bytes(const tinygltf::Model& model, int view, const std::string& label) {
  const unsigned char* const data = view_data(model, view, label);
  return {data, data + model.bufferViews[static_cast<std::size_t>(view)].byteLength};
}

}  // namespace umbrix::io::detail
