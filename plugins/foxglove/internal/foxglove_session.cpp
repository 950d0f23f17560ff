#include "plugins/foxglove/internal/foxglove_session.h"

#include <algorithm>
#include <variant>

#include "core/base/nearest_name.h"
#include "plugins/command_service/request_table.h"
#include "plugins/foxglove/internal/robot_stop_access.h"

namespace runnel::internal {

namespace {

constexpr auto kBetweenSamples = std::chrono::microseconds(16'667);  // 60 Hz
constexpr auto kBetweenTimes = std::chrono::milliseconds(50);
constexpr auto kSoon = std::chrono::milliseconds(5);
constexpr std::size_t kChannelsInMessage = 50;
constexpr std::size_t kMostPublications = 100;
// Of binary messages: what it is, and the channel or service.
constexpr std::size_t kHead = 5;
constexpr char kMessageData = 1, kServiceCall = 2;

WebRole RoleFor(std::string_view request) { return WebRoleNamed(FindRequest(request).value()->role).value(); }

}  // namespace

FoxgloveSession::FoxgloveSession(std::shared_ptr<FoxgloveShared> shared, WebClient& client)
    : shared_(std::move(shared)),
      client_(client),
      send_queue_(client),
      subscriptions_(shared_->application.service.application(), client),
      parameters_(*shared_, send_queue_, client.Waker()),
      calls_(*shared_, send_queue_, client) {
  send_queue_.Send(ServerInfoMessage(*shared_));
}

void FoxgloveSession::SendStatus(StatusLevel level, const Error& error) {
  // A client that makes mistakes and does not listen need not hear of all of them.
  if (!send_queue_.is_long()) send_queue_.Send(StatusMessage(level, error.ToString()));
}

bool FoxgloveSession::MayDo(WebRole needed, std::string_view what) {
  const WebRole role = shared_->RoleOf(client_);
  const auto is_meant = CheckIsMeant();
  if (role >= needed && needed > WebRole::kLook && !is_meant) {
    SendError({.message = std::string(what) + ": " + is_meant.error().message});
    return false;
  }
  if (role >= needed) return true;
  SendError({.message = std::string(what) + ": viewers may only " + std::string(WebRoleName(role)),
             .hint = "it takes a token for the role '" + std::string(WebRoleName(needed)) + "'"});
  return false;
}

Result<void> FoxgloveSession::CheckIsMeant() const {
  const auto arrival = client_.arrival();
  if (!arrival) return {};
  return shared_->runtime().robot_stop().CheckIsKnown({.asked = {}, .requests = arrival->mark});
}

// A release outranks as well: it must neither wait nor be overtaken by a STOP that was pressed later.
WebArrival FoxgloveSession::OnArrival(std::string_view message, bool is_text) {
  WebArrival arrival{.mark = shared_->runtime().robot_stop().requests()};
  if (is_text || message.size() < kHead) return arrival;
  const std::uint32_t id = ReadNumber(message, 1);
  const auto found = message[0] == kMessageData ? publications_.find(id) : publications_.end();
  arrival.outranks = message[0] == kServiceCall ? calls_.Is(kStopName, id) || calls_.Is(kReleaseName, id)
                                                : found != publications_.end() && found->second == nullptr;
  return arrival;
}

void FoxgloveSession::OnTooMany(std::string_view /*message*/, bool /*is_text*/) {
  SendError({.message = "too many messages a second: this one is not carried out"});
}

void FoxgloveSession::OnText(std::string_view message) {
  const auto parsed = ParseClientMessage(message);
  if (!parsed) return SendError(parsed.error());
  if (MayDo(parsed->role, parsed->op)) std::visit([this](const auto& each) { Handle(each); }, parsed->said);
}

void FoxgloveSession::OnBinary(std::string_view message) {
  if (!message.empty() && message[0] == kServiceCall) {
    return calls_.Begin(message, shared_->RoleOf(client_) >= RoleFor("call"), CheckIsMeant());
  }
  if (message.size() < kHead || message[0] != kMessageData) {
    return SendError(
        {.message = "there is no binary message of this kind here",
         .hint = "byte 1: the value of a client's channel, then the channel's id; byte 2: a call of a service"});
  }
  const std::uint32_t id = ReadNumber(message, 1);
  const auto found = publications_.find(id);
  if (found != publications_.end() && found->second == nullptr) {
    (void)SetStop(*shared_, kStopName, message.substr(kHead));
    return;
  }
  if (!MayDo(RoleFor("publish"), "publishing")) return;
  if (found == publications_.end()) {
    return SendError({.message = "channel " + std::to_string(id) + " is not advertised"});
  }
  const auto arrival = client_.arrival();
  const auto received = arrival ? Time(arrival->at.time_since_epoch()) : SteadyClock().Now();
  const auto published = found->second->Publish(message.substr(kHead), received);
  if (!published) SendError(published.error().WithPath(found->second->input().path));
}

void FoxgloveSession::Handle(const SubscribeMessage& message) {
  shared_->directory.Look(shared_->Now());
  const auto content = shared_->directory.content();
  for (const Error& error : subscriptions_.Add(message, *content)) SendError(error);
  sample_at_ = {};
}

void FoxgloveSession::Handle(const UnsubscribeMessage& message) {
  for (const Error& error : subscriptions_.Remove(message)) SendError(error);
}

void FoxgloveSession::Handle(const AdvertiseMessage& message) {
  bool may_search = true;
  for (const AdvertiseMessage::Channel& channel : message.channels) Advertise(channel, may_search);
}

void FoxgloveSession::Advertise(const AdvertiseMessage::Channel& channel, bool& may_search) {
  if (channel.encoding != "json") {
    return SendError({.message = "advertise: values come as 'json' here, not as '" + channel.encoding + "'"});
  }
  if (publications_.contains(channel.id)) {
    return SendError({.message = "advertise: channel " + std::to_string(channel.id) + " is in use"});
  }
  if (publications_.size() >= kMostPublications) {
    return SendError({.message = "advertise: more than " + std::to_string(kMostPublications) + " channels"});
  }
  if (channel.topic == kStopName) {
    publications_[channel.id] = nullptr;
    return;
  }
  if (!MayDo(RoleFor("publish"), "advertise")) return;
  const auto content = shared_->directory.content();
  const auto input = content->inputs.find(channel.topic);
  if (input == content->inputs.end()) {
    Error error{.message = "advertise: '" + channel.topic + "' is no input, or means several"};
    if (std::exchange(may_search, false)) {
      const auto topics = NamesOf(content->inputs, [](const auto& each) { return each.first; });
      error.hint = NearestNameHint(channel.topic, topics);
    }
    return SendError(error);
  }
  publications_[channel.id] = std::make_unique<ClientPublication>(*shared_, input->second, client_.Waker());
}

void FoxgloveSession::Handle(const UnadvertiseMessage& message) {
  for (const std::uint32_t id : message.ids) {
    if (publications_.erase(id) > 0) continue;
    SendError({.message = "unadvertise: channel " + std::to_string(id) + " is not advertised"});
  }
}

void FoxgloveSession::Handle(const SubscribeGraphMessage& message) {
  has_graph_ = message.is_wanted;
  graph_.clear();
  if (!has_graph_) return;
  graph_ = shared_->directory.content()->graph;
  send_queue_.Send(GraphMessage({}, graph_));
}

FoxgloveSession::SteadyTime FoxgloveSession::OnPoll() {
  const auto now = shared_->Now();
  const SteadyTime look_at = shared_->directory.Look(now);
  if (!send_queue_.Continue()) return now + kSoon;
  FollowStructure();
  const bool is_publishing = ContinuePublications();
  SteadyTime next = std::min(look_at, parameters_.Continue(now));
  next = std::min(next, calls_.Continue(now));
  SendTime(now);
  if (now >= sample_at_) sample_at_ = now + (subscriptions_.Sample(now) ? kBetweenSamples : kSoon);
  for (const Error& error : subscriptions_.TakeFailures()) SendError(error);
  if (!subscriptions_.is_empty()) next = std::min(next, sample_at_);
  if (is_publishing || !send_queue_.is_empty()) next = std::min<SteadyTime>(next, now + kSoon);
  return std::min(next, time_at_);
}

void FoxgloveSession::FollowStructure() {
  const auto content = shared_->directory.content();
  if (content != content_) {
    content_ = content;
    std::vector<std::uint32_t> gone;
    for (const std::uint32_t id : advertised_) {
      if (!content->channels.contains(id)) gone.push_back(id);
    }
    for (const std::uint32_t id : gone) advertised_.erase(id);
    subscriptions_.Retain(*content);
    if (!gone.empty()) send_queue_.Send(UnadvertiseMessageFor("unadvertise", "channelIds", gone));
    DropPublications(*content);
    calls_.Follow(*content, shared_->RoleOf(client_) >= RoleFor("call"));
    if (has_graph_ && content->graph != graph_) {
      send_queue_.Send(GraphMessage(graph_, content->graph));
      graph_ = content->graph;
    }
  }
  AdvertiseNew();
}

// In pieces, since there may be thousands.
void FoxgloveSession::AdvertiseNew() {
  auto channel = content_->channels.begin();
  while (advertised_.size() < content_->channels.size() && send_queue_.is_empty()) {
    std::vector<const DirectoryChannel*> fresh;
    for (; channel != content_->channels.end() && fresh.size() < kChannelsInMessage; ++channel) {
      if (advertised_.insert(channel->first).second) fresh.push_back(&channel->second);
    }
    send_queue_.Send(AdvertiseMessageFor(fresh));
  }
}

void FoxgloveSession::DropPublications(const DirectoryContent& content) {
  std::erase_if(publications_, [&](const auto& each) {
    const auto& [id, publication] = each;
    if (publication == nullptr) return false;
    const DirectoryInput& before = publication->input();
    const auto input = content.inputs.find(before.path);
    const bool is_there = input != content.inputs.end() && input->second.type == before.type;
    if (is_there && input->second == before) return false;
    SendStatus(StatusLevel::kWarning,
               {.message = "channel " + std::to_string(id) +
                           (is_there ? " is closed: whether something moves by its input has changed; advertise it anew"
                                     : " is closed: its input is gone"),
                .path = before.path});
    return true;
  });
}

// Whether outputs are still being made.
bool FoxgloveSession::ContinuePublications() {
  bool is_any_making = false;
  std::erase_if(publications_, [&](const auto& each) {
    if (each.second == nullptr) return false;  // of the STOP
    if (each.second->Continue()) is_any_making = true;
    const auto error = each.second->TakeError();
    if (error) SendError(*error);
    return error.has_value() && !each.second->is_made();
  });
  return is_any_making;
}

void FoxgloveSession::SendTime(SteadyTime now) {
  if (now < time_at_) return;
  time_at_ = now + kBetweenTimes;
  const Time time = shared_->runtime().clock().Now();
  if (time == time_) return;
  if (client_.SendBinary(TimeMessage(time))) time_ = time;
}

}  // namespace runnel::internal
