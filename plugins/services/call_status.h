#pragma once

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

/// "answered", "timed_out", …
[[nodiscard]] inline const char* CallStatusName(CallStatus status) noexcept {
  switch (status) {
    case CallStatus::kPending: return "pending";
    case CallStatus::kAnswered: return "answered";
    case CallStatus::kFailed: return "failed";
    case CallStatus::kAborted: return "aborted";
    case CallStatus::kTimedOut: return "timed_out";
    case CallStatus::kNotConnected: return "not_connected";
    case CallStatus::kBusy: return "busy";
    case CallStatus::kDisconnected: return "disconnected";
    case CallStatus::kFaulted: return "faulted";
  }
  return "";
}

inline void Describe(TypeBuilder<CallStatus>& type) {
  type.Name("call_status");
  for (int i = 0; i <= static_cast<int>(CallStatus::kFaulted); ++i) {
    const auto status = static_cast<CallStatus>(i);
    type.Value(CallStatusName(status), status);
  }
}

}  // namespace runnel
