#include "plugins/network/offer_list.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/element/element_path.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

namespace {

bool IsMeantBy(const OfferOptions& offer, const std::string& path) {
  if (!offer.port.empty()) return offer.port == path;
  const auto patterns = PortPatterns::Make(offer.patterns);
  return patterns && patterns->Fit(path);
}

bool Names(const std::string& pattern, const std::string& path) {
  const auto alone = PortPatterns::Make({pattern});
  return alone && alone->Name(path);
}

bool IsExclusion(const std::string& pattern) { return pattern.starts_with('!'); }

// As a pattern again: without a word for it, or with one that leaves it out.
void LeaveOut(const std::string& path, OfferOptions& offer) {
  std::erase_if(offer.patterns, [&](const std::string& each) { return !IsExclusion(each) && Names(each, path); });
  if (IsMeantBy(offer, path)) offer.patterns.push_back("!" + ShortPortPath(path));
}

// Patterns that begin at the root mean what they name, with the application's name or without; of others nobody knows.
void RenameIn(std::string& pattern, const std::string& from, const std::string& to) {
  const std::string mark = IsExclusion(pattern) ? "!" : "";
  const std::string path = pattern.substr(mark.size());
  const std::size_t inner = from.find('/', 1);
  for (const std::size_t begin : {std::size_t{0}, inner}) {
    if (begin == std::string::npos || !IsAtOrBelow(path, from.substr(begin))) continue;
    const std::size_t to_begin = begin == 0 ? 0 : to.find('/', 1);
    pattern = mark + to.substr(to_begin) + path.substr(from.size() - begin);
    return;
  }
}

bool IsEmpty(const OfferOptions& offer) {
  return offer.port.empty() && std::ranges::all_of(offer.patterns, IsExclusion);
}

}  // namespace

Result<void> OfferList::Add(const std::string& path, OfferOptions wanted) {
  const auto topic_of = [&](const OfferOptions& each) {
    return each.topic.empty() ? TopicOfPort(network, path) : each.topic;
  };
  const std::string topic = topic_of(wanted);
  for (const OfferOptions& each : offers) {
    if (!IsMeantBy(each, path) || topic_of(each) != topic) continue;
    return Error{.message = "is offered as " + topic + " already",
                 .path = path,
                 .hint = "remove that first, or say another topic"};
  }
  // One that a pattern has offered before.
  for (OfferOptions& each : offers) {
    OfferOptions with = each;
    std::erase_if(with.patterns,
                  [&](const std::string& one) { return IsExclusion(one) && Names(one.substr(1), path); });
    if (!each.port.empty() || with.patterns == each.patterns || !IsMeantBy(with, path)) continue;
    OfferOptions rest = each;
    rest.patterns = wanted.patterns;
    rest.position = wanted.position;
    if (rest != wanted) continue;
    each = std::move(with);
    return {};
  }
  wanted.port = path;
  offers.push_back(std::move(wanted));
  return {};
}

Result<void> OfferList::Remove(const std::string& path, const std::string& topic) {
  const auto is_meant = [&](const OfferOptions& each) {
    const bool is_topic = topic.empty() || topic == (each.topic.empty() ? TopicOfPort(network, path) : each.topic);
    return is_topic && IsMeantBy(each, path);
  };
  bool is_found = false;
  for (OfferOptions& each : offers) {
    if (!is_meant(each)) continue;
    is_found = true;
    if (each.port.empty()) {
      LeaveOut(path, each);
    } else {
      each.port.clear();
    }
  }
  std::erase_if(offers, IsEmpty);
  if (is_found) return {};
  return Error{.message = "is not offered" + (topic.empty() ? "" : " as " + topic),
               .path = path,
               .hint = "runnel network shows what is"};
}

void OfferList::Rename(const std::string& from, const std::string& to) {
  for (OfferOptions& each : offers) {
    MovePath(each.port, from, to);
    for (std::string& pattern : each.patterns) RenameIn(pattern, from, to);
  }
}

void OfferList::DropSecond() {
  std::set<std::pair<std::string, std::string>> known;
  std::erase_if(offers, [&](const OfferOptions& each) {
    const std::string topic = each.topic.empty() ? TopicOfPort(network, each.port) : each.topic;
    return !each.port.empty() && !known.emplace(each.port, topic).second;
  });
}

}  // namespace runnel
