#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/element/configurable.h"
#include "core/element/framework_element.h"
#include "core/paths/path_search.h"

namespace runnel {

/// One parameter that stands for several of what is within a group, and so belongs to its interface: who sets it sets
/// all of them. It has no value of its own but that of the first; its type, unit and bounds are the first one's, and
/// each of them has to take the value.
///
///     GroupParameter radius{{group, "radius"}, {"left/radius", "right/radius"}};
///
/// The targets are found by their paths when they are needed, so they may be swapped, and come and go.
///
/// Threads:  as Configurable, but Parse(), Check() and Value() under the structure lock, too.
class GroupParameter final : public FrameworkElement, public Configurable {
 public:
  /// `targets` as seen from the parent; those that are not there yet are looked for later.
  explicit GroupParameter(const Placement& placement, std::vector<std::string> targets = {},
                          std::string description = {});

  /// One more. Under the structure lock.
  void Add(std::string target);
  [[nodiscard]] const std::vector<std::string>& targets() const noexcept { return targets_; }
  /// The same parameters by their paths of now: some have got other names. Under the structure lock.
  void SetPaths(std::vector<std::string> targets) noexcept { targets_ = std::move(targets); }
  /// Those that are there now.
  [[nodiscard]] std::vector<ConfigurableElement> Find() const;

  [[nodiscard]] Result<std::shared_ptr<const void>> Parse(std::string_view text) const override;
  [[nodiscard]] Result<void> Check(const void* value) const override;
  /// All or none. Errors: besides, that nothing is there that could be set.
  Result<void> Put(const Own& own) override;
  /// Of the first.
  [[nodiscard]] Values values() const override;
  [[nodiscard]] std::shared_ptr<void> Value() const override;
  /// Of the first target that was there when somebody asked.
  [[nodiscard]] const TypeInfo& type() const override {
    LookAtFirst();
    return *type_;
  }
  [[nodiscard]] const ConfigurableInfo& info() const override {
    LookAtFirst();
    return info_;
  }

 private:
  void LookAtFirst() const;

  std::vector<std::string> targets_;
  // Guarded by the structure lock until the first target has been seen.
  mutable std::atomic<bool> has_looked_{false};
  mutable const TypeInfo* type_;
  mutable ConfigurableInfo info_;
};

}  // namespace runnel
