// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "render_job.h"

namespace umbrix::app {

/// The options that were given and may change pixels, one a line, in the order of the command's definition: all but
/// those that are known not to, so that an option that is added later counts until someone says otherwise.
std::string picture_options(const CLI::App& command);

/// Hashes the bytes of all files that scene and setup are made of. bad_input names a file that is there and cannot be
/// read.
Status hash_inputs(const RenderJob& job, std::string& out);

/// What a job's files have as `umbrix:job`: a hash of its inputs, of Umbrix's version and of all options that change
/// the file's pixels. Not of threads, kernel, paths and progress, nor of which frame and part of it the file holds.
std::string job_hash(const RenderJob& job, const std::string& path);

/// The same for a heat map.
std::string job_hash(const RenderJob& job, const render::HeatMapContent& heat_map);

/// The same for the frame's floats, whatever files they go to.
std::string pixel_hash(const RenderJob& job);

}  // namespace umbrix::app
