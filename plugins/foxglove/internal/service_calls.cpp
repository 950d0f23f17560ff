#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>
#include <vector>

#include "core/element/attempt.h"
#include "core/element/runtime.h"
#include "plugins/foxglove/internal/client_message.h"
#include "plugins/foxglove/internal/foxglove_session.h"
#include "plugins/foxglove/internal/foxglove_shared.h"
#include "plugins/foxglove/internal/robot_stop_access.h"
#include "plugins/foxglove/internal/server_messages.h"
#include "plugins/values/foxglove_channel.h"
#include "plugins/values/json_reader.h"

namespace runnel::internal {

namespace {

constexpr Duration kCallTimeout = std::chrono::minutes(10);  // of what people wait for; they may close the viewer
constexpr auto kLookAtCalls = std::chrono::milliseconds(5);
constexpr std::size_t kMostCalls = 100;

}  // namespace

void ServiceCalls::Follow(const DirectoryContent& content, bool may_call) {
  std::vector<std::uint32_t> gone;
  std::vector<const DirectoryService*> fresh;
  for (const auto& [id, path] : advertised_) {
    if (!content.services.contains(id)) gone.push_back(id);
  }
  for (const std::uint32_t id : gone) advertised_.erase(id);
  for (const auto& [id, service] : content.services) {
    if (!may_call && service.path != kStopName) continue;
    if (advertised_.try_emplace(id, service.path).second) fresh.push_back(&service);
  }
  if (!gone.empty()) send_queue_.Send(UnadvertiseMessageFor("unadvertiseServices", "serviceIds", gone));
  if (!fresh.empty()) send_queue_.Send(AdvertiseServicesMessage(fresh));
}

bool ServiceCalls::Is(std::string_view name, std::uint32_t service) const {
  const auto found = advertised_.find(service);
  return found != advertised_.end() && found->second == name;
}

void ServiceCalls::Begin(std::string_view message, bool may_call, const Result<void>& is_meant) {
  const auto call = ReadServiceCall(message);
  if (!call) return send_queue_.Send(StatusMessage(StatusLevel::kError, call.error().ToString()));
  Pending pending{.service = call->service, .call = call->call, .path = {}, .json = call->payload, .begun = {}};
  const auto found = advertised_.find(call->service);
  if (Is(kStopName, call->service) || (may_call && is_meant && Is(kReleaseName, call->service))) {
    const std::string reply = SetStop(shared_, found->second, call->payload);
    if (!client_.SendBinary(ServiceReplyMessage(call->service, call->call, reply))) {
      Fail(pending, {.message = "done, but the reply was lost, as too much waits for this viewer"});
    }
    return;
  }
  if (!may_call) return Fail(pending, {.message = "calling takes a token for the role 'drive'"});
  if (!is_meant) return Fail(pending, is_meant.error());
  if (found == advertised_.end()) return Fail(pending, {.message = "there is no such service any more"});
  if (call->encoding != "json") {
    return Fail(pending, {.message = "arguments come as 'json' here, not as '" + call->encoding + "'"});
  }
  if (pending_.size() >= kMostCalls) return Fail(pending, {.message = "too many calls are under way"});
  pending.path = found->second;
  pending.as_of = shared_.runtime().robot_stop().AsOfNow();
  pending_.push_back(std::move(pending));
}

void ServiceCalls::Fail(const Pending& pending, const Error& error) {
  send_queue_.Send(ServiceFailureMessage(pending.service, pending.call, error.ToString()));
}

ServiceCalls::SteadyTime ServiceCalls::Continue(SteadyTime now) {
  std::erase_if(pending_, [this](Pending& each) { return !ContinueOne(each); });
  return pending_.empty() ? SteadyTime::max() : now + kLookAtCalls;
}

bool ServiceCalls::ContinueOne(Pending& pending) {
  try {
    if (!pending.begun && !TryBegin(pending)) return true;
    const CallStatus status = pending.begun->Poll(shared_.runtime().clock().Now());
    if (status == CallStatus::kPending) return true;
    if (status == CallStatus::kAnswered) {
      SendReply(pending);
    } else {
      const std::string why = pending.begun->error();
      Fail(pending, {.message = why.empty() ? CallStatusName(status) : why, .path = pending.path});
    }
  } catch (...) {  // of TryBegin(), or of a type that throws when it is read or shown
    Fail(pending, CaughtError());
  }
  return false;
}

// False: the structure is locked at the moment. Throws ElementError.
bool ServiceCalls::TryBegin(Pending& pending) {
  Runtime& runtime = shared_.runtime();
  const std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
  if (!lock) return false;
  const auto found = FindCallable(runtime, pending.path);
  if (!found) throw ElementError(found.error());
  Callable* const callable = *found;
  auto call = callable->NewCall();
  if (const TypeInfo* const type = callable->arguments()) {
    auto set = SetFromMessage(*type, pending.json, call->arguments());
    if (set) set = CheckRequired(*callable, JsonPart::Parse(pending.json)->token());
    if (!set) throw ElementError(set.error().WithPath(pending.path));
  }
  pending.reply = callable->reply();
  (void)call->Begin(runtime.clock().Now(), kCallTimeout, pending.as_of);
  pending.begun = std::move(call);
  return true;
}

void ServiceCalls::SendReply(const Pending& pending) {
  std::string json = "{}";
  if (pending.reply != nullptr) {
    const auto forms = ChannelsFor(*pending.reply, "");
    json.clear();
    if (!forms.empty()) forms.front().append(pending.begun->reply(), Time(), json);
  }
  if (!client_.SendBinary(ServiceReplyMessage(pending.service, pending.call, json))) {
    Fail(pending, {.message = "the reply was lost, as too much waits for this viewer"});
  }
}

}  // namespace runnel::internal
