// What stops a port in the place of another one.

#include <algorithm>
#include <utility>

#include "core/element/runtime.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"

namespace runnel {

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
