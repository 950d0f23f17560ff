#include "plugins/parameters/parameter_base.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <mutex>
#include <utility>

#include "core/base/characters.h"
#include "core/base/unit.h"
#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/paths/new_feeds.h"
#include "core/port/typed_ports.h"

namespace runnel {

namespace {

std::string NumberText(double number) {
  std::array<char, 400> digits{};  // the largest number has 309
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed);
  return {digits.data(), end.ptr};
}

constexpr const char* kGroupName = "parameter";

// Owned by the module like any element made at run time; the parameters in it belong to the
// module's C++ object and are gone before the module deletes what it owns.
FrameworkElement& ParameterGroup(FrameworkElement& module) {
  if (FrameworkElement* group = module.FindChild(kGroupName)) return *group;
  return module.runtime().Create<PortGroup>(module, kGroupName);
}

// What no file can carry could not be saved.
Result<void> CheckCharacters(std::string_view text) {
  const std::string fault = UnwritableCharacter(text);
  if (fault.empty()) return {};
  return Error{.message = "the value contains " + fault};
}

}  // namespace

Result<std::string> NumberInUnit(std::string_view text, std::string_view unit) {
  const std::string_view all = Trimmed(text);
  const std::string_view digits = all.substr(all.starts_with('+') ? 1 : 0);
  double number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const std::string_view own = Trimmed(digits.substr(static_cast<std::size_t>(read.ptr - digits.data())));
  if (read.ec != std::errc() || !std::isfinite(number) || own.empty()) return std::string(text);
  if (own == unit) return std::string(digits.substr(0, static_cast<std::size_t>(read.ptr - digits.data())));
  const std::string quoted = "'" + std::string(all) + "'";
  const auto from = ParseUnit(own);
  if (unit.empty()) {
    if (!from) return std::string(text);
    return Error{.message = quoted + " has a unit where none is wanted", .hint = "write the number only"};
  }
  const std::string hint = "write it in " + std::string(unit);
  if (!from) return Error{.message = quoted + " is no number with a unit", .hint = hint};
  const auto ratio = RatioOfUnits(own, unit);
  if (!ratio) {
    return Error{.message = quoted + " is no value in " + std::string(unit), .hint = hint};
  }
  return NumberText(number * ratio->numerator / ratio->denominator);
}

ParameterBase::ParameterBase(FrameworkElement* module, std::string name, internal::ParameterDescription description,
                             const void* default_value)
    : FrameworkElement({ParameterGroup(*module), std::move(name)}, ElementKind::kParameter),
      description_(std::move(description)),
      module_(dynamic_cast<Module*>(module)) {
  if (!description_.is_within_bounds || description_.is_within_bounds(default_value)) return;
  const std::string unit = info().unit.empty() ? "" : " " + info().unit;
  throw ElementError({.message = "its default, " + info().default_value + unit + ", is out of its bounds",
                      .path = path(),
                      .hint = "they are " + info().bounds + unit});
}

ParameterBase::~ParameterBase() = default;

Result<std::shared_ptr<const void>> ParameterBase::Parse(std::string_view text) const {
  if (auto good = CheckCharacters(text); !good) return good.error();
  const auto readable = description_.is_number ? NumberInUnit(text, info().unit) : Result(std::string(text));
  if (!readable) return readable.error();
  const std::shared_ptr<void> value = type().Make();
  if (auto read = runnel::SetFromText(type(), *readable, value.get()); !read) {
    Error error = read.error();
    if (description_.is_number && error.hint.empty() && !info().unit.empty()) {
      error.hint = "write a number; without a unit it is in " + info().unit;
    }
    return error;
  }
  if (auto good = Check(value.get()); !good) return good.error();
  return std::shared_ptr<const void>(value);
}

Result<void> ParameterBase::Check(const void* value) const {
  if (description_.is_within_bounds && !description_.is_within_bounds(value)) {
    const std::string unit = info().unit.empty() ? "" : " " + info().unit;
    return Error{.message = runnel::ToText(type(), value) + unit + " is out of bounds",
                 .hint = "allowed is " + info().bounds + unit};
  }
  if (!description_.is_number) return CheckCharacters(runnel::ToText(type(), value));
  return {};
}

Result<void> ParameterBase::Put(const Own& own) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (info().is_static && life_cycle() == LifeCycle::kReady) {
    return Error{.message = "the parameter is static: it can be set only before its module is ready",
                 .path = path(),
                 .hint = "set it in the application file, or have a change do it, which makes the module anew"};
  }
  if (info().is_static && parent()->parent()->has_constructed()) {
    return Error{.message = "the parameter is static, and ports have been made by it already",
                 .path = path(),
                 .hint = "set it before anything is connected"};
  }
  if (auto good = Check(own.value.get()); !good) return good.error().WithPath(path());
  // A cycle in which an output feeds the parameter may be about to do the same: that tries, and this waits.
  const std::lock_guard assigning(assigning_);
  const bool is_unset = own.settings != 0 && !own.is_set();
  const bool is_default = is_unset && runnel::ToText(type(), own.value.get()) == info().default_value;
  const std::uint64_t given = std::min(own.given, LastNumber());
  const bool was_fed = is_fed(), is_to_be_fed = given < given_.load(std::memory_order_relaxed);
  if (was_fed != is_to_be_fed || !was_fed) {
    auto last_given = was_fed ? Value() : last_given_;
    Assume(is_to_be_fed ? last_given_.get() : own.value.get());
    last_given_ = std::move(last_given);
  }
  if (own_) own_ = own.value;
  own_given_.store(given, std::memory_order_relaxed);
  const bool is_of_this = own.settings >> Own::kSettingsBits == id();
  settings_ = is_of_this ? own.settings : is_default ? id() << Own::kSettingsBits : settings_ + 1;
  return {};
}

