#include "plugins/foxglove/internal/directory.h"

#include <mutex>
#include <set>

#include "core/lockfree/thread_epoch.h"
#include "core/plugin/module_type_name.h"
#include "core/types/type_info.h"
#include "plugins/foxglove/internal/robot_stop_access.h"
#include "plugins/services/callable.h"
#include "plugins/structure/value_by_hand.h"

namespace runnel::internal {

namespace {

// A large structure takes some milliseconds to look at: not more often than a person notices.
constexpr auto kBetweenLooks = std::chrono::milliseconds(100);
constexpr auto kLookOn = std::chrono::milliseconds(5);  // while there is more to look at, or it is locked

// As viewers want it: of an object.
std::string SchemaOf(const TypeInfo* type) {
  if (type == nullptr) return R"({"type":"object","properties":{}})";
  const auto forms = ChannelsFor(*type, "");
  return forms.empty() ? "" : forms.front().schema;
}

std::string OwnerPath(const FrameworkElement& element) {
  const FrameworkElement* const owner = FindOwner(element);
  return owner != nullptr ? owner->path() : "/";
}

// What several have in common names none of them; those are called by their paths.
const std::string& NameIn(const std::unordered_map<std::string, int>& counts, const std::string& topic,
                          const std::string& path) {
  return counts.at(topic) == 1 ? topic : path;
}

}  // namespace

// What of a structure can be shown, in the order of the tree. Made under the structure lock.
struct Directory::Search {
  struct FoundPort {
    const Port* port;  // as long as the structure is the same
    std::string path;
    std::string topic;
    const TypeInfo* type;
    bool is_shown;   // values come out of it
    bool is_target;  // values can be put into it
    bool drives;     // something moves by these
    std::string owner;
    std::vector<std::string> readers;  // owners of the ports that read what comes out, sorted
  };
  using Counts = std::unordered_map<std::string, int>;  // how many elements have a topic

  // Whether what is below is to be shown, too.
  bool Visit(const FrameworkElement& element) {
    if (element.FindAnnotation<BroughtByClient>() != nullptr) return false;
    if (const auto* const port = dynamic_cast<const Port*>(&element)) {
      Add(*port);
    } else if (const auto* const parameter = dynamic_cast<const Configurable*>(&element)) {
      parameters.emplace_back(TopicOf(element), DirectoryParameter{element.path(), &parameter->type(), parameter});
      ++parameter_topics[parameters.back().first];
    }
    return true;
  }
  // Which of the ports tells where the robot is; nullptr if none does.
  [[nodiscard]] const Port* FindRobotPose() const {
    std::vector<const Port*> all;
    for (const FoundPort& each : ports) all.push_back(each.port);
    return RobotPose(all);
  }
  void Add(const Port& port) {
    if (const auto* const callable = port.FindAnnotation<Callable>()) {
      services.push_back({.name = TopicOf(port),
                          .path = port.path(),
                          .type = port.type().name(),
                          .request_schema = SchemaOf(callable->arguments()),
                          .reply_schema = SchemaOf(callable->reply())});
    }
    const bool is_output = port.direction() == Port::Direction::kOutput;
    FoundPort found{&port,
                    port.path(),
                    TopicOf(port),
                    &port.type(),
                    is_output || port.is_proxy(),
                    !is_output,
                    !is_output && MovesSomething(port),
                    OwnerPath(port),
                    {}};
    if (found.is_target) ++target_topics[found.topic];
    if (found.is_shown) {
      ++shown_topics[found.topic];
      std::set<std::string> readers;
      for (const Port* sink : port.Sinks()) readers.insert(OwnerPath(*sink));
      found.readers.assign(readers.begin(), readers.end());
    }
    ports.push_back(std::move(found));
  }

