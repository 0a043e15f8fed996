// SPDX-License-Identifier: Apache-2.0
#include <umbrix/io/image_file.h>
#include <umbrix/io/scene_file.h>

#include <cstdio>

// Loads a scene and writes a picture of one pixel: both need the libraries behind umbrix::io.
int main(int, char** arguments) {
  umbrix::io::SceneFile scene;
  umbrix::Status status = umbrix::io::load_scene(arguments[1], scene);
  umbrix::io::Image image;
  image.width = image.height = 1;
  image.channels = {"R", "G", "B"};
  image.pixels = {1, 1, 1};
  umbrix::io::WriteOptions options;
  options.overwrite = true;
  if (status.ok()) status = umbrix::io::write_image(arguments[2], image, options);
  std::printf("meshes: %d %s\n", scene.meshes.empty() ? 0 : 1, status.message().c_str());
  return status.ok() ? 0 : 1;
}
