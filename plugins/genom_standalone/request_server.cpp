#include "plugins/genom_standalone/request_server.h"

#include <algorithm>
#include <limits>

#include "core/base/nearest_name.h"

namespace runnel::genom_standalone {

using genom_execution::Engine;
using genom_execution::Request;
using genom_execution::ServiceTable;

namespace {

constexpr LineServer::Client kNobody = -1;
constexpr std::int64_t kMostPieces = 100'000;  // of a step, while nobody else is heard
constexpr int kDeepest = 100;  // lists and objects inside of one another, which are walked through by recursion

// What the engine's own exceptions have with them.
Json Words(const genom_execution::Outcome& outcome) {
  Json words = Json::object();
  const auto names = outcome.word_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (outcome.words()[i] != nullptr) words[names[i]] = outcome.words()[i];
  }
  return words;
}

// The details of exceptions that every component has, by their names.
const ValueType kCode{.kind = ValueKind::kLong};
const ValueType kWords{.kind = ValueKind::kText, .length = 128};
const ValueMember kCodeMember[] = {{"code", 0, &kCode}};
const ValueMember kWhatMember[] = {{"what", 0, &kWords}};
const ValueType kSystemError{.kind = ValueKind::kStruct, .members = kCodeMember};
const ValueType kUnknown{.kind = ValueKind::kStruct, .members = kWhatMember};

const ValueType* DetailType(const StandaloneComponent& component, genom_execution::Event exception) {
  for (const StandaloneDetail& each : component.details) {
    if (each.exception == exception) return each.type;
  }
  if (exception == std::string_view("::genom::syserr")) return &kSystemError;
  const bool has_words =
      exception == std::string_view("::genom::unkex") || exception == genom_execution::kMiddlewareError;
  return has_words ? &kUnknown : nullptr;
}

}  // namespace

RequestServer::RequestServer(const StandaloneComponent& component, Engine& engine, LineServer& lines,
                             std::function<Time(Duration)> step)
    : component_(component), engine_(engine), lines_(lines), step_(std::move(step)) {}

void RequestServer::Take(LineServer::Client client, const std::string& line) {
  try {
    TakeObject(client, line);
  } catch (const std::exception& error) {  // no memory, as a rule; the component goes on
    lines_.Send(client, Json{{"error", std::string("cannot be done: ") + error.what()}}.dump());
  }
}

