#include "core/port/connection_rules.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "core/element/attempt.h"
#include "core/port/port.h"

namespace runnel {

namespace {

struct RuleRegistry {
  std::mutex mutex;
  std::vector<ConnectionRule> rules;
  std::atomic<bool> has_some{false};  // so that those who have none pay nothing
};

RuleRegistry& Rules() {
  static RuleRegistry registry;
  return registry;
}

}  // namespace

void AddConnectionRule(ConnectionRule rule) {
  RuleRegistry& registry = Rules();
  const std::lock_guard lock(registry.mutex);
  std::erase_if(registry.rules, [&](const ConnectionRule& each) { return each.name == rule.name; });
  if (rule.check) {
    const auto place = std::ranges::upper_bound(registry.rules, rule.name, {}, &ConnectionRule::name);
    registry.rules.insert(place, std::move(rule));
  }
  // relaxed: whoever looks has the lock then.
  registry.has_some.store(!registry.rules.empty(), std::memory_order_relaxed);
}

std::vector<ConnectionRule> ConnectionRules() {
  RuleRegistry& registry = Rules();
  const std::lock_guard lock(registry.mutex);
  return registry.rules;
}

Result<void> CheckConnectionRules(const Port& from, const Port& to) {
  if (!Rules().has_some.load(std::memory_order_relaxed)) return {};
  for (const ConnectionRule& rule : ConnectionRules()) {
    const Result<void> allowed = Attempt([&] { return rule.check(from, to); });
    if (allowed) continue;
    Error error = allowed.error().WithContext("must not be connected to " + to.path()).WithPath(from.path());
    error.message += " (rule '" + rule.name + "')";
    return error;
  }
  return {};
}

}  // namespace runnel
