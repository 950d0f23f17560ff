// What the log and `runnel network` say of the network.

#include <algorithm>
#include <fstream>
#include <mutex>
#include <set>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/element/runtime.h"
#include "core/types/duration_text.h"
#include "plugins/network/network_link.h"
#include "plugins/network_discovery/distant_type.h"

namespace runnel {

namespace {

constexpr std::size_t kRoomForImages = 4'194'304;
constexpr const char* kHasMissed =
    "for a moment there was no memory, so that somebody, or what somebody writes or reads, may not be known here until "
    "this application, or the other one, is started again";

std::string Doubt(const WireEndpointOptions& own, const WireEndpointOptions& other, bool is_writer) {
  const std::string doubt =
      is_writer ? TypeDoubt(own.user_data, other.user_data) : TypeDoubt(other.user_data, own.user_data);
  return doubt.empty() ? "" : "is of another version: " + doubt;
}

}  // namespace

void NetworkLink::Trouble(const std::string& of, const Error& error) {
  new_troubles_[of] = error.message + (error.hint.empty() ? "" : "; " + error.hint);
}

// Each when it begins, and again if it has been over meanwhile.
void NetworkLink::TellTroubles() {
  const auto look = [&](const WireEndpointOptions& own, const std::string& path, bool is_writer) {
    for (const WireEndpoint& other : table_.Partners(own.topic, !is_writer)) {
      const std::string misfit = is_writer ? Misfit(own, other.options) : Misfit(other.options, own);
      const std::string why = misfit.empty() ? Doubt(own, other.options, is_writer) : "does not fit: " + misfit;
      if (why.empty()) continue;
      const std::string who = table_.NameOf(other.participant);
      // Many may have no name.
      new_troubles_[path + " " + who + " " + why] = ReadableTopic(own.topic) + " of " + who + " " + why;
    }
  };
  for (const auto& each : offered_) look(each->endpoint(), each->path(), true);
  for (const auto& each : taken_) {
    if (each->is_connected()) look(each->endpoint(), each->output().path(), false);
  }
  TellMissing();
  TellMasters();
  const auto tell_error = [&](auto& port, const std::string& path) {
    if (const auto error = port.TakeError()) Trouble(path, *error);
  };
  for (const auto& each : offered_) tell_error(*each, each->path());
  for (const auto& each : taken_) tell_error(*each, each->output().path());
  if (table_.has_missed()) Trouble("members", {.message = kHasMissed});
  for (const std::string& why : table_.refusals()) new_troubles_["keys " + why] = "not let in, " + why;
  for (const auto& [of, text] : new_troubles_) {
    const auto told = troubles_.find(of);
    if (told == troubles_.end() || told->second != text)
      element_.log().Warn("{}: {}", of.substr(0, of.find(' ')), text);
  }
  troubles_ = new_troubles_;
}

// That who is there does not offer what is to be had of it: not at once, as discovery tells one after the other.
void NetworkLink::TellMissing() {
  constexpr auto kPatience = std::chrono::seconds(1);
  const Time now = SteadyClock().Now();
  std::map<std::string, Time> missing;
  is_missing_young_ = false;
  for (const auto& each : taken_) {
    const std::string topic = each->endpoint().topic;
    if (!each->options().is_distant || !each->is_connected() || each->matched() > 0 ||
        !table_.Partners(topic, true).empty())
      continue;
    const std::string path = "/" + each->options().topic;
    const auto member = MemberOfPath(table_, path);
    if (!member) continue;
    const Time since = missing[topic] = missing_.try_emplace(topic, now).first->second;
    if (now - since < kPatience) {
      is_missing_young_ = true;
    } else {
      Trouble(each->output().path(), {.message = member->name + " offers no " + path,
                                      .hint = NearestNameHint(path, OfferedBeside(table_, path))});
    }
  }
  missing_ = std::move(missing);
}

// Of those without keys that are trusted here nothing is known but that they are there.
bool NetworkLink::IsStranger(const WireMember& member) const {
  if (!element_.options().member.security || member.id == participant_->id()) return false;
  return std::ranges::none_of(table_.endpoints(),
                              [&](const WireEndpoint& each) { return each.participant == member.id; });
}

void NetworkLink::TellMembers() {
  constexpr auto kPatience = std::chrono::seconds(3);  // for both to show their keys
  std::map<WireId, std::string> now;
  std::map<WireId, Time> strangers;
  for (const WireMember& each : table_.members()) {
    if (each.id == participant_->id()) continue;
    const std::string name = table_.NameOf(each.id);
    if (!IsStranger(each)) {
      now[each.id] = name;
      continue;
    }
    const Time since = strangers[each.id] = strangers_.try_emplace(each.id, SteadyClock().Now()).first->second;
    if (SteadyClock().Now() - since > kPatience) {
      Trouble("keys " + name,
              {.message = name + " is there, but shows no keys that are trusted here, or does not trust these"});
    }
  }
  strangers_ = std::move(strangers);
  for (const auto& [id, name] : now) {
    const auto told = members_.find(id);
    if (told != members_.end() && told->second == name) continue;  // of nodes it is told later how they are called
    element_.log().Info("{} is in the network", name);
    if (name == element_.options().member.name) {
      element_.log().Warn("two are called {} in the network: say <network name=\"…\"> in one of their files", name);
    }
  }
  for (const auto& [id, name] : members_) {
    if (now.contains(id)) continue;
    element_.log().Info("{} has left the network", name);
    structure_topic_->Forget(name);
  }
  members_ = std::move(now);
}

Result<std::optional<std::string>> NetworkLink::StructureOf(const std::string& path) {
  const auto words = SplitPath(path);
  if (words.empty())
    return Error{.message = "'" + path + "' names no application", .hint = "//NAME, as runnel network lists them"};
  const std::string name(words.front());
  const auto names = NamesOf(table_.members(), &WireMember::name);
  const bool is_there = std::ranges::find(names, name) != names.end();
  if (!is_there &&
      SteadyClock().Now() - began_ > std::chrono::seconds(1)) {  // until then others may not have been found yet
    return Error{
        .message = "there is no '" + name + "' in the network", .path = path, .hint = NearestNameHint(name, names)};
  }
  const auto text = is_there ? structure_topic_->Find(name) : std::nullopt;
  if (!text) return std::optional<std::string>();
  return FindInStructure(*text, path);
}

std::string NetworkLink::Text() const {
  const WireMemberOptions& own = element_.options().member;
  std::string text = own.name + " in domain " + std::to_string(own.domain) + "\n";
  std::size_t room = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> room;
  if (room > 0 && room < kRoomForImages) {
    text += "sockets have room for " + std::to_string(room / 1024) +
            " KiB: for images, sysctl net.core.rmem_max=" + std::to_string(kRoomForImages) + "\n";
  }
  for (const WireMember& each : table_.members()) {
    if (each.id == participant_->id()) continue;
    text += "member " + table_.NameOf(each.id) +
            (IsStranger(each) ? ": NOT LET IN, as it shows no keys that are trusted here, or does not trust these\n"
                              : "\n");
  }
  for (const std::string& why : table_.refusals()) text += "NOT LET IN " + why + "\n";
  if (table_.has_missed()) text += std::string("NOT ALL: ") + kHasMissed + "\n";
  const std::lock_guard lock(runtime_.structure_mutex());
  const auto add_partners = [&](const WireEndpointOptions& mine, const OfferedPort* offered, const TakenPort* taken) {
    const bool is_writer = offered != nullptr;
    const std::uint64_t chosen = taken != nullptr ? taken->chosen() : 0;
    for (const WireEndpoint& other : table_.Partners(mine.topic, !is_writer)) {
      const std::string misfit = is_writer ? Misfit(mine, other.options) : Misfit(other.options, mine);
      text += std::string(is_writer ? "    read by " : "    written by ") + table_.NameOf(other.participant) + " (" +
              QosText(other.options.qos) + ")" + (misfit.empty() ? "" : ": NOT MATCHED, " + misfit);
      const bool is_matched = is_writer ? offered->HasReader(other.handle) : taken->matched() > 0;
      if (misfit.empty() && !is_matched) text += ": not matched (yet), for a reason that it does not say";
      const std::string doubt = misfit.empty() ? Doubt(mine, other.options, is_writer) : "";
      const auto delay = taken != nullptr ? taken->least_delay(other.handle) : std::nullopt;
      if (delay) text += ", " + DurationText(*delay) + " on its way by both clocks";
      const bool is_heard = chosen == 0 || chosen == other.handle || !misfit.empty();
      text += (doubt.empty() ? "" : ", " + doubt) + (is_heard ? "\n" : ": NOT HEARD, as another one has it\n");
    }
  };
  const auto add = [&](const WireEndpointOptions& endpoint, const std::string& arrow, const std::string& counts) {
    text += arrow + "  " + endpoint.type + ", " + QosText(endpoint.qos) + counts + "\n";
  };
  for (const auto& each : offered_) {
    add(each->endpoint(), "offers " + each->path() + " as " + each->options().topic,
        ", " + std::to_string(each->sent()) + " sent" +
            (each->sent_after_cycles() > 0 ? " (" + std::to_string(each->sent_after_cycles()) + " after cycles)" : "") +
            (each->dropped() > 0 ? ", " + std::to_string(each->dropped()) + " lost" : "") +
            (each->is_stopped() ? ", STOPPED: its safe value is sent" : ""));
    add_partners(each->endpoint(), each.get(), nullptr);
  }
  for (const auto& each : taken_) {
    if (!each->is_connected()) continue;
    const std::string field = each->options().field.empty() ? "" : "." + each->options().field;
    add(each->endpoint(), "takes " + each->options().topic + field + " to " + each->output().path(),
        ", " + std::to_string(each->taken()) + " came" +
            (each->Owner().name.empty() ? "" : ", " + each->Owner().name + " has it") +
            (each->refused() > 0 ? ", " + std::to_string(each->refused()) + " could not be read" : ""));
    add_partners(each->endpoint(), nullptr, each.get());
    if (const std::string masters = Masters(*each); !masters.empty()) text += "    TWO MASTERS: " + masters + "\n";
  }
  TellAwaited(text);
  text += services_.Text();
  std::set<std::string> others;
  for (const WireEndpoint& each : table_.endpoints()) {
    if (each.is_own || IsInternalTopic(each.options.topic)) continue;
    others.insert((each.is_writer ? "written " : "read ") + ReadableTopic(each.options.topic) + "  " +
                  each.options.type + " by " + table_.NameOf(each.participant));
  }
  for (const std::string& each : others) text += each + "\n";
  return text;
}

// Under one name is also who has been killed and started again: of such it is told once values of both come.
std::string NetworkLink::Masters(const TakenPort& taken) const {
  const WireEndpointOptions endpoint = taken.endpoint();
  if (taken.options().is_exclusive || endpoint.qos.is_exclusive) return {};
  std::set<std::string> names;
  std::string all;
  for (const WireEndpoint& other : table_.Partners(endpoint.topic, true)) {
    if (!Misfit(other.options, endpoint).empty()) continue;
    const std::string name = table_.NameOf(other.participant);
    names.insert(name);
    all += (all.empty() ? "" : " and ") + name;
  }
  return names.size() > 1 || taken.they_come_in_turn() ? all + " write it, and all of them are heard" : "";
}

void NetworkLink::TellMasters() {
  for (const auto& each : taken_) {
    each->NoteTurnIsTold();
    const std::string masters = Masters(*each);
    if (masters.empty()) continue;
    const char* const exclusive = "say <take … exclusive=\"true\"/> if one is enough";
    Trouble(each->output().path(),
            {.message = masters, .hint = each->options().is_distant ? "end one of them" : exclusive});
  }
}

// Once of each: how far they are apart changes.
void NetworkLink::TellClocks() {
  for (const auto& each : taken_) {
    if (!each->options().keeps_stamps) continue;
    for (const WireEndpoint& other : table_.Partners(each->endpoint().topic, true)) {
      const Duration delay = each->least_delay(other.handle).value_or(Duration{});
      const bool is_old = delay > WriterClock::kMostOfNetworks && !each->endpoint().qos.is_latched;
      const bool is_ahead = -delay > WriterClock::kMostOfNetworks;
      if ((!is_old && !is_ahead) || !other_clocks_.insert(other.participant).second) continue;
      const std::string name = table_.NameOf(other.participant);
      const double seconds = ToSeconds(std::chrono::abs(delay));
      if (is_old) {
        element_.log().Warn(
            "values of {} are {:.3f} s old when they come, by both clocks: if nothing holds them up, its clock is "
            "behind this one's; synchronise the clocks (chrony, ptp4l)",
            name, seconds);
      } else {
        element_.log().Warn(
            "the clock of {} is {:.3f} s ahead of this one's: ages of its values are counted from when the soonest "
            "came; synchronise the clocks (chrony, ptp4l)",
            name, seconds);
      }
    }
  }
}

void NetworkLink::TellOwners() {
  for (const auto& each : taken_) {
    TakenPort::WriterInCharge owner = each->Owner();
    TakenPort::WriterInCharge& told = owners_[each->output().path()];
    if (owner.handle == told.handle && owner.name == told.name) continue;
    if (owner.name.empty()) {
      element_.log().Warn("{}: {} has it no more", each->output().path(), told.name);
    } else {
      element_.log().Info("{}: {} has it now{}", each->output().path(), owner.name,
                          told.name.empty() ? "" : " instead of " + told.name);
    }
    told = std::move(owner);
  }
}

}  // namespace runnel
