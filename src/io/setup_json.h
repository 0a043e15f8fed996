// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

/// Checked values of a setup file. All throw LoadError, which names the value by `label`.
namespace umbrix::io::detail {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLargestFloat = std::numeric_limits<float>::max();

/// A number from `low` to `high`.
double setup_number(const nlohmann::json& value, double low, double high, const std::string& label);

/// Three numbers, each from `low` up and small enough for a float.
glm::dvec3 setup_vector(const nlohmann::json& value, double low, const std::string& label);

constexpr double radians(double degrees) { return degrees * kPi / 180; }

/// A member that must be there.
const nlohmann::json& setup_member(const nlohmann::json& object, const char* name, const std::string& label);

/// Refuses what is no object, or has other members: a misspelt "intensty" would else be a dark picture.
void refuse_unknown(const nlohmann::json& object, std::initializer_list<const char*> known, const std::string& label);

/// `v` at unit length; `fault` is the message if it has none.
glm::dvec3 setup_direction(const glm::dvec3& v, const std::string& label, const char* fault);

}  // namespace umbrix::io::detail
