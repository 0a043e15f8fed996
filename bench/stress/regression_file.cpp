// SPDX-License-Identifier: Apache-2.0
#include "stress/regression_file.h"

#include <filesystem>

#include "umbrix/io/image_file.h"

namespace umbrix::bench {

Status append_regressions(const std::string& path, const std::vector<judge::Regression>& regressions,
                          std::size_t* added) {
  std::string text;
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    if (Status status = judge::read_file(path, text); !status) return status;
  }
  *added = 0;
  for (const judge::Regression& regression : regressions) {
    // The same triangles and ray under another name are the same.
    const std::string entry = judge::to_text(regression);
    const std::string data = entry.substr(entry.find('\n') + 1);
    if (text.find(data) != std::string::npos) continue;
    if (!text.empty() && text.back() != '\n') text += '\n';
    text += "\n" + entry;
    ++*added;
  }
  return *added == 0 ? Status() : io::write_text(path, text, true);
}

}  // namespace umbrix::bench
