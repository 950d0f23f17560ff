// Ports that drive, and what stops them (Port::SetDriving(), Port::Block()), also in the place of another one.
#include "core/port/port_stop.h"

#include <chrono>
#include <mutex>

#include "core/base/retry.h"
#include "core/conversion/number_conversion.h"
#include "core/element/runtime.h"
#include "core/port/driving_ports.h"
#include "core/port/parameter_input.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"
#include "core/port/stop_link.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {
constexpr Duration kLongestBrake = std::chrono::seconds(10);
}  // namespace

Result<AnyValue> Port::FindSafeValue(const AnyValue& declared, DrivingKind command) const {
  const auto refuse = [&](std::string message) { return Error{.message = std::move(message), .path = path()}; };
  // What a velocity is read as while nothing comes may well move.
  const bool may_move =
      command == DrivingKind::kVelocity || DrivingKindByUnits(type_, unit()) == DrivingKind::kVelocity;
  const AnyValue given = declared || may_move ? declared : limits().default_value;
  if (given && &given.type() != &type_) {
    return refuse("its safe value is a " + given.type().name() + " and not a " + type_.name());
  }
  if (given && !type_.is_transparent()) return refuse("a " + type_.name() + " cannot be copied");
  if (given) return given;
  // What is only said to be a velocity may go to a place farther on.
  if (!IsVelocity(type_, unit()) || HasLists(type_)) {
    Error error = refuse("something moves by it, and it has no safe value");
    error.hint = "add safe=\"…\": the " + type_.name() + " at which it stands still";
    return error;
  }
  const std::shared_ptr<const void> zero = type_.Make();
  if (!zero) return refuse("only a module can make values of type " + type_.name());
  return AnyValue(type_, zero);
}

Result<DrivingKind> Port::FindDrivingKind(DrivingKind declared, const AnyValue& safe_value) const {
  const DrivingKind known = DrivingKindByUnits(type_, unit());
  // A unit of anything else, as the microseconds of a pulse, says little.
  const bool is_said_otherwise = known == DrivingKind::kPosition || known == DrivingKind::kVelocity;
  if (declared != DrivingKind::kUnspecified && is_said_otherwise && declared != known && internal::IsNumber(type_)) {
    return Error{.message = "is in " + unit() + ", which is that of a " + NameOf(known) + ", and is said to be a " +
                            NameOf(declared),
                 .path = path(),
                 .hint = "leave out what it is said to be"};
  }
  if (declared != DrivingKind::kUnspecified) return declared;
  if (known != DrivingKind::kUnspecified) return known;
  if (!HasNumbers(type_)) return IsZero(safe_value) ? DrivingKind::kEffort : DrivingKind::kPosition;
  return Error{.message =
                   "something moves by it, and neither a unit nor its module says whether it is a position, a velocity "
                   "or an effort",
               .path = path(),
               .hint = "add command=\"velocity\", say; or its module declares its unit"};
}

Result<void> Port::SetDriving(bool drives, AnyValue safe_value, std::optional<Duration> brake, DrivingKind command) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (!drives && declared_stop() != nullptr) {
    return Error{.message = "its module says that something moves by it", .path = path()};
  }
  if (!drives && !is_driving()) return {};
  if (auto may = CheckMayBeSet(*this); !may) return may;
  auto& state = internal::DrivingState::Of(*this);  // before anything is changed
  std::shared_ptr<const DrivingMark> mark;
  Result<void> set;
  if (drives) {
    mark = std::make_shared<const DrivingMark>(DrivingMark{std::move(safe_value), brake, command});
    auto whole = Complete(*mark, nullptr);
    if (!whole) return whole.error();
    set = SetStop(std::move(whole->safe_value), *whole->brake, whole->command, runtime().robot_stop().signal());
  } else {
    auto safe = FindSafeValue(safe_value, command);
    if (!safe) return safe.error();
    set = SetStop(std::move(*safe), {}, command, nullptr);
  }
  if (set) state = internal::DrivingState(std::move(mark));
  return set;
}

Result<DrivingMark> Port::Complete(DrivingMark mark, const PortStop* before) const {
  const PortStop* const declared = declared_stop();
  const PortStop* const rest = declared != nullptr ? declared : before;
  if (!mark.safe_value && rest != nullptr) mark.safe_value = rest->safe_value();
  if (!mark.brake) mark.brake = rest != nullptr ? rest->brake() : Duration{};
  // The unit of this one says more than that the other one's was any.
  const bool is_told = rest != nullptr && (rest == declared || rest->command() != DrivingKind::kEffort ||
                                           DrivingKindByUnits(type_, unit()) == DrivingKind::kUnspecified);
  if (mark.command == DrivingKind::kUnspecified && is_told) mark.command = rest->command();
  auto safe = FindSafeValue(mark.safe_value, mark.command);
  if (!safe) return safe.error();
  mark.safe_value = std::move(*safe);
  const auto command = FindDrivingKind(mark.command, mark.safe_value);
  if (!command) return command.error();
  mark.command = *command;
  return mark;
}

