#include "plugins/supervision/stop_button.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/conversion/number_conversion.h"
#include "core/paths/path_search.h"
#include "core/port/driving_ports.h"
#include "core/port/input_base.h"
#include "core/port/probe_port.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

bool IsSet(const Port& port) { return port.is_set_by_hand() || port.is_set_by_hand(Port::Setter::kRule); }

// The output of the driver whose button alone is heard by the port, as it is; nullptr: nothing is connected.
Result<const Port*> FindButton(const Port& port) {
  const auto refuse = [](const Port& at, std::string message) {
    return Error{
        .message = std::move(message), .path = at.path(), .hint = "name the output of the button's own driver"};
  };
  const Port* at = &port;
  while (at->is_proxy() || at->direction() == Port::Direction::kInput) {
    if (at->incoming().empty()) return nullptr;
    if (at->incoming().size() > 1) return refuse(*at, "cannot release the STOP, as several buttons press by it");
    const Port* const from = at->incoming().front();
    if (from->ConnectionTo(*at)->converted)
      return refuse(*at, "cannot release the STOP, as what comes to it is converted");
    at = from;
  }
  const auto* const elsewhere = at->FindAnnotation<WritersElsewhere>();
  if (elsewhere != nullptr && *elsewhere->count > 1)
    return refuse(*at, "cannot release the STOP, as several write to it");
  const Port* read = nullptr;
  VisitSiblings(*at, Port::Direction::kInput, [&](const Port& each) {
    const auto* const input = dynamic_cast<const InputBase*>(&each);
    const Ageing ageing = input != nullptr ? input->ageing() : Ageing::kUnspecified;
    if (ageing != Ageing::kSetOnce && (!each.incoming().empty() || IsSet(each))) read = &each;
  });
  if (read != nullptr) return refuse(*at, "cannot release the STOP, as its module makes it of " + read->path());
  return at;
}

}  // namespace

Result<void> CheckStopButton(const Port& port, bool releases) {
  if (!internal::IsNumber(port.type())) {
    return Error{.message = "cannot be a stop button, as it sends a " + port.type().name(),
                 .path = port.path(),
                 .hint = "a button sends bool, true while it is pressed, or a number"};
  }
  const auto button = FindButton(port);
  return releases && !button ? Result<void>(button.error()) : Result<void>();
}

namespace internal {

namespace {
constexpr Duration kLookForPort = std::chrono::milliseconds(50);
constexpr Duration kLookAgain = std::chrono::milliseconds(10);
constexpr Duration kStuckAfter = std::chrono::seconds(1);

/// Why nobody can press by a port, one sentence for each place on the way to it.
class WayToButton {
 public:
  /// `fed`: how many connections the ports on the way have had at most. Which port it was need not be known: who renames or
  /// replaces it finds the connections, or does not.
  WayToButton(const Scheduler& scheduler, std::map<std::string, std::size_t>& fed, const Port& port)
      : scheduler_(scheduler), fed_(fed) {
    Look(port);
  }
  std::set<std::string> lacks;

