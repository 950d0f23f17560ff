#pragma once

#include <string>
#include <vector>

#include "apps/runnel/command_line.h"
#include "plugins/control/control_client.h"

namespace runnel::program {

/// Which of several running applications a command is for that does not say it by --app: its name or process; "" if nothing
/// tells.
///
/// "/robot/laser" is of the application robot, and so is "//robot/laser", which becomes the former, if it runs here; else it is
/// for one that sees robot in the network, or at least has a network. What comes of "//robot/laser" by a connection is for the
/// other one, if there is only one other. Looks at what others say of the network; waits for them.
[[nodiscard]] std::string ApplicationByWords(const std::vector<RunningApplication>& running,
                                             ControlArguments& arguments);

/// All of an answer at once.
struct Answer {
  int code = 0;
  std::string output = {}, errors = {};
};
[[nodiscard]] Result<Answer> AskForAll(ControlClient& client, const std::string& request);

/// The file that is meant by `word`: of an application that comes with Runnel, its name is enough (`bug_demo`). Files
/// that are there come first; a word that means neither is what it was.
[[nodiscard]] std::string ApplicationFile(const std::string& word);

}  // namespace runnel::program
