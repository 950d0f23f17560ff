#include "plugins/wire_fast/fast_log.h"

#include <memory>
#include <mutex>
#include <utility>

#include <fastdds/dds/log/Log.hpp>

namespace runnel {

namespace {

using eprosima::fastdds::dds::Log;
using eprosima::fastdds::dds::LogConsumer;

struct Said {
  std::mutex mutex;
  std::string last;
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
    LastSaid().last = entry.message;
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

Error FastError(const std::string& what) {
  Log::Flush();
  const std::lock_guard lock(LastSaid().mutex);
  const std::string said = std::exchange(LastSaid().last, {});
  return {.message = what + (said.empty() ? "" : ": " + said)};
}

}  // namespace runnel
