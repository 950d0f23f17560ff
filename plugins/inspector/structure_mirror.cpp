#include "plugins/inspector/structure_mirror.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <unordered_set>
#include <utility>

#include "core/element/configurable.h"
#include "core/port/probe_port.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kMostChanges = 100;
// For which the structure is locked while parameters are looked at.
constexpr auto kHold = std::chrono::milliseconds(2);
constexpr std::size_t kStride = 64;  // parameters between two looks at the clock

// What is in both lists goes from both.
void Cancel(std::vector<std::string>& a, std::vector<std::string>& b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::vector<std::string> only_a;
  std::vector<std::string> only_b;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only_a));
  std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(only_b));
  a = std::move(only_a);
  b = std::move(only_b);
}

void AppendRaw(const std::string& item, std::string& json) { json += item; }

// A recorder is no part of the application.
bool IsObserver(const Port& port) { return dynamic_cast<const ProbePort*>(&port) != nullptr; }

}  // namespace

StructureMirror::StructureMirror(Runtime& runtime, const ModuleRegistry& modules, const Scheduler& scheduler,
                                 const ApplicationLog& log)
    : runtime_(runtime), log_(log), walk_(runtime) {
  around_.modules = &modules;
  around_.scheduler = &scheduler;
}

bool StructureMirror::Look() {
  try {
    return LookOn();
  } catch (...) {
    Forget();
    throw;
  }
}

void StructureMirror::Forget() noexcept {
  ++revision_;  // which no change leads to: viewers are told the whole
  changes_.clear();
  entries_.clear();
  order_.clear();
  walk_.Forget();
  found_ = {};
  seen_ = {};
  next_parameter_ = 0;
  metered_ = nullptr;
}

bool StructureMirror::LookOn() {
  std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
  if (!lock) return false;
  NoteFaults();
  const auto outcome = walk_.Continue([this] { BeginWalk(); },
                                      [this](const FrameworkElement& element) {
                                        if (element.parent() != nullptr) Visit(element);
                                        return true;
                                      });
  if (outcome == StructureWalk::Outcome::kUnderWay) return false;
  if (outcome == StructureWalk::Outcome::kUnchanged) {
    SweepParameters();
    return true;
  }
  lock.unlock();  // the rest is our own
  FinishWalk();
  return true;
}

void StructureMirror::NoteFaults() {
  if (auto paused = around_.scheduler->PausedPaths(); paused != around_.paused) {
    around_.paused = std::move(paused);
    walk_.Forget();
  }
  const auto news = log_.ReadEntries(next_in_log_, ApplicationLog::kMostEntries);
  next_in_log_ = news.next;
  for (const ApplicationLog::Entry& entry : news.entries) {
    if (entry.module.empty()) continue;
    const auto found = runtime_.root().Find(entry.module);
    if (!found) continue;       // it has been deleted since
    if (entry.cause.empty()) {  // it goes on
      if (around_.failed.erase((*found)->id()) == 0) continue;
    } else {
      around_.failed[(*found)->id()] = entry.cause;
    }
    walk_.Forget();
  }
}

void StructureMirror::NoteThreads() {
  around_.thread_names.clear();
  around_.default_thread = 0;
  const auto note = [&](const FrameworkElement& folder) {
    for (const FrameworkElement* each : folder.children()) {
      if (each->kind() != ElementKind::kThread) continue;
      around_.thread_names[each->id()] = each->name();
      const bool is_default = each->name() == around_.scheduler->options().default_thread;
      if (around_.default_thread == 0 || is_default) around_.default_thread = each->id();
    }
  };
  for (const FrameworkElement* top : runtime_.root().children()) {
    note(*top);
    if (const auto* const folder = top->FindChild("threads")) note(*folder);
  }
}

void StructureMirror::BeginWalk() {
  ++walks_;
  found_ = {};
  NoteThreads();  // first: modules name theirs
}

void StructureMirror::Visit(const FrameworkElement& element) {
  Entry entry = Describe(element);
  const auto known = entries_.find(element.id());
  if (known != entries_.end()) known->second.walk = walks_;
  const bool is_news =
      known == entries_.end() || known->second.json != entry.json || known->second.connections != entry.connections;
  if (is_news) found_.news.emplace_back(element.id(), std::move(entry));
  found_.order.push_back(element.id());
  switch (element.kind()) {
    case ElementKind::kPort: {
      const auto* const port = dynamic_cast<const Port*>(&element);
      if (port->is_proxy() || port->direction() != Port::Direction::kOutput) return;
      found_.metered.ports.push_back(port->path());
      found_.ports.push_back(port);
      return;
    }
    case ElementKind::kThread:
      if (const auto* const thread = dynamic_cast<const ThreadContainer*>(&element)) {
        found_.metered.threads.push_back(thread->path());
        found_.threads.push_back(thread);
      }
      return;
    case ElementKind::kParameter:
      found_.parameters.push_back(&element);
      return;
    default:
      return;
  }
}

