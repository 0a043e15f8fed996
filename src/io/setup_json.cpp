// SPDX-License-Identifier: Apache-2.0
#include "io/setup_json.h"

#include <cmath>

#include "io/load_error.h"

namespace umbrix::io::detail {

using nlohmann::json;

double setup_number(const json& value, double low, double high, const std::string& label) {
  if (!value.is_number()) bad_input("{}: is not a number", label);
  const auto n = value.get<double>();
  if (!(n >= low && n <= high)) bad_input("{}: {} is not from {} to {}", label, n, low, high);
  return n;
}

glm::dvec3 setup_vector(const json& value, double low, const std::string& label) {
  if (!value.is_array() || value.size() != 3) bad_input("{}: must be three numbers", label);
  glm::dvec3 out;
  for (int i = 0; i < 3; ++i) out[i] = setup_number(value[static_cast<std::size_t>(i)], low, kLargestFloat, label);
  return out;
}

const json& setup_member(const json& object, const char* name, const std::string& label) {
  const auto found = object.find(name);
  if (found == object.end()) bad_input("{}: '{}' is missing", label, name);
  return *found;
}

void refuse_unknown(const json& object, std::initializer_list<const char*> known, const std::string& label) {
  if (!object.is_object()) bad_input("{}: is not an object", label);
  for (const auto& entry : object.items()) {
    bool found = false;
    for (const char* name : known) found = found || entry.key() == name;
    if (!found) bad_input("{}: unknown member '{}'", label, printable(entry.key(), 64));
  }
}

glm::dvec3 setup_direction(const glm::dvec3& v, const std::string& label, const char* fault) {
  const double length = glm::length(v);
  if (!(length > 0) || !std::isfinite(length)) bad_input("{}: {}", label, fault);
  return v / length;
}

}  // namespace umbrix::io::detail
