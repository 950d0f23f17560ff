// What inputs take (Port::SetLimits()).

#include <algorithm>
#include <exception>
#include <mutex>
#include <utility>

#include "core/base/retry.h"
#include "core/conversion/number_conversion.h"
#include "core/element/runtime.h"
#include "core/port/parameter_input.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {
bool IsWithin(const InputLimits& limits, double number) {
  // What is no number is in no bounds.
  return !(limits.minimum && !(number >= *limits.minimum)) && !(limits.maximum && !(number <= *limits.maximum));
}

Result<void> CheckLimits(const Port& port, const InputLimits& limits) {
  const auto refuse = [&](std::string message) { return Error{.message = std::move(message), .path = port.path()}; };
  const bool is_input = !port.is_proxy() && port.direction() == Port::Direction::kInput;
  if (!is_input) return refuse("only an input of a module has limits");
  if (limits.has_bounds() && !internal::IsNumber(port.type())) {
    return refuse("a " + port.type().name() + " has no bounds");
  }
  if (limits.minimum && limits.maximum && *limits.minimum > *limits.maximum) {
    return refuse("its lower bound is above the upper one");
  }
  if (!limits.default_value) {
    if (limits.out_of_bounds != OutOfBounds::kDefault) return {};
    return refuse("what is out of bounds is to become the default value, and there is none");
  }
  if (&limits.default_value.type() != &port.type()) {
    return refuse("its default value is a " + limits.default_value.type().name() + " and not a " + port.type().name());
  }
  if (!port.type().is_transparent()) return refuse("a " + port.type().name() + " cannot be copied");
  if (limits.has_bounds() && !IsWithin(limits, internal::NumberIn(port.type(), limits.default_value.get()))) {
    return refuse("its default value is out of its bounds");
  }
  return {};
}
}  // namespace

Result<void> internal::CheckWithin(const Port& port, const InputLimits& limits, const void* value) {
  if (!limits.has_bounds()) return {};
  if (IsWithin(limits, NumberIn(port.type(), value))) return {};
  return Error{.message = "the value is out of the bounds of this input: " + BoundsText(limits), .path = port.path()};
}

std::string BoundsText(const InputLimits& limits) {
  const auto text = [](const std::optional<double>& bound) { return bound ? TextOf(*bound) : std::string(); };
  if (!limits.has_bounds()) return {};
  return text(limits.minimum) + (limits.minimum ? " .." : "..") + (limits.maximum ? " " : "") + text(limits.maximum);
}

Result<void> Port::SetLimits(InputLimits limits) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (!limits.has_some()) {
    if (extras_ && extras_->limits) ExchangeLimits(nullptr);
    return {};
  }
  if (auto may = CheckMayBeSet(*this); !may) return may;
  if (auto good = CheckLimits(*this, limits); !good) return good;
  auto held = std::make_unique<internal::HeldToLimits>();
  held->limits = std::move(limits);
  held->out_of_bounds = std::make_shared<std::atomic<std::uint64_t>>(0);
  auto conversion = Conversion::Of(
      type_, [limits = held->limits, count = held->out_of_bounds, &type = type_](const void* from, void* to) {
        const auto copy = [&](const void* value) { return CopyValue(type, value, to); };
        if (!limits.has_bounds()) return copy(from);
        const double number = internal::NumberIn(type, from);
        if (IsWithin(limits, number)) return copy(from);
        count->fetch_add(1, std::memory_order_relaxed);
        if (limits.out_of_bounds == OutOfBounds::kDefault) return copy(limits.default_value.get());
        // What is no number has none that is nearest.
        if (limits.out_of_bounds == OutOfBounds::kDiscard || number != number) return false;
        const bool is_below = limits.minimum && number < *limits.minimum;
        internal::SetNumber(type, to, is_below ? *limits.minimum : *limits.maximum);
        return true;
      });
  held->flow = std::make_unique<internal::ConvertedFlow>(std::move(conversion), *this, held->limits.default_value);
  ExchangeLimits(std::move(held));
  return {};
}

void Port::ExchangeLimits(std::unique_ptr<internal::HeldToLimits> limits) {
  auto& place = Extras().limits;
  auto ended = std::exchange(place, std::move(limits));
  std::exception_ptr failure;
  try {
    RebindSinks();
  } catch (...) {  // some are bound to what it was to be held by
    failure = std::current_exception();
    place.swap(ended);
    Retry([&] { RebindSinks(); });
  }
  if (ended) ended->flow->KeepOnly({});
  if (ended && ended->default_value) internal::DeleteLater(std::move(ended->default_value));
  if (failure) std::rethrow_exception(failure);
}

const InputLimits& Port::limits() const noexcept {
  static const InputLimits none;
  return extras_ && extras_->limits ? extras_->limits->limits : none;
}

std::uint64_t Port::out_of_bounds() const noexcept {
  return extras_ && extras_->limits ? extras_->limits->out_of_bounds->load(std::memory_order_relaxed) : 0;
}

Port* Port::TakerOf(const Port& source) const {
  const bool looks = extras_ && extras_->limits && by_hand() != &source &&
                     extras_->limits->default_value.get() != &source && !extras_->limits->flow->Makes(source);
  return looks ? extras_->limits->flow->InputFor(source) : const_cast<Port*>(this);
}

void Port::HoldToLimits(Links links, std::vector<Source>& sources) const {
  internal::HeldToLimits& held = *extras_->limits;
  for (Source& each : sources) {
    each.output = held.flow->OutputFor(*each.output, links == Links::kMake);
  }
  std::erase_if(sources, [](const Source& each) { return each.output == nullptr; });
  if (!sources.empty() || !held.limits.default_value) return;
  if (!held.default_value && links == Links::kMake) {
    auto channel = internal::MakeChannelFor(type_);
    if (!channel) return;
    auto output = std::make_unique<internal::StandIn>(*this, std::move(channel));
    (void)output->PublishFilled(internal::FillWith(held.limits.default_value));
    held.default_value = std::move(output);
  }
  if (held.default_value) sources.push_back({held.default_value.get(), {}});
}

}  // namespace runnel
