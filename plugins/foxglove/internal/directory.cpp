#include "plugins/foxglove/internal/directory.h"

#include <mutex>

#include "core/lockfree/thread_epoch.h"
#include "core/types/type_info.h"
#include "plugins/command_service/parameter_text.h"

namespace runnel::internal {

namespace {

// A large structure takes some milliseconds to look at: not more often than a person notices.
constexpr auto kBetweenLooks = std::chrono::milliseconds(100);

/// Which names several elements have; those are called by their paths.
class Names {
 public:
  void Note(const std::string& name) { ++count_[name]; }
  [[nodiscard]] bool IsOfOne(const std::string& name) const {
    const auto found = count_.find(name);
    return found != count_.end() && found->second == 1;
  }

 private:
  std::unordered_map<std::string, int> count_;
};

void AddInputs(const FoundStructure& found, DirectoryContent& content) {
  Names topics;
  for (const FoundPort& port : found.ports) {
    if (port.is_target) topics.Note(port.topic);
  }
  for (const FoundPort& port : found.ports) {
    if (!port.is_target || !port.type->is_transparent()) continue;
    content.inputs[port.path] = {port.path, port.type};
    if (topics.IsOfOne(port.topic)) content.inputs[port.topic] = {port.path, port.type};
  }
}

void AddParameters(const FoundStructure& found, DirectoryContent& content) {
  Names names;
  for (const FoundParameter& each : found.parameters) names.Note(each.topic);
  for (const FoundParameter& each : found.parameters) {
    const std::string& name = names.IsOfOne(each.topic) ? each.topic : each.path;
    content.parameters[name] = {each.path, each.type, each.element};
  }
}

}  // namespace

void Directory::Look(SteadyTime now) {
  if (now < look_at_) return;
  FoundStructure found;
  {
    const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
    if (!lock) return;
    look_at_ = now + kBetweenLooks;
    if (has_looked_ && runtime_.revision() == content_->revision) return;
    found = FindStructure(runtime_);
  }
  has_looked_ = true;
  auto content = std::make_shared<DirectoryContent>();
  content->revision = found.revision;
  AddParameters(found, *content);
  AddInputs(found, *content);
  AddChannels(found, *content);
  content_ = std::move(content);
}

void Directory::AddChannels(const FoundStructure& found, DirectoryContent& content) {
  Names topics;
  for (const FoundPort& port : found.ports) {
    if (port.is_shown) topics.Note(port.topic);
  }
  if (found.robot_pose != FoundStructure::kNone) {
    const FoundPort& port = found.ports[found.robot_pose];
    if (const Encoding& encoding = TransformOf(*port.type))
      AddChannel("/tf", port, encoding, content);
  }
  for (const FoundPort& port : found.ports) {
    if (!port.is_shown) continue;
    const std::string& topic = topics.IsOfOne(port.topic) ? port.topic : port.path;
    const std::vector<Encoding>& encodings = EncodingsOf(*port.type);
    for (const Encoding& encoding : encodings)
      AddChannel(topic + encoding->topic, port, encoding, content);
    if (!encodings.empty()) content.graph[topic] = {{port.owner}, port.readers};
  }
}

void Directory::AddChannel(std::string topic, const FoundPort& port, const Encoding& encoding,
                           DirectoryContent& content) {
  const auto next = static_cast<std::uint32_t>(ids_.size() + 1);
  const auto [place, is_new] = ids_.try_emplace({topic, encoding.get()}, next);
  content.channels[place->second] = {place->second, std::move(topic), port.path, port.type,
                                     encoding};
}

const std::vector<Directory::Encoding>& Directory::EncodingsOf(const TypeInfo& type) {
  const auto [place, is_new] = encodings_.try_emplace(&type);
  if (is_new) {
    for (FoxgloveChannel& channel : ChannelsFor(type, "")) {
      place->second.push_back(std::make_shared<const FoxgloveChannel>(std::move(channel)));
    }
  }
  return place->second;
}

const Directory::Encoding& Directory::TransformOf(const TypeInfo& type) {
  const auto [place, is_new] = transforms_.try_emplace(&type);
  if (is_new) {
    if (auto channel = TransformChannelFor(type)) {
      place->second = std::make_shared<const FoxgloveChannel>(std::move(*channel));
    }
  }
  return place->second;
}

std::optional<Directory::ParameterTexts> Directory::ReadParameters(
    const std::vector<std::string>& names) const {
  // What is there under the lock stays in memory while the guard is held; so the lock need not be.
  const EpochGuard guard;
  {
    const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
    if (!lock || runtime_.revision() != content_->revision) return std::nullopt;
  }
  ParameterTexts texts;
  for (const std::string& name : names) {
    const auto found = content_->parameters.find(name);
    if (found != content_->parameters.end()) texts[name] = ParameterText(*found->second.element);
  }
  return texts;
}

}  // namespace runnel::internal
