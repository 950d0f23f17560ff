#include "apps/runnel/typed_steps.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <poll.h>
#include <unistd.h>

namespace runnel::program {

void TypedSteps::Look(Pace& pace) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (input_has_ended_ || poll(&input, 1, 0) <= 0) return;
  std::array<char, 256> typed;
  const ssize_t count = read(STDIN_FILENO, typed.data(), typed.size());
  input_has_ended_ = count <= 0;
  if (count <= 0) return;
  const auto lines = std::count(typed.data(), typed.data() + count, '\n');
  if (lines > 0) (void)pace.StepCycles(static_cast<std::uint64_t>(lines));
}

}  // namespace runnel::program
