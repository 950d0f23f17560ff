#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "plugins/genom_execution/component_table.h"
#include "plugins/genom_standalone/value_type.h"

namespace runnel::genom_standalone {

/// A value, as in the beginning.
class OwnedValue {
 public:
  explicit OwnedValue(const ValueType& type) : memory_(type.memory), bytes_(memory_.size) { memory_.make(data()); }
  ~OwnedValue() { memory_.destroy(data()); }
  OwnedValue(const OwnedValue&) = delete;
  OwnedValue& operator=(const OwnedValue&) = delete;

  [[nodiscard]] void* data() noexcept { return bytes_.data(); }
  void Set(const void* value) { memory_.copy(data(), value); }

 private:
  const ValueMemory& memory_;
  std::vector<std::byte> bytes_;
};

/// A port: what codels have of it, and what is exchanged with clients.
///
/// Threads: data(), Fetch() and Write() by codels, which exclude each other; the rest by any.
class StandalonePort {
 public:
  StandalonePort(const ValueType& type, bool is_input)
      : type_(type), is_input_(is_input), data_(type), has_data_(!is_input), newest_(type) {}

  /// Of an input: what was fetched last, nullptr before the first. Of an output: the component's own.
  [[nodiscard]] void* data() noexcept { return has_data_ ? data_.data() : nullptr; }
  void Fetch() {
    const std::lock_guard lock(mutex_);
    if (!has_newest_) return;
    data_.Set(newest_.data());
    has_data_ = true;
  }
  void Write() { Put(data_.data()); }
  [[nodiscard]] bool is_input() const noexcept { return is_input_; }
  [[nodiscard]] const ValueType& type() const noexcept { return type_; }

  /// Calls use(value) while nobody changes it; `value` is nullptr before the first.
  template <typename Use>
  auto WithNewest(Use use) {
    const std::lock_guard lock(mutex_);
    return use(has_newest_ ? newest_.data() : nullptr);
  }
  /// Takes a value's place by a copy.
  void Put(const void* value) {
    const std::lock_guard lock(mutex_);
    newest_.Set(value);
    has_newest_ = true;
  }

 private:
  const ValueType& type_;
  const bool is_input_;
  OwnedValue data_;
  bool has_data_;
  std::mutex mutex_;
  OwnedValue newest_;
  bool has_newest_ = false;
};

/// `port multiple`: ports by names, made when they are opened or put to; who has one keeps it when it is closed.
///
/// Threads: any.
class StandaloneMultiplePort {
 public:
  StandaloneMultiplePort(const ValueType& type, bool is_input) : type_(type), is_input_(is_input) {}

  [[nodiscard]] std::shared_ptr<StandalonePort> Find(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = ports_.find(name);
    return found != ports_.end() ? found->second : nullptr;
  }
  std::shared_ptr<StandalonePort> Open(const std::string& name) {
    const std::lock_guard lock(mutex_);
    auto& port = ports_[name];
    if (port == nullptr) port = std::make_shared<StandalonePort>(type_, is_input_);
    return port;
  }
  bool Close(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return ports_.erase(name) > 0;
  }
  [[nodiscard]] bool is_input() const noexcept { return is_input_; }

 private:
  const ValueType& type_;
  const bool is_input_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<StandalonePort>> ports_;
};

struct StandaloneParameter {
  const char* name;
  std::size_t offset;  ///< in the data of a request
  const ValueType* type;
  bool is_input;
  bool is_output;
  const char* initial = "";  ///< JSON, "" if the description says none
};

struct StandaloneService {
  std::span<const StandaloneParameter> parameters = {};
};

struct StandalonePortEntry {
  const char* name;
  StandalonePort* port;  ///< or
  StandaloneMultiplePort* ports = nullptr;
};

struct StandaloneDetail {
  genom_execution::Event exception;
  const ValueType* type;
};

/// A component as a process: what a template makes, for RunStandalone().
struct StandaloneComponent {
  const genom_execution::ComponentTable& table;
  void* ids;                                         ///< made; nullptr: it has none
  std::span<const StandaloneService> services = {};  ///< as in the table
  std::span<const StandalonePortEntry> ports = {};
  std::span<const StandaloneDetail> details = {};
};

/// A value as JSON.
[[nodiscard]] std::string TextOf(const ValueType& type, const void* value);

/// The main function of such a process: runs the component by threads of its own, one for each task, and answers requests
/// in JSON lines over a Unix socket until it is told to end, or by SIGINT or SIGTERM. With --stepped it has no thread and no
/// clock but what requests say, and does the same each time. Returns the process' exit code.
[[nodiscard]] int RunStandalone(const StandaloneComponent& component, int count, char** words);

}  // namespace runnel::genom_standalone
