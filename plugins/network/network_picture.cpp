// What the page shows of the network.

#include <algorithm>
#include <map>

#include "plugins/network/network_link.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/values/json_writer.h"

namespace runnel {

namespace {

// "runnel_msgs::msg::dds_::RangeScan_" as people call it: "RangeScan"; others: "sensor_msgs/msg/LaserScan".
std::string ReadableType(std::string type) {
  if (type.ends_with('_')) type.pop_back();
  constexpr std::string_view kOwn = "runnel_msgs::msg::dds_::";
  if (type.starts_with(kOwn)) return type.substr(kOwn.size());
  constexpr std::string_view kMiddle = "::msg::dds_::";
  const std::size_t middle = type.find(kMiddle);
  if (middle != std::string::npos) type.replace(middle, kMiddle.size(), "/msg/");
  return type;
}

}  // namespace

NetworkLink::Partner NetworkLink::PartnerOf(const WireEndpointOptions& mine, bool is_writer) const {
  Partner found;
  for (const WireEndpoint& other : table_.Partners(mine.topic, !is_writer)) {
    const std::string misfit = is_writer ? Misfit(mine, other.options) : Misfit(other.options, mine);
    if (misfit.empty()) found.names.push_back(table_.NameOf(other.participant));
    if (!misfit.empty()) found.misfit = table_.NameOf(other.participant) + ": " + misfit;
  }
  return found;
}

std::string NetworkLink::Picture() {
  const WireMemberOptions& own = element_.options().member;
  return JsonObjectText([&](JsonObject& json) {
    json.Add("name", own.name).Add("element", element_.path());
    std::map<WireId, Duration> delays;  // the least, by who writes
    AppendList(offered_, json.Key("offers"), [&](const auto& each, std::string& text) {
      const Partner readers = PartnerOf(each->endpoint(), true);
      JsonObject object(text);
      object.Add("port", each->path())
          .Add("topic", each->options().topic)
          .AddTextOrNull("misfit", readers.misfit)
          .Add("is_stopped", each->is_stopped());
      AppendList(readers.names, object.Key("readers"), AppendJsonString);
    });
    AppendList(taken_, json.Key("takes"), [&](const auto& each, std::string& text) {
      const Partner writers = PartnerOf(each->endpoint(), false);
      for (const WireEndpoint& writer : table_.Partners(each->endpoint().topic, true)) {
        const auto delay = each->least_delay(writer.handle);
        if (!delay) continue;
        Duration& least = delays.emplace(writer.participant, *delay).first->second;
        least = std::min(least, *delay);
      }
      JsonObject object(text);
      object.Add("port", each->output().path())
          .Add("topic", each->options().topic)
          .AddTextOrNull("misfit", writers.misfit.empty() ? Masters(*each) : writers.misfit);
      object.Add("is_wanted", !each->output().outgoing().empty());
      AppendList(writers.names, object.Key("writers"), AppendJsonString);
      object.AddTextOrNull("owner", each->Owner().name);
    });
    std::vector<WireMember> others = table_.members();
    std::erase_if(others, [&](const WireMember& each) { return each.id == participant_->id(); });
    const std::vector<WireEndpoint> endpoints = table_.endpoints();
    AppendList(others, json.Key("applications"), [&](const WireMember& member, std::string& text) {
      JsonObject object(text);
      const bool is_application = std::ranges::any_of(endpoints, [&](const WireEndpoint& each) {
        return each.participant == member.id && each.is_writer && IsInternalTopic(each.options.topic);
      });
      object.AddTextOrNull("name", is_application ? member.name : "");
      const auto delay = delays.find(member.id);
      object.AddOrNull("delay", delay != delays.end() ? std::optional(ToSeconds(delay->second)) : std::nullopt);
      object.Add("is_simulated", table_.HasSimulatedTime(member.id));
      std::vector<WireEndpoint> offers = endpoints;
      std::erase_if(offers, [&](const WireEndpoint& each) {
        const bool is_topic =
            ReadableTopic(each.options.topic).starts_with('/') && !IsInternalTopic(each.options.topic);
        return each.participant != member.id || !each.is_writer || !is_topic;
      });
      object.AddTextOrNull("structure", is_application ? structure_topic_->Find(member.name).value_or("") : "");
      AppendList(offers, object.Key("offers"), [](const WireEndpoint& each, std::string& to) {
        JsonObject(to).Add("topic", ReadableTopic(each.options.topic)).Add("type", ReadableType(each.options.type));
      });
    });
  });
}

}  // namespace runnel
