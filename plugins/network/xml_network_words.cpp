#include "plugins/network/xml_network_words.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "core/base/number_text.h"

namespace runnel {

namespace {

// By ValueQuality, and by ValueSending.
const std::vector<std::string> kQualities = {"newest", "each", "sensor", "latched"};
const std::vector<std::string> kSendings = {"network", "after_cycle"};

AttributeRule Quality(const char* summary) { return WordRule("qos", kQualities, summary); }

AttributeRule MessageTypeRule() {
  return {.name = "as",
          .summary =
              "type of the messages: sensor_msgs/msg/LaserScan; without, the values by their description; of services: "
              "std_srvs/srv/Trigger"};
}

std::optional<double> RateIn(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(std::strtod(text.c_str(), nullptr));
}

std::optional<ValueQuality> QualityIn(const std::string& text) {
  if (text.empty()) return {};
  return static_cast<ValueQuality>(std::ranges::find(kQualities, text) - kQualities.begin());
}

const std::string& NameOf(ValueQuality quality) { return kQualities[static_cast<std::size_t>(quality)]; }

// Those that are usual are left out.
class Words {
 public:
  Words& Add(const char* name, const std::string& value) {
    if (!value.empty()) words_.push_back({name, value});
    return *this;
  }
  Words& AddIf(bool value, const char* name) { return Add(name, std::string(value ? "true" : "")); }
  [[nodiscard]] std::vector<Setting> Take() { return std::move(words_); }

 private:
  std::vector<Setting> words_;
};

}  // namespace

std::vector<AttributeRule> OfferRules() {
  return {
      {.name = "ports", .summary = "patterns, separated by blanks: laser/* **/pose !**/debug"},
      {.name = "port", .kind = AttributeKind::kPath, .summary = "one of them", .names_element = true},
      {.name = "topic", .summary = "its name in the network: /scan; without, /<name of the application>/<path>"},
      {.name = "service", .summary = "likewise, of a port that is a service: /save_map"},
      MessageTypeRule(),
      KindRule("frame", AttributeKind::kName, "of coordinates, for headers of messages"),
      KindRule("child_frame", AttributeKind::kName, "what moves, for transforms and odometry"),
      Quality("newest (default): reliable; each: every value, in a queue; sensor: best effort; latched: "
              "who comes late gets the newest"),
      WordRule("sending", kSendings,
               "which thread sends: network (default), the network's; after_cycle: for small values, the one that has "
               "published them, when its cycle has ended"),
      KindRule("rate", AttributeKind::kNumber, "most values a second; the newest wins"),
      KindRule("strength", AttributeKind::kCount,
               "for who takes exclusively: of several that offer the topic the strongest counts"),
      WordRule("measured", {"true", "false"},
               "true: a velocity that is measured, and no command: it is sent on in STOP")};
}

std::vector<AttributeRule> TakeRules() {
  return {{.name = "topic", .summary = "its name: /cmd_vel"},
          {.name = "service", .summary = "instead: one that clients of this application call: /save_map"},
          MessageTypeRule(),
          {.name = "field",
           .summary = "of the messages, of which alone the values are made: percentage, pose.pose.position, ranges[0]"},
          {.name = "to",
           .kind = AttributeKind::kPathList,
           .required = true,
           .summary = "inputs, of whose type the values are",
           .names_element = true},
          Quality("what is asked of those who write; by default what they offer"),
          WordRule("stamp", {"arrived", "sent"},
                   "arrived (default): measured when they came; sent: when the writer says, if the clocks of "
                   "both machines are synchronised"),
          WordRule("exclusive", {"true", "false"}, "true: of several that write only the strongest counts"),
          WordRule("live", {"true", "false"}, "true: also with simulated time, of which runs are not repeatable then")};
}

OfferOptions OfferSaid(const SaidOf& said) {
  OfferOptions offer{.topic = said("topic"),
                     .as = said("as"),
                     .frame = said("frame"),
                     .child_frame = said("child_frame"),
                     .quality = QualityIn(said("qos")).value_or(ValueQuality::kNewest),
                     .sending = said("sending") == kSendings[1] ? ValueSending::kAfterCycle : ValueSending::kNetwork,
                     .rate = RateIn(said("rate")).value_or(0),
                     .is_measured = said("measured") == "true"};
  if (const std::string strength = said("strength"); !strength.empty()) {
    offer.strength = NumberIn<std::int32_t>(strength).value_or(kTooStrong);
  }
  return offer;
}

std::optional<Error> WhatIsWrong(const OfferOptions& offer) {
  if (offer.strength == kTooStrong) {
    return Error{.message =
                     "a strength is a number from 0 to " + std::to_string(std::numeric_limits<std::int32_t>::max())};
  }
  if (offer.rate < 0) return Error{.message = "the rate is a number above 0, of values a second"};
  if (offer.rate > 0 && offer.sending == ValueSending::kAfterCycle) {
    return Error{.message = "values of a bounded rate are sent by the network's thread",
                 .hint = "leave out rate, or sending"};
  }
  return {};
}

TakeOptions TakeSaid(const SaidOf& said) {
  return {.topic = said("topic"),
          .as = said("as"),
          .field = said("field"),
          .quality = QualityIn(said("qos")),
          .is_exclusive = said("exclusive") == "true",
          .keeps_stamps = said("stamp") == "sent",
          .is_live = said("live") == "true"};
}

std::vector<Setting> WordsOf(const OfferOptions& offer) {
  return Words()
      .Add("topic", offer.topic)
      .Add("as", offer.as)
      .Add("frame", offer.frame)
      .Add("child_frame", offer.child_frame)
      .Add("qos", offer.quality == ValueQuality::kNewest ? "" : NameOf(offer.quality))
      .Add("sending", offer.sending == ValueSending::kNetwork ? "" : kSendings[1])
      .Add("rate", offer.rate > 0 ? fmt::format("{}", offer.rate) : "")
      .Add("strength", offer.strength ? std::to_string(*offer.strength) : "")
      .AddIf(offer.is_measured, "measured")
      .Take();
}

std::vector<Setting> WordsOf(const TakeOptions& take) {
  return Words()
      .Add("as", take.as)
      .Add("field", take.field)
      .Add("qos", take.quality ? NameOf(*take.quality) : "")
      .Add("stamp", take.keeps_stamps ? "sent" : "")
      .AddIf(take.is_exclusive, "exclusive")
      .AddIf(take.is_live, "live")
      .Take();
}

}  // namespace runnel
