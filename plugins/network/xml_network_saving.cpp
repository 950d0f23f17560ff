#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/ranges.h>

#include "plugins/application_files/path_use.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/network/offer_list.h"
#include "plugins/network/xml_network_words.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

namespace {

using Words = std::map<std::string, std::string>;

SaidOf SaidIn(XmlElement tag) {
  return [tag](const char* name) { return tag.TextOr(name); };
}

template <typename Options>
Words MapOf(const Options& options) {
  Words words;
  for (const Setting& each : WordsOf(options)) words[each.parameter] = each.value;
  return words;
}

std::string Joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

// As the file calls a port, seen from the application.
std::string NameInFile(const std::string& path) { return ShortPortPath(path).substr(1); }

void AddWords(const std::vector<Setting>& words, NewElement& element) {
  for (const Setting& each : words) element.attributes.emplace_back(each.parameter, each.value);
}

// Takes the tags of a file for what is offered, one by one.
class OfferTags {
 public:
  OfferTags(NetworkElement& network, FrameworkElement& application, internal::FileUpdate& update)
      : application_(application), update_(update) {
    OfferList list{network.options().member.name, network.options().offers};
    std::erase_if(list.offers, [&](const OfferOptions& each) {
      return !each.port.empty() && !application.runtime().root().Find(each.port);
    });
    list.DropSecond();  // a file that says both is refused
    left_ = std::move(list.offers);
  }

  // Those that say what is offered stay as they are; of the others, those of the same options get other patterns, and
  // the rest goes.
  void Update(const std::vector<XmlElement>& tags) {
    std::vector<XmlElement> others;
    for (const XmlElement tag : tags) {
      if (!Take([&](const OfferOptions& each) { return Says(tag, each, true); })) others.push_back(tag);
    }
    for (const XmlElement tag : others) {
      const auto taken = Take([&](const OfferOptions& each) { return Says(tag, each, false); });
      if (taken) {
        update_.editor().SetAttribute(tag, "ports", Joined(taken->patterns));
      } else {
        update_.editor().Remove(tag);
      }
    }
  }
  void AppendTo(XmlElement network) {
    for (const OfferOptions& each : left_) {
      NewElement made{.name = "offer"};
      if (each.port.empty()) {
        made.attributes.emplace_back("ports", Joined(each.patterns));
      } else {
        made.attributes.emplace_back("port", NameInFile(each.port));
      }
      AddWords(WordsOf(each), made);
      update_.editor().Append(network, std::move(made));
    }
  }

 private:
  template <typename Is>
  std::optional<OfferOptions> Take(const Is& is) {
    const auto found = std::ranges::find_if(left_, is);
    if (found == left_.end()) return {};
    OfferOptions taken = std::move(*found);
    left_.erase(found);
    return taken;
  }
  bool Says(XmlElement tag, const OfferOptions& offer, bool is_whole) const {
    if (MapOf(OfferSaid(SaidIn(tag))) != MapOf(offer)) return false;
    const XmlAttribute* const ports = tag.Attribute("ports");
    if (ports != nullptr) return offer.port.empty() && (!is_whole || SplitPaths(ports->value) == offer.patterns);
    const Port* const port = FindPort(PathIn(*tag.Attribute("port"), application_), PathKind::kOutput);
    return port != nullptr && port->path() == offer.port;
  }

  FrameworkElement& application_;
  internal::FileUpdate& update_;
  std::vector<OfferOptions> left_;
};

// The same for what is taken: each connection of an output is said by one tag.
class TakeTags {
 public:
  TakeTags(NetworkElement& network, FrameworkElement& application, internal::FileUpdate& update)
      : network_(network), application_(application), update_(update) {}

