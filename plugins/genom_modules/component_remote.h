#pragma once

#include "plugins/genom_execution/codel_context.h"
#include "plugins/services/client.h"

namespace runnel::genom_modules {

/// A remote's `call()`: waits for the answer, which is why codels with remotes are run as asynchronous ones. Returns what
/// the codel is to return if there was none: an exception whose text says why.
template <typename Reply, typename... Arguments, typename Take>
genom_execution::Event CallRemote(Client<Reply(Arguments...)>& client, Take take,
                                  const std::remove_cvref_t<Arguments>&... arguments) {
  auto future = client.Begin(arguments...);
  const auto outcome = future.Wait();
  if (!outcome) return genom_execution::kMiddlewareError;
  if constexpr (std::is_void_v<Reply>) {
    take();
  } else {
    take(*outcome);
  }
  return nullptr;
}

}  // namespace runnel::genom_modules
