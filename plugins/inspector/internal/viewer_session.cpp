#include "plugins/inspector/internal/viewer_session.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/log/log_level.h"
#include "core/types/type_info.h"
#include "plugins/command_service/extension_texts.h"
#include "plugins/command_service/request_table.h"
#include "plugins/structure/change_history.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

using std::chrono::milliseconds;

constexpr std::size_t kMostWatches = 500;
constexpr std::size_t kMostPending = 64;
constexpr std::size_t kMostReplies = 1000;
constexpr std::size_t kMostBytes = 8 << 20;  // of replies, if it is more than one
constexpr std::size_t kMostLogEntries = 500;
// A viewer for which more is waiting gets no values, rates and states until it has taken it.
constexpr std::size_t kSlow = 1 << 20;
constexpr auto kState = milliseconds(100);
constexpr auto kAlive = milliseconds(1000);
constexpr auto kTimeAlone = milliseconds(200);
constexpr auto kNetwork = milliseconds(500);
constexpr double kFastestWatch = 60;
constexpr double kFastestRates = 10;
constexpr std::size_t kMostElements = 1'000'000;
constexpr double kFastestImages = 15;

Duration IntervalOf(double rate) { return FromSeconds(1 / rate); }

}  // namespace

ViewerSession::ViewerSession(Inspection& inspection, WebClient& client)
    : inspection_(inspection),
      client_(client),
      name_("viewer " + std::to_string(inspection.NumberViewer())),
      is_for_stop_(client.protocol() == kStopProtocol),
      pressed_(inspection.application().runtime.robot_stop().signal()->Listen(client.Waker())) {
  if (!is_for_stop_) SendHello();
}

bool ViewerSession::IsSlow() const { return client_.waiting_bytes() > kSlow; }

void ViewerSession::SendHello() {
  const InspectorOptions& options = inspection_.options();
  const bool is_simulated = inspection_.scheduler().pace().is_simulated();
  client_.SendText(JsonObjectText([&](JsonObject& json) {
    json.Add("op", "hello").Add("protocol", 1);
    json.Add("application", options.application).Add("file", options.file);
    json.Add("run", inspection_.run()).Add("clock", is_simulated ? "simulated" : "real");
    json.Add("viewer", name_).Add("read_only", role() == WebRole::kLook);
    json.Add("role", WebRoleName(role())).Add("runnel", options.version);
  }));
}

WebSession::SteadyTime ViewerSession::SendAlive() {
  const SteadyTime now = std::chrono::steady_clock::now();
  const auto stop = inspection_.application().runtime.robot_stop().state();
  if (now < alive_due_ && told_stop_ == stop.requests) return alive_due_;
  const bool is_sent = client_.SendText(JsonObjectText([&](JsonObject& json) {
    // Who hears of a STOP asks for everything later than it was pressed.
    const Duration at = std::max<Duration>(now.time_since_epoch(), stop.requested.time_since_epoch());
    JsonObject told(json.Add("op", "alive").Add("at", ToSeconds(at)).Key("stop"));
    told.Add("in_force", stop.in_force).Add("by", stop.by);
    told.Add("since", ToSeconds(stop.since - inspection_.start()));
    const auto& reach = inspection_.stop_reach();
    if (!reach) return;
    AppendList(reach->unreached, told.Key("unreached"), [](const auto& each, std::string& to) {
      JsonObject(to).Add("path", each.first).Add("why", each.second);
    });
    if (!stop.in_force) return;
    told.Add("drives", reach->drives);
    told.Add("braking", inspection_.application().runtime.clock().Now() < stop.since + reach->brake);
  }));
  if (is_sent) told_stop_ = stop.requests;
  // Pages answer it, by which operators are heard as of now.
  const Duration silence = inspection_.service().operators().timeout();
  return alive_due_ = now + (silence > Duration() ? std::min<Duration>(kAlive, silence / 4) : kAlive);
}

WebSession::SteadyTime ViewerSession::OnPoll() {
  SteadyTime next = SendAlive();
  SendReplies();
  if (is_for_stop_) return next;
  next = std::min(next, inspection_.Look());
  SendStructure();
  SendArrangement();
  SendLog();
  const SteadyTime now = std::chrono::steady_clock::now();
  if (now >= state_due_) SendState(now);
  next = std::min(next, state_due_);
  if (now >= network_due_) SendNetwork(now);
  next = std::min(next, network_due_);
  if (!watches_.empty()) {
    SendValues(now);
    for (const auto& [path, watch] : watches_) next = std::min(next, watch.due);
  }
  if (rates_interval_ > Duration{}) {
    if (now >= rates_due_) SendRates(now);
    next = std::min(next, rates_due_);
  }
  return next;
}

