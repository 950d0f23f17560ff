#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/module/group.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/genom_modules/codel_values.h"
#include "plugins/genom_modules/component_module.h"
#include "plugins/parameters/input_timeout.h"

namespace runnel::genom_modules {

/// That a port is of, or a group of ports below it.
inline ComponentModule& ComponentOf(const FrameworkElement& port) {
  FrameworkElement* at = port.parent();
  while (dynamic_cast<ComponentModule*>(at) == nullptr) at = at->parent();
  return dynamic_cast<ComponentModule&>(*at);
}

/// `port in`: read() fetches, data() has what was fetched last, null if that did not count (InputTimeout, `<port>_timeout`).
/// What codels have is the view itself, or made of it.
/// Threads: the codels', one at a time.
template <typename View, typename Value, bool is_view>
class InPort {
 public:
  template <typename Owner>
  InPort(Owner&& owner, const std::string& name, const std::string& description)
      : input_(owner, name, {.description = description, .ageing = Ageing::kTimesOut}) {
    component_.AddReading(reading_);
  }

  void Fetch(const genom_execution::CodelContext& context) {
    fetched_ = timeout_.Read(input_, input_.runtime().clock().Now());
    reading_.Note(context.request, fetched_ ? fetched_.timestamp() : Time::max());
    if constexpr (!is_view) {
      if (fetched_) ToCodel(value_, *fetched_);
    }
  }
  [[nodiscard]] const Value* data() const {
    if (!fetched_) return nullptr;
    if constexpr (is_view) {
      return reinterpret_cast<const Value*>(&*fetched_);
    } else {
      return &value_;
    }
  }

 private:
  struct Nothing {};
  Input<View> input_;
  ComponentModule& component_ = ComponentOf(input_);
  const std::string group_ = input_.parent()->parent() == &component_ ? "" : input_.parent()->name() + "_";
  InputTimeout timeout_{&component_, group_ + input_.name(), {.log = &component_.log()}};
  Lease<View> fetched_;
  PortReading reading_;
  [[no_unique_address]] std::conditional_t<is_view, Nothing, Value> value_{};
};

/// `port out`: data() is the component's own, write() publishes a copy of it.
template <typename View, typename Value, bool is_view>
class OutPort {
 public:
  template <typename Owner>
  OutPort(Owner&& owner, const std::string& name, const std::string& description)
      : output_(owner, name, {.description = description}), component_(ComponentOf(output_)) {}

  void Write(const genom_execution::CodelContext& context) {
    if constexpr (!is_view) ToView(view_, value_);
    output_.Publish(view_, component_.StampFor(context.request));
  }
  [[nodiscard]] Value* data() noexcept {
    if constexpr (is_view) {
      return reinterpret_cast<Value*>(&view_);
    } else {
      return &value_;
    }
  }

 private:
  struct Nothing {};
  Output<View> output_;
  const ComponentModule& component_;
  View view_{};
  [[no_unique_address]] std::conditional_t<is_view, Nothing, Value> value_{};
};

/// `port multiple`: one for each name that the module's static parameter of the same name lists, below the port's name.
template <typename Port>
class MultiplePort {
 public:
  /// In Construct().
  void Make(FrameworkElement& group, const std::string& name, const std::string& description,
            const std::vector<std::string>& names) {
    if (names.empty()) return;
    group_ = std::make_unique<PortGroup>(Placement{group, name});
    for (const std::string& each : names) {
      ports_.push_back({each, std::make_unique<Port>(*group_, each, description)});
    }
  }
  /// nullptr: there is none of that name.
  [[nodiscard]] Port* Find(std::string_view name) const {
    const auto found = std::ranges::find(ports_, name, &Named::name);
    return found == ports_.end() ? nullptr : found->port.get();
  }

 private:
  struct Named {
    std::string name;
    std::unique_ptr<Port> port;
  };
  std::unique_ptr<PortGroup> group_;
  std::vector<Named> ports_;
};

}  // namespace runnel::genom_modules
