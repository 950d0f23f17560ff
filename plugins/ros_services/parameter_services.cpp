#include "plugins/ros_services/parameter_services.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/element/configurable.h"
#include "core/element/runtime.h"
#include "core/log/logger.h"
#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/network_discovery/value_form.h"
#include "plugins/ros_services/ros_time.h"

namespace runnel {

namespace {

constexpr std::uint32_t kDepth = 1000;            // as nodes of ROS 2 have it
constexpr std::uint32_t kIdentity = 0x80000000u;  // beyond those of services that files name
// So often it is looked what has changed, while somebody listens.
constexpr auto kLookForChanges = std::chrono::milliseconds(200);
constexpr auto kNoHurry = std::chrono::hours(1);
constexpr auto kAfterFailure = std::chrono::milliseconds(100);
// Each is set by itself, between two cycles.
constexpr std::size_t kMostAlone = 1000;

template <typename T>
void Write(const T& value, Octets& octets) {
  WriteCdr(TypeOf<T>(), &value, octets);
}

std::string Sentence(const Error& error) { return error.message + (error.hint.empty() ? "" : "; " + error.hint); }

// Behind the prefix no more than `depth` names; 0: as many as there are.
bool IsWithin(std::string_view name, std::uint64_t depth) {
  return depth == 0 || static_cast<std::uint64_t>(std::ranges::count(name, '.')) < depth;
}

bool IsListed(std::string_view name, const RosListRequest& request) {
  if (request.prefixes.empty()) return IsWithin(name, request.depth);
  return std::ranges::any_of(request.prefixes, [&](const std::string& prefix) {
    if (name == prefix) return true;
    return name.starts_with(prefix + ".") && IsWithin(name.substr(prefix.size() + 1), request.depth);
  });
}

}  // namespace

/// One of the six.
struct ParameterServices::Server {
  std::unique_ptr<ServiceEndpoints> endpoints;
  std::function<Result<void>(const ServiceMessage&, Octets&)> answer;
};

ParameterServices::ParameterServices(FrameworkElement& application, std::string node, ServiceDialect dialect,
                                     ParameterSetter set, Logger& log, const DiscoveryTable* table)
    : application_(application),
      node_(std::move(node)),
      dialect_(dialect),
      set_(std::move(set)),
      log_(log),
      table_(table),
      wake_(std::make_shared<WakeEvent>()) {}

template <typename Request, typename Answer>
Result<void> ParameterServices::Add(const char* name, const char* type, WireParticipant& participant,
                                    const Answer& answer) {
  const std::string of = std::string("rcl_interfaces/srv/") + type;
  auto endpoints = ServiceEndpoints::Start(ServiceEndpoints::Side::kServer,
                                           {.service = (node_ == "/" ? "" : node_) + "/" + name,
                                            .request = ServiceType::OfRos(of + "_Request"),
                                            .response = ServiceType::OfRos(of + "_Response"),
                                            .depth = kDepth,
                                            .dialect = dialect_,
                                            .table = table_},
                                           participant, kIdentity + static_cast<std::uint32_t>(servers_.size()),
                                           [wake = wake_] { wake->Notify(); });
  if (!endpoints) return endpoints.error();
  auto server = std::make_unique<Server>();
  server->endpoints = std::move(*endpoints);
  server->answer = [answer](const ServiceMessage& asked, Octets& octets) -> Result<void> {
    Request request;
    if (auto read = ReadCdr(TypeOf<Request>(), asked.message, &request); !read) return read.error();
    Write(answer(request, asked.sent), octets);
    return {};
  };
  servers_.push_back(std::move(server));
  return {};
}

Result<std::unique_ptr<ParameterServices>> ParameterServices::Start(FrameworkElement& application,
                                                                    const std::string& node,
                                                                    WireParticipant& participant,
                                                                    ServiceDialect dialect, ParameterSetter set,
                                                                    Logger& log, const DiscoveryTable* table) {
  std::unique_ptr<ParameterServices> made(
      new ParameterServices(application, node, dialect, std::move(set), log, table));
  ParameterServices& self = *made;
  Result<void> done = self.Add<RosListRequest>("list_parameters", "ListParameters", participant,
                                               [&self](const auto& request, Time) { return self.List(request); });
  const auto add = [&]<typename Request>(std::type_identity<Request>, const char* name, const char* type,
                                         const auto& answer) {
    if (done) done = self.Add<Request>(name, type, participant, answer);
  };
  constexpr std::type_identity<Names> kNames;
  constexpr std::type_identity<Wanted> kSet;
  add(kNames, "get_parameters", "GetParameters", [&self](const auto& request, Time) { return self.Get(request); });
  add(kNames, "get_parameter_types", "GetParameterTypes",
      [&self](const auto& request, Time) { return self.GetTypes(request); });
  add(kNames, "describe_parameters", "DescribeParameters",
      [&self](const auto& request, Time) { return self.DescribeAll(request); });
  add(kSet, "set_parameters", "SetParameters",
      [&self](const auto& request, Time sent) { return self.Set(request, sent); });
  add(kSet, "set_parameters_atomically", "SetParametersAtomically",
      [&self](const auto& request, Time sent) { return self.SetAtomically(request, sent); });
  if (!done) return done.error();
  auto events =
      participant.MakeWriter(RosEndpoint("/parameter_events", "rcl_interfaces/msg/ParameterEvent", {.depth = kDepth}),
                             [&self](std::size_t count) {
                               self.listeners_.store(count, std::memory_order_relaxed);
                               self.wake_->Notify();
                             });
  if (!events) return events.error();
  self.events_ = std::move(*events);
  self.told_ = self.Values();
  self.thread_ = std::thread([&self] { self.Run(); });
  return made;
}

ParameterServices::~ParameterServices() {
  ends_ = true;
  wake_->Notify();
  if (thread_.joinable()) thread_.join();
}

void ParameterServices::AddIds(std::vector<WireId>& readers, std::vector<WireId>& writers) const {
  for (const auto& each : servers_) {
    readers.push_back(each->endpoints->reader_id());
    writers.push_back(each->endpoints->writer_id());
  }
  writers.push_back(events_->id());
}

ParameterServices::Parameters ParameterServices::FindAll() const {
  Parameters found;
  const std::string& application = application_.path();
  application_.Visit([&](FrameworkElement& element) {
    auto* const parameter = dynamic_cast<Configurable*>(&element);
    if (parameter == nullptr || element.life_cycle() == LifeCycle::kDeleted) return;
    std::string path = element.path();
    // The group in which a module has its parameters is left out, as it may be in all paths.
    std::string plain = path;
    const FrameworkElement* const group = element.parent();
    if (group != nullptr && group->name() == "parameter") plain = group->parent()->path() + "/" + element.name();
    found.try_emplace(RosParameterName(application, plain), Found{parameter, std::move(path)});
  });
  return found;
}

RosListReply ParameterServices::List(const RosListRequest& request) const {
  const std::lock_guard lock(application_.runtime().structure_mutex());
  RosListReply reply;
  std::set<std::string> prefixes;
  for (const auto& [name, found] : FindAll()) {
    if (!IsListed(name, request)) continue;
    reply.names.push_back(name);
    if (const std::size_t dot = name.rfind('.'); dot != std::string::npos) prefixes.insert(name.substr(0, dot));
  }
  reply.prefixes.assign(prefixes.begin(), prefixes.end());
  return reply;
}

template <typename Use>
void ParameterServices::ForEach(const Names& names, const Use& use) const {
  const std::lock_guard lock(application_.runtime().structure_mutex());
  const Parameters all = FindAll();
  for (const std::string& name : names) {
    const auto found = all.find(name);
    use(name, found != all.end() ? found->second.parameter : nullptr);
  }
}

std::vector<RosParameterValue> ParameterServices::Get(const Names& names) const {
  std::vector<RosParameterValue> values;
  ForEach(names, [&](const std::string&, const Configurable* parameter) {
    values.push_back(parameter != nullptr ? ToRosParameter(parameter->type(), parameter->Value().get())
                                          : RosParameterValue());
  });
  return values;
}

std::vector<RosParameterType> ParameterServices::GetTypes(const Names& names) const {
  std::vector<RosParameterType> types;
  for (const RosParameterValue& each : Get(names)) types.push_back(each.type);
  return types;
}

std::vector<RosParameterDescriptor> ParameterServices::DescribeAll(const Names& names) const {
  std::vector<RosParameterDescriptor> descriptors;
  ForEach(names, [&](const std::string& name, const Configurable* parameter) {
    RosParameterDescriptor descriptor;
    descriptor.name = name;
    if (parameter != nullptr) descriptor = DescribeRosParameter(name, *parameter);
    descriptor.read_only = descriptor.read_only || set_ == nullptr;
    descriptors.push_back(std::move(descriptor));
  });
  return descriptors;
}

std::vector<Result<ParameterChange>> ParameterServices::Prepare(const Wanted& wanted) const {
  const std::lock_guard lock(application_.runtime().structure_mutex());
  const Parameters all = FindAll();
  bool has_hint = false;
  const auto prepare = [&](const RosParameter& each) -> Result<ParameterChange> {
    const auto found = all.find(each.name);
    if (found == all.end()) {
      Error error{.message = "there is no parameter '" + each.name + "'"};
      if (!std::exchange(has_hint, true))  // of many it would take long
        error.hint = NearestNameHint(each.name, NamesOf(all, [](const auto& known) { return known.first; }));
      return error;
    }
    if (set_ == nullptr) {
      return Error{.message = "parameters may not be set from elsewhere",
                   .hint = "the application's file is to say <ros parameters=\"write\"/>"};
    }
    auto text = TextOf(each.value, found->second.parameter->type());
    if (!text) return text.error();
    if (const auto checked = found->second.parameter->CheckText(*text); !checked) return checked.error();
    return ParameterChange{found->second.path, std::move(*text)};
  };
  std::vector<Result<ParameterChange>> changes;
  for (const RosParameter& each : wanted) changes.push_back(prepare(each));
  return changes;
}

std::vector<RosSetResult> ParameterServices::Set(const Wanted& wanted, Time sent) const {
  if (wanted.size() > kMostAlone) {
    return std::vector<RosSetResult>(wanted.size(),
                                     {.successful = false,
                                      .reason = "at most " + std::to_string(kMostAlone) +
                                                " are set one by one; set_parameters_atomically takes more"});
  }
  std::vector<RosSetResult> results;
  for (auto& change : Prepare(wanted)) {
    if (ends_) change = Error{.message = "the application ends"};
    results.push_back(change ? SetTogether({*change}, sent)
                             : RosSetResult{.successful = false, .reason = Sentence(change.error())});
  }
  return results;
}

RosSetResult ParameterServices::SetAtomically(const Wanted& wanted, Time sent) const {
  std::vector<ParameterChange> changes;
  for (auto& change : Prepare(wanted)) {
    if (!change) return {.successful = false, .reason = Sentence(change.error())};
    changes.push_back(std::move(*change));
  }
  return SetTogether(changes, sent);
}

RosSetResult ParameterServices::SetTogether(const std::vector<ParameterChange>& changes, Time sent) const {
  if (changes.empty()) return {.successful = true, .reason = ""};
  auto done = application_.runtime().robot_stop().CheckIsKnown({.asked = sent, .requests = {}});
  if (done) done = set_(changes);
  return {.successful = done.has_value(), .reason = done ? "" : Sentence(done.error())};
}

void ParameterServices::Run() noexcept {
  Octets octets;
  Time next_look{};
  while (!ends_) {
    Duration pause = kNoHurry;
    try {
      // One of each in turn: to set many may take long.
      bool is_left = false;
      for (const auto& each : servers_) {
        const auto request = ends_ ? std::nullopt : each->endpoints->Take();
        // What is no request has no answer.
        if (request && each->answer(*request, octets)) (void)each->endpoints->Reply(request->id, octets);
        each->endpoints->SendKept();
        is_left = is_left || each->endpoints->waiting() > 0;
      }
      const Time now = SteadyClock().Now();
      if (is_left && now < next_look) continue;
      next_look = now + kLookForChanges;
      TellChanges();
      if (is_left) continue;
      if (listeners_.load(std::memory_order_relaxed) > 0) pause = kLookForChanges;
    } catch (...) {
      log_.Error("parameters of ROS 2: {}", DescribeException());
      pause = kAfterFailure;  // requests may be left
    }
    if (!ends_) wake_->WaitUntil(SteadyClock().Now() + pause);
  }
}

std::map<std::string, RosParameterValue> ParameterServices::Values() const {
  std::map<std::string, RosParameterValue> values;
  const std::lock_guard lock(application_.runtime().structure_mutex());
  for (const auto& [name, found] : FindAll()) {
    values.emplace(name, ToRosParameter(found.parameter->type(), found.parameter->Value().get()));
  }
  return values;
}

// Who begins to listen is told what has changed since somebody listened last.
void ParameterServices::TellChanges() {
  if (listeners_.load(std::memory_order_relaxed) == 0) return;
  std::map<std::string, RosParameterValue> now = Values();
  RosParameterEvent event;
  event.stamp = SinceEpoch();
  event.node = node_;
  // By their octets: what is not a number is the same as before, too.
  const auto octets_of = [](const RosParameterValue& value) {
    Octets octets;
    Write(value, octets);
    return octets;
  };
  for (const auto& [name, value] : now) {
    const auto before = told_.find(name);
    if (before == told_.end()) event.new_parameters.push_back({name, value});
    if (before != told_.end() && octets_of(before->second) != octets_of(value))
      event.changed_parameters.push_back({name, value});
  }
  for (const auto& [name, value] : told_) {
    if (!now.contains(name)) event.deleted_parameters.push_back({name, value});
  }
  told_ = std::move(now);
  if (event.new_parameters.empty() && event.changed_parameters.empty() && event.deleted_parameters.empty()) return;
  const auto octets = std::make_shared<Octets>();
  Write(event, *octets);
  (void)events_->Write(octets, event.stamp.time_since_epoch().count());
}

}  // namespace runnel
