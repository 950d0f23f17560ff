// Ports that drive, and what stops them (Port::SetDriving(), Port::Block()).

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

}  // namespace runnel
