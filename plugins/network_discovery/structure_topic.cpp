#include "plugins/network_discovery/structure_topic.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "plugins/cdr_values/cdr_stream.h"
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

std::unique_ptr<StructureTopic> StructureTopic::Start(WireParticipant& participant, const std::string& name,
                                                      std::function<void()> on_wanted) {
  std::unique_ptr<StructureTopic> topic(new StructureTopic(participant));
  topic->on_wanted_ = std::move(on_wanted);
  auto writer = participant.MakeWriter(Endpoint(name), {});
  if (writer) topic->writer_ = std::move(*writer);
  if (!writer) topic->refusal_ = writer.error();
  return topic;
}

void StructureTopic::Tell(const std::string& structure) {
  if (writer_ == nullptr || structure == told_) return;
  auto octets = std::make_shared<Octets>();
  CdrWriter(*octets).PutText(structure);
  if (writer_->Write(octets, 0)) told_ = structure;
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
    auto reader = participant_.MakeReader(Endpoint(name),
                                          [this, name](const WireSample& sample) {
                                            std::string text;
                                            auto from = CdrReader::Begin(sample.octets);
                                            if (!from || !from->GetText(text)) return;
                                            const std::lock_guard lock(mutex_);
                                            texts_[name] = Printable(text, "\n");
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

Result<std::optional<std::string>> FindInStructure(const std::string& text, const std::string& path) {
  const auto words = SplitPath(path);
  if (words.size() == 1) return std::optional(text);
  // The lines of the element: from its own to the next that is indented no deeper.
  std::istringstream lines(text);
  std::string found;
  std::vector<std::string> candidates;
  std::size_t word = 0;
  std::size_t depth = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string::npos) continue;
    if (word == words.size() && indent <= depth) break;
    if (word == words.size()) {
      found += line + "\n";
      continue;
    }
    if (word > 0 && indent <= depth) break;  // past the element around
    std::string here = line.substr(indent, line.find(' ', indent) - indent);
    if (word == 0) here.erase(0, 1);  // "/base"
    if (word > 0 && indent != depth + 2) continue;
    candidates.push_back(here);
    if (here != words[word]) continue;
    candidates.clear();
    depth = indent;
    if (++word == words.size()) found = line + "\n";
  }
  if (found.empty()) {
    const std::string missing(words[std::min(word, words.size() - 1)]);
    return Error{.message = std::string(words.front()) + " has no '" + missing + "' there",
                 .path = path,
                 .hint = NearestNameHint(missing, candidates)};
  }
  return std::optional(found);
}

}  // namespace runnel
