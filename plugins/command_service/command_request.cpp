#include "plugins/command_service/command_request.h"

#include <utility>

namespace runnel {

CommandAnswer CommandAnswer::Done(std::string text) {
  return {.outcome = Outcome::kDone, .text = std::move(text), .diagnostics = {}};
}

CommandAnswer CommandAnswer::Failed(Error error) {
  CommandAnswer answer{.outcome = Outcome::kFailed, .text = {}, .diagnostics = {}};
  answer.diagnostics.Add(std::move(error));
  return answer;
}

CommandAnswer CommandAnswer::Refused(Error error) {
  CommandAnswer answer = Failed(std::move(error));
  answer.outcome = Outcome::kRefused;
  return answer;
}

}  // namespace runnel
