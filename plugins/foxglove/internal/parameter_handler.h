#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/element/configurable.h"
#include "plugins/foxglove/internal/client_message.h"
#include "plugins/foxglove/internal/directory.h"
#include "plugins/structure/change.h"

namespace runnel::internal {

/// {"name":…,"value":…} as the protocol has it: switches and numbers as such (with the type "float64" for
/// those that are no whole ones), lists as lists ("float64_array", "byte_array"), structures as objects,
/// everything else (texts, names of enumerations, "20ms") as its text. NaN and infinity are null. A value
/// whose type throws is what it has thrown, as a text.
[[nodiscard]] std::string ParameterJson(const std::string& name, const Configurable& parameter);

/// What a client sets, at `path`. What it leaves out of a structure is as it is now. Texts are taken as the
/// text format. Errors: the value is none of the type.
[[nodiscard]] Result<SetParameter> SettingOf(const SetParametersMessage::Item& item, const std::string& path,
                                             const Configurable& parameter);

struct FoxgloveShared;
class SendQueue;

/// What one client asks and is told about parameters.
class ParameterHandler {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// `wake` has the session take a turn, from any thread.
  ParameterHandler(FoxgloveShared& shared, SendQueue& send_queue, std::function<void()> wake)
      : shared_(shared), send_queue_(send_queue), wake_(std::move(wake)) {}

  void Get(const GetParametersMessage& message);
  void Set(const SetParametersMessage& message);
  void Subscribe(const SubscribeParametersMessage& message);

  /// Answers what can be answered now. When it wants to be called again.
  SteadyTime Continue(SteadyTime now);

 private:
  struct PendingSet;  // a request to set, from its coming to its answer

  [[nodiscard]] std::vector<std::string> AllNames() const;
  void SendError(const Error& error);
  /// `may_search`: for the nearest name, which takes time; once in a message.
  [[nodiscard]] Error NoSuchParameter(const std::string& name, bool& may_search) const;
  using Values = std::map<std::string, std::string>;  // as JSON, by name
  /// Of those that exist. Nothing if that cannot be said at the moment.
  [[nodiscard]] std::optional<Values> Read(const std::vector<std::string>& names) const;
  void SendValues(const Values& values, const std::optional<std::string>& id);
  bool AnswerGets();
  bool ContinueSets();
  bool BeginSet(PendingSet& set);
  void SendChanges();

  FoxgloveShared& shared_;
  SendQueue& send_queue_;
  const std::function<void()> wake_;
  std::deque<GetParametersMessage> gets_;
  std::deque<std::shared_ptr<PendingSet>> sets_;
  std::set<std::string> subscribed_;
  Values told_;  // of those that are subscribed to
  SteadyTime look_at_{};
};

}  // namespace runnel::internal
