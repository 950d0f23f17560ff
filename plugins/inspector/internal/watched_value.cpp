#include <chrono>
#include <mutex>
#include <utility>
#include <vector>

#include "core/element/attempt.h"
#include "core/lockfree/thread_epoch.h"
#include "core/types/type_info.h"
#include "plugins/inspector/internal/viewer_session.h"
#include "plugins/services/callable.h"
#include "plugins/values/json_values.h"
#include "plugins/values/json_writer.h"
#include "plugins/values/value_bytes.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kLongestText = 2'000;
constexpr std::size_t kLargestValue = 4'000'000;  // bytes
constexpr std::size_t kLargestImage = 16'000'000;

}  // namespace

void ViewerSession::SendValues(SteadyTime now) {
  std::vector<Watch*> due;
  for (auto& [path, watch] : watches_) {
    if (now >= watch.due) due.push_back(&watch);
  }
  if (due.empty()) return;
  // What is found under the lock stays in memory while the guard is held; so the lock need not be.
  const EpochGuard guard;
  std::vector<Watch*> found;
  {
    const std::unique_lock lock(inspection_.application().runtime.structure_mutex(), std::try_to_lock);
    if (!lock) {
      for (Watch* watch : due) watch->due = now + std::chrono::milliseconds(5);
      return;
    }
    for (Watch* watch : due) {
      watch->due = std::max(watch->due + watch->interval, now + watch->interval / 2);
      // One that has been deleted may come back.
      if (!watch->port.Find(inspection_.application().runtime)) continue;
      NoteService(*watch);
      found.push_back(watch);
    }
  }
  if (IsSlow()) return;
  std::string items;
  for (Watch* watch : found) {
    std::string item = "{\"path\":";
    AppendJsonString(watch->port.path(), item);
    std::optional<std::uint64_t> count;
    try {
      count = LookAt(*watch, item);
    } catch (...) {  // of a type that throws when it is written
      Error error = CaughtError();
      const std::string path = watch->port.path();
      error.path = path;
      Refuse({}, std::move(error));
      watches_.erase(path);
      continue;  // the watch is gone
    }
    if (!count && watch->is_service_told) continue;
    if (!std::exchange(watch->is_service_told, true)) item += ",\"service\":" + watch->service;
    const std::uint64_t dropped = watch->port.dropped();
    if (dropped > 0) item += ",\"drops\":" + std::to_string(dropped);
    items += (items.empty() ? "" : ",") + item + (count ? ",\"count\":" + std::to_string(*count) : "") + "}";
  }
  if (items.empty()) return;
  std::string text = "{\"op\":\"values\",\"time\":";
  AppendJsonNumber(ToSeconds(inspection_.running_for()), text);
  client_.SendText(text + ",\"items\":[" + items + "]}");
}

std::optional<std::uint64_t> ViewerSession::LookAt(Watch& watch, std::string& item) const {
  const std::size_t begin = item.size();
  return watch.port.VisitIfNew([&](const void* value, ValueTimes times) {
    item.resize(begin);  // the look before was at a value that another one replaced meanwhile
    item += ",\"stamp\":";
    AppendJsonNumber(ToSeconds(times.publication_time - inspection_.start()), item);
    if (times.timestamp != times.publication_time) {
      item += ",\"measured\":";
      AppendJsonNumber(ToSeconds(times.timestamp - inspection_.start()), item);
    }
    item += ",\"value\":";
    if (!AppendValue(watch, value, times.timestamp, item)) item += ",\"cut\":true";
    item += ",\"bytes\":" + std::to_string(BytesOf(watch.port.type(), value));
  });
}

void ViewerSession::NoteService(Watch& watch) {
  const auto* const callable = watch.port.port().FindAnnotation<Callable>();
  if (callable == nullptr) return;
  const ServiceState state = callable->state();
  std::string text = JsonObjectText([&](JsonObject& json) {
    json.Add("waiting", state.waiting).Add("answered", state.answered).Add("failed", state.failed);
    JsonArray running(json.Key("running"));
    for (const auto& each : state.running) {
      JsonObject(running.Next())
          .Add("number", each.number)
          .Add("progress", each.progress)
          .Add("doing", each.doing)
          .Add("abort", each.is_abort_asked);
    }
  });
  if (text == watch.service) return;
  watch.service = std::move(text);
  watch.is_service_told = false;
}

bool ViewerSession::AppendValue(Watch& watch, const void* value, Time time, std::string& json) {
  const TypeInfo& type = watch.port.type();
  if (watch.wants_image && type.semantic_tag() == "image") {
    if (watch.pictured != &type) {
      std::vector<FoxgloveChannel> channels = ChannelsFor(type, watch.port.path());
      watch.picture.reset();
      if (channels.size() > 1) watch.picture = std::move(channels.back());
      watch.pictured = &type;
    }
    if (watch.picture && BytesOf(type, value) <= kLargestImage) {
      watch.picture->append(value, time, json);
      return true;
    }
  }
  return AppendJson(type, value, json, {watch.elements, kLongestText, kLargestValue});
}

}  // namespace runnel::internal
