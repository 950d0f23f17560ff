#pragma once

#include <algorithm>
#include <chrono>
#include <string_view>

#include "plugins/genom_execution/component_table.h"
#include "plugins/services/client.h"

namespace runnel::genom_modules {

/// As long as an activity takes; what is gone is told at once.
inline constexpr Duration kAsLongAsItTakes = std::chrono::hours(24 * 365);

/// A remote's `call()`: waits for the answer, which is why codels with remotes are run as asynchronous ones. `take` gets
/// the reply. If there is none, returns what the codel is to return: what `raise(context, NAME, DETAIL)` makes of the
/// exception that the service has answered with, nullptr being that it knows none of that name; else an mwerr that says why.
template <typename Reply, typename... Arguments, typename Take, typename Raise>
genom_execution::Event CallRemote(const genom_execution::CodelContext& context, Client<Reply(Arguments...)>& client,
                                  Raise raise, Take take, const std::remove_cvref_t<Arguments>&... arguments) {
  auto future = client.Begin(arguments...);
  const auto outcome = future.Wait();
  if (!outcome) {
    const std::string_view error = outcome.error();
    const std::size_t end = std::min(error.find(' '), error.size());
    genom_execution::Event raised = nullptr;
    if (outcome.status() == CallStatus::kFailed) {
      raised = raise(context, error.substr(0, end), error.substr(std::min(end + 1, error.size())));
    }
    return raised != nullptr ? raised : genom_execution::RaiseMiddlewareError(context, error);
  }
  if constexpr (std::is_void_v<Reply>) {
    take();
  } else {
    take(*outcome);
  }
  return nullptr;
}

}  // namespace runnel::genom_modules