 private:
  void Look(const Port& port) {
    if (!seen_.insert(&port).second) return;
    if (IsSet(port)) lacks.insert(port.path() + " is set by hand, or by a rule");
    const bool is_output = port.direction() == Port::Direction::kOutput && !port.is_proxy();
    if (is_output) return LookAtModule(port);
    std::size_t& most = fed_[port.path()];
    most = std::max(most, port.incoming().size());
    if (port.incoming().empty()) {
      lacks.insert("nothing is connected to " + port.path());
    } else if (port.incoming().size() < most) {
      lacks.insert(
          fmt::format("{} of {} connections to {} are gone", most - port.incoming().size(), most, port.path()));
    }
    for (const Port* each : port.incoming()) Look(*each);
  }
  void LookAtModule(const Port& output) {
    const auto* const elsewhere = output.FindAnnotation<WritersElsewhere>();
    if (elsewhere != nullptr && *elsewhere->count == 0) lacks.insert("nobody writes to " + output.path());
    const std::string why = scheduler_.WhyAtRest(output, kStuckAfter);
    if (!why.empty()) lacks.insert(why);
    std::vector<const Port*> passed;
    bool is_fed = false;
    VisitSiblings(output, Port::Direction::kInput, [&](const Port& each) {
      const auto* const input = dynamic_cast<const InputBase*>(&each);
      const bool is_passed = input != nullptr && &each.type() == &output.type() &&
                             (input->ageing() == Ageing::kPassedOn || input->ageing() == Ageing::kTimesOut);
      if (!is_passed) return;
      passed.push_back(&each);
      is_fed = is_fed || WasFed(each);
    });
    for (const Port* each : passed) {
      if (!is_fed || WasFed(*each)) Look(*each);  // not all of a choice need be fed
    }
  }
  [[nodiscard]] bool WasFed(const Port& input) const {
    return !input.incoming().empty() || IsSet(input) || fed_.contains(input.path());
  }

  const Scheduler& scheduler_;
  std::map<std::string, std::size_t>& fed_;
  std::set<const Port*> seen_;
};
}  // namespace

/// Beside the tree, as no part of the application.
class ButtonElement final : public FrameworkElement {
 public:
  ButtonElement(FrameworkElement& root, const TypeInfo& type)
      : FrameworkElement(Placement{root, "stop_button", false}), probe(*this, "pressed", type) {}
  ProbePort probe;
};

StopButton::StopButton(Runtime& runtime, const Scheduler& scheduler, StopButtonRule rule, Tell tell)
    : runtime_(runtime), scheduler_(scheduler), rule_(std::move(rule)), tell_(std::move(tell)) {
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    Port& port = **PathSearch(runtime_).FindPort(rule_.port, PathKind::kOutput);
    element_ = std::make_unique<ButtonElement>(runtime_.root(), port.type());
    // The first time it makes what it sleeps on, which takes the lock: not in the thread, which waits for no lock.
    (void)element_->probe.Wait(Duration(1));
    (void)Port::Connect(port, element_->probe);
    if (const auto button = FindButton(port)) button_ = *button;
  }
  thread_ = std::thread([this] { Work(); });
}

StopButton::~StopButton() {
  ends_.store(true);
  thread_.join();
}

void StopButton::Work() {
  while (!ends_.load()) {
    try {
      Look();
    } catch (...) {  // for lack of memory; the next look finds what this one has not
      std::this_thread::sleep_for(kLookAgain);
    }
  }
}

void StopButton::Look() {
  (void)element_->probe.Wait(kLookForPort);
  TakeValues();
  if (down_ && !is_set_by_hand_ && !runtime_.robot_stop().in_force())
    Press({rule_.port});  // somebody else has released it
  if (!LookForPort()) return;
  const auto let_go = std::exchange(let_go_, {});
  if (!let_go || !rule_.releases) return;
  const std::string why = lacks_.empty() ? why_not_ : *lacks_.begin();
  if (!why.empty()) return TellOfHeldStop(why);  // by whatever else it may have become 0
  // A STOP that somebody has pressed since it was let go stays.
  if (!runtime_.robot_stop().Release(rule_.port, *let_go)) return;
  tell_({rule_.port, "the STOP is released by its button", runtime_.clock().Now(), false, true});
}