std::optional<DrivingMark> Port::FindMark() const {
  const auto said = internal::DrivingState::MarkOf(*this);
  const bool is_declared = declared_stop() != nullptr;
  if (!is_driving() || (is_declared && !said)) return {};
  DrivingMark mark = said ? *said : DrivingMark{};
  if (is_declared) return mark;
  // What is from a module that was in its place.
  const PortStop& now = *extras_->stop;
  const auto is_as_now = [&] {
    const auto whole = Complete(mark, nullptr);
    return whole && ToText(type_, whole->safe_value.get()) == ToText(type_, now.safe_value().get()) &&
           whole->brake == now.brake() && whole->command == now.command();
  };
  if (said && is_as_now()) return mark;
  return DrivingMark{now.safe_value(), now.brake(), now.command()};
}

Result<void> Port::Block() {
  const std::lock_guard lock(runtime().structure_mutex());
  if (auto may = CheckMayBeSet(*this); !may) return may;
  if (auto read = internal::CheckHasItsPlace(*this); !read) return read;
  if (!extras_ || !extras_->stop) {
    auto safe = FindSafeValue({}, DrivingKind::kUnspecified);
    if (!safe) return safe.error();
    if (auto set = SetStop(std::move(*safe), Duration{}, DrivingKind::kUnspecified, nullptr); !set) return set;
  }
  extras_->blocked_since = SteadyClock().Now();
  if (extras_->stop->block()->Press()) TellOfChange();
  return {};
}

bool Port::Unblock() {
  const std::lock_guard lock(runtime().structure_mutex());
  if (!is_blocked()) return false;
  BeginMotionAnew();  // before it counts what is made from then on
  if (!extras_->stop->block()->Release([this] { return runtime().clock().Now(); })) return false;
  TellOfChange();
  return true;
}

bool Port::is_driving() const noexcept { return extras_ && extras_->stop && extras_->stop->robot(); }
bool Port::is_blocked() const noexcept { return extras_ && extras_->stop && extras_->stop->block()->in_force(); }
Time Port::blocked_since() const noexcept { return extras_ ? extras_->blocked_since : Time(); }
std::shared_ptr<const PortStop> Port::stop() const noexcept { return extras_ ? extras_->stop : nullptr; }

Result<void> Port::SetStop(AnyValue safe_value, Duration brake, DrivingKind command,
                           std::shared_ptr<StopSignal> robot) {
  // Readers must be able to hold a value of the type.
  const auto channel = internal::MakeChannelFor(type_);
  if (!channel) return CannotPublish("only a module can make values of its type");
  if (brake > kLongestBrake) {
    return Error{.message = "would take longer than 10 s to brake",
                 .path = path(),
                 .hint = "a STOP has to stop; give the time it needs"};
  }
  if (brake > Duration{} && !internal::StopLink::CanBrake(safe_value, *channel)) {
    return Error{
        .message = "cannot brake: a " + type_.name() + " is larger than 32 bytes, or a part of it is no number",
        .path = path(),
        .hint = "leave out how long it brakes; its safe value is in force at once then"};
  }
  auto stop = std::make_shared<PortStop>(std::move(safe_value), brake, command, std::move(robot), this->stop().get());
  auto before = std::exchange(Extras().stop, std::move(stop));
  try {
    RebindSinks();
  } catch (...) {
    extras_->stop = std::move(before);
    Retry([&] { RebindSinks(); });
    throw;
  }
  TellOfChange();
  return {};
}

// Also of what is covered by a value by hand: that does not take a stop away.
std::vector<internal::PassedStop> internal::PassedStops(const Port& port) {
  std::vector<PassedStop> stops;
  if (auto own = port.stop()) stops.push_back({own, own->safe_value()});
  for (const Port* from : port.incoming()) {
    const Connection* const edge = from->ConnectionTo(port);
    for (PassedStop& each : PassedStops(*from)) {
      if (std::ranges::find(stops, each.stop, &PassedStop::stop) != stops.end()) continue;
      if (edge->converted) {
        const std::shared_ptr<void> value = port.type().Make();
        if (!value) continue;
        // What becomes nothing leaves the value as it is made.
        (void)edge->converted->conversion()(each.safe_value.get(), value.get());
        each.safe_value = AnyValue(port.type(), value);
      }
      stops.push_back(std::move(each));
    }
  }
  return stops;
}

