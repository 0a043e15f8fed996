// SPDX-License-Identifier: Apache-2.0
// The camera of a setup file (docs/setup.md). Between keyframes each number goes its own way, straight or along a
// Catmull-Rom spline: Hermite's cubic whose slope at a key is that from the key before to the key after, so that its
// first derivative is continuous also where keys are not evenly spaced.

#include "io/setup_camera.h"

#include <algorithm>

#include "io/camera_motion.h"
#include "io/key_track.h"
#include "io/load_error.h"
#include "io/setup_json.h"

namespace umbrix::io::detail {
namespace {

using nlohmann::json;

constexpr double kLeastFov = 0.001, kMostFov = 179.999;

// What a camera is made of, as numbers that can be blended.
struct View {
  glm::dvec3 eye = glm::dvec3(0), target = glm::dvec3(0), up = glm::dvec3(0, 1, 0);
  double fov_y_degrees = 45;
};

View operator+(const View& a, const View& b) {
  return {a.eye + b.eye, a.target + b.target, a.up + b.up, a.fov_y_degrees + b.fov_y_degrees};
}
View operator*(const View& a, double s) { return {a.eye * s, a.target * s, a.up * s, a.fov_y_degrees * s}; }

void aim(const View& view, const std::string& label, Camera& camera) {
  if (!(view.fov_y_degrees >= kLeastFov && view.fov_y_degrees <= kMostFov)) {
    bad_input("{}.fov_y_degrees: {} is not from {} to {}", label, view.fov_y_degrees, kLeastFov, kMostFov);
  }
  const glm::dvec3 z = setup_direction(view.eye - view.target, label, "eye and target are the same point");
  const glm::dvec3 x = setup_direction(glm::cross(view.up, z), label, "'up' is zero or points along the view");
  const glm::dvec3 y = glm::cross(z, x);
  camera.yfov = radians(view.fov_y_degrees);
  for (int r = 0; r < 3; ++r) camera.to_world[static_cast<std::size_t>(r)] = {x[r], y[r], z[r], view.eye[r]};
}

// What `object` says; of the rest, `before`.
View read_view(const json& object, const View& before, const std::string& label) {
  View view = before;
  for (const auto& [name, vector] : {std::pair("eye", &view.eye), {"target", &view.target}, {"up", &view.up}}) {
    if (object.contains(name)) *vector = setup_vector(object.at(name), -kLargestFloat, label + "." + name);
  }
  if (object.contains("fov_y_degrees")) {
    view.fov_y_degrees = setup_number(object.at("fov_y_degrees"), kLeastFov, kMostFov, label + ".fov_y_degrees");
  }
  return view;
}

View read_whole_view(const json& object, const std::string& label) {
  setup_member(object, "eye", label);
  setup_member(object, "target", label);
  return read_view(object, View(), label);
}

class SetupMotion final : public CameraMotion {
 public:
  SetupMotion(std::vector<double> frames, std::vector<View> views, bool smooth)
      : frames_(std::move(frames)), views_(std::move(views)), smooth_(smooth) {}

  void move(const Moment& moment, Camera& camera) const override {
    aim(view_at(moment.frame), "camera between keyframes", camera);
  }

  std::array<double, 2> span() const override { return {frames_.front(), frames_.back()}; }

 private:
  View view_at(double frame) const {
    const KeyPlace place = find_place(frames_, frame);
    const std::size_t key = place.key;
    if (place.u == 0) return views_[key];
    if (!smooth_) return views_[key] * (1 - place.u) + views_[key + 1] * place.u;
    return hermite(views_[key], slope(key), views_[key + 1], slope(key + 1), place.u, place.span);
  }

  View slope(std::size_t key) const {
    const std::size_t before = key > 0 ? key - 1 : 0, after = std::min(key + 1, views_.size() - 1);
    return (views_[after] + views_[before] * -1) * (1 / (frames_[after] - frames_[before]));
  }

  std::vector<double> frames_;
  std::vector<View> views_;
  bool smooth_;
};

bool read_smooth(const json& object) {
  if (!object.contains("interpolation")) return false;
  const json& value = object.at("interpolation");
  if (value == "smooth") return true;
  if (value == "linear") return false;
  bad_input("camera.interpolation: is neither \"linear\" nor \"smooth\"");
}

Camera read_moving_camera(const json& object) {
  refuse_unknown(object, {"keyframes", "interpolation"}, "camera");
  const json& keys = object.at("keyframes");
  if (!keys.is_array() || keys.empty()) bad_input("camera.keyframes: must be an array of at least one key");
  std::vector<double> frames;
  std::vector<View> views;
  Camera camera;
  for (const json& key : keys) {
    const std::string label = fmt::format("camera.keyframes[{}]", frames.size());
    refuse_unknown(key, {"frame", "eye", "target", "up", "fov_y_degrees"}, label);
    const double frame =
        setup_number(setup_member(key, "frame", label), -kLargestFloat, kLargestFloat, label + ".frame");
    if (!frames.empty() && !(frame > frames.back())) {
      bad_input("{}.frame: {} is not above the one before, {}", label, frame, frames.back());
    }
    const View view = views.empty() ? read_whole_view(key, label) : read_view(key, views.back(), label);
    Camera at_key;
    aim(view, label, at_key);
    if (views.empty()) camera = at_key;
    frames.push_back(frame);
    views.push_back(view);
  }
  camera.motion = std::make_shared<SetupMotion>(std::move(frames), std::move(views), read_smooth(object));
  return camera;
}

Camera read_still_camera(const json& object) {
  refuse_unknown(object, {"eye", "target", "up", "fov_y_degrees"}, "camera");
  Camera camera;
  aim(read_whole_view(object, "camera"), "camera", camera);
  return camera;
}

}  // namespace

Camera read_setup_camera(const json& object) {
  Camera camera = object.contains("keyframes") ? read_moving_camera(object) : read_still_camera(object);
  camera.name = "setup";
  return camera;
}

}  // namespace umbrix::io::detail
