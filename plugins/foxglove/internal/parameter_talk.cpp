#include "plugins/foxglove/internal/parameter_talk.h"

#include <algorithm>
#include <utility>

#include "core/base/nearest_name.h"
#include "plugins/foxglove/internal/foxglove_shared.h"
#include "plugins/foxglove/internal/outbox.h"
#include "plugins/foxglove/internal/parameter_values.h"
#include "plugins/foxglove/internal/server_messages.h"
#include "plugins/json_values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr auto kBetweenLooks = std::chrono::milliseconds(250);
constexpr auto kSoon = std::chrono::milliseconds(5);
constexpr auto kLongTime = std::chrono::hours(1);
constexpr std::size_t kMostWaiting = 100;  // requests of one client
constexpr std::size_t kMostAtOnce = 1000;

}  // namespace

struct ParameterTalk::Setting {
  SetParametersMessage message;
  std::shared_ptr<ChangeWorker::Job> job;
  std::vector<Error> errors;  // the worker's until the job is done
};

std::vector<std::string> ParameterTalk::AllNames() const {
  std::vector<std::string> names;
  for (const auto& [name, parameter] : shared_.directory.content()->parameters) {
    names.push_back(name);
  }
  return names;
}

void ParameterTalk::Complain(const Error& error) {
  outbox_.Send(StatusMessage(StatusLevel::kError, error.ToString()));
}

Error ParameterTalk::NoSuchParameter(const std::string& name, bool& may_search) const {
  Error error{.message = "there is no parameter '" + name + "'"};
  if (std::exchange(may_search, false)) error.hint = NearestNameHint(name, AllNames());
  return error;
}

void ParameterTalk::Get(const GetParametersMessage& message) {
  if (gets_.size() >= kMostWaiting) {
    return Complain({.message = "getParameters: too many requests are waiting"});
  }
  gets_.push_back(message);
}

void ParameterTalk::Set(const SetParametersMessage& message) {
  if (shared_.application.is_read_only || !shared_.application.change) {
    return Complain({.message = "setParameters: viewers may look, and change nothing"});
  }
  if (settings_.size() >= kMostWaiting) {
    return Complain({.message = "setParameters: too many requests are waiting"});
  }
  if (message.parameters.size() > kMostAtOnce) {
    return Complain({.message = "setParameters: more than " + std::to_string(kMostAtOnce) +
                                " parameters at once"});
  }
  settings_.push_back(std::make_shared<Setting>(Setting{message, nullptr, {}}));
}

void ParameterTalk::Subscribe(const SubscribeParametersMessage& message) {
  const auto known = AllNames();
  if (message.names.empty()) {
    subscribed_.clear();
    if (message.is_wanted) subscribed_.insert(known.begin(), known.end());
  }
  bool may_search = true;
  for (const std::string& name : message.names) {
    if (!message.is_wanted) {
      subscribed_.erase(name);
    } else if (std::ranges::binary_search(known, name)) {
      subscribed_.insert(name);
    } else if (!outbox_.is_long()) {
      Complain(NoSuchParameter(name, may_search));
    }
  }
  std::erase_if(told_, [&](const auto& each) { return !subscribed_.contains(each.first); });
  look_at_ = {};
}

ParameterTalk::MachineTime ParameterTalk::Continue(MachineTime now) {
  if (outbox_.is_long()) return now + kSoon;
  const bool has_answered = AnswerGets();
  const bool has_set = ContinueSetting();
  if (!subscribed_.empty() && now >= look_at_) {
    look_at_ = now + kBetweenLooks;
    TellChanges();
  }
  if (!has_answered || !has_set) return now + kSoon;
  return subscribed_.empty() ? now + kLongTime : look_at_;
}

void ParameterTalk::SendValues(const Directory::ParameterTexts& texts,
                               const std::optional<std::string>& id) {
  const auto content = shared_.directory.content();
  std::string json;
  {
    JsonObject message(json);
    message.Add("op", "parameterValues");
    {
      JsonArray list(message.Key("parameters"));
      for (const auto& [name, text] : texts) {
        AppendParameter(name, *content->parameters.at(name).type, text, list.Next());
      }
    }
    if (id) message.Add("id", *id);
  }
  outbox_.Send(std::move(json));
}

// False if something is still to be answered.
bool ParameterTalk::AnswerGets() {
  while (!gets_.empty()) {
    const GetParametersMessage& get = gets_.front();
    const auto texts = shared_.directory.ReadParameters(get.names.empty() ? AllNames() : get.names);
    if (!texts) return false;
    bool may_search = true;
    for (const std::string& name : get.names) {
      if (!texts->contains(name) && !outbox_.is_long()) Complain(NoSuchParameter(name, may_search));
    }
    SendValues(*texts, get.id);
    gets_.pop_front();
  }
  return true;
}

bool ParameterTalk::ContinueSetting() {
  while (!settings_.empty()) {
    Setting& setting = *settings_.front();
    if (!setting.job && !BeginSetting(setting)) return false;
    if (!setting.job->is_done()) return false;
    std::vector<std::string> names;
    for (const auto& item : setting.message.parameters) names.push_back(item.name);
    // What they are now, whatever has come of it.
    if (setting.message.id) {
      const auto texts = shared_.directory.ReadParameters(names);
      if (!texts) return false;
      SendValues(*texts, setting.message.id);
    }
    for (const Error& error : setting.errors) {
      if (!outbox_.is_long()) Complain(error);
    }
    settings_.pop_front();
    look_at_ = {};
  }
  return true;
}

// False if the structure is locked.
bool ParameterTalk::BeginSetting(Setting& setting) {
  const auto content = shared_.directory.content();
  std::vector<std::string> names;
  for (const auto& item : setting.message.parameters) names.push_back(item.name);
  const auto texts = shared_.directory.ReadParameters(names);
  if (!texts) return false;
  std::vector<SetParameter> changes;
  bool may_search = true;
  for (const auto& item : setting.message.parameters) {
    const auto found = content->parameters.find(item.name);
    if (found == content->parameters.end()) {
      setting.errors.push_back(NoSuchParameter(item.name, may_search));
      continue;
    }
    auto text = TextOfSetting(item, *found->second.type, texts->at(item.name));
    if (text) {
      changes.push_back({found->second.path, std::move(*text)});
    } else {
      Error error = text.error();
      error.path = found->second.path;
      setting.errors.push_back(std::move(error));
    }
  }
  setting.job = shared_.worker->Post([changes = std::move(changes), owner = settings_.front(),
                                      &application = shared_.application] {
    // Each for itself: what is wrong with one is no reason to leave out the others.
    for (const SetParameter& change : changes) {
      const auto done = application.change({change});
      if (!done) owner->errors.push_back(done.error());
    }
  });
  return true;
}

void ParameterTalk::TellChanges() {
  const auto texts = shared_.directory.ReadParameters({subscribed_.begin(), subscribed_.end()});
  if (!texts) {
    look_at_ = {};
    return;
  }
  Directory::ParameterTexts changed;
  for (const auto& [name, text] : *texts) {
    const auto before = told_.find(name);
    if (before == told_.end() || before->second != text) changed[name] = text;
  }
  told_ = *texts;
  if (!changed.empty()) SendValues(changed, std::nullopt);
}

}  // namespace runnel::internal
