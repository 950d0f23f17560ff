#include <algorithm>
#include <chrono>
#include <mutex>

#include "core/element/attempt.h"
#include "core/lockfree/thread_epoch.h"
#include "plugins/foxglove/internal/foxglove_session.h"
#include "plugins/foxglove/internal/robot_stop_access.h"
#include "plugins/foxglove/internal/server_messages.h"

namespace runnel::internal {

namespace {

// So much may wait for a client before values are skipped: half a second of a slow network.
constexpr std::size_t kMuchWaiting = 1 << 20;
constexpr std::size_t kLogEntriesAtOnce = 500;
constexpr auto kBetweenStops = std::chrono::seconds(1);

}  // namespace

std::vector<Error> Subscriptions::Add(const SubscribeMessage& message, const DirectoryContent& content) {
  std::vector<Error> errors;
  for (const auto& [id, channel_id] : message.subscriptions) {
    const auto channel = content.channels.find(channel_id);
    if (channel == content.channels.end()) {
      errors.push_back({.message = "subscribe: there is no channel " + std::to_string(channel_id) + " (any more)"});
      continue;
    }
    const bool is_subscribed =
        std::ranges::any_of(by_id_, [&](const auto& each) { return each.second.channel.id == channel->first; });
    if (by_id_.contains(id) || is_subscribed) {
      errors.push_back({.message = is_subscribed ? "subscribe: " + channel->second.topic + " is subscribed to already"
                                                 : "subscribe: the id " + std::to_string(id) + " is in use"});
      continue;
    }
    by_id_[id] = To(channel->second);
    is_any_lost_ = true;
  }
  return errors;
}

Subscriptions::Subscription Subscriptions::To(const DirectoryChannel& channel) {
  return {channel, channel.type == nullptr ? nullptr : std::make_unique<WatchedPort>(channel.port)};
}

std::vector<Error> Subscriptions::Remove(const UnsubscribeMessage& message) {
  std::vector<Error> errors;
  for (const std::uint32_t id : message.ids) {
    if (by_id_.erase(id) > 0) continue;
    errors.push_back({.message = "unsubscribe: there is no subscription " + std::to_string(id)});
  }
  return errors;
}

void Subscriptions::Retain(const DirectoryContent& content) {
  std::erase_if(by_id_, [&](const auto& each) { return !content.channels.contains(each.second.channel.id); });
  for (auto& [id, subscription] : by_id_) {
    const DirectoryChannel& now = content.channels.at(subscription.channel.id);
    if (now.port == subscription.channel.port) continue;
    // The same topic of another port: the robot's pose, for example.
    subscription = To(now);
    is_any_lost_ = true;
  }
}

bool Subscriptions::Sample(SteadyTime now) {
  for (auto& [id, each] : by_id_) {
    if (each.channel.encoding->topic == kStopName) ShowStop(id, each, now);
  }
  if (by_id_.empty() || client_.waiting_bytes() > kMuchWaiting) return true;
  const EpochGuard guard;  // what is found stays in memory so long
  {
    Runtime& runtime = application_.runtime;
    const std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
    if (!lock) return false;
    // What has been found in this structure is still there.
    if (is_any_lost_ || found_at_ != runtime.revision()) {
      is_any_lost_ = false;
      for (auto& [id, each] : by_id_) {
        if (each.port == nullptr) continue;
        each.is_found = each.port->Find(runtime) && &each.port->type() == each.channel.type;
      }
      found_at_ = runtime.revision();
    }
  }
  for (auto each = by_id_.begin(); each != by_id_.end();) {
    const auto subscription = each++;
    if (subscription->second.channel.encoding->topic == "/log") ShowLog(subscription->first, subscription->second);
    if (!subscription->second.is_found || Show(subscription->first, subscription->second)) continue;
    by_id_.erase(subscription);
  }
  return true;
}

// As it is, then each change, and each second; whoever has the structure lock, and however much waits.
void Subscriptions::ShowStop(std::uint32_t id, Subscription& subscription, SteadyTime now) {
  const RobotStop::State state = application_.runtime.robot_stop().state();
  if (subscription.next > state.requests && now < subscription.told_at + kBetweenStops) return;
  std::string bytes;
  AppendMessageHead(id, application_.runtime.clock().Now(), bytes);
  subscription.channel.encoding->append(&state, state.since, bytes);
  if (!client_.SendBinary(std::move(bytes))) return;
  subscription.next = state.requests + 1;
  subscription.told_at = now;
}

// All that is kept, then what comes.
void Subscriptions::ShowLog(std::uint32_t id, Subscription& subscription) {
  const ApplicationLog& log = application_.log;
  std::uint64_t& next = subscription.next;
  const auto read = log.ReadEntries(next, kLogEntriesAtOnce);
  next += read.lost;
  for (const ApplicationLog::Entry& entry : read.entries) {
    const LogMessage message = log.MessageOf(entry);
    std::string bytes;
    AppendMessageHead(id, message.time, bytes);
    subscription.channel.encoding->append(&message, message.time, bytes);
    if (!client_.SendBinary(std::move(bytes))) return;
    ++next;
  }
}

bool Subscriptions::Show(std::uint32_t id, Subscription& subscription) {
  std::string bytes;
  bool is_new = false;
  try {
    is_new = subscription.port
                 ->VisitIfNew([&](const void* value, ValueTimes times) {
                   bytes.clear();
                   AppendMessageHead(id, times.publication_time, bytes);
                   subscription.channel.encoding->append(value, times.timestamp, bytes);
                 })
                 .has_value();
  } catch (...) {
    Error error = CaughtError();
    error.path = subscription.channel.port;
    failures_.push_back(std::move(error));
    return false;
  }
  if (!is_new || client_.SendBinary(std::move(bytes))) return true;
  // Not taken: to be shown again, since it may be the last one for a long time.
  subscription.port = std::make_unique<WatchedPort>(subscription.channel.port);
  subscription.is_found = false;
  is_any_lost_ = true;
  return true;
}

}  // namespace runnel::internal