void StopButton::TakeValues() {
  bool is_old = false;
  const auto look = [&](const void* value, ValueTimes times) {
    const std::uint64_t source = element_->probe.last_source();
    if (NumberIn(element_->probe.type(), value) != 0) {
      Press({rule_.port});
      let_go_.reset();
      down_ = Down{source, times};
      return;
    }
    // Letting go releases, not being up: others may have pressed. Nor does the end of a value by hand: that is another source.
    if (!down_ || down_->source != source) return;
    // Who only says that nothing has come any more, as by a time-out, bears the stamp of what came last. A clock may stand.
    const ValueTimes pressed = std::exchange(down_, {})->times;
    let_go_by_ = source;
    if (times.timestamp > pressed.timestamp || times.publication_time == pressed.publication_time) {
      let_go_ = runtime_.robot_stop().AsOfNow();
      // What was held up on its way is older than what others have pressed since.
      if (let_go_->requests != pressed_)
        let_go_->asked = SteadyClock().Now() - (runtime_.clock().Now() - times.timestamp);
    } else {
      is_old = true;
    }
  };
  while (element_->probe.Take(look)) {
  }
  if (is_old && rule_.releases) TellOfHeldStop("its 0 bears the time of what was pressed");
  const std::uint64_t dropped = element_->probe.dropped();
  if (dropped != std::exchange(dropped_, dropped)) Press({rule_.port, ", of which values were lost"});
}

// Whoever has the structure lock is not waited for.
bool StopButton::LookForPort() {
  const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
  if (!lock) return false;
  const auto& sources = element_->probe.incoming();
  if (!sources.empty()) {
    rule_.port = sources.front()->path();
    is_gone_ = false;
    WayToButton way(scheduler_, fed_, *sources.front());
    bool is_down = false;
    const auto look = [&](const void* value, ValueTimes) {
      is_down = is_down || NumberIn(element_->probe.type(), value) != 0;
    };
    for (const Port* each : sources.front()->ShownPorts()) each->VisitLatest(look);
    is_set_by_hand_ = sources.front()->is_set_by_hand();
    if (down_ && !element_->probe.IsFedBy(down_->source)) down_.reset();  // a value by hand has ended
    if (is_down && !is_set_by_hand_ && !runtime_.robot_stop().in_force()) Press({rule_.port});
    for (const std::string& each : way.lacks) {
      if (!lacks_.contains(each)) Press({rule_.port, ", as ", each});
    }
    if (!way.lacks.empty()) down_.reset();
    lacks_ = std::move(way.lacks);
    const auto found = FindButton(*sources.front());
    why_not_ = found ? "" : found.error().path + " " + found.error().message;
    // Letting go counts after a press of the same one.
    const Port* const button = found ? *found : nullptr;
    if (button != button_) down_.reset();
    if (button != button_ && let_go_) why_not_ = "another button is connected now";
    button_ = button;
    if (lacks_.empty() && why_not_.empty() && !element_->probe.IsFedBy(let_go_by_))
      let_go_.reset();  // a value by hand was let go
    return true;
  }
  if (!is_gone_) Press({rule_.port, ", which is gone"});
  is_gone_ = true;
  lacks_.clear();
  down_.reset();  // letting go counts after a press that has come by the next connection
  const auto found = PathSearch(runtime_).FindPort(rule_.port, PathKind::kOutput);
  if (found && &(*found)->type() == &element_->probe.type()) (void)Port::Connect(**found, element_->probe);
  return true;
}

void StopButton::Press(std::initializer_list<std::string_view> by) noexcept {
  pressed_ = runtime_.robot_stop().requests() + 1;
  std::string name = "the button";
  try {
    name += " ";
    for (const std::string_view each : by) name += each;
  } catch (const std::bad_alloc&) {  // it is pressed with fewer words
  }
  if (!runtime_.robot_stop().Press(name)) return;
  told_.clear();
  try {
    tell_({rule_.port, "STOP, by " + name, runtime_.clock().Now()});
  } catch (const std::bad_alloc&) {  // who follows the STOP has been told by it
  }
}

void StopButton::TellOfHeldStop(const std::string& why) {
  if (why != std::exchange(told_, why))
    tell_({rule_.port, "does not release the STOP, as " + why, runtime_.clock().Now()});
}

}  // namespace internal

}  // namespace runnel
