#include "plugins/network_discovery/structure_topic.h"

#include <utility>
#include <vector>

#include "plugins/cdr_values/cdr_reader.h"
#include "plugins/cdr_values/cdr_writer.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

constexpr std::size_t kMostApplications = 1000;  // that are asked for

WireEndpointOptions Endpoint(const std::string& name) {
  return {.topic = DdsTopic(NearestRosName("/" + name + "/runnel_structure")),
          .type = "std_msgs::msg::dds_::String_",
          .qos = {.is_latched = true}};
}

}  // namespace

Result<std::unique_ptr<StructureTopic>> StructureTopic::Start(WireParticipant& participant, const std::string& name,
                                                              std::function<void()> on_wanted) {
  std::unique_ptr<StructureTopic> topic(new StructureTopic(participant));
  topic->on_wanted_ = std::move(on_wanted);
  auto writer = participant.MakeWriter(Endpoint(name), {});
  if (!writer) return writer.error();
  topic->writer_ = std::move(*writer);
  return topic;
}

void StructureTopic::Tell(const std::string& structure) {
  if (structure == told_) return;
  told_ = structure;
  auto octets = std::make_shared<Octets>();
  CdrWriter(*octets).PutText(structure);
  (void)writer_->Write(octets, 0);
}

void StructureTopic::Follow() {
  std::vector<std::string> wanted;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [name, text] : texts_) {
      if (!readers_.contains(name)) wanted.push_back(name);
    }
  }
  for (const std::string& name : wanted) {
    auto reader = participant_.MakeReader(
        Endpoint(name),
        [this, name](const WireSample& sample) {
          std::string text;
          auto from = CdrReader::Begin(sample.octets);
          if (!from || !from->GetText(text)) return;
          const std::lock_guard lock(mutex_);
          texts_[name] = std::move(text);
        },
        {});
    if (reader) readers_[name] = std::move(*reader);
  }
}

void StructureTopic::Forget(const std::string& name) {
  readers_.erase(name);  // first, without the lock: it waits for who writes the text
  const std::lock_guard lock(mutex_);
  texts_.erase(name);
}

std::optional<std::string> StructureTopic::Find(const std::string& name) {
  {
    const std::lock_guard lock(mutex_);
    const auto known = texts_.find(name);
    if (known != texts_.end()) return known->second;
    if (texts_.size() >= kMostApplications) return {};
    texts_[name];
  }
  on_wanted_();
  return {};
}

}  // namespace runnel
