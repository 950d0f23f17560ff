#include "plugins/wire_fast/fast_log.h"

#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include <fastdds/dds/log/Log.hpp>

namespace runnel {

namespace {

using eprosima::fastdds::dds::Log;
using eprosima::fastdds::dds::LogConsumer;

struct Said {
  std::mutex mutex;
  std::string last;
  std::string refusal;
};

// Never destroyed: Fast DDS's thread may speak when the process ends.
Said& LastSaid() {
  static auto* const said = new Said;
  return *said;
}

class Listener final : public LogConsumer {
 public:
  void Consume(const Log::Entry& entry) override {
    const std::lock_guard lock(LastSaid().mutex);
    if (entry.kind == Log::Error) LastSaid().last = entry.message;
    // Others of its kinds are told of values, again and again.
    if (std::string_view(entry.context.category) == "SECURITY_AUTHENTICATION") LastSaid().refusal = entry.message;
  }
};

}  // namespace

void HearFastLog() {
  static const bool hears = [] {
    Log::ClearConsumers();
    Log::SetVerbosity(Log::Error);
    Log::RegisterConsumer(std::make_unique<Listener>());
    return true;
  }();
  (void)hears;
}

void HearFastSecurity() { Log::SetVerbosity(Log::Warning); }

std::string TakeFastRefusal() {
  Log::Flush();
  const std::lock_guard lock(LastSaid().mutex);
  return std::exchange(LastSaid().refusal, {});
}

Error FastError(const std::string& what) {
  Log::Flush();
  const std::lock_guard lock(LastSaid().mutex);
  const std::string said = std::exchange(LastSaid().last, {});
  return {.message = what + (said.empty() ? "" : ": " + said)};
}

}  // namespace runnel
