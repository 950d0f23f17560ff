#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/element/robot_stop.h"
#include "core/types/type_builder.h"
#include "core/types/type_info.h"

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

struct CallRecordBase;
struct ValueToken;
class Runtime;

/// One call of a service whose types the caller knows by their descriptions only. Destroyed while it is under way, it
/// is given up, and an activity is asked to end.
///
/// Threads: one at a time.
class AnyCall {
 public:
  virtual ~AnyCall() = default;
  /// Of the type Callable::arguments(): to be filled before Begin(). nullptr if there are none.
  [[nodiscard]] virtual void* arguments() = 0;
  /// Those of a call that was recorded, in place of filling them: a value of the type that the service's NAME_calls has.
  virtual void TakeArguments(const CallRecordBase& record) = 0;
  /// Puts it into the service's queue: kPending, or why not. Under the structure lock under which the service was found.
  /// If STOP is pressed or released later than `as_of` and before the service takes it out, it fails, and is not served.
  virtual CallStatus Begin(Time now, Duration timeout, const RobotStop::AsOf& as_of = {}) = 0;
  /// How it is going. Times are the application's.
  virtual CallStatus Poll(Time now) = 0;
  /// Of the type Callable::reply(), once the status is kAnswered. nullptr if there is none.
  [[nodiscard]] virtual const void* reply() const = 0;
  [[nodiscard]] virtual std::string error() const = 0;
  [[nodiscard]] virtual double progress() const = 0;
  [[nodiscard]] virtual const char* doing() const = 0;
  /// Asks an activity to come to its end; the answer is still awaited.
  virtual void Abort() = 0;
};

/// How a service is doing.
struct ServiceState {
  struct Running {
    std::uint64_t number = 0;  ///< of the caller's calls, or the id of the activity
    double progress = 0;       ///< 0 to 1
    std::string doing = {};
    bool is_abort_asked = false;
  };
  std::size_t waiting = 0;
  std::uint64_t answered = 0;
  std::uint64_t failed = 0;           ///< with whatever reason
  std::vector<Running> running = {};  ///< what began first comes first
};

/// "This can be called": the annotation of a port by which terminals, viewers and other protocols find services, say
/// what they take and give, and call them, without knowing their types. Components described in other languages offer
/// their services by one of their own.
///
/// Threads: under the structure lock.
class Callable : public Annotation {
 public:
  /// A structure with a field for each argument, or the only argument itself; nullptr: none.
  [[nodiscard]] virtual const TypeInfo* arguments() const = 0;
  /// nullptr: nothing but that it has been done.
  [[nodiscard]] virtual const TypeInfo* reply() const = 0;
  /// Whether a call may say nothing: NewCall() has filled in all of them.
  [[nodiscard]] virtual bool are_arguments_optional() const { return false; }
  /// Names of arguments that a call has to say, as nothing is right if it does not: see SetArguments().
  [[nodiscard]] virtual std::vector<std::string> required() const { return {}; }
  [[nodiscard]] virtual const std::string& description() const = 0;
  /// Whether calls take long: they report progress, and can be aborted.
  [[nodiscard]] virtual bool is_activity() const = 0;
  [[nodiscard]] virtual std::unique_ptr<AnyCall> NewCall() = 0;
  [[nodiscard]] virtual ServiceState state() const = 0;
  /// Asks the activities that are under way to come to their ends; false: there is none.
  virtual bool Abort() = 0;
};

/// What an output's path calls. Under the structure lock. Errors: no such port, with the nearest; it is no service, with those
/// that are there.
[[nodiscard]] Result<Callable*> FindCallable(Runtime& runtime, const std::string& path);

/// Sets what a text says of a call's arguments. Errors: as of SetFromText(); one that is required is not there.
[[nodiscard]] Result<void> SetArguments(const Callable& callable, std::string_view text, AnyCall& call);
/// The latter alone, of arguments that have come in another form: the tokens of a structure.
[[nodiscard]] Result<void> CheckRequired(const Callable& callable, const ValueToken& said);

}  // namespace runnel
