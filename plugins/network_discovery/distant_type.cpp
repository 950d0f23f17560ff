#include "plugins/network_discovery/distant_type.h"

#include <algorithm>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/port/typed_ports.h"
#include "core/types/type_info.h"
#include "plugins/network_discovery/discovery_table.h"
#include "plugins/network_discovery/value_form.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

namespace {

constexpr std::string_view kUnit = "runnel_unit=";

bool IsOffered(const WireEndpoint& writer, const TypeInfo& type) {
  return writer.options.type == DdsType(MessageNameOf(type));
}

// Of several that are called so, that with the same description.
const TypeInfo* FindNamed(const WireEndpoint& writer) {
  const TypeInfo* found = nullptr;
  for (const TypeInfo* const each : RegisteredTypes()) {
    if (each->kind() == TypeKind::kOpaque || FindTypedPorts(*each) == nullptr || !IsOffered(writer, *each)) continue;
    const bool is_the_same =
        writer.options.user_data.find("runnel_type=" + DescriptionText(*each) + ";") != std::string::npos;
    if (found == nullptr || is_the_same) found = each;
    if (is_the_same) break;
  }
  return found;
}

std::string UnitSaid(const std::string& user_data) {
  const std::size_t begin = user_data.find(kUnit);
  if (begin == std::string::npos) return {};
  const std::size_t end = user_data.find(';', begin);
  return user_data.substr(begin + kUnit.size(), end - begin - kUnit.size());
}

std::string WhyNobodyWrites(const DiscoveryTable& table, const std::string& path) {
  const auto words = SplitPath(path);
  const std::string name(words.empty() ? "" : words.front());
  const auto with_hint = [](const std::string& text, const std::string& hint) {
    return text + (hint.empty() ? "" : "; " + hint);
  };
  if (!MemberOfPath(table, path)) {
    const auto names = NamesOf(table.members(), [](const WireMember& each) { return "//" + each.name; });
    return with_hint(name + " is not in the network yet, which says what values it has",
                     NearestNameHint("//" + name, names));
  }
  return with_hint(name + " offers no " + path, NearestNameHint(path, OfferedBeside(table, path)));
}

std::string NameInTopics(const std::string& path) {
  const auto words = SplitPath(path);
  return NearestRosName("/" + std::string(words.empty() ? "" : words.front()));
}

}  // namespace

std::optional<WireMember> MemberOfPath(const DiscoveryTable& table, const std::string& path) {
  const std::string name = NameInTopics(path);
  const auto members = table.members();
  const auto found =
      std::ranges::find(members, name, [](const WireMember& each) { return NearestRosName("/" + each.name); });
  return found == members.end() ? std::nullopt : std::optional(*found);
}

std::vector<std::string> OfferedBeside(const DiscoveryTable& table, const std::string& path) {
  std::vector<std::string> offers;
  const std::string begin = NameInTopics(path) + "/";
  for (const WireEndpoint& each : table.endpoints()) {
    const std::string offered = ReadableTopic(each.options.topic);
    const bool is_meant =
        each.is_writer && !each.is_own && !IsInternalTopic(each.options.topic) && offered.starts_with(begin);
    if (is_meant) offers.push_back("/" + offered);
  }
  return offers;
}

std::string UnitText(const std::string& unit) { return unit.empty() ? "" : std::string(kUnit) + unit + ";"; }

OfferedType FindDistantType(const DiscoveryTable& table, const std::string& path, const TypeInfo* expected,
                            const std::function<void()>& know_types) {
  const auto writers = table.Partners(DdsTopic(TopicOfDistantPath(path)), true);
  if (writers.empty()) return {.type = {.why_not = WhyNobodyWrites(table, path)}};
  for (const WireEndpoint& each : writers) {
    if (expected != nullptr && IsOffered(each, *expected))
      return {.type = {expected, UnitSaid(each.options.user_data)}, .is_offered = true};
  }
  const WireEndpoint& writer = writers.front();
  const TypeInfo* type = FindNamed(writer);
  if (type == nullptr && know_types) {
    know_types();
    type = FindNamed(writer);
  }
  if (type != nullptr) return {.type = {type, UnitSaid(writer.options.user_data)}, .is_offered = true};
  const std::string name = RosType(writer.options.type);
  const bool is_described = writer.options.user_data.find("runnel_type=") != std::string::npos;
  if (is_described) {
    return {.type = {.why_not = "its values are of the type " + name +
                                ", which is not known here: load a plugin with ports of it"},
            .is_offered = true};
  }
  const std::string topic = TopicOfDistantPath(path);
  return {
      .type = {.why_not = "its values are messages " + name + ": runnel take " + topic + " PORT --as " + name +
                          " takes them, or <take topic=\"" + topic + "\" as=\"" + name + "\" to=\"…\"/> in the file"},
      .is_offered = true,
      .message = name};
}

std::string TopicOfPort(const std::string& network_name, std::string_view port_path) {
  return NearestRosName("/" + network_name + ShortPortPath(port_path));
}

std::string TopicOfDistantPath(std::string_view path) {
  path.remove_prefix(1);
  return NearestRosName(PlainPortPath(path));
}

std::string ReadableTopic(std::string_view wire_topic) {
  const std::string topic = RosTopic(wire_topic);
  return topic.empty() ? std::string(wire_topic) : topic;
}

}  // namespace runnel