std::uint64_t ParameterBase::LastNumber() const noexcept {
  return std::max(given_.load(std::memory_order_relaxed), refused_.load(std::memory_order_relaxed));
}

// What another module has refused, and nothing has come since.
bool ParameterBase::IsToReadAgain() const noexcept {
  const std::uint64_t refused = refused_.load(std::memory_order_relaxed);
  return refused > std::max(given_.load(std::memory_order_relaxed), own_given_.load(std::memory_order_relaxed));
}

// Under `assigning_`.
void ParameterBase::Assume(const void* value) {
  if (Assign(value) && module_ != nullptr) module_->NoteParameterChange();
}

// Of what an output publishes, only texts are looked at: all else would have to be written for it.
bool ParameterBase::MayBeFed(const void* value) const {
  if (description_.is_within_bounds && !description_.is_within_bounds(value)) return false;
  return &type() != &TypeOf<std::string>() || CheckCharacters(*static_cast<const std::string*>(value)).has_value();
}

// A task of its own, run where the module is, so that parameters that nothing feeds cost no cycle anything.
class ParameterBase::Feeder final : public FrameworkElement {
 public:
  Feeder(const Placement& placement, ParameterBase& parameter, const TypedPorts& ports)
      : FrameworkElement(placement, ElementKind::kPortGroup),
        parameter_(parameter),
        held_(ports.MakeHeldValues(1)),
        input_(ports.MakeInput(*this, parameter.name(), {.description = "sets the parameter", .trigger = true})) {
    Annotate(std::make_unique<Executable>([this]() -> std::vector<Task> {
      return {{this, Phase::kSense, BoundCall::To<&Feeder::Take>(*this), {this}, {}}};
    }));
  }

  [[nodiscard]] Port& input() noexcept { return *input_; }
  void Take() {
    const bool is_new = held_->Read(*input_, 0) || is_left_;
    if (!is_new && !parameter_.IsToReadAgain()) return;
    const std::unique_lock lock(parameter_.assigning_, std::try_to_lock);
    is_left_ = is_new && !lock;
    if (!lock || (!is_new && !parameter_.IsToReadAgain())) return;  // somebody sets it just now: in the next cycle
    const void* const value = held_->Find(0);
    // What an input that is made later gives is newer, wherever the module has been made again.
    const std::uint64_t number = std::max(parameter_.LastNumber(), id() << Own::kSettingsBits) + 1;
    if (value != nullptr && parameter_.MayBeFed(value)) {
      parameter_.Assume(value);
      parameter_.given_.store(number, std::memory_order_relaxed);
    } else if (value != nullptr && is_new) {
      parameter_.refused_.store(number, std::memory_order_relaxed);
    }
    held_->Drop(0);
  }

 private:
  ParameterBase& parameter_;
  const std::unique_ptr<HeldValues> held_;
  const std::unique_ptr<Port> input_;
  bool is_left_ = false;  // a value that has not been taken over yet
};

// It may have gone again.
bool ParameterBase::HasFeeder() const { return feeder_ != nullptr && FindChild("feed") == feeder_; }

Configurable::Values ParameterBase::values() const {
  const Own own{own_ ? own_ : Value(), own_given_.load(std::memory_order_relaxed), settings_};
  // The module may run: a value that is newer than its number is none the less the last.
  const std::uint64_t number = given_.load(std::memory_order_relaxed);
  const auto given = number > own.given ? Value() : last_given_;
  const std::uint64_t refused = refused_.load(std::memory_order_relaxed);
  return {&type(), description_.is_number ? info().unit : "", own, given, number, refused};
}

void ParameterBase::TakeFeed() {
  if (HasFeeder()) feeder_->Take();
}

Result<void> ParameterBase::TakeGiven(const Values& other) {
  if (info().is_static) return {};
  const bool is_there = other.number > given_.load(std::memory_order_relaxed);
  const bool is_good = is_there && IsLike(other) && MayBeFed(other.given.get());
  const auto value = is_there && !is_good ? ConvertedFrom(other, other.given) : Result(other.given);
  const std::lock_guard assigning(assigning_);
  // What is refused is newer than what was given before, which does not count any more.
  const std::uint64_t refused = std::max(other.refused, value ? 0 : other.number);
  refused_.store(std::max(refused, refused_.load(std::memory_order_relaxed)), std::memory_order_relaxed);
  if (value && !is_there) return {};
  if (!own_) own_ = Value();
  given_.store(value ? other.number : 0, std::memory_order_relaxed);
  Assume(is_fed() ? value->get() : own_.get());
  last_given_ = value ? *value : nullptr;
  return value ? Result<void>() : value.error().WithPath(path());
}

Port* ParameterBase::Feed() {
  const TypedPorts* const ports = FindTypedPorts(type());
  if (ports == nullptr || info().is_static || life_cycle() == LifeCycle::kDeleted) return nullptr;
  if (!own_) own_ = Value();
  if (!HasFeeder()) {
    feeder_ = &runtime().Create<Feeder>(*this, "feed", *this, *ports);
    NewFeeds::Note(feeder_->input());
  }
  if (life_cycle() == LifeCycle::kReady && feeder_->life_cycle() == LifeCycle::kConstructed) {
    (void)runtime().MakeReady(*feeder_);
  }
  return &feeder_->input();
}

}  // namespace runnel
