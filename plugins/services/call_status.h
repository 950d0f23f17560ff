#pragma once

#include <array>
#include <cstddef>

#include "core/types/type_builder.h"

namespace runnel {

/// How a call ended, or that it has not.
enum class CallStatus {
  kPending,       ///< waits for its turn, or is being served
  kAnswered,      ///< there is a reply
  kFailed,        ///< the service has said an error, or thrown
  kAborted,       ///< the caller has asked for it, and the service has ended
  kTimedOut,      ///< the caller's time-out has passed, on the application's clock
  kNotConnected,  ///< there was no service at the other end; nothing has been called
  kBusy,          ///< as many calls as client or service have room for are under way; nothing has been called
  kDisconnected,  ///< the service has been deleted, or is no longer connected
  kFaulted,       ///< the module that serves has failed
};

/// By CallStatus.
inline constexpr std::array kCallStatusNames{"pending",       "answered", "failed",       "aborted", "timed_out",
                                             "not_connected", "busy",     "disconnected", "faulted"};
static_assert(kCallStatusNames.size() == static_cast<std::size_t>(CallStatus::kFaulted) + 1);

/// "answered", "timed_out", …
[[nodiscard]] inline const char* CallStatusName(CallStatus status) noexcept {
  return kCallStatusNames[static_cast<std::size_t>(status)];
}

inline void Describe(TypeBuilder<CallStatus>& type) {
  type.Name("call_status");
  for (std::size_t i = 0; i < kCallStatusNames.size(); ++i) type.Value(kCallStatusNames[i], static_cast<CallStatus>(i));
}

}  // namespace runnel