StructureMirror::Entry StructureMirror::Describe(const FrameworkElement& element) const {
  Entry entry{.path = element.path(), .json = ElementJson(element, around_), .connections = {}, .walk = walks_};
  if (const auto* const port = dynamic_cast<const Port*>(&element)) {
    for (const Connection& each : port->outgoing()) {
      if (IsObserver(*each.to)) continue;
      entry.connections.push_back(ConnectionJson(each));
    }
  }
  return entry;
}

StructureMirror::Difference StructureMirror::TakeNews() {
  Difference difference;
  // What comes first is told as a whole.
  const bool is_told = revision_ > 0;
  const auto add = [is_told](std::vector<std::string>& to, const std::vector<std::string>& more) {
    if (is_told) to.insert(to.end(), more.begin(), more.end());
  };
  std::unordered_set<std::string_view> made_anew;
  for (auto& [id, entry] : found_.news) {
    Entry& before = entries_[id];
    if (before.json != entry.json) add(difference.elements, {entry.json});
    add(difference.disconnected, before.connections);
    add(difference.connected, entry.connections);
    before = std::move(entry);
    if (is_told) made_anew.insert(before.path);
  }
  std::erase_if(entries_, [&](const auto& each) {
    const Entry& entry = each.second;
    if (entry.walk == walks_) return false;
    if (made_anew.count(entry.path) == 0) difference.gone.push_back(entry.path);
    add(difference.disconnected, entry.connections);
    around_.failed.erase(each.first);
    return true;
  });
  // A connection to another element of the same path is the same to a viewer.
  Cancel(difference.connected, difference.disconnected);
  std::sort(difference.gone.begin(), difference.gone.end());
  return difference;
}

void StructureMirror::FinishWalk() {
  Difference difference = TakeNews();
  order_.clear();
  order_.reserve(found_.order.size());
  for (const std::uint64_t id : found_.order) order_.push_back(&entries_.at(id));
  seen_ = std::move(found_);
  metered_ = std::make_shared<const MeteredElements>(std::move(seen_.metered));
  next_parameter_ = 0;
  walk_.Confirm();
  Tell(std::move(difference));
}

// Nobody announces that a parameter has been set.
void StructureMirror::SweepParameters() {
  const auto until = std::chrono::steady_clock::now() + kHold;
  const auto is_late = [&] { return std::chrono::steady_clock::now() >= until; };
  Difference difference;
  for (std::size_t i = 0; i < seen_.parameters.size() && (i % kStride != 0 || !is_late()); ++i) {
    const FrameworkElement& parameter = *seen_.parameters[next_parameter_];
    next_parameter_ = (next_parameter_ + 1) % seen_.parameters.size();
    std::string json = ElementJson(parameter, around_);
    Entry& entry = entries_[parameter.id()];
    if (entry.json == json) continue;
    entry.json = std::move(json);
    difference.elements.push_back(entry.json);
  }
  Tell(std::move(difference));
}

void StructureMirror::Tell(Difference difference) {
  const bool is_same = difference.gone.empty() && difference.elements.empty() && difference.connected.empty() &&
                       difference.disconnected.empty();
  if (is_same && revision_ > 0) return;
  ++revision_;
  std::string message;
  if (revision_ > 1) {  // what comes first is told as a whole
    JsonObject json(message);
    json.Add("op", "structure_change").Add("revision", revision_);
    AppendList(difference.gone, json.Key("gone"), AppendJsonString);
    AppendList(difference.elements, json.Key("elements"), AppendRaw);
    AppendList(difference.connected, json.Key("connected"), AppendRaw);
    AppendList(difference.disconnected, json.Key("disconnected"), AppendRaw);
  }
  changes_.push_back(std::move(message));
  if (changes_.size() > kMostChanges) changes_.pop_front();
}

std::string StructureMirror::Whole() const {
  return JsonObjectText([this](JsonObject& json) {
    json.Add("op", "structure").Add("revision", revision_);
    AppendList(order_, json.Key("elements"), [](const Entry* entry, std::string& text) { text += entry->json; });
    JsonArray connections(json.Key("connections"));
    for (const Entry* entry : order_) {
      for (const std::string& each : entry->connections) connections.Next() += each;
    }
  });
}

const std::string* StructureMirror::ChangeTo(std::uint64_t revision) const {
  const std::uint64_t oldest = revision_ + 1 - changes_.size();
  return revision >= oldest && revision <= revision_ ? &changes_[revision - oldest] : nullptr;
}

std::optional<CountSample> StructureMirror::Count() const {
  const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
  if (!lock || !walk_.is_current()) return {};
  CountSample sample{.of = metered_, .publications = {}, .threads = {}, .time = runtime_.clock().Now()};
  sample.publications.reserve(seen_.ports.size());
  for (const Port* port : seen_.ports) sample.publications.push_back(Publications::Of(*port));
  for (const ThreadContainer* thread : seen_.threads) sample.threads.push_back(thread->statistics());
  return sample;
}

}  // namespace runnel::internal
