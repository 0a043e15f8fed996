// SPDX-License-Identifier: Apache-2.0
#include "progress_option.h"

#include "choice_option.h"
#include "openjd_lines.h"

namespace umbrix::app {

void add_progress_option(CLI::App& command, ProgressStyle& style) {
  const auto choose = [&style](ProgressStyle chosen) {
    style = chosen;
    if (chosen == ProgressStyle::openjd) use_openjd_lines();
  };
  add_choice<ProgressStyle>(
      command, "--progress", choose,
      {{"auto", ProgressStyle::automatic},
       {"bar", ProgressStyle::bar},
       {"lines", ProgressStyle::lines},
       {"none", ProgressStyle::none},
       {"openjd", ProgressStyle::openjd}},
      "On stderr; auto: a bar on a terminal, else lines. openjd: on stdout, for Open Job Description's farms [auto]");
}

}  // namespace umbrix::app
