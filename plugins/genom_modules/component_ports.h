#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/module/port_group.h"
#include "core/port/input.h"
#include "core/port/output.h"

namespace runnel::genom_modules {

/// `port in`: read() fetches, data() has what was fetched last. Threads: the codels', one at a time.
template <typename Value>
class InPort {
 public:
  template <typename Owner>
  InPort(Owner&& owner, const std::string& name, const std::string& description)
      : input_(owner, name, {.description = description}) {}

  void Fetch() noexcept { fetched_ = input_.Read(); }
  [[nodiscard]] const Value* data() const { return fetched_ ? &*fetched_ : nullptr; }

 private:
  Input<Value> input_;
  Lease<Value> fetched_;
};

/// `port out`: data() is the component's own, write() publishes a copy of it.
template <typename Value>
class OutPort {
 public:
  template <typename Owner>
  OutPort(Owner&& owner, const std::string& name, const std::string& description)
      : output_(owner, name, {.description = description}) {}

  void Write() { output_.Publish(data_); }
  [[nodiscard]] Value* data() noexcept { return &data_; }

 private:
  Output<Value> output_;
  Value data_{};
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
    for (const auto& each : ports_) {
      if (each.name == name) return each.port.get();
    }
    return nullptr;
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
