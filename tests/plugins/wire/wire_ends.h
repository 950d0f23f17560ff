#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "plugins/wire/wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

inline std::shared_ptr<Octets> Four(int value) {
  return std::make_shared<Octets>(Octets{std::byte(0), std::byte(1), std::byte(0), std::byte(value)});
}

/// Who is there, as one member is told.
class Members final : public WireDiscovery {
 public:
  void OnMember(const WireMember& member) override {
    const std::lock_guard lock(mutex_);
    members_.push_back(member);
  }
  void OnMemberGone(const WireId& id) override {
    const std::lock_guard lock(mutex_);
    std::erase_if(members_, [&](const WireMember& each) { return each.id == id; });
  }
  void OnEndpoint(const WireEndpoint& endpoint) override {
    const std::lock_guard lock(mutex_);
    endpoints_.push_back(endpoint);
  }
  void OnEndpointGone(const WireId& id) override {
    const std::lock_guard lock(mutex_);
    std::erase_if(endpoints_, [&](const WireEndpoint& each) { return each.id == id; });
  }
  [[nodiscard]] std::vector<WireMember> members() const {
    const std::lock_guard lock(mutex_);
    return members_;
  }
  [[nodiscard]] std::vector<WireEndpoint> endpoints() const {
    const std::lock_guard lock(mutex_);
    return endpoints_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<WireMember> members_;
  std::vector<WireEndpoint> endpoints_;
};

/// What has come to a reader.
struct Arrived {
  std::mutex mutex;
  std::vector<int> values;
  std::vector<std::int64_t> times;
  std::vector<std::uint64_t> writers;
  std::size_t matched = 0;

  [[nodiscard]] OnSample Taker() {
    return [this](const WireSample& sample) {
      const std::lock_guard lock(mutex);
      values.push_back(std::to_integer<int>(sample.octets[3]));
      times.push_back(sample.source_time);
      writers.push_back(sample.writer);
    };
  }
  [[nodiscard]] OnMatched Counter() {
    return [this](std::size_t count) {
      const std::lock_guard lock(mutex);
      matched = count;
    };
  }
  template <typename Is>
  void WaitFor(const Is& is) {
    WaitUntil("it has come", [&] {
      const std::lock_guard lock(mutex);
      return is(*this);
    });
  }
};

}  // namespace runnel::test