namespace {

constexpr const char* kDeclare = "have the new module declare that it drives, with its safe value";

// Whether the safe value of `from` would be that of something else: the command of another unit, a zero that has become a position.
bool MeansOther(const Port& port, const Port& from, const AnyValue& safe_value, DrivingKind command) {
  const bool is_position = DrivingKindByUnits(port.type(), port.unit()) == DrivingKind::kPosition;
  return !port.unit().empty() && port.unit() != from.unit() && (is_position || !IsSafeInAnyUnit(safe_value, command));
}

}  // namespace

// What stops this port in the place of the other: what has been said of the place, then what its own module declares, then what
// it had if it was there before, else what stopped the other. With the block of the place. An interface port is that of a plain
// group, or of a composite that moves nothing: what is set of it goes over as it is.
Result<std::shared_ptr<const PortStop>> Port::StopInPlaceOf(const Port& from) const {
  const std::shared_ptr<const PortStop> before = from.stop();
  if (is_proxy() || from.is_proxy()) return before;
  const auto mark = internal::DrivingState::MarkOf(from);
  const auto* const state = FindAnnotation<internal::DrivingState>();
  const bool comes_back = state != nullptr && state->is_replaced && state->mark == mark;
  // Its plugin may have been loaded anew meanwhile: what its module declares now counts.
  const bool is_declared = declared_stop() != nullptr;
  const auto with_block = [&](const AnyValue& safe, Duration brake, DrivingKind command,
                              std::shared_ptr<StopSignal> robot) {
    return std::make_shared<const PortStop>(safe, brake, command, std::move(robot), before.get());
  };
  const auto refuse = [&](const AnyValue& safe, std::string hint) {
    return Error{.message = "is in " + unit() + ", and its safe value, " + ToText(type(), safe.get()) + ", is not",
                 .hint = std::move(hint)};
  };
  // Where nothing else is known of its place: of its own unit.
  const auto stopped = [&](const PortStop& by,
                           const std::shared_ptr<StopSignal>& robot) -> Result<std::shared_ptr<const PortStop>> {
    const auto safe = FindSafeValue({}, DrivingKind::kUnspecified);
    const bool is_other = !safe && MeansOther(*this, from, by.safe_value(), by.command());
    const bool is_rolled_back = comes_back && !state->is_later;
    if (is_other && (!by.in_force() || is_rolled_back)) return std::shared_ptr<const PortStop>();
    if (is_other) {
      return refuse(by.safe_value(), by.block()->in_force() ? "release its block first" : "release STOP first");
    }
    return with_block(safe ? *safe : by.safe_value(), {}, robot ? by.command() : DrivingKind::kUnspecified, robot);
  };
  const std::shared_ptr<const PortStop> drove = before && before->robot() ? before : nullptr;
  auto farther_up = internal::PassedStops(from);
  std::erase_if(farther_up,
                [&](const internal::PassedStop& each) { return each.stop == before || !each.stop->robot(); });
  if (!is_declared && comes_back) {
    const PortStop* const had = state->stop_before.get();
    if (had != nullptr) return with_block(had->safe_value(), had->brake(), had->command(), had->robot());
    // What nobody has said to drive is not let go of while it is stopped.
    if (state->is_later && drove && drove->robot()->in_force() && farther_up.empty())
      return stopped(*drove, drove->robot());
    if (before && before->block()->in_force()) return stopped(*before, nullptr);
    return std::shared_ptr<const PortStop>();
  }
  for (const internal::PassedStop& each : farther_up) {
    if (!comes_back && MeansOther(*this, from, each.safe_value, each.stop->command()))
      return refuse(each.safe_value, kDeclare);
  }
  if (!is_declared && !drove) {
    return before && MeansOther(*this, from, before->safe_value(), before->command()) ? stopped(*before, nullptr)
                                                                                      : before;
  }
  const DrivingMark said = mark ? *mark : DrivingMark{};
  auto whole = Complete(said, drove.get());
  if (!whole) return whole.error();
  const bool is_its_own = is_declared && !said.safe_value;
  if (!is_its_own && !comes_back && MeansOther(*this, from, whole->safe_value, whole->command)) {
    return refuse(whole->safe_value, said.safe_value
                                         ? "the application says the safe value of the place: correct its <driving>"
                                         : kDeclare);
  }
  const bool is_as_before = before && before->robot() && whole->safe_value.get() == before->safe_value().get() &&
                            whole->brake == before->brake() && whole->command == before->command();
  if (is_as_before) return before;
  return with_block(whole->safe_value, *whole->brake, whole->command, runtime().robot_stop().signal());
}

}  // namespace runnel