void ViewerSession::SendStructure() {
  if (IsSlow()) return;
  const auto catalogue = inspection_.catalogue();
  if (catalogue != nullptr && catalogue != catalogue_) {
    if (client_.SendText(catalogue->message)) catalogue_ = catalogue;
  }
  if (catalogue_ == nullptr) return;
  const StructureMirror& mirror = inspection_.mirror();
  while (structure_ < mirror.revision() && !IsSlow()) {
    const std::string* const change = structure_ > 0 ? mirror.ChangeTo(structure_ + 1) : nullptr;
    if (change == nullptr) {
      if (client_.SendText(mirror.Whole())) structure_ = mirror.revision();
      return;
    }
    if (!client_.SendText(*change)) return;
    ++structure_;
  }
}

void ViewerSession::SendArrangement() {
  const Arrangement& arrangement = inspection_.arrangement();
  if (structure_ == 0 || arrangement_ >= arrangement.revision() || IsSlow()) return;
  if (client_.SendText(arrangement.MessageSince(arrangement_))) arrangement_ = arrangement.revision();
}

void ViewerSession::SendState(SteadyTime now) {
  state_due_ = now + kState;
  if (IsSlow()) return;
  const Pace& pace = inspection_.scheduler().pace();
  const Duration time = inspection_.running_for();
  const auto verdict = inspection_.verdict();
  std::string state = JsonObjectText([&](JsonObject& json) {
    json.Add("paused", pace.is_paused());
    json.AddOrNull("speed", pace.is_simulated() ? std::optional(pace.speed()) : std::nullopt);
    const ChangeHistory* const history = inspection_.application().history;
    json.AddTextOrNull("undo", history != nullptr ? history->NextUndo().value_or("") : "");
    json.AddTextOrNull("redo", history != nullptr ? history->NextRedo().value_or("") : "");
    if (history != nullptr) {
      json.AddTextOrNull("undo_client", history->UndoClient());
      json.AddTextOrNull("redo_client", history->RedoClient());
    }
    json.Add("faults", inspection_.application().log.faults());
    {
      JsonObject levels(json.Key("log_levels"));
      for (const auto& [path, level] : ReadLogLevels(inspection_.application().runtime)) {
        levels.Add(path.empty() ? "/" : path, LogLevelName(level));
      }
    }
    AppendList(inspection_.service().hand_settings().All(), json.Key("hands"),
               [](const std::pair<std::string, HandState>& each, std::string& to) {
                 JsonObject(to).Add("path", each.first).Add("state", HandStateName(each.second));
               });
    json.Add("ended", verdict.has_value());
    json.AddTextOrNull("verdict", verdict.value_or(""));
  });
  if (state == state_ && (time == state_time_)) return;
  if (state == state_) state_due_ = now + kTimeAlone;
  std::string text = "{\"op\":\"state\",\"time\":";
  AppendJsonNumber(ToSeconds(time), text);
  text += "," + state.substr(1);
  if (!client_.SendText(std::move(text))) return;
  state_ = std::move(state);
  state_time_ = time;
}

// Of applications without a network nothing.
void ViewerSession::SendNetwork(SteadyTime now) {
  network_due_ = now + kNetwork;
  if (structure_ == 0 || IsSlow()) return;
  Runtime& runtime = inspection_.application().runtime;
  std::string picture;
  {
    const std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
    if (!lock) {
      network_due_ = now + milliseconds(5);
      return;
    }
    const ExtensionTexts::Text* const text = ExtensionTexts::Find(runtime, "network_picture");
    if (text == nullptr) return;
    std::shared_ptr<void> asking;
    const auto told = (*text)("", asking);
    if (!told || !*told) return;
    picture = **told;
  }
  if (picture == network_) return;
  if (client_.SendText("{\"op\":\"network\"," + picture.substr(1))) network_ = std::move(picture);
}

void ViewerSession::SendReplies() {
  std::erase_if(pending_, [&](const ViewerRequest& each) {
    if (each.is_done && !each.is_done()) return false;
    replies_.push_back(each.take_reply());
    inspection_.LookSoon();
    return true;
  });
  while (!replies_.empty() && client_.SendText(replies_.front())) replies_.pop_front();
  std::size_t bytes = 0;
  for (const std::string& each : replies_) bytes += each.size();
  if (replies_.size() > kMostReplies || (replies_.size() > 1 && bytes > kMostBytes)) {
    client_.Close("too many replies wait to be read");
  }
}

void ViewerSession::SendLog() {
  if (IsSlow()) return;
  const ApplicationLog& log = inspection_.application().log;
  if (!log_) {
    const std::uint64_t end = log.end();
    log_ = end > kMostLogEntries ? end - kMostLogEntries : 0;
  }
  if (log.end() <= *log_) return;
  const ApplicationLog::Entries read = log.ReadEntries(*log_, kMostLogEntries);
  std::string text = JsonObjectText([&](JsonObject& json) {
    AppendList(read.entries, json.Add("op", "log").Key("entries"),
               [](const ApplicationLog::Entry& each, std::string& to) {
                 JsonObject object(to);
                 object.Add("number", each.number).Add("time", ToSeconds(each.time));
                 object.Add("kind", ApplicationLog::KindName(each.kind)).Add("text", each.text);
               });
  });
  if (client_.SendText(std::move(text))) log_ = read.next;
}