  std::vector<FoundPort> ports;
  std::vector<DirectoryService> services = StopServices();             // without their numbers
  std::vector<std::pair<std::string, DirectoryParameter>> parameters;  // with their topics
  Counts target_topics, shown_topics, parameter_topics;
};

Directory::Directory(Runtime& runtime)
    : runtime_(runtime), walk_(runtime), stop_(std::make_shared<const FoxgloveChannel>(StopChannel())) {}
Directory::~Directory() = default;

Directory::SteadyTime Directory::Look(SteadyTime now) {
  if (now < look_at_) return look_at_;
  std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
  if (!lock) return now + kLookOn;
  const auto outcome = walk_.Continue([this] { search_ = std::make_unique<Search>(); },
                                      [this](const FrameworkElement& element) { return search_->Visit(element); });
  if (outcome == StructureWalk::Outcome::kUnderWay) return now + kLookOn;
  look_at_ = now + kBetweenLooks;
  if (outcome == StructureWalk::Outcome::kUnchanged) return look_at_;
  const std::unique_ptr<const Search> search = std::move(search_);
  const Port* const robot_pose = search->FindRobotPose();
  lock.unlock();
  auto content = std::make_shared<DirectoryContent>();
  for (const auto& [topic, parameter] : search->parameters) {
    content->parameters[NameIn(search->parameter_topics, topic, parameter.path)] = parameter;
  }
  for (const Search::FoundPort& port : search->ports) {
    if (!port.is_target || !port.type->is_transparent()) continue;
    const DirectoryInput input{port.path, port.type, port.drives};
    content->inputs[port.path] = input;
    content->inputs[NameIn(search->target_topics, port.topic, port.path)] = input;
  }
  for (DirectoryService service : search->services) {
    const auto next = static_cast<std::uint32_t>(service_ids_.size() + 1);
    const std::string all =
        service.path + "\n" + service.type + "\n" + service.request_schema + "\n" + service.reply_schema;
    service.id = service_ids_.try_emplace(all, next).first->second;
    content->services[service.id] = std::move(service);
  }
  AddChannels(*search, robot_pose, *content);
  content_ = std::move(content);
  walk_.Confirm();
  return look_at_;
}

void Directory::AddChannels(const Search& search, const Port* robot_pose, DirectoryContent& content) {
  if (!search.shown_topics.contains(log_->topic)) AddChannel(log_->topic, "", nullptr, log_, content);
  AddChannel(stop_->topic, "", nullptr, stop_, content);
  for (const Search::FoundPort& port : search.ports) {
    if (port.port != robot_pose) continue;
    const Encoding& transform = EncodingsOf(*port.type).transform;
    if (transform) AddChannel("/tf", port.path, port.type, transform, content);
  }
  for (const Search::FoundPort& port : search.ports) {
    if (!port.is_shown) continue;
    const std::string& topic = NameIn(search.shown_topics, port.topic, port.path);
    const std::vector<Encoding>& encodings = EncodingsOf(*port.type).plain;
    for (const Encoding& encoding : encodings) {
      AddChannel(topic + encoding->topic, port.path, port.type, encoding, content);
    }
    if (!encodings.empty()) content.graph[topic] = {{port.owner}, port.readers};
  }
}

void Directory::AddChannel(std::string topic, const std::string& port, const TypeInfo* type, const Encoding& encoding,
                           DirectoryContent& content) {
  const auto next = static_cast<std::uint32_t>(ids_.size() + 1);
  const auto [place, is_new] = ids_.try_emplace({topic, encoding.get()}, next);
  content.channels[place->second] = {place->second, std::move(topic), port, type, encoding};
}

const Directory::Encodings& Directory::EncodingsOf(const TypeInfo& type) {
  const auto known = encodings_.find(&type);
  if (known != encodings_.end()) return known->second;
  Encodings made;
  for (FoxgloveChannel& channel : ChannelsFor(type, "")) {
    made.plain.push_back(std::make_shared<const FoxgloveChannel>(std::move(channel)));
  }
  if (auto channel = TransformChannelFor(type)) {
    made.transform = std::make_shared<const FoxgloveChannel>(std::move(*channel));
  }
  return encodings_.emplace(&type, std::move(made)).first->second;
}

bool Directory::VisitParameters(const std::vector<std::string>& names, const ParameterVisitor& visit) const {
  // What is there under the lock stays in memory while the guard is held; so the lock need not be.
  const EpochGuard guard;
  {
    const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
    if (!lock || !walk_.is_current()) return false;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = content_->parameters.find(names[i]);
    visit(i, found != content_->parameters.end() ? &found->second : nullptr);
  }
  return true;
}

}  // namespace runnel::internal
