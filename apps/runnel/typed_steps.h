#pragma once

#include "plugins/scheduling/pace.h"

namespace runnel::program {

/// Lets a paused application run one cycle for each line of standard input.
class TypedSteps {
 public:
  /// Does not wait for input. Now and then.
  void Look(Pace& pace);

 private:
  bool input_has_ended_ = false;
};

}  // namespace runnel::program