void RequestServer::TakeObject(LineServer::Client client, const std::string& line) {
  if (line.find_first_not_of(" \t\r") == std::string::npos) return;
  bool is_too_deep = false;
  const auto keeps = [&](int depth, Said::parse_event_t, Said&) { return !(is_too_deep |= depth > kDeepest); };
  const Said json = Said::parse(line, keeps, false);
  Json answer = Json::object();
  if (json.is_object() && json.contains("as")) answer["as"] = Json(json["as"]);
  if (!json.is_object() || is_too_deep) {
    answer["error"] =
        is_too_deep ? "is nested deeper than " + std::to_string(kDeepest) + " levels" : "is no object in JSON";
    return lines_.Send(client, answer.dump());
  }
  const auto done = Do(client, json);
  Answer();
  if (done && done->is_discarded()) return;  // is answered later
  if (done) {
    answer["done"] = *done;
  } else {
    answer["error"] = done.error().ToString();
  }
  lines_.Send(client, answer.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Result<Json> RequestServer::Do(LineServer::Client client, const Said& line) {
  if (line.contains("call") || line.contains("abort")) return Begin(client, line);
  if (line.contains("put")) return Put(line["put"]);
  if (line.contains("get")) return Get(line["get"]);
  if (line.contains("state")) return State();
  if (line.contains("describe")) return Description();
  if (line.contains("kill")) {
    engine_.Stop();
    lines_.Wake();
    return Json::object();
  }
  if (line.contains("step")) return Step(line);
  return Error{.message = "says nothing that is to be done",
               .hint = "say one of 'call', 'abort', 'put', 'get', 'state', 'describe', 'step', 'kill'"};
}

Result<Json> RequestServer::Step(const Said& line) {
  if (step_ == nullptr)
    return Error{.message = "the component has a clock of its own", .hint = "start it with --stepped"};
  if (!line["step"].is_number() || line["step"].get<double>() < 0)
    return Error{.message = "'step' is a number of seconds"};
  Duration left = FromSeconds(line["step"].get<double>());
  if (left > kFarthest - time_.time_since_epoch()) return Error{.message = "time goes on for 146 years at most"};
  Duration piece = left;
  if (line.contains("every")) {
    if (line["every"].is_number()) piece = FromSeconds(line["every"].get<double>());
    if (!line["every"].is_number() || piece <= Duration::zero())
      return Error{.message = "'every' is a number of seconds, and not 0"};
  }
  if (piece > Duration::zero() && left / piece > kMostPieces)
    return Error{.message = "these are more than " + std::to_string(kMostPieces) + " pieces",
                 .hint = "make several steps"};
  do {
    time_ = step_(std::min(left, piece));
    left -= std::min(left, piece);
  } while (left > Duration::zero());
  return Json{{"time", ToSeconds(time_)}};
}

Result<std::size_t> RequestServer::FindService(const std::string& name) const {
  const auto& services = component_.table.services;
  const auto found = std::ranges::find_if(services, [&](const ServiceTable& each) { return each.name == name; });
  if (found != services.end()) return static_cast<std::size_t>(found - services.begin());
  return Error{.message = "there is no service '" + name + "'",
               .hint = NearestNameHint(name, NamesOf(services, &ServiceTable::name))};
}

Result<Json> RequestServer::Begin(LineServer::Client client, const Said& line) {
  Call call{.client = client,
            .as = line.contains("as") ? Json(line["as"]) : Json(),
            .service = component_.table.services.size(),
            .request = nullptr};
  if (line.contains("abort")) {
    if (!line["abort"].is_number_unsigned() ||
        line["abort"].get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
      return Error{.message = "'abort' is the id of an activity"};
    }
    call.request = std::make_unique<Request>(component_.table, Engine::AbortService());
    call.request->abort_id = line["abort"].get<std::uint32_t>();
  } else {
    if (!line["call"].is_string()) return Error{.message = "'call' is the name of a service"};
    const auto service = FindService(line["call"].get<std::string>());
    if (!service) return service.error();
    call.service = *service;
    call.request = std::make_unique<Request>(component_.table, component_.table.services[*service]);
    const Said with = line.contains("with") ? line["with"] : Said::object();
    if (auto filled = Fill(component_.services[*service], call.request->data(), with); !filled) return filled.error();
  }
  call.request->client = &lines_;
  call.request->on_change = [](void* lines) { static_cast<LineServer*>(lines)->Wake(); };
  calls_.push_back(std::move(call));
  if (engine_.Send(*calls_.back().request)) return Json(Json::value_t::discarded);
  calls_.pop_back();
  return Error{.message = "too many requests wait"};
}

Result<void> RequestServer::Fill(const StandaloneService& service, void* data, const Said& with) {
  if (!with.is_object()) return Error{.message = "'with' is an object of parameters"};
  for (const auto& [name, value] : with.items()) {
    const auto is_it = [&name = name](const auto& each) { return each.is_input && each.name == name; };
    const bool is_one = std::ranges::any_of(service.parameters, is_it);
    if (!is_one) {
      return Error{.message = "there is no input '" + name + "'",
                   .hint = NearestNameHint(name, NamesOf(service.parameters, &StandaloneParameter::name))};
    }
  }
  for (const StandaloneParameter& each : service.parameters) {
    void* const value = static_cast<std::byte*>(data) + each.offset;
    if (!each.is_input) continue;
    const std::string_view initial = each.initial;
    if (!with.contains(each.name) && initial.empty()) return Error{.message = "is not given", .path = each.name};
    if (!initial.empty()) {
      auto read = FromJson(*each.type, Said::parse(initial, nullptr, false), value, each.name);
      if (!read && !with.contains(each.name)) return read;
    }
    if (!with.contains(each.name)) continue;
    auto read = FromJson(*each.type, with[each.name], value, each.name);
    if (read && initial.empty()) read = CheckAllAreSaid(*each.type, with[each.name], each.name);
    if (!read) return read;
  }
  return {};
}

Result<std::shared_ptr<StandalonePort>> RequestServer::FindPort(const std::string& name, bool is_to_be_made) {
  const std::string first = name.substr(0, name.find('/'));
  const auto found = std::ranges::find_if(component_.ports, [&](const auto& each) { return each.name == first; });
  if (found == component_.ports.end()) {
    return Error{.message = "there is no port '" + first + "'",
                 .hint = NearestNameHint(first, NamesOf(component_.ports, &StandalonePortEntry::name))};
  }
  if (found->port != nullptr && first == name)
    return std::shared_ptr<StandalonePort>(std::shared_ptr<void>(), found->port);
  if (found->port != nullptr || first == name) {
    return Error{.message = found->port != nullptr ? "is no multiple port" : "is a multiple port",
                 .path = first,
                 .hint = found->port != nullptr ? "leave out what is behind the /" : "say which: " + first + "/NAME"};
  }
  const std::string element = name.substr(first.size() + 1);
  if (is_to_be_made && found->ports->is_input()) return found->ports->Open(element);
  if (auto port = found->ports->Find(element)) return port;
  return Error{.message = "is not open", .path = name};
}

Result<Json> RequestServer::Put(const Said& values) {
  if (!values.is_object()) return Error{.message = "'put' is an object of ports and values"};
  for (const auto& [name, json] : values.items()) {
    const auto port = FindPort(name, true);
    if (!port) return port.error();
    if (!(*port)->is_input()) return Error{.message = "is an output", .path = name};
    OwnedValue value((*port)->type());
    if (auto read = FromJson((*port)->type(), json, value.data(), name); !read) return read.error();
    (*port)->Put(value.data());
  }
  return Json::object();
}

Result<Json> RequestServer::Get(const Said& name) {
  if (!name.is_string()) return Error{.message = "'get' is the name of a port"};
  const auto port = FindPort(name.get<std::string>(), false);
  if (!port) return port.error();
  return (*port)->WithNewest(
      [&](const void* value) { return value != nullptr ? ToJson((*port)->type(), value) : Json(nullptr); });
}

Json RequestServer::State() {
  Json activities = Json::array(), tasks = Json::array();
  for (const Call& each : calls_) {
    const std::string state = each.request->doing();
    if (each.request->id() != 0)
      activities.push_back({{"id", each.request->id()}, {"service", each.request->service().name}, {"state", state}});
  }
  for (auto& each : engine_.tasks()) {
    const auto figures = each.figures();
    tasks.push_back({{"name", each.table().name}, {"cycles", figures.cycles}, {"longest", ToSeconds(figures.longest)}});
  }
  return {{"component", component_.table.name},
          {"version", component_.table.version},
          {"digest", component_.table.digest},
          {"activities", activities},
          {"tasks", tasks}};
}

Json RequestServer::Description() const {
  Json services = Json::array(), ports = Json::array();
  for (std::size_t i = 0; i < component_.services.size(); ++i) {
    Json inputs = Json::array(), outputs = Json::array();
    for (const StandaloneParameter& each : component_.services[i].parameters) {
      if (each.is_input) inputs.push_back(each.name);
      if (each.is_output) outputs.push_back(each.name);
    }
    services.push_back({{"name", component_.table.services[i].name}, {"inputs", inputs}, {"outputs", outputs}});
  }
  for (const StandalonePortEntry& each : component_.ports) {
    const bool is_input = each.port != nullptr ? each.port->is_input() : each.ports->is_input();
    ports.push_back(
        {{"name", each.name}, {"direction", is_input ? "in" : "out"}, {"is_multiple", each.port == nullptr}});
  }
  return {{"services", services}, {"ports", ports}};
}

Json RequestServer::Ending(const Call& call) const {
  const auto& outcome = call.request->outcome();
  Json answer = Json::object();
  if (!call.as.is_null()) answer["as"] = call.as;
  if (!outcome.is_success()) {
    std::string name = outcome.exception();
    answer["failed"] = name.starts_with("::") ? name.substr(2) : name;
    const ValueType* const type = DetailType(component_, outcome.exception());
    answer["detail"] =
        type != nullptr && outcome.detail() != nullptr ? ToJson(*type, outcome.detail()) : Words(outcome);
    return answer;
  }
  answer["done"] = Json::object();
  if (call.service == component_.services.size()) return answer;
  for (const StandaloneParameter& each : component_.services[call.service].parameters) {
    if (each.is_output)
      answer["done"][each.name] = ToJson(*each.type, static_cast<std::byte*>(call.request->data()) + each.offset);
  }
  return answer;
}

void RequestServer::Answer() {
  for (auto call = calls_.begin(); call != calls_.end();) {
    const Request::State state = call->request->state();
    if (!call->is_accepted && call->request->id() != 0 &&
        (state == Request::State::kAccepted || state == Request::State::kDone)) {
      call->is_accepted = true;
      Json answer = Json::object();
      if (!call->as.is_null()) answer["as"] = call->as;
      answer["accepted"] = call->request->id();
      lines_.Send(call->client, answer.dump());
    }
    if (state != Request::State::kDone) {
      ++call;
      continue;
    }
    lines_.Send(call->client, Ending(*call).dump(-1, ' ', false, Json::error_handler_t::replace));
    call = calls_.erase(call);
  }
}

bool RequestServer::IsAwaitedBy(LineServer::Client client) const {
  return std::ranges::any_of(calls_, [&](const Call& each) { return each.client == client; });
}

// What it has asked for goes on.
void RequestServer::ClientIsGone(LineServer::Client client) {
  for (Call& each : calls_) {
    if (each.client == client) each.client = kNobody;
  }
}

}  // namespace runnel::genom_standalone