  void Update(XmlElement tag) {
    const std::string topic = tag.Attribute("topic")->value;
    const auto take = std::ranges::find(network_.takes(), topic, [](const auto& each) { return each.options.topic; });
    const XmlAttribute& to = *tag.Attribute("to");
    std::set<std::size_t> gone;
    std::size_t count = 0;
    for (const PathUse& each : PathsIn(to, application_)) {
      const Port* const port = FindPort(each, PathKind::kInput);
      const bool is_known = take != network_.takes().end() && port != nullptr;
      const bool is_there = is_known && take->output->ConnectionTo(*port) != nullptr;
      if (!is_there || !said_.insert({take->output, port}).second) gone.insert(count);
      ++count;
    }
    if (gone.size() == count) return update_.editor().Remove(tag);
    update_.editor().RemoveWords(to, gone);
    const Words wanted = Wanted(take->options);
    for (const AttributeRule& rule : TakeRules()) {
      if (rule.name == "topic" || rule.name == "to") continue;
      const XmlAttribute* const said = tag.Attribute(rule.name);
      const auto word = wanted.find(rule.name);
      const bool was_usual = !MapOf(TakeSaid(SaidIn(tag))).contains(rule.name);
      if (word == wanted.end() && said != nullptr && !was_usual && rule.name != "live") {
        update_.editor().RemoveAttribute(tag, rule.name);
      } else if (word != wanted.end() && (said == nullptr || said->value != word->second)) {
        update_.editor().SetAttribute(tag, rule.name, word->second);
      }
    }
  }
  void AppendTo(XmlElement network) {
    for (const NetworkElement::Take& take : network_.takes()) {
      if (take.options.is_distant) continue;  // is said by <connect>
      std::vector<std::string> to;
      for (const Connection& each : take.output->outgoing()) {
        if (!each.to->IsAtOrBelow(application_) || said_.contains({take.output, each.to})) continue;
        if (!each.options.part.empty() || !each.options.convert.empty()) {
          update_.saving().Fail({.message = "a part of what is taken cannot be said by <take>",
                                 .path = each.to->path(),
                                 .hint = "connect it to an interface port of a group, and that to this one"});
        }
        to.push_back(NameInFile(each.to->path()));
      }
      if (to.empty()) continue;
      NewElement made{.name = "take", .attributes = {{"topic", take.options.topic}, {"to", Joined(to)}}};
      for (const auto& [name, value] : Wanted(take.options)) made.attributes.emplace_back(name, value);
      update_.editor().Append(network, std::move(made));
    }
  }

 private:
  // "live" may be said of all.
  [[nodiscard]] Words Wanted(const TakeOptions& take) const {
    Words words = MapOf(take);
    if (network_.options().is_live) words.erase("live");
    return words;
  }

  NetworkElement& network_;
  FrameworkElement& application_;
  internal::FileUpdate& update_;
  std::set<std::pair<const Port*, const Port*>> said_;
};

// What a tag of a service names.
bool LeadsSomewhere(XmlElement tag, FrameworkElement& application) {
  for (const char* const name : {"port", "to"}) {
    const XmlAttribute* const paths = tag.Attribute(name);
    if (paths == nullptr) continue;
    for (const PathUse& each : PathsIn(*paths, application)) {
      if (FindPort(each, std::string_view(name) == "to" ? PathKind::kInput : PathKind::kOutput) == nullptr)
        return false;
    }
  }
  return true;
}

}  // namespace

void UpdateNetworkTag(XmlElement tag, FrameworkElement& application, internal::FileUpdate& update) {
  NetworkElement* const network = NetworkElement::FindIn(application);
  if (network == nullptr) return update.editor().Remove(tag);
  OfferTags offers(*network, application, update);
  TakeTags takes(*network, application, update);
  std::vector<XmlElement> offer_tags;
  for (const XmlElement child : tag.children()) {
    if (child.Attribute("service") != nullptr) {  // stays as it is while it runs
      if (!LeadsSomewhere(child, application)) update.editor().Remove(child);
      continue;
    }
    if (child.name() == "offer") offer_tags.push_back(child);
    if (child.name() == "take") takes.Update(child);
  }
  offers.Update(offer_tags);
  offers.AppendTo(tag);
  takes.AppendTo(tag);
}

}  // namespace runnel
