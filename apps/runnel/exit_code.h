#pragma once

namespace runnel::program {

/// What the program tells whoever called it.
enum class ExitCode : int {
  kDone = 0,
  kRunFailed = 1,  ///< the application ran, and did not come to a good end
  kBadInput = 2,   ///< application file, arguments, configuration, plugins
};

}  // namespace runnel::program