void ViewerSession::SendRates(SteadyTime now) {
  if (IsSlow()) {
    rates_due_ = now + rates_interval_;
    return;
  }
  auto sample = inspection_.mirror().Count();
  if (!sample) {
    rates_due_ = now + milliseconds(5);
    return;
  }
  rates_due_ = now + rates_interval_;
  if (!counted_ || counted_->of != sample->of) {
    counted_ = std::move(sample);
    rates_.clear();
    return;
  }
  std::string text = RateMessage(*counted_, *sample, ToSeconds(inspection_.running_for()), rates_);
  if (client_.SendText(std::move(text))) {
    counted_ = std::move(sample);
  } else {
    rates_.clear();  // all of them are told anew
  }
  SendProfile();
}

// Once more when it has ended.
void ViewerSession::SendProfile() {
  Scheduler& scheduler = inspection_.scheduler();
  const std::unique_lock lock(inspection_.application().runtime.structure_mutex(), std::try_to_lock);
  if (!lock) return;
  const auto measured = scheduler.profiled_for();
  const Profile profile = scheduler.ReadProfile();
  const bool is_any = measured || !profile.latencies.empty();
  if (!is_any && !has_profile_) return;
  if (client_.SendText(ProfileMessage(profile, measured))) has_profile_ = is_any;
}

void ViewerSession::OnText(std::string_view text) {
  std::optional<std::uint64_t> request;
  auto parsed = ParseViewerMessage(text, &request);
  if (!parsed) {
    replies_.push_back(Refusal(request, {{parsed.error()}}));
    return;
  }
  ViewerMessage& message = *parsed;
  const Operation* const operation = FindOperation(message.op);
  if (operation == nullptr) {
    return Refuse(message, {.message = "there is no operation '" + message.op + "'",
                            .hint = NearestNameHint(message.op, NamesOf(AllOperations(), &Operation::name))});
  }
  if (message.op == "alive") return;  // that was heard, if it says when
  if (is_for_stop_ && message.op != "stop" && (message.op != "release" || message.path != kRobotStopName)) {
    return Refuse(message, {.message = "this connection knows no '" + message.op + "'",
                            .hint = "it bears 'stop', and 'release' with the path 'stop'"});
  }
  const WebRole needed = RoleFor(*operation, message);
  if (role() < needed) return RefuseRole(message, needed);
  if (const auto good = CheckFields(*operation, message); !good) return Refuse(message, good.error());
  message.as_of = inspection_.application().runtime.robot_stop().AsOfNow(message.at);
  if (const auto arrival = client_.arrival()) {
    message.received = Time(arrival->at.time_since_epoch());
    message.as_of.requests = arrival->mark;
  }
  if (operation->begin != nullptr) return BeginRequest(*operation, std::move(message));
  if (message.op == "watch") return BeginWatching(message);
  if (message.op == "unwatch") {
    watches_.erase(message.path);
    return;
  }
  const double rate = std::min(message.rate.value_or(1), kFastestRates);
  rates_interval_ = rate > 0 ? IntervalOf(std::max(rate, 0.01)) : Duration{};
  rates_due_ = {};
  counted_.reset();
}

void ViewerSession::RefuseRole(const ViewerMessage& message, WebRole needed) {
  if (inspection_.options().is_read_only) {
    return Refuse(message, {.message = "this inspector is read-only: '" + message.op + "' is not allowed"});
  }
  Refuse(message, {.message = "'" + message.op + "' is not allowed to who may only " + std::string(WebRoleName(role())),
                   .path = message.path,
                   .hint = "it takes a token for the role '" + std::string(WebRoleName(needed)) + "'"});
}

void ViewerSession::Refuse(const ViewerMessage& message, Error error) {
  replies_.push_back(Refusal(message.request, {{std::move(error)}}));
}

void ViewerSession::BeginWatching(const ViewerMessage& message) {
  const double fastest = message.wants_image ? kFastestImages : kFastestWatch;
  const double rate = std::clamp(message.rate.value_or(10), 1.0, fastest);
  const std::size_t elements = std::min(message.elements, kMostElements);
  const auto found = watches_.find(message.path);
  if (found != watches_.end()) watches_.erase(found);  // with what has been shown: all is shown anew
  if (watches_.size() >= kMostWatches) {
    return Refuse(message, {.message = "more than " + std::to_string(kMostWatches) + " ports cannot be watched at once",
                            .path = message.path});
  }
  watches_.emplace(message.path, Watch{WatchedPort(message.path), IntervalOf(rate), elements, message.wants_image});
}

void ViewerSession::BeginRequest(const Operation& operation, ViewerMessage message) {
  // STOP outranks every limit.
  if (message.op != "stop" && pending_.size() + replies_.size() >= kMostPending) {
    return Refuse(message, {.message = "too many requests are waiting already"});
  }
  message.client = name_;
  pending_.push_back(operation.begin(inspection_, std::move(message), client_.Waker()));
}

}  // namespace runnel::internal
