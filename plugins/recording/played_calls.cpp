#include "plugins/recording/recording_player.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/module/executable.h"
#include "core/port/cycle.h"
#include "core/types/type_info.h"
#include "plugins/services/call_record.h"
#include "plugins/services/callable.h"
#include "plugins/values/foxglove_channel.h"

namespace runnel {

namespace {

constexpr std::string_view kSuffix = "_calls";
constexpr Duration kNoTimeout = std::chrono::hours(24 * 365);

}  // namespace

struct PlayedCalls::Service {
  Port* records;
  Callable* callable;
  FrameworkElement* module;
};

/// The calls of one module's services. Runs in front of its first task.
class PlayedCalls::OfModule {
 public:
  struct Made {
    Callable* callable;
    std::shared_ptr<void> record;  // a CallRecord
    Time called;
    std::unique_ptr<AnyCall> call = nullptr;  // while it is under way

    [[nodiscard]] const CallRecordBase& base() const { return *static_cast<const CallRecordBase*>(record.get()); }
  };

  OfModule(const PlayedCalls& all, FrameworkElement& module) : all_(all), module_(module) {}

  [[nodiscard]] FrameworkElement& module() const noexcept { return module_; }
  [[nodiscard]] std::size_t size() const noexcept { return calls_.size(); }
  void Add(Made made) { calls_.push_back(std::move(made)); }
  void Wrap() {
    std::ranges::stable_sort(calls_, {}, [](const Made& each) { return std::pair(each.base().begun, each.called); });
    std::vector<Task> tasks = module_.FindAnnotation<Executable>()->tasks();
    if (tasks.empty()) return;
    original_ = tasks.front().run;
    tasks.front().run = BoundCall::To<&OfModule::Run>(*this);
    module_.Annotate(std::make_unique<Executable>([tasks] { return tasks; }));
  }
  void Run() {
    if (const Cycle* const cycle = CurrentCycle()) Make(cycle->now);
    (*original_)();
  }

 private:
  void Make(Time now) {
    const Time then = now - all_.offset_;
    for (; next_ < calls_.size() && calls_[next_].base().begun <= then; ++next_) {
      Made& made = calls_[next_];
      made.call = made.callable->NewCall();
      made.call->TakeArguments(made.base());
      if (made.call->Begin(now, kNoTimeout) == CallStatus::kPending) under_way_.push_back(&made);
    }
    std::erase_if(under_way_, [&](Made* made) {
      const Time asked = made->base().asked_to_end;
      if (asked != Time() && asked <= then) made->call->Abort();
      if (made->call->Poll(now) == CallStatus::kPending) return false;
      made->call.reset();
      return true;
    });
  }

  const PlayedCalls& all_;
  FrameworkElement& module_;
  std::vector<Made> calls_;
  std::size_t next_ = 0;
  std::vector<Made*> under_way_;
  std::optional<BoundCall> original_;
};

PlayedCalls::PlayedCalls() = default;
PlayedCalls::~PlayedCalls() = default;

bool PlayedCalls::Add(Port& records, std::uint16_t channel) {
  if (!records.name().ends_with(kSuffix) || records.parent() == nullptr) return false;
  FrameworkElement* const port = records.parent()->FindChild(records.name().substr(0, records.name().size() - kSuffix.size()));
  auto* const callable = port != nullptr ? port->FindAnnotation<Callable>() : nullptr;
  FrameworkElement* module = records.parent();
  while (module != nullptr && module->FindAnnotation<Executable>() == nullptr) module = module->parent();
  if (callable == nullptr || module == nullptr) return false;
  services_.emplace(channel, Service{&records, callable, module});
  return true;
}

Result<void> PlayedCalls::Read(McapReader& reader, Time from, Time to) {
  if (services_.empty()) return {};
  return reader.ReadMessages([&](const McapMessage& message) -> Result<void> {
    const auto found = services_.find(message.channel);
    if (found == services_.end()) return {};
    const auto& [records, callable, module] = found->second;
    OfModule::Made made{callable, records->type().Make(), Time(Duration(message.publish_time))};
    if (auto read = SetFromMessage(records->type(), message.data, made.record.get()); !read) {
      Error error = read.error();
      error.path = records->path();
      return error;
    }
    const CallRecordBase& call = made.base();
    if (call.number != 0 || call.begun < from || call.begun > to) return {};
    auto of = std::ranges::find(modules_, module, [](const auto& each) { return &each->module(); });
    if (of == modules_.end()) of = modules_.insert(of, std::make_unique<OfModule>(*this, *module));
    (*of)->Add(std::move(made));
    return {};
  });
}

void PlayedCalls::WrapTasks(const std::function<bool(const FrameworkElement& module)>& runs) {
  for (const auto& each : modules_) {
    if (!runs(each->module())) continue;
    each->Wrap();
    size_ += each->size();
  }
}

}  // namespace runnel
