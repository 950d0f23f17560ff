#include "plugins/network/network_ports.h"

#include <algorithm>
#include <utility>

#include "core/base/retry.h"
#include "core/conversion/conversion.h"
#include "core/paths/late_connections.h"
#include "core/port/probe_port.h"
#include "core/types/builtin_types.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

// Of its type nothing can be said of what is to become it.
bool TakesAnything(const TypeInfo& type) {
  return &type == &runnel::TypeOf<Signal>() || &type == &runnel::TypeOf<std::string>();
}

Result<void> CheckEdge(const DistantType& from, const Connection& edge) {
  const Port& to = *edge.to;
  if (dynamic_cast<const ProbePort*>(&to) != nullptr) return {};
  if (from.type == &to.type() && edge.options.part.empty() && edge.options.convert.empty()) return {};
  const auto found =
      Conversion::Find({*from.type, to.type(), edge.options.part, edge.options.convert, from.unit, to.unit()});
  return found ? Result<void>() : found.error();
}

}  // namespace

NetworkPorts* NetworkPorts::Of(const NetworkElement& network) {
  auto* const ports = dynamic_cast<NetworkPorts*>(DistantPorts::FindIn(network));
  return ports != nullptr && ports->network_ == &network ? ports : nullptr;
}

const NetworkElement::Take* NetworkPorts::FindTake(std::string_view path) const {
  if (network_ == nullptr || !SplitPortPath(path).part.empty()) return nullptr;
  const auto& takes = network_->takes();
  const auto found =
      std::ranges::find(takes, TopicOfDistantPath(path), [](const auto& each) { return each.options.topic; });
  return found == takes.end() ? nullptr : &*found;
}

Port* NetworkPorts::Find(std::string_view path) const {
  const NetworkElement::Take* const take = FindTake(path);
  return take == nullptr || take->is_over ? nullptr : take->output;
}

OfferedType NetworkPorts::Ask(const std::string& path, const TypeInfo* expected) const {
  if (!find_type_) return {.type = {.why_not = "the network does not run, which says what values it has"}};
  OfferedType offered = find_type_(path, expected);
  if (expected == nullptr || offered.message.empty() || network_ == nullptr) return offered;
  const auto form = ValueForm::Make(*expected, offered.message, {}, {}, network_->options().messages.get());
  if (form && (*form)->codec->why_no_decoding().empty()) offered.type.type = expected;
  return offered;
}

DistantType NetworkPorts::TypeOf(std::string_view path) const {
  const Port* const known = Find(path);
  return Ask(std::string(path), known != nullptr ? &known->type() : nullptr).type;
}

TakeOptions NetworkPorts::OptionsOf(const std::string& path) const {
  return {.topic = TopicOfDistantPath(path),
          .keeps_stamps = true,
          .is_distant = true,
          .is_live = network_->options().is_live,
          .position = network_->options().position};
}

Result<Port*> NetworkPorts::MakeOutput(const std::string& path, const OfferedType& offered) {
  TakeOptions options = OptionsOf(path);
  options.as = offered.message;
  const auto made = network_->AddTake(options, *offered.type.type, offered.type.unit);
  // It is taken, and without its path would be saved as another one.
  if (made) Retry([&] { (*made)->Annotate(std::make_unique<DistantPort>(path)); });
  return made;
}

Result<Port*> NetworkPorts::Make(std::string_view path, const Port& to, const ConnectOptions& options) {
  if (network_ == nullptr) return Error{.message = "the application with the network has gone"};
  const NetworkElement::Take* const take = FindTake(path);
  Port* const known = take != nullptr ? take->output : nullptr;
  const bool makes_room = known != nullptr && known->outgoing().empty() && &known->type() != &to.type();
  if (known != nullptr && !makes_room) return known;
  const std::string whole(path);
  // Of a unit nothing may be guessed: numbers of another one would be taken for it until that is told.
  const bool is_plain =
      options.part.empty() && options.convert.empty() && to.unit().empty() && !TakesAnything(to.type());
  OfferedType offered = Ask(whole, &to.type());
  if (!offered.message.empty() && !is_plain) offered.type.type = nullptr;
  if (known != nullptr) {
    if (offered.type.type == &known->type() && offered.type.unit == known->unit()) return known;
    network_->GiveUp(*known);
    return nullptr;
  }
  if (offered.type.type != nullptr) return MakeOutput(whole, offered);
  if (offered.is_offered) return Error{.message = "cannot be connected: " + offered.type.why_not, .path = whole};
  if (is_plain) return MakeOutput(whole, {.type = {.type = &to.type()}});
  if (const auto live = network_->CheckLiveness(OptionsOf(whole)); !live) return live.error();
  return nullptr;
}

Result<void> NetworkPorts::MakeAwaited(const std::string& path) {
  if (network_ == nullptr || Find(path) != nullptr) return {};
  const OfferedType offered = Ask(path, nullptr);
  if (offered.type.type == nullptr) return {};
  const auto made = MakeOutput(path, offered);
  return made ? Result<void>() : made.error();
}

std::optional<OfferedType> NetworkPorts::OtherType(const NetworkElement::Take& take, std::string& why_not) const {
  const Port& output = *take.output;
  const std::string& path = DistantPathOf(output);
  if (!take.options.is_distant || path.empty()) return {};
  OfferedType told = Ask(path, &output.type());
  if (take.is_over && output.outgoing().empty()) return OfferedType{};
  if (told.type.type == nullptr) return {};
  if (told.type.type == &output.type() && told.type.unit == output.unit() && told.message == take.options.as) return {};
  for (const Connection& each : output.outgoing()) {
    const auto possible = CheckEdge(told.type, each);
    if (possible) continue;
    why_not = each.to->path() + ": " + possible.error().message +
              (possible.error().hint.empty() ? "" : "; " + possible.error().hint);
    return {};
  }
  return told;
}

Result<void> NetworkPorts::Renew(Port& output, const OfferedType& type, UnlistedElement& gone) {
  const std::string path = DistantPathOf(output);
  const std::vector<Connection> edges = output.outgoing();
  auto dropped = network_->DropTake(output);
  if (dropped) gone = std::move(*dropped);
  LateConnections& late = LateConnections::Of(network_->runtime());
  late.LookAgain();  // at those that it knows already
  for (const Connection& each : edges) {
    const bool is_of_somebody = dynamic_cast<const ProbePort*>(each.to) != nullptr;  // who looks for what is there now
    if (is_of_somebody || late.Find(path, each.to->path()) != nullptr) continue;
    if (const auto noted = late.Add(path, each.to->path(), each.options); !noted) return noted;
  }
  if (!dropped) return dropped.error();
  if (type.type.type == nullptr) return {};
  const auto made = MakeOutput(path, type);
  return made ? Result<void>() : made.error();
}

}  // namespace runnel
